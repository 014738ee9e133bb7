#include "document/command_text.hpp"

#include "base/text.hpp"
#include "document/command_words.hpp"
#include "document/degrees.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>

namespace axil::document {

using quantify::LeafArrangement;
using skeleton3d::Camera;
using skeleton3d::CameraModel;

namespace {

using Count = CommandArgument::Count;

// ---- single values ---------------------------------------------------------------------------------------------------

constexpr std::pair<CameraModel, const char*> kModels[] = {
    {CameraModel::Unknown, "unknown"}, {CameraModel::Orthographic, "orthographic"}, {CameraModel::Perspective, "perspective"}};

template <class Number>
std::optional<Number> wholeNumber(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// Degrees are for people; not every angle is a number of degrees exactly, and those few are printed in radians.
std::string angleText(Angle angle) {
  const double degrees = degreesOf(angle);
  return Angle::fromDegrees(degrees) == angle ? shortest(degrees) : shortest(angle.radians()) + "rad";
}

std::optional<Angle> angleFrom(std::string_view text) {
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

std::vector<std::string_view> commaPieces(std::string_view text) {
  std::vector<std::string_view> pieces;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    pieces.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return pieces;
}

// ---- the words of one command, taken one after another ---------------------------------------------------------------

std::string upper(std::string_view name) {
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

std::optional<CameraModel> modelFrom(std::string_view text) {
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

const std::vector<Option<LeafArrangement>>& leafOptions() {
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

const std::vector<Option<Camera>>& cameraOptions() {
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

template <> std::string Words::take(const char* name) { return word(name); }
template <> SharedText Words::take(const char* name) { return SharedText(word(name)); }
template <> double Words::take(const char* name) { return as(name, "a number", parseNumber); }
template <> int Words::take(const char* name) { return as(name, "a whole number", wholeNumber<int>); }
template <> std::uint64_t Words::take(const char* name) { return as(name, "a whole number from 0", wholeNumber<std::uint64_t>); }
template <> NodeId Words::take(const char* name) { return as(name, "a whole number", idFrom<NodeId>); }
template <> StemId Words::take(const char* name) { return as(name, "a whole number", idFrom<StemId>); }
template <> CameraModel Words::take(const char* name) { return as(name, "unknown, orthographic or perspective", modelFrom); }
template <> std::vector<NodeId> Words::take(const char* name) { return restOfIds<NodeId>(*this, name); }
template <> std::vector<StemId> Words::take(const char* name) { return restOfIds<StemId>(*this, name); }
template <> Camera Words::take(const char*) { return restOfOptions(*this, cameraOptions()); }
template <> PhotoPoint Words::take(const char* name) {
  const double x = take<double>((std::string(name) + "x").c_str());
  return {{x, take<double>((std::string(name) + "y").c_str())}};
}
template <> LeafArrangement Words::take(const char*) {
  const StemId stem = take<StemId>("stem");
  LeafArrangement leaves = restOfOptions(*this, leafOptions());
  leaves.stem = stem;
  return leaves;
}

std::string textOf(const std::string& text) { return asWord(text); }
std::string textOf(const SharedText& text) { return asWord(text.text()); }
std::string textOf(double value) { return shortest(value); }
std::string textOf(int value) { return std::to_string(value); }
std::string textOf(std::uint64_t value) { return std::to_string(value); }
std::string textOf(NodeId id) { return std::to_string(id.value); }
std::string textOf(StemId id) { return std::to_string(id.value); }
std::string textOf(PhotoPoint p) { return shortest(p.px.x) + " " + shortest(p.px.y); }
std::string textOf(CameraModel model) { return std::find_if(std::begin(kModels), std::end(kModels), [&](auto& m) { return m.first == model; })->second; }
std::string textOf(const Camera& camera) { return optionWords(camera, cameraOptions()); }
std::string textOf(const LeafArrangement& leaves) {
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

// ---- the table -------------------------------------------------------------------------------------------------------

struct Row {
  CommandInfo info;
  std::size_t index = 0;
  std::function<std::string(const Command&)> print;
  std::function<Command(Words&)> read;
};

template <class C, class T>
struct Field {
  const char* name;
  ArgumentKind kind;
  T C::*member;
};

template <class C, class... Ts>
Row row(const char* name, const char* help, Field<C, Ts>... fields) {
  Row made;
  made.info = {name, {}, help};
  made.index = Command(C()).index();
  (addArguments<Ts>(made.info.arguments, fields.name, fields.kind), ...);
  made.print = [=](const Command& command) {
    std::string line = name;
    for (const std::string& word : std::initializer_list<std::string>{textOf(std::get<C>(command).*(fields.member))...})
      if (!word.empty()) line += " " + word;
    return line;
  };
  made.read = [=](Words& words) {
    C command;
    ((command.*(fields.member) = words.take<Ts>(fields.name)), ...);
    return Command(std::move(command));
  };
  return made;
}

template <class C, class T>
Field<C, T> arg(const char* name, ArgumentKind kind, T C::*member) {
  return {name, kind, member};
}

std::vector<Row> makeRows() {
  using K = ArgumentKind;
  return {
      row<SetName>("set_name", "names the plant", arg("name", K::Text, &SetName::name)),
      row<SetDescription>("set_description", "gives the plant's description", arg("text", K::Text, &SetDescription::text)),
      row<SetSeed>("set_seed", "sets the seed of all random choices", arg("seed", K::Whole, &SetSeed::seed)),
      row<SetUnit>("set_unit", "names the unit of every length; no number changes", arg("unit", K::Text, &SetUnit::unit)),

      row<AcceptTrait>("accept_trait", "confirms what the description says", arg("organ", K::Text, &AcceptTrait::organ),
                       arg("property", K::Text, &AcceptTrait::property), arg("words", K::Text, &AcceptTrait::words)),
      row<ChangeTrait>("change_trait", "takes another value instead of what the description says; with \"\" for the words, a fact of your own",
                       arg("organ", K::Text, &ChangeTrait::organ), arg("property", K::Text, &ChangeTrait::property), arg("words", K::Text, &ChangeTrait::words),
                       arg("value", K::Text, &ChangeTrait::value)),
      row<ChangeTraitRange>("change_trait_range", "takes another range instead of what the description says", arg("organ", K::Text, &ChangeTraitRange::organ),
                            arg("property", K::Text, &ChangeTraitRange::property), arg("words", K::Text, &ChangeTraitRange::words),
                            arg("low", K::Number, &ChangeTraitRange::low), arg("high", K::Number, &ChangeTraitRange::high),
                            arg("unit", K::Text, &ChangeTraitRange::unit)),
      row<RejectTrait>("reject_trait", "goes on as if the description did not say it", arg("organ", K::Text, &RejectTrait::organ),
                       arg("property", K::Text, &RejectTrait::property), arg("words", K::Text, &RejectTrait::words)),
      row<ForgetTrait>("forget_trait", "takes a decision about the description back", arg("organ", K::Text, &ForgetTrait::organ),
                       arg("property", K::Text, &ForgetTrait::property), arg("words", K::Text, &ForgetTrait::words)),

      row<AddView>("add_view", "adds a view; \"\" for no photo", arg("view", K::Text, &AddView::view), arg("photo", K::Photo, &AddView::photo)),
      row<RemoveView>("remove_view", "removes a view with its clicks", arg("view", K::View, &RemoveView::view)),
      row<RenameView>("rename_view", "renames a view; its clicks follow", arg("view", K::View, &RenameView::view), arg("name", K::Text, &RenameView::name)),
      row<SwapViews>("swap_views", "exchanges the names of two photos that were given the wrong way round", arg("view", K::View, &SwapViews::view),
                     arg("other", K::View, &SwapViews::other)),
      row<RelinkPhoto>("relink_photo", "says where a view's photo is now", arg("view", K::View, &RelinkPhoto::view), arg("photo", K::Photo, &RelinkPhoto::photo)),
      row<SetPhotoSize>("set_photo_size", "says what size the photo must have; 0 0 for any", arg("view", K::View, &SetPhotoSize::view),
                        arg("width", K::Whole, &SetPhotoSize::width), arg("height", K::Whole, &SetPhotoSize::height)),

      row<SetCamera>("set_camera", "gives a whole camera, as a calibration says", arg("view", K::View, &SetCamera::view), arg("", K::Option, &SetCamera::camera)),
      row<SetCameraModel>("set_camera_model", "makes the camera unknown (estimated), orthographic or perspective", arg("view", K::View, &SetCameraModel::view),
                          arg("model", K::Model, &SetCameraModel::model)),
      row<SetFocal>("set_focal", "sets the focal length in pixels", arg("view", K::View, &SetFocal::view), arg("fx", K::Number, &SetFocal::fx_px),
                    arg("fy", K::Number, &SetFocal::fy_px)),
      row<ClearFocal>("clear_focal", "forgets the focal length", arg("view", K::View, &ClearFocal::view)),
      row<SetOrigin>("set_origin", "says where the plant's collar is seen", arg("view", K::View, &SetOrigin::view), arg("", K::Number, &SetOrigin::at)),
      row<ClearOrigin>("clear_origin", "forgets where the collar is seen", arg("view", K::View, &ClearOrigin::view)),
      row<SetScale>("set_scale", "says how long the line between two points is", arg("view", K::View, &SetScale::view), arg("from_", K::Number, &SetScale::from),
                    arg("to_", K::Number, &SetScale::to), arg("length", K::Number, &SetScale::length)),
      row<ClearScale>("clear_scale", "forgets the known length", arg("view", K::View, &ClearScale::view)),

      row<AddNode>("add_node", "adds a node with its first click", arg("node", K::NewNode, &AddNode::node), arg("view", K::View, &AddNode::view),
                   arg("", K::Number, &AddNode::at)),
      row<RemoveNodes>("remove_nodes", "removes nodes; their stems close over the gap", arg("node", K::Node, &RemoveNodes::nodes)),
      row<AddClick>("add_click", "clicks a node in one more view", arg("node", K::Node, &AddClick::node), arg("view", K::View, &AddClick::view),
                    arg("", K::Number, &AddClick::at)),
      row<MoveClick>("move_click", "moves a node's click", arg("node", K::Node, &MoveClick::node), arg("view", K::View, &MoveClick::view),
                     arg("", K::Number, &MoveClick::at)),
      row<RemoveClick>("remove_click", "removes a node's click from a view", arg("node", K::Node, &RemoveClick::node), arg("view", K::View, &RemoveClick::view)),
      row<SetRadius>("set_radius", "sets half the stem's width at a node", arg("node", K::Node, &SetRadius::node), arg("radius", K::Number, &SetRadius::radius)),
      row<ClearRadius>("clear_radius", "forgets the stem's width at a node", arg("node", K::Node, &ClearRadius::node)),

      row<AddStem>("add_stem", "adds a stem through nodes, base first", arg("stem", K::NewStem, &AddStem::stem), arg("node", K::Node, &AddStem::nodes)),
      row<StartBranch>("start_branch", "begins a stem at a node of another", arg("stem", K::NewStem, &StartBranch::stem), arg("node", K::Node, &StartBranch::at)),
      row<AppendNode>("append_node", "puts a node after a stem's tip", arg("stem", K::Stem, &AppendNode::stem), arg("node", K::Node, &AppendNode::node)),
      row<InsertNode>("insert_node", "puts a node into a stem, before another", arg("stem", K::Stem, &InsertNode::stem), arg("node", K::Node, &InsertNode::node),
                      arg("before", K::Node, &InsertNode::before)),
      row<RemoveFromStem>("remove_from_stem", "takes a node out of a stem; the node stays", arg("stem", K::Stem, &RemoveFromStem::stem),
                          arg("node", K::Node, &RemoveFromStem::node)),
      row<AttachStem>("attach_stem", "lets a stem begin at a node of another", arg("stem", K::Stem, &AttachStem::stem), arg("node", K::Node, &AttachStem::at)),
      row<SplitStem>("split_stem", "cuts a stem in two at a node", arg("stem", K::Stem, &SplitStem::stem), arg("node", K::Node, &SplitStem::at),
                     arg("upper", K::NewStem, &SplitStem::upper)),
      row<JoinStems>("join_stems", "lets one stem go on as another", arg("lower", K::Stem, &JoinStems::lower), arg("upper", K::Stem, &JoinStems::upper)),
      row<ReverseStem>("reverse_stem", "turns a stem round, tip to base", arg("stem", K::Stem, &ReverseStem::stem)),
      row<RemoveStem>("remove_stem", "removes a stem with all that hangs on it", arg("stem", K::Stem, &RemoveStem::stem)),

      row<AddLeaves>("add_leaves", "puts leaves on a stem", arg("", K::Option, &AddLeaves::leaves)),
      row<ChangeLeaves>("change_leaves", "replaces one of the leaf arrangements", arg("number", K::LeavesNumber, &ChangeLeaves::number),
                        arg("", K::Option, &ChangeLeaves::leaves)),
      row<RemoveLeaves>("remove_leaves", "removes one of the leaf arrangements", arg("number", K::LeavesNumber, &RemoveLeaves::number)),
      row<CopyLeaves>("copy_leaves", "puts the same leaves on other stems", arg("number", K::LeavesNumber, &CopyLeaves::number),
                      arg("stem", K::Stem, &CopyLeaves::stems)),
  };
}

const std::vector<Row>& rows() {
  static const std::vector<Row> made = [] {
    std::vector<Row> all = makeRows();
    AXIL_ASSERT(all.size() == std::variant_size_v<Command>, "every command has one row");
    for (std::size_t i = 0; i < all.size(); ++i) AXIL_ASSERT(all[i].index == i, "rows stand in the order of the variant");
    return all;
  }();
  return made;
}

Result<Command> fromWords(const std::vector<Word>& words) {
  if (words.empty()) return fail(ErrorCode::BadInput, "there is no command; the first word says what to do, as add_click does");
  const std::string name = words.front().whole();
  std::vector<std::string> names;
  for (const Row& row : rows()) {
    names.push_back(row.info.name);
    if (row.info.name != name) continue;
    Words arguments(row.info, words);
    Command command = row.read(arguments);
    if (auto trouble = arguments.finish()) return fail(std::move(*trouble));
    return command;
  }
  return fail(ErrorCode::BadInput, "there is no command '" + name + "'" + didYouMean(name, names));
}

}  // namespace

const std::vector<CommandInfo>& commandTable() {
  static const std::vector<CommandInfo> table = [] {
    std::vector<CommandInfo> infos;
    for (const Row& row : rows()) infos.push_back(row.info);
    return infos;
  }();
  return table;
}

std::string usageOf(const CommandInfo& info) {
  std::string usage = info.name;
  for (const CommandArgument& argument : info.arguments) {
    if (argument.kind == ArgumentKind::Option) usage += " [" + argument.name + "=..]";
    else usage += " " + upper(argument.name) + (argument.count == Count::OneOrMore ? " .." : "");
  }
  return usage;
}

std::string print(const Command& command) { return rows()[command.index()].print(command); }

std::string print(std::span<const Command> step) {
  std::string line;
  for (const Command& command : step) line += (line.empty() ? "" : " ; ") + print(command);
  return line;
}

Result<Command> parseCommand(std::string_view line) {
  const auto words = cutLine(line);
  if (!words) return words.failure();
  if (words->size() > 1) return fail(ErrorCode::BadInput, "there are several commands in the line; one is expected here");
  return fromWords(words->front());
}

Result<Step> parseStep(std::string_view line) {
  const auto commands = cutLine(line);
  if (!commands) return commands.failure();
  Step step;
  for (const std::vector<Word>& words : *commands) {
    auto command = fromWords(words);
    if (!command) return command.failure();
    step.push_back(std::move(*command));
  }
  return step;
}

}  // namespace axil::document
