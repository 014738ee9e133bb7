#pragma once
/// \file
/// Private to document: how each kind of value stands in a command's line, read, printed and listed. What commands there are is the table of
/// command_text.cpp.

#include "base/text.hpp"
#include "document/command_text.hpp"
#include "document/command_words.hpp"
#include "document/degrees.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>

namespace axil::document::values {

using quantify::LeafArrangement;
using skeleton3d::Camera;
using skeleton3d::CameraModel;
using Count = CommandArgument::Count;

// ---- single values ---------------------------------------------------------------------------------------------------

inline constexpr std::pair<CameraModel, const char*> kModels[] = {
    {CameraModel::Unknown, "unknown"}, {CameraModel::Orthographic, "orthographic"}, {CameraModel::Perspective, "perspective"}};

template <class Number>
std::optional<Number> wholeNumber(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// Degrees are for people; not every angle is a number of degrees exactly, and those few are printed in radians.
inline std::string angleText(Angle angle) {
  const double degrees = degreesOf(angle);
  return Angle::fromDegrees(degrees) == angle ? shortest(degrees) : shortest(angle.radians()) + "rad";
}

inline std::optional<Angle> angleFrom(std::string_view text) {
  const bool radians = text.ends_with("rad");
  const auto number = parseNumber(radians ? text.substr(0, text.size() - 3) : text);
  if (!number) return std::nullopt;
  return radians ? Angle::fromRadians(*number) : Angle::fromDegrees(*number);
}

template <class Element, class ToText>
std::string commaList(const Element& elements, ToText toText) {
  std::string text;
  for (const auto& element : elements) text += (text.empty() ? "" : ",") + toText(element);
  return text;
}

inline std::vector<std::string_view> commaPieces(std::string_view text) {
  std::vector<std::string_view> pieces;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    pieces.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return pieces;
}

// ---- the words of one command, taken one after another ---------------------------------------------------------------

inline std::string upper(std::string_view name) {
  std::string text(name);
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

/// Keeps the first trouble; after it every value is a neutral one.
class Words {
 public:
  Words(const CommandInfo& info, std::vector<Word> words) : info_(info), words_(std::move(words)) {}

  template <class T>
  T take(const char* name);

  void trouble(const std::string& what) {
    if (!trouble_) trouble_ = Error{ErrorCode::BadInput, info_.name + ": " + what};
  }
  [[nodiscard]] bool more() const { return next_ < words_.size(); }
  [[nodiscard]] const Word& nextWord() { return words_[next_++]; }

  std::string word(const char* name) {
    if (more()) return nextWord().whole();
    trouble(upper(name) + " is missing; it takes " + usageOf(info_));
    return {};
  }
  /// `read` gives the value of a word, or nothing where it is not `kind`.
  template <class Read>
  auto as(const char* name, const char* kind, Read read) {
    const std::string text = word(name);
    const auto value = read(text);
    if (!value) trouble(upper(name) + " must be " + kind + ", not '" + text + "'");
    return value ? *value : typename decltype(value)::value_type{};
  }
  [[nodiscard]] std::optional<Error> finish() {
    if (more()) trouble("'" + words_[next_].whole() + "' is one word too many; it takes " + usageOf(info_) + ", and texts with blanks are quoted");
    return trouble_;
  }

 private:
  const CommandInfo& info_;
  std::vector<Word> words_;
  std::size_t next_ = 1;
  std::optional<Error> trouble_;
};

template <class AnId>
std::optional<AnId> idFrom(std::string_view text) {
  const auto value = wholeNumber<std::int32_t>(text);
  return value ? std::optional(AnId(*value)) : std::nullopt;
}

inline std::optional<CameraModel> modelFrom(std::string_view text) {
  for (const auto& [model, name] : kModels)
    if (text == name) return model;
  return std::nullopt;
}

template <class AnId>
std::vector<AnId> restOfIds(Words& words, const char* name) {
  std::vector<AnId> ids;
  do ids.push_back(words.as(name, "a whole number", idFrom<AnId>));
  while (words.more());
  return ids;
}

// ---- options ---------------------------------------------------------------------------------------------------------

/// One `name=value` of a T: its text where it is given, and how it is read; reading says whether the text was fit.
template <class T>
struct Option {
  const char* name;
  const char* kind;
  std::function<std::optional<std::string>(const T&)> print;
  std::function<bool(std::string_view, T&)> read;
};

template <class T, class V, class Print, class Read>
Option<T> optional(const char* name, const char* kind, std::optional<V> T::*member, Print print, Read read) {
  return {name, kind, [=](const T& t) { return t.*member ? std::optional<std::string>(print(*(t.*member))) : std::nullopt; },
          [=](std::string_view text, T& t) { return (t.*member = read(text)).has_value(); }};
}

template <class T>
Option<T> optionalText(const char* name, std::string T::*member) {
  return {name, "a text", [=](const T& t) { return (t.*member).empty() ? std::nullopt : std::optional(t.*member); },
          [=](std::string_view text, T& t) { return !(t.*member = text).empty(); }};
}

inline const std::vector<Option<LeafArrangement>>& leafOptions() {
  using L = LeafArrangement;
  const auto wholeText = [](int value) { return std::to_string(value); };
  const char* const number = "a number";
  const char* const angle = "a number of degrees (55) or radians (0.96rad)";
  static const std::vector<Option<L>> options = {
      optionalText("arrangement", &L::arrangement),
      optional("nodes", "a whole number", &L::nodes, wholeText, wholeNumber<int>),
      {"at", "node ids with commas",
       [](const L& l) { return l.at.empty() ? std::nullopt : std::optional(commaList(l.at, [](NodeId id) { return std::to_string(id.value); })); },
       [](std::string_view text, L& l) {
         for (const std::string_view piece : commaPieces(text)) {
           const auto id = idFrom<NodeId>(piece);
           if (!id) return false;
           l.at.push_back(*id);
         }
         return true;
       }},
      optional("angle", angle, &L::angle, angleText, angleFrom),
      optional("roll", angle, &L::roll, angleText, angleFrom),
      optional("azimuth", angle, &L::azimuth, angleText, angleFrom),
      optional("length", number, &L::length, shortest, parseNumber),
      optional("width", number, &L::width, shortest, parseNumber),
      optional("petiole", number, &L::petiole, shortest, parseNumber),
      optionalText("shape", &L::shape),
  };
  return options;
}

/// So many numbers of a camera, left out where they are those of a camera nobody described.
template <class Get, class Set>
Option<Camera> cameraNumbers(const char* name, const char* kind, std::size_t count, Get get, Set set) {
  return {name, kind,
          [=](const Camera& camera) -> std::optional<std::string> {
            const std::vector<double> numbers = get(camera);
            if (numbers == get(Camera())) return std::nullopt;
            return commaList(numbers, shortest);
          },
          [=](std::string_view text, Camera& camera) {
            std::vector<double> numbers;
            for (const std::string_view piece : commaPieces(text))
              if (const auto number = parseNumber(piece)) numbers.push_back(*number);
              else return false;
            if (numbers.size() == count) set(camera, numbers);
            return numbers.size() == count;
          }};
}

inline const std::vector<Option<Camera>>& cameraOptions() {
  using Numbers = std::vector<double>;
  static const std::vector<Option<Camera>> options = {
      {"model", "unknown, orthographic or perspective",
       [](const Camera& c) { return std::optional<std::string>(std::find_if(std::begin(kModels), std::end(kModels), [&](auto& m) { return m.first == c.model; })->second); },
       [](std::string_view text, Camera& c) {
         const auto model = modelFrom(text);
         c.model = model.value_or(CameraModel::Unknown);
         return model.has_value();
       }},
      cameraNumbers(
          "focal", "2 numbers (fx,fy)", 2, [](const Camera& c) { return c.focal_px ? Numbers{c.focal_px->x, c.focal_px->y} : Numbers{}; },
          [](Camera& c, const Numbers& n) { c.focal_px = glm::dvec2{n[0], n[1]}; }),
      cameraNumbers(
          "centre", "2 numbers (cx,cy)", 2, [](const Camera& c) { return Numbers{c.centre_px.x, c.centre_px.y}; },
          [](Camera& c, const Numbers& n) { c.centre_px = {n[0], n[1]}; }),
      cameraNumbers(
          "distortion", "5 numbers (k1,k2,p1,p2,k3)", 5, [](const Camera& c) { return Numbers(c.distortion.begin(), c.distortion.end()); },
          [](Camera& c, const Numbers& n) { std::copy(n.begin(), n.end(), c.distortion.begin()); }),
      cameraNumbers(
          "scale", "px per unit", 1, [](const Camera& c) { return Numbers{c.scale_px_per_unit}; }, [](Camera& c, const Numbers& n) { c.scale_px_per_unit = n[0]; }),
      cameraNumbers(
          "rotation", "9 numbers, row by row", 9,
          [](const Camera& c) {
            Numbers n;
            for (int row = 0; row < 3; ++row)
              for (int column = 0; column < 3; ++column) n.push_back(c.rotation[column][row]);
            return n;
          },
          [](Camera& c, const Numbers& n) {
            for (int row = 0; row < 3; ++row)
              for (int column = 0; column < 3; ++column) c.rotation[column][row] = n[static_cast<std::size_t>(row * 3 + column)];
          }),
      cameraNumbers(
          "translation", "3 numbers", 3, [](const Camera& c) { return Numbers{c.translation.x, c.translation.y, c.translation.z}; },
          [](Camera& c, const Numbers& n) { c.translation = {n[0], n[1], n[2]}; }),
  };
  return options;
}

template <class T>
std::string optionWords(const T& value, const std::vector<Option<T>>& options) {
  std::string words;
  for (const Option<T>& option : options)
    if (const auto text = option.print(value)) words += (words.empty() ? "" : " ") + std::string(option.name) + "=" + asWord(*text);
  return words;
}

template <class T>
std::vector<std::string> namesOf(const std::vector<Option<T>>& options) {
  std::vector<std::string> names;
  for (const Option<T>& option : options) names.emplace_back(option.name);
  return names;
}

template <class T>
void readOption(Words& words, const Word& word, T& value, const std::vector<Option<T>>& options, std::vector<std::string>& seen) {
  const auto option = std::find_if(options.begin(), options.end(), [&](const Option<T>& o) { return word.key == o.name; });
  if (word.key.empty()) return words.trouble("'" + word.text + "' has no name; say NAME=" + asWord(word.text) + " with one of " + commaList(namesOf(options), [](auto& n) { return n; }));
  if (option == options.end()) return words.trouble("there is no option '" + word.key + "'" + didYouMean(word.key, namesOf(options)));
  if (std::find(seen.begin(), seen.end(), word.key) != seen.end()) return words.trouble(word.key + " is given twice");
  seen.push_back(word.key);
  if (!option->read(word.text, value)) words.trouble(word.key + " must be " + option->kind + ", not '" + word.text + "'");
}

template <class T>
T restOfOptions(Words& words, const std::vector<Option<T>>& options) {
  T value;
  std::vector<std::string> seen;
  while (words.more()) readOption(words, words.nextWord(), value, options, seen);
  return value;
}

// ---- how each type of member is read, printed and listed -------------------------------------------------------------

template <> inline std::string Words::take(const char* name) { return word(name); }
template <> inline SharedText Words::take(const char* name) { return SharedText(word(name)); }
template <> inline double Words::take(const char* name) { return as(name, "a number", parseNumber); }
template <> inline int Words::take(const char* name) { return as(name, "a whole number", wholeNumber<int>); }
template <> inline std::uint64_t Words::take(const char* name) { return as(name, "a whole number from 0", wholeNumber<std::uint64_t>); }
template <> inline NodeId Words::take(const char* name) { return as(name, "a whole number", idFrom<NodeId>); }
template <> inline StemId Words::take(const char* name) { return as(name, "a whole number", idFrom<StemId>); }
template <> inline CameraModel Words::take(const char* name) { return as(name, "unknown, orthographic or perspective", modelFrom); }
template <> inline std::vector<NodeId> Words::take(const char* name) { return restOfIds<NodeId>(*this, name); }
template <> inline std::vector<StemId> Words::take(const char* name) { return restOfIds<StemId>(*this, name); }
template <> inline Camera Words::take(const char*) { return restOfOptions(*this, cameraOptions()); }
template <> inline PhotoPoint Words::take(const char* name) {
  const double x = take<double>((std::string(name) + "x").c_str());
  return {{x, take<double>((std::string(name) + "y").c_str())}};
}
template <> inline LeafArrangement Words::take(const char*) {
  const StemId stem = take<StemId>("stem");
  LeafArrangement leaves = restOfOptions(*this, leafOptions());
  leaves.stem = stem;
  return leaves;
}

inline std::string textOf(const std::string& text) { return asWord(text); }
inline std::string textOf(const SharedText& text) { return asWord(text.text()); }
inline std::string textOf(double value) { return shortest(value); }
inline std::string textOf(int value) { return std::to_string(value); }
inline std::string textOf(std::uint64_t value) { return std::to_string(value); }
inline std::string textOf(NodeId id) { return std::to_string(id.value); }
inline std::string textOf(StemId id) { return std::to_string(id.value); }
inline std::string textOf(PhotoPoint p) { return shortest(p.px.x) + " " + shortest(p.px.y); }
inline std::string textOf(CameraModel model) { return std::find_if(std::begin(kModels), std::end(kModels), [&](auto& m) { return m.first == model; })->second; }
inline std::string textOf(const Camera& camera) { return optionWords(camera, cameraOptions()); }
inline std::string textOf(const LeafArrangement& leaves) {
  const std::string options = optionWords(leaves, leafOptions());
  return textOf(leaves.stem) + (options.empty() ? "" : " ") + options;
}
template <class AnId>
std::string textOf(const std::vector<AnId>& ids) {
  std::string text;
  for (const AnId id : ids) text += (text.empty() ? "" : " ") + textOf(id);
  return text;
}

template <class T>
void addOptions(std::vector<CommandArgument>& arguments, const std::vector<Option<T>>& options) {
  for (const Option<T>& option : options) arguments.push_back({option.name, ArgumentKind::Option, Count::ZeroOrOne});
}

template <class T>
void addArguments(std::vector<CommandArgument>& arguments, const char* name, ArgumentKind kind) {
  if constexpr (std::is_same_v<T, PhotoPoint>) {
    arguments.push_back({std::string(name) + "x", ArgumentKind::Number, Count::One});
    arguments.push_back({std::string(name) + "y", ArgumentKind::Number, Count::One});
  } else if constexpr (std::is_same_v<T, Camera>) {
    addOptions(arguments, cameraOptions());
  } else if constexpr (std::is_same_v<T, LeafArrangement>) {
    arguments.push_back({"stem", ArgumentKind::Stem, Count::One});
    addOptions(arguments, leafOptions());
  } else {
    const bool many = std::is_same_v<T, std::vector<NodeId>> || std::is_same_v<T, std::vector<StemId>>;
    arguments.push_back({name, kind, many ? Count::OneOrMore : Count::One});
  }
}

}  // namespace axil::document::values
