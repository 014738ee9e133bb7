#include "ui/preferences.hpp"

#include "base/files.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace axil::ui {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "studio.txt";
constexpr std::uintmax_t kMaximumBytes = 100'000;
constexpr std::array<const char*, 2> kThemes = {"dark", "light"};
constexpr std::array<const char*, 3> kLanguages = {"en", "zh_hant", "zh_hans"};

template <class Value, std::size_t N>
void readNamed(std::optional<Value>& value, std::string_view word, const std::array<const char*, N>& names) {
  for (std::size_t i = 0; i < N; ++i)
    if (word == names[i]) value = static_cast<Value>(i);
}

void readNumber(float& number, std::string_view word) {
  if (const auto read = parseNumber(word); read && std::isfinite(*read)) number = static_cast<float>(*read);
}

void readLine(Preferences& preferences, std::string_view line) {
  const std::size_t tab = line.find('\t');
  if (tab == std::string_view::npos) return;
  const std::string_view key = line.substr(0, tab), value = line.substr(tab + 1);
  if (key == "theme") readNamed(preferences.theme, value, kThemes);
  if (key == "language") readNamed(preferences.language, value, kLanguages);
  if (key == "scale") {
    float scale = 0;
    readNumber(scale, value);
    if (scale >= 0.5f && scale <= 4) preferences.scale = scale;
  }
  if (key == "left") readNumber(preferences.layout.left, value);
  if (key == "right") readNumber(preferences.layout.right, value);
  if (key == "across") readNumber(preferences.layout.across, value);
  if (key == "down") readNumber(preferences.layout.down, value);
  if (key == "recent" && !value.empty() && preferences.recent.size() < kMostRecent) preferences.recent.emplace_back(value);
}

}  // namespace

Layout withinReason(Layout layout) {
  return {std::clamp(layout.left, 200.0f, 520.0f), std::clamp(layout.right, 200.0f, 520.0f), std::clamp(layout.across, 0.15f, 0.85f),
          std::clamp(layout.down, 0.15f, 0.85f)};
}

std::string print(const Preferences& preferences) {
  std::string text;
  const auto line = [&](const char* key, const std::string& value) { text += std::string(key) + "\t" + value + "\n"; };
  const auto number = [](float value) { return shortest(roundedTo(static_cast<double>(value), 4)); };
  if (preferences.theme) line("theme", kThemes[static_cast<std::size_t>(*preferences.theme)]);
  if (preferences.language) line("language", kLanguages[static_cast<std::size_t>(*preferences.language)]);
  if (preferences.scale) line("scale", number(*preferences.scale));
  line("left", number(preferences.layout.left));
  line("right", number(preferences.layout.right));
  line("across", number(preferences.layout.across));
  line("down", number(preferences.layout.down));
  for (const fs::path& project : preferences.recent)
    if (project.string().find('\n') == std::string::npos) line("recent", project.string());
  return text;
}

Preferences parsePreferences(std::string_view text) {
  Preferences preferences;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    readLine(preferences, text.substr(at, end - at));
    at = end + 1;
  }
  preferences.layout = withinReason(preferences.layout);
  return preferences;
}

Preferences readPreferences(const fs::path& stateFolder) {
  if (stateFolder.empty()) return {};
  const auto text = readFile(stateFolder / kFile, kMaximumBytes);
  return text ? parsePreferences(*text) : Preferences{};
}

Result<void> writePreferences(const fs::path& stateFolder, const Preferences& preferences) {
  std::error_code ignored;
  fs::create_directories(stateFolder, ignored);
  return writeFile(stateFolder / kFile, print(preferences));
}

void rememberProject(Preferences& preferences, const fs::path& project) {
  std::erase(preferences.recent, project);
  preferences.recent.insert(preferences.recent.begin(), project);
  if (preferences.recent.size() > kMostRecent) preferences.recent.resize(kMostRecent);
}

}  // namespace axil::ui
