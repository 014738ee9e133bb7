#include "simeco/lsystem_view.hpp"

#include "base/files.hpp"
#include "base/text.hpp"
#include "simeco/report.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace axil::simeco {

namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// Words of a line, each with its place; commas separate, too.
struct Word {
  std::string_view text;
  std::size_t at = 0;
};
std::vector<Word> wordsOf(std::string_view text, std::size_t offset) {
  std::vector<Word> words;
  for (std::size_t i = 0; i < text.size();) {
    const auto separates = [&](std::size_t at) { return isBlank(text[at]) || text[at] == ','; };
    if (separates(i)) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && !separates(end)) ++end;
    words.push_back({text.substr(i, end - i), offset + i});
    i = end;
  }
  return words;
}

std::string lowered(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (isBlank(c) && (result.empty() || result.back() == ' ')) continue;
    result.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : isBlank(c) ? ' ' : c);
  }
  return result;
}

/// Settings of the reference program that have nothing to do with where the turtle goes.
constexpr std::string_view kPassedOver[] = {
    "scale factor", "scale", "min zoom", "max zoom", "front distance", "back distance", "projection", "render mode", "z buffer",
    "cue range", "shade mode", "light", "light direction", "diffuse reflection", "ambient light", "viewpoint", "view reference point", "twist",
    "view", "surface ambient", "surface diffuse", "contour", "contours", "contour sides", "texture", "bsurface", "tsurface", "mesh",
    "function set", "color map", "colormap", "background", "background scene", "double buffer", "new frame", "box", "frame", "stroke",
    "field of view", "font", "winding", "generate on view change", "corrected rotation", "cut", "concave polygons", "line caps", "initial contour",
    "initial color back", "terrain", "axis", "axes", "shininess", "specular", "material", "gradient map", "homomorphism", "module", "modules",
    "render", "capping", "screen size", "interactive mode", "environment", "file", "antialiasing", "shadow map", "shadows", "final", "display",
    "backface culling", "gallery", "timeline", "view volume", "stationary view", "maximum depth", "cue", "tropism size"};

class ViewReader {
 public:
  ViewReader(std::string_view text, const std::filesystem::path& folder) : text_(text), folder_(folder) {}

  ParsedView run() {
    std::string clean = withoutComments();
    for (std::size_t at = 0; at < clean.size();) {
      const std::size_t end = std::min(clean.find('\n', at), clean.size());
      line(std::string_view(clean).substr(at, end - at), at);
      at = end + 1;
    }
    return {std::move(view_), report_.take()};
  }

 private:
  /// Comments become blanks, so that places stay.
  std::string withoutComments() {
    std::string clean(text_);
    for (std::size_t i = 0; i + 1 < clean.size(); ++i) {
      if (clean[i] != '/' || (clean[i + 1] != '*' && clean[i + 1] != '/')) continue;
      const bool block = clean[i + 1] == '*';
      const std::size_t found = clean.find(block ? "*/" : "\n", i + (block ? 2 : 0));
      const std::size_t end = found == std::string::npos ? clean.size() : found + (block ? 2 : 0);
      for (; i < end; ++i)
        if (clean[i] != '\n') clean[i] = ' ';
      --i;
    }
    return clean;
  }

  void line(std::string_view words, std::size_t at) {
    if (trimmed(words).empty() || trimmed(words).front() == '#') return;
    const std::size_t colon = words.find(':');
    if (colon == std::string_view::npos) return error(at, at + words.size(), "expected a setting, 'keyword: value'", "");
    const std::string keyword = lowered(trimmed(words.substr(0, colon)));
    values_ = wordsOf(words.substr(colon + 1), at + colon + 1);
    where_ = {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at + words.size())};
    setting(keyword, words.substr(colon + 1));
  }

  void setting(const std::string& keyword, std::string_view value) {
    if (keyword == "angle increment") view_.angleIncrement = Angle::fromDegrees(number(0).value_or(45));
    else if (keyword == "angle factor") angleFactor();
    else if (keyword == "initial line width") view_.lineWidth = size(view_.lineWidth);
    else if (keyword == "line width increment") view_.widthIncrement = number(0).value_or(0);
    else if (keyword == "initial scale") view_.scale = size(view_.scale);
    else if (keyword == "scale multiplier") view_.scaleMultiplier = size(view_.scaleMultiplier);
    else if (keyword == "initial color" || keyword == "initial colour") view_.colour = colour(128);
    else if (keyword == "color increment" || keyword == "colour increment") view_.colourIncrement = colour(1);
    else if (keyword == "color" || keyword == "colour") paint();
    else if (keyword == "surface") surface();
    else if (keyword == "function") function(trimmed(value));
    else if (keyword == "line style") lineStyle();
    else if (keyword == "tapered lines") view_.taperedLines = onOff(true);
    else if (keyword == "interpretation past %") view_.pastCut = onOff(true);
    else if (keyword == "tropism" || keyword == "torque") tropism(keyword == "torque");
    else if (keyword == "tropism direction") oldDirection();
    else if (keyword == "initial elasticity") old().elasticity = number(0).value_or(0);
    else if (std::find(std::begin(kPassedOver), std::end(kPassedOver), keyword) == std::end(kPassedOver)) unknown(keyword, value);
  }

  void unknown(const std::string& keyword, std::string_view) {
    static constexpr std::string_view kKnown[] = {"angle increment", "angle factor", "initial line width", "line width increment", "initial scale",
                                                  "scale multiplier", "initial color", "color increment", "color", "surface", "function", "tapered lines", "line style", "interpretation past %",
                                                  "tropism", "torque", "tropism direction", "initial elasticity"};
    report_.warning(where_, "the setting '" + keyword + "' is not known and not used", didYouMean(keyword, kKnown));
  }

  void angleFactor() {
    const double factor = number(0).value_or(8);
    if (factor > 0) view_.angleIncrement = Angle::fromDegrees(360 / factor);
    else error(where_.begin, where_.end, "an angle factor must be above 0", "6 stands for 60 degrees");
  }

  void lineStyle() {
    const std::string value = values_.empty() ? "" : lowered(values_[0].text);
    if (value == "pixel") view_.lineStyle = LineStyle::Pixel;
    else if (value == "polygon") view_.lineStyle = LineStyle::Polygon;
    else if (value == "cylinder") view_.lineStyle = LineStyle::Cylinder;
    else error(where_.begin, where_.end, "a line style is pixel, polygon or cylinder", "");
  }

  /// `color: INDEX RED GREEN BLUE`, 0 to 255 each.
  void paint() {
    double values[4];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto value = number(i);
      if (!value) return;
      if (*value < 0 || *value > 255) return error(where_.begin, where_.end, "an index, red, green and blue are 0 to 255 each", "color: 3 255 250 240");
      values[i] = *value;
    }
    view_.colours[static_cast<int>(values[0])] = {values[1] / 255, values[2] / 255, values[3] / 255, 1};
  }

  /// `surface: LETTER [leaf|flower|fruit] SHAPE [SCALE]`. What follows, as the reference program has it, concerns its own files.
  void surface() {
    if (values_.size() < 2 || values_[0].text.size() != 1) return error(where_.begin, where_.end, "a surface is a letter and a shape", "surface: l leaf ovate 0.5");
    ViewSurface result;
    std::size_t at = 1;
    const std::string kind = lowered(values_[at].text);
    if (values_.size() > 2 && (kind == "leaf" || kind == "flower" || kind == "fruit")) {
      result.kind = kind == "leaf" ? OrganKind::Leaf : kind == "flower" ? OrganKind::Flower : OrganKind::Fruit;
      ++at;
    }
    result.model = std::string(values_[at].text);
    if (values_.size() > at + 1) result.scale = number(at + 1).value_or(1);
    view_.surfaces[values_[0].text[0]] = result;
  }

  /// `function: X Y X Y ...`, or the name of a function file beside the view file.
  void function(std::string_view value) {
    view_.functions.emplace_back();
    if (values_.empty()) return error(where_.begin, where_.end, "a function is points or a file", "function: 0 0  0.5 1  1 0");
    const std::size_t digit = values_[0].text.find_first_not_of("+-.");
    const bool file = digit == std::string_view::npos || values_[0].text[digit] < '0' || values_[0].text[digit] > '9';
    const auto curve = file ? functionFile(value) : responseCurve(numbers());
    if (curve) view_.functions.back() = *curve;
    else if (file) report_.warning(where_, curve.error().message, "func(" + std::to_string(view_.functions.size()) + ", x) has no answer");
    else error(where_.begin, where_.end, curve.error().message, "function: 0 0  0.5 1  1 0");
  }
  [[nodiscard]] Result<ResponseCurve> functionFile(std::string_view name) const {
    const std::filesystem::path path = folder_ / std::filesystem::path(name);
    const bool below = std::filesystem::path(name).is_relative() && name.find("..") == std::string_view::npos;
    if (!below) return fail(ErrorCode::BadInput, "the function file '" + std::string(name) + "' does not lie beside the view file");
    const auto text = readFile(path);
    if (!text) return text.failure();
    return parseResponseCurve(*text);
  }
  std::vector<double> numbers() {
    std::vector<double> all;
    for (std::size_t i = 0; i < values_.size(); ++i) all.push_back(number(i).value_or(0));
    return all;
  }

  OldTropism& old() {
    if (!view_.oldTropism) view_.oldTropism.emplace();
    return *view_.oldTropism;
  }
  void oldDirection() {
    const auto direction = vector(0);
    if (direction) old().direction = *direction;
  }

  void tropism(bool torque) {
    Tropism result;
    result.torque = torque;
    bool directed = false;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const std::string_view key = values_[i].text;
      if (key == "T:") {
        const auto direction = vector(i + 1);
        if (!direction) return;
        result.direction = *direction;
        directed = true;
        i += 3;
      } else if (key == "A:" || key == "I:" || key == "E:" || key == "S:") {
        const auto value = number(++i);
        if (!value) return;
        if (key == "A:") result.angle = Angle::fromDegrees(*value);
        if (key == "I:") result.intensity = std::clamp(*value, -1.0, 1.0);
        if (key == "E:") result.elasticity = *value;
        if (key == "S:") result.step = *value;
      } else {
        return error(values_[i].at, values_[i].at + key.size(), "expected T: A: I: E: or S:, found '" + std::string(key) + "'", "tropism: T: 0 1 0 E: 0.2");
      }
    }
    if (!directed) return error(where_.begin, where_.end, "a tropism needs a direction", "tropism: T: 0 1 0 E: 0.2");
    view_.tropisms.push_back(result);
  }

  std::optional<double> number(std::size_t index) {
    if (index >= values_.size()) {
      error(where_.begin, where_.end, "a number is missing here", "");
      return std::nullopt;
    }
    std::string text(values_[index].text);
    if (text.starts_with('+')) text.erase(0, 1);
    if (text.starts_with('.')) text.insert(0, "0");
    if (text.starts_with("-.")) text.insert(1, "0");
    if (text.ends_with('.')) text.push_back('0');
    const auto value = parseNumber(text);
    if (!value || !std::isfinite(*value)) {
      error(values_[index].at, values_[index].at + values_[index].text.size(), "'" + std::string(values_[index].text) + "' is not a number", "");
      return std::nullopt;
    }
    return value;
  }
  double size(double otherwise) {
    const auto value = number(0);
    if (value && *value < 0) error(where_.begin, where_.end, "this must not be negative", "");
    return value && *value >= 0 ? *value : otherwise;
  }
  int colour(int otherwise) { return static_cast<int>(std::clamp(number(0).value_or(otherwise), -1e6, 1e6)); }
  bool onOff(bool otherwise) {
    const std::string value = values_.empty() ? "" : lowered(values_[0].text);
    if (value == "on" || value == "off") return value == "on";
    error(where_.begin, where_.end, "expected on or off", "");
    return otherwise;
  }
  std::optional<glm::dvec3> vector(std::size_t index) {
    glm::dvec3 result{0, 0, 0};
    for (int i = 0; i < 3; ++i) {
      const auto value = number(index + static_cast<std::size_t>(i));
      if (!value) return std::nullopt;
      result[i] = *value;
    }
    if (!(glm::length(result) > 0)) {
      error(where_.begin, where_.end, "0 0 0 is no direction", "");
      return std::nullopt;
    }
    return glm::normalize(result);
  }

  void error(std::size_t begin, std::size_t end, std::string message, std::string hint) {
    report_.error({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)}, std::move(message), std::move(hint));
  }

  std::string_view text_;
  const std::filesystem::path& folder_;
  LSystemView view_;
  Report report_;
  std::vector<Word> values_;
  SourceSpan where_;
};

}  // namespace

ParsedView parseLSystemView(std::string_view text, const std::filesystem::path& folder) { return ViewReader(text, folder).run(); }

Result<LSystemView> readLSystemView(const std::filesystem::path& path) {
  const auto text = readFile(path);
  if (!text) return text.failure();
  ParsedView parsed = parseLSystemView(*text, path.parent_path());
  if (!hasErrors(parsed.diagnostics)) return std::move(parsed.view);
  Error error{ErrorCode::BadInput, "the view file '" + path.string() + "' has mistakes; mend them or move it away", {}};
  for (const Diagnostic& d : parsed.diagnostics) error.details.push_back(formatDiagnostic(d, *text, path.filename().string()));
  return fail(std::move(error));
}

Result<LSystemView> viewBeside(const std::filesystem::path& lsystemFile) {
  const std::filesystem::path path = std::filesystem::path(lsystemFile).replace_extension(".v");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return LSystemView{};
  return readLSystemView(path);
}

}  // namespace axil::simeco
