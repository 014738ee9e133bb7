#include "document/command_text.hpp"

#include "document/command_values.hpp"

namespace axil::document {

using namespace values;

namespace {

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
      row<PlaceClick>("place_click", "puts a click where other photos say the node is; cameras are not estimated from it", arg("node", K::Node, &PlaceClick::node),
                      arg("view", K::View, &PlaceClick::view), arg("", K::Number, &PlaceClick::at), arg("within_px", K::Number, &PlaceClick::within_px)),
      row<MoveClick>("move_click", "moves a node's click; from then on it is a person's", arg("node", K::Node, &MoveClick::node), arg("view", K::View, &MoveClick::view),
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
