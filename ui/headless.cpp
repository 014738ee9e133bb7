#define GL_GLEXT_PROTOTYPES
#include "ui/headless.hpp"

#include "base/text.hpp"
#include "render/drawing_context.hpp"
#include "render/picture.hpp"
#include "ui/drawing.hpp"

#include <GL/gl.h>
#include <GL/glext.h>
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <array>
#include <chrono>
#include <cstring>
#include <functional>
#include <map>
#include <sstream>
#include <thread>

namespace axil::ui {
namespace {

/// A picture in the graphics memory that frames are drawn into.
class Canvas {
 public:
  Canvas(int width, int height) : width_(width), height_(height) {
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glGenFramebuffers(1, &buffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, buffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  }
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas() {
    glDeleteFramebuffers(1, &buffer_);
    glDeleteTextures(1, &texture_);
  }
  void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, buffer_); }
  [[nodiscard]] render::Image image() const {
    render::Image image{width_, height_, {}};
    const std::size_t row = static_cast<std::size_t>(width_) * 3;
    std::vector<std::uint8_t> upsideDown(row * static_cast<std::size_t>(height_));
    glBindFramebuffer(GL_FRAMEBUFFER, buffer_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upsideDown.data());
    image.rgb.resize(upsideDown.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(height_); ++y)
      std::memcpy(&image.rgb[y * row], &upsideDown[(static_cast<std::size_t>(height_) - 1 - y) * row], row);
    return image;
  }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  int width_, height_;
  GLuint texture_ = 0, buffer_ = 0;
};

/// The keys of a keyboard, numbered as the desktop window numbers them.
void nameKeys(ImGuiIO& io) {
  const std::pair<ImGuiKey, int> keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB}, {ImGuiKey_LeftArrow, GLFW_KEY_LEFT}, {ImGuiKey_RightArrow, GLFW_KEY_RIGHT}, {ImGuiKey_UpArrow, GLFW_KEY_UP}, {ImGuiKey_DownArrow, GLFW_KEY_DOWN}, {ImGuiKey_Home, GLFW_KEY_HOME},
                                           {ImGuiKey_End, GLFW_KEY_END}, {ImGuiKey_Delete, GLFW_KEY_DELETE}, {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE}, {ImGuiKey_Space, GLFW_KEY_SPACE},
                                           {ImGuiKey_Enter, GLFW_KEY_ENTER}, {ImGuiKey_Escape, GLFW_KEY_ESCAPE}, {ImGuiKey_A, GLFW_KEY_A}, {ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [name, number] : keys) io.KeyMap[name] = number;
}

std::optional<int> keyNamed(const std::string& name) {
  static const std::map<std::string, int> kKeys = {{"escape", GLFW_KEY_ESCAPE}, {"delete", GLFW_KEY_DELETE}, {"f1", GLFW_KEY_F1}, {"enter", GLFW_KEY_ENTER}, {"slash", GLFW_KEY_SLASH},
                                                   {"backspace", GLFW_KEY_BACKSPACE}, {"space", GLFW_KEY_SPACE}, {"up", GLFW_KEY_UP}, {"down", GLFW_KEY_DOWN}, {"home", GLFW_KEY_HOME}, {"end", GLFW_KEY_END}};
  if (const auto key = kKeys.find(name); key != kKeys.end()) return key->second;
  if (name.size() == 1 && name[0] >= 'a' && name[0] <= 'z') return GLFW_KEY_A + (name[0] - 'a');
  if (name.size() == 1 && name[0] >= '0' && name[0] <= '9') return GLFW_KEY_0 + (name[0] - '0');
  return std::nullopt;
}

std::vector<std::string> wordsOf(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

}  // namespace

struct HeadlessStudio::Inside {
  std::optional<render::DrawingContext> context;
  std::unique_ptr<Canvas> canvas;
  bool started = false;
  std::optional<Studio> studio;

  ~Inside() {
    studio.reset();
    if (started) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui::DestroyContext();
    }
    canvas.reset();
  }

  enum class Drawing { Done, Skipped };
  void frame(Drawing drawing = Drawing::Skipped) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(canvas->width()), static_cast<float>(canvas->height())};
    io.DeltaTime = 1 / 60.0f;
    prepareDrawing(*studio);
    ImGui::NewFrame();
    studio->frame();
    ImGui::Render();
    if (drawing == Drawing::Skipped) return;
    canvas->bind();
    draw(*studio, canvas->width(), canvas->height());
  }

  Result<void> wait() {
    using namespace std::chrono_literals;
    const auto latest = std::chrono::steady_clock::now() + 120s;
    for (int quietFrames = 0; quietFrames < 3;) {
      frame();
      quietFrames = studio->isBusy() ? 0 : quietFrames + 1;
      if (quietFrames == 0) std::this_thread::sleep_for(2ms);
      if (std::chrono::steady_clock::now() > latest) return fail(ErrorCode::LimitReached, "the work in the background did not end within two minutes");
    }
    frame(Drawing::Done);
    return {};
  }

  // ---- a hand ------------------------------------------------------------------------------------------------------------------

  using Words = std::vector<std::string>;

  Result<ImVec2> onScreen(const std::string& view, const std::string& x, const std::string& y) {
    const auto px = parseNumber(x), py = parseNumber(y);
    if (!px || !py) return fail(ErrorCode::BadInput, "a place is two numbers, not " + x + " " + y);
    const auto& frames = studio->state().shownFrames;
    const auto shown = frames.find(view);
    if (shown == frames.end()) return fail(ErrorCode::NotFound, "no pane shows the view " + view);
    const auto& [lens, middle] = shown->second;
    return ImVec2(static_cast<float>(middle.x + (*px - lens.centre.x) * lens.zoom), static_cast<float>(middle.y + (*py - lens.centre.y) * lens.zoom));
  }

  void moveTo(ImVec2 place) {
    ImGui::GetIO().MousePos = place;
    frame();
    frame();
  }
  void clickAt(ImVec2 place) {
    moveTo(place);
    ImGui::GetIO().MouseDown[0] = true;
    frame();
    ImGui::GetIO().MouseDown[0] = false;
    frame();
    frame();
  }
  void dragTo(ImVec2 from, ImVec2 to, int button) {
    moveTo(from);
    ImGui::GetIO().MouseDown[button] = true;
    frame();
    for (int i = 1; i <= 4; ++i) {
      const float share = static_cast<float>(i) / 4;
      moveTo({from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share});
    }
    ImGui::GetIO().MouseDown[button] = false;
    frame();
    frame();
  }

  Result<void> click(const Words& w) {
    const auto at = onScreen(w[0], w[1], w[2]);
    if (!at) return at.failure();
    clickAt(*at);
    return {};
  }
  Result<void> shiftClick(const Words& w) {
    ImGui::GetIO().KeyShift = true;
    auto done = click(w);
    ImGui::GetIO().KeyShift = false;
    return done;
  }
  Result<void> menu(const Words& w) {
    const auto at = onScreen(w[0], w[1], w[2]);
    if (!at) return at.failure();
    moveTo(*at);
    ImGui::GetIO().MouseDown[1] = true;
    frame();
    ImGui::GetIO().MouseDown[1] = false;
    frame();
    frame();
    return {};
  }
  Result<void> pull(const Words& w) {
    const auto place = studio->state().landmarks.find(w[0]);
    const auto dx = parseNumber(w[1]), dy = parseNumber(w[2]);
    if (place == studio->state().landmarks.end()) return fail(ErrorCode::NotFound, "nothing is called " + w[0]);
    if (!dx || !dy) return fail(ErrorCode::BadInput, "ui pull takes two numbers");
    const auto [x, y, width, height] = place->second;
    const ImVec2 from{x + width / 2, y + height / 4};
    dragTo(from, {from.x + static_cast<float>(*dx), from.y + static_cast<float>(*dy)}, 0);
    return {};
  }
  Result<void> clickIn(const Words& w) {
    const auto place = studio->state().landmarks.find(w[0]);
    const auto x = parseNumber(w[1]), y = parseNumber(w[2]);
    if (place == studio->state().landmarks.end()) return fail(ErrorCode::NotFound, "nothing is called " + w[0]);
    if (!x || !y) return fail(ErrorCode::BadInput, "ui click_in takes two numbers");
    clickAt({place->second[0] + static_cast<float>(*x), place->second[1] + static_cast<float>(*y)});
    return {};
  }
  Result<void> move(const Words& w) {
    const auto at = onScreen(w[0], w[1], w[2]);
    if (!at) return at.failure();
    moveTo(*at);
    return {};
  }
  Result<void> drag(const Words& w) {
    const auto from = onScreen(w[0], w[1], w[2]), to = onScreen(w[0], w[3], w[4]);
    if (!from) return from.failure();
    if (!to) return to.failure();
    dragTo(*from, *to, 0);
    return {};
  }
  Result<void> wheel(const Words& w) {
    const auto at = onScreen(w[0], w[1], w[2]);
    const auto notches = parseNumber(w[3]);
    if (!at) return at.failure();
    if (!notches) return fail(ErrorCode::BadInput, "ui wheel takes a number of notches");
    moveTo(*at);
    ImGui::GetIO().MouseWheel = static_cast<float>(*notches);
    frame();
    frame();
    return {};
  }
  Result<void> pan(const Words& w) {
    const auto place = studio->state().landmarks.find("pane_" + w[0]);
    const auto dx = parseNumber(w[1]), dy = parseNumber(w[2]);
    if (place == studio->state().landmarks.end()) return fail(ErrorCode::NotFound, "no pane shows the view " + w[0]);
    if (!dx || !dy) return fail(ErrorCode::BadInput, "ui pan takes two numbers");
    const auto [x, y, width, height] = place->second;
    const ImVec2 from{x + width / 2, y + height / 2};
    dragTo(from, {from.x + static_cast<float>(*dx), from.y + static_cast<float>(*dy)}, 2);
    return {};
  }
  Result<void> press(const Words& w) {
    frame();
    const auto place = studio->state().landmarks.find(w[0]);
    if (place == studio->state().landmarks.end()) return fail(ErrorCode::NotFound, "nothing called " + w[0] + " can be pressed now");
    const auto [x, y, width, height] = place->second;
    clickAt({x + width / 2, y + height / 2});
    return {};
  }
  Result<void> key(const Words& w) {
    ImGuiIO& io = ImGui::GetIO();
    std::string name = w[0];
    for (std::size_t plus = name.find('+'); plus != std::string::npos; plus = name.find('+')) {
      const std::string held = name.substr(0, plus);
      (held == "ctrl" ? io.KeyCtrl : held == "alt" ? io.KeyAlt : io.KeyShift) = true;
      name = name.substr(plus + 1);
    }
    const auto number = keyNamed(name);
    if (number) {
      io.KeysDown[*number] = true;
      frame();
      io.KeysDown[*number] = false;
    }
    io.KeyCtrl = io.KeyShift = io.KeyAlt = false;
    frame();
    if (!number) return fail(ErrorCode::BadInput, "no key is called " + name);
    return {};
  }
  Result<void> frames(const Words& w) {
    const auto count = parseNumber(w[0]);
    if (!count || *count < 0 || *count > 10'000) return fail(ErrorCode::BadInput, "ui frames takes a number from 0 to 10000");
    for (int i = 0; i < static_cast<int>(*count); ++i) frame();
    return {};
  }
  template <class Value>
  Result<void> choose(Value& value, const std::string& word, const std::map<std::string, Value>& values) {
    const auto found = values.find(word);
    if (found == values.end()) return fail(ErrorCode::BadInput, "there is no " + word + " to choose");
    value = found->second;
    frame();
    return {};
  }
  Result<void> way(const Words& w) {
    return choose(studio->state().way, w[0], {{"describe", Way::Describe}, {"photos", Way::Photos}, {"stems", Way::Stems}, {"leaves", Way::Leaves}, {"grammar", Way::Grammar}, {"grow", Way::Grow}});
  }
  Result<void> theme(const Words& w) { return choose(studio->state().theme, w[0], {{"dark", Theme::Dark}, {"light", Theme::Light}}); }
  Result<void> language(const Words& w) {
    return choose(studio->state().language, w[0], {{"en", Language::English}, {"zh_hant", Language::TraditionalChinese}, {"zh_hans", Language::SimplifiedChinese}});
  }
  Result<void> scale(const Words& w) {
    const auto value = parseNumber(w[0]);
    if (!value || *value < 0.5 || *value > 4) return fail(ErrorCode::BadInput, "ui scale takes a number from 0.5 to 4");
    studio->state().scale = static_cast<float>(*value);
    frame();
    return {};
  }
  Result<void> time(const Words& w) {
    const auto value = parseNumber(w[0]);
    if (!value) return fail(ErrorCode::BadInput, "ui time takes a number");
    studio->state().time = *value;
    return wait();
  }
  Result<void> orbit(const Words& w) {
    const auto azimuth = parseNumber(w[0]), elevation = parseNumber(w[1]), zoom = parseNumber(w[2]);
    if (!azimuth || !elevation || !zoom || *zoom <= 0) return fail(ErrorCode::BadInput, "ui orbit takes two angles in degrees and a zoom above 0");
    studio->state().orbit = {.azimuth = Angle::fromDegrees(*azimuth), .elevation = Angle::fromDegrees(*elevation), .zoom = *zoom, .shift = {0, 0}};
    return wait();
  }
  Result<void> screenshot(const Words& w) {
    if (auto waited = wait(); !waited) return waited;
    return render::writePng(w[0], canvas->image());
  }

  Result<void> type(std::string_view text) {
    ImGui::GetIO().AddInputCharactersUTF8(std::string(text).c_str());
    frame();
    frame();
    return {};
  }

  Result<void> handLine(std::string_view line) {
    struct Row {
      std::size_t words;
      std::function<Result<void>(Inside&, const Words&)> act;
    };
    static const std::map<std::string, Row> kRows = {
        {"click", {3, &Inside::click}}, {"shift_click", {3, &Inside::shiftClick}}, {"menu", {3, &Inside::menu}}, {"pull", {3, &Inside::pull}}, {"click_in", {3, &Inside::clickIn}}, {"move", {3, &Inside::move}}, {"drag", {5, &Inside::drag}}, {"wheel", {4, &Inside::wheel}}, {"pan", {3, &Inside::pan}},
        {"press", {1, &Inside::press}}, {"key", {1, &Inside::key}}, {"frames", {1, &Inside::frames}}, {"way", {1, &Inside::way}}, {"theme", {1, &Inside::theme}},
        {"language", {1, &Inside::language}}, {"scale", {1, &Inside::scale}}, {"time", {1, &Inside::time}}, {"orbit", {3, &Inside::orbit}}, {"screenshot", {1, &Inside::screenshot}},
        {"wait", {0, [](Inside& in, const Words&) { return in.wait(); }}}};
    if (line.starts_with("type ")) return type(line.substr(5));
    Words words = wordsOf(line);
    const auto row = words.empty() ? kRows.end() : kRows.find(words.front());
    if (row == kRows.end()) return fail(ErrorCode::BadInput, "there is no ui " + std::string(line));
    if (words.size() != row->second.words + 1) return fail(ErrorCode::BadInput, "ui " + words.front() + " takes " + std::to_string(row->second.words) + " words");
    words.erase(words.begin());
    return row->second.act(*this, words);
  }

  Result<void> runLine(std::string_view line) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    if (line.empty() || line.front() == '#') return {};
    if (line.starts_with("ui ")) return handLine(line.substr(3));
    auto done = studio->runLine(line);
    frame();
    return done;
  }
};

HeadlessStudio::HeadlessStudio(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
HeadlessStudio::HeadlessStudio(HeadlessStudio&&) noexcept = default;
HeadlessStudio& HeadlessStudio::operator=(HeadlessStudio&&) noexcept = default;
HeadlessStudio::~HeadlessStudio() = default;

Result<HeadlessStudio> HeadlessStudio::open(StudioOptions options, int width_px, int height_px) {
  auto context = render::DrawingContext::open();
  if (!context) return context.failure();
  auto inside = std::make_unique<Inside>();
  inside->context.emplace(std::move(*context));
  inside->canvas = std::make_unique<Canvas>(width_px, height_px);
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  nameKeys(ImGui::GetIO());
  inside->started = true;
  if (!ImGui_ImplOpenGL3_Init("#version 150")) return fail(ErrorCode::NoAnswer, "nothing can be drawn: the drawing library does not start");
  auto studio = Studio::create(std::move(options));
  if (!studio) return studio.failure();
  inside->studio.emplace(std::move(*studio));
  inside->frame();
  return HeadlessStudio(std::move(inside));
}

Studio& HeadlessStudio::studio() { return *inside_->studio; }

Result<void> HeadlessStudio::run(std::string_view lines) {
  for (std::size_t at = 0, number = 1; at < lines.size(); ++number) {
    const std::size_t end = std::min(lines.find('\n', at), lines.size());
    if (auto done = inside_->runLine(lines.substr(at, end - at)); !done) {
      Error error = done.error();
      error.message = "line " + std::to_string(number) + ": " + error.message;
      return fail(std::move(error));
    }
    at = end + 1;
  }
  return {};
}

void HeadlessStudio::drawFrame() {
  inside_->frame(Inside::Drawing::Done);
  glFinish();
}

Result<render::Image> HeadlessStudio::picture() {
  if (auto waited = inside_->wait(); !waited) return waited.failure();
  return inside_->canvas->image();
}

}  // namespace axil::ui
