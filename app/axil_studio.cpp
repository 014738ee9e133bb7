/// \file
/// `axil-studio`: the window. Options in; what it does stands in ui/. Without a display it replays a session and draws what the window
/// would show.

#include "app/terminal.hpp"
#include "base/files.hpp"
#include "document/journal.hpp"
#include "render/picture.hpp"
#include "ui/ui.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <map>
#include <optional>

namespace {

using namespace axil;

struct Options {
  std::string project;
  std::string replay;
  std::string screenshot;
  int width = 1440;
  int height = 900;
  std::optional<float> scale;
  std::optional<ui::Theme> theme;
  std::optional<ui::Language> language;
};

Result<void> replay(const Options& options) {
  constexpr std::uintmax_t kMaximumSessionBytes = 100'000'000;
  ui::StudioOptions studio{.stateFolder = {}, .theme = options.theme, .language = options.language, .scale = options.scale, .screenScale = 1, .wake = {}};
  auto headless = ui::HeadlessStudio::open(std::move(studio), options.width, options.height);
  if (!headless) return headless.failure();
  if (!options.project.empty())
    if (auto opened = headless->studio().open(options.project); !opened) return opened;
  if (!options.replay.empty()) {
    const auto lines = readFile(options.replay, kMaximumSessionBytes);
    if (!lines) return lines.failure();
    if (auto ran = headless->run(*lines); !ran) return fail({ran.error().code, options.replay + ": " + ran.error().message, ran.error().details});
  }
  if (options.screenshot.empty()) return {};
  const auto picture = headless->picture();
  if (!picture) return picture.failure();
  return render::writePng(options.screenshot, *picture);
}

Result<void> window(const Options& options) {
  ui::WindowOptions window{.project = options.project, .studio = {.stateFolder = {}, .theme = options.theme, .language = options.language, .scale = options.scale, .screenScale = 1, .wake = {}}};
  // Without a home folder there is no journal; work goes on all the same.
  if (const auto folder = document::stateFolder()) window.studio.stateFolder = *folder;
  return ui::runWindow(std::move(window));
}

void describe(CLI::App& app, Options& options) {
  static const std::map<std::string, ui::Theme> themes = {{"dark", ui::Theme::Dark}, {"light", ui::Theme::Light}};
  static const std::map<std::string, ui::Language> languages = {
      {"en", ui::Language::English}, {"zh_hant", ui::Language::TraditionalChinese}, {"zh_hans", ui::Language::SimplifiedChinese}};
  app.add_option("PROJECT", options.project, "A project file, NAME.axil");
  app.add_option("--replay", options.replay, "Do a saved session's lines without a window, then end");
  app.add_option("--screenshot", options.screenshot, "Draw what the window shows into a PNG, without a window");
  app.add_option("--theme", options.theme, "dark or light; by default as last time")->transform(CLI::CheckedTransformer(themes))->option_text("THEME");
  app.add_option("--language", options.language, "en, zh_hant or zh_hans; by default as last time")->transform(CLI::CheckedTransformer(languages))->option_text("LANGUAGE");
  app.add_option("--scale", options.scale, "Size of everything, 1 to 2.5; by default as last time, at first as the screen says")->check(CLI::Range(0.5, 4.0));
  app.add_option("--width", options.width, "Of a screenshot, pixels")->check(CLI::Range(640, 8192))->capture_default_str();
  app.add_option("--height", options.height, "Of a screenshot, pixels")->check(CLI::Range(480, 8192))->capture_default_str();
  app.footer("Examples:\n  axil-studio plant.axil\n  axil-studio --replay session.txt --screenshot out.png plant.axil");
  app.set_version_flag("--version", "axil-studio " AXIL_VERSION);
}

int runStudio(int argc, char** argv) {
  CLI::App app{"Click stems across three photos, see the grammar, watch the plant grow."};
  app.name("axil-studio");
  Options options;
  describe(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const bool headless = !options.replay.empty() || !options.screenshot.empty();
  const auto done = headless ? replay(options) : window(options);
  return done ? 0 : app::report(done.error());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return runStudio(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "axil-studio: %s\n", error.what());
    return 1;
  }
}
