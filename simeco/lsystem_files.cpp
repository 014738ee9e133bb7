#include "simeco/lsystem_files.hpp"

#include "base/files.hpp"
#include "base/text.hpp"
#include "simeco/lsystem_language.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace axil::simeco {

namespace {

constexpr std::size_t kMostFiles = 64;
constexpr std::size_t kMostBytes = std::size_t{16} << 20;

struct OpenFile {
  std::string text;
  std::size_t at = 0;
};
/// Number n is the n-th, counted from 1; none: closed.
using OpenFiles = std::vector<std::optional<OpenFile>>;

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }
bool isNumberPart(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '-' || c == 'e' || c == 'E'; }

void skipSpace(OpenFile& file) {
  while (file.at < file.text.size() && isSpace(file.text[file.at])) ++file.at;
}

/// The number that stands next: the longest run of its signs that is one.
std::optional<double> numberNext(OpenFile& file, bool whole) {
  skipSpace(file);
  constexpr std::size_t kLongest = 400;
  std::size_t end = file.at;
  while (end < file.text.size() && end - file.at < kLongest && isNumberPart(file.text[end]) && !(whole && (file.text[end] == '.' || file.text[end] == 'e' || file.text[end] == 'E'))) ++end;
  for (; end > file.at; --end) {
    std::string digits = file.text.substr(file.at, end - file.at);
    if (digits.starts_with('+')) digits.erase(0, 1);
    if (digits.starts_with('.')) digits.insert(0, "0");
    if (digits.ends_with('.')) digits += '0';
    const auto value = parseNumber(digits);
    if (!value) continue;
    file.at = end;
    return value;
  }
  return std::nullopt;
}

double scan(OpenFile& file, std::string_view format, std::span<double> values) {
  std::size_t read = 0;
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (isSpace(format[i])) {
      skipSpace(file);
    } else if (format[i] != '%') {
      if (file.at >= file.text.size() || file.text[file.at] != format[i]) break;
      ++file.at;
    } else {
      while (i + 1 < format.size() && (format[i + 1] == 'l' || (format[i + 1] >= '0' && format[i + 1] <= '9'))) ++i;
      const char kind = ++i < format.size() ? format[i] : ' ';
      if (read >= values.size()) break;
      const auto value = numberNext(file, kind == 'd' || kind == 'i');
      if (!value) return read == 0 && file.at >= file.text.size() ? -1 : static_cast<double>(read);
      values[read++] = *value;
    }
  }
  return static_cast<double>(read);
}

std::string_view lineOf(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

double opened(OpenFiles& files, const IncludeReader& reader, std::string_view text) {
  const std::string name(lineOf(text));
  if (files.size() >= kMostFiles) return 0;
  if (!lineOf(text).starts_with('r')) {
    files.emplace_back(OpenFile{});  // nothing is written: it stays empty
    return static_cast<double>(files.size());
  }
  auto content = reader(name);
  if (!content || content->size() > kMostBytes) return 0;
  files.emplace_back(OpenFile{*std::move(content), 0});
  return static_cast<double>(files.size());
}

}  // namespace

FileHost filesBeside(const std::filesystem::path& grammar) {
  return [files = std::make_shared<OpenFiles>(), reader = includesBeside(grammar)](FileCall call, std::string_view text, std::span<double> values) -> Result<double> {
    if (call == FileCall::Open) return opened(*files, reader, text);
    const double number = values[0];
    const bool known = number >= 1 && number <= static_cast<double>(files->size()) && (*files)[static_cast<std::size_t>(number) - 1];
    if (!known) return call == FileCall::Scan ? -1.0 : 0.0;
    auto& file = (*files)[static_cast<std::size_t>(number) - 1];
    if (call == FileCall::Close) {
      file.reset();
      return 0.0;
    }
    return scan(*file, lineOf(text), values.subspan(1));
  };
}

}  // namespace axil::simeco
