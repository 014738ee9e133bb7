#include "base/text.hpp"
#include "ui/trait_words.hpp"
#include "ui/widgets_interop.hpp"

#include <algorithm>
#include <imgui_stdlib.h>

namespace axil::ui {
namespace {

using document::Step;
using keywords::Trait;

const document::ProjectTrait* decisionOn(const document::Project& project, const Trait& trait) {
  for (const document::ProjectTrait& decision : project.traits)
    if (decision.organ == trait.organ && decision.property == trait.property && decision.words == trait.text) return &decision;
  return nullptr;
}

/// The value the project goes by: as read, or as the user changed it.
Trait decided(Trait trait, const document::ProjectTrait* decision) {
  if (decision == nullptr || decision->verdict != document::Verdict::Changed) return trait;
  if (!decision->value.empty()) trait.value = decision->value;
  if (decision->low) trait.low = decision->low, trait.high = decision->high, trait.unit = decision->unit;
  return trait;
}

/// A fact that no words of the description say.
Trait ownFact(const document::ProjectTrait& decision) {
  Trait trait;
  trait.organ = decision.organ;
  trait.property = decision.property;
  return decided(std::move(trait), &decision);
}

bool isOwn(const document::ProjectTrait& decision) { return decision.words.empty() && decision.verdict == document::Verdict::Changed; }

std::string propertyWord(const Panel& panel, const std::string& property) {
  const std::string key = "property_" + property;
  return panel.texts.has(key) ? panel.t(key) : property;
}

std::string aboutWhat(const Panel& panel, const std::string& organ, const std::string& property) {
  return organWord(organ, panel.state.language) + " · " + propertyWord(panel, property);
}

FactDraft draftOf(const Trait& trait, std::optional<std::size_t> index) {
  const double low = trait.low.value_or(0);
  return {.index = index, .organ = trait.organ, .property = trait.property, .words = trait.text, .isMeasured = trait.low.has_value(),
          .value = trait.value, .low = low, .high = trait.high.value_or(low), .unit = trait.unit};
}

// ---- a fact while it is written --------------------------------------------------------------------------------------------

void sizeFields(FactDraft& draft, const Panel& panel) {
  const float third = (ImGui::GetContentRegionAvail().x - panel.px(16)) / 3;
  ImGui::SetNextItemWidth(third);
  ImGui::InputDouble("##low", &draft.low, 0, 0, "%.4g");
  ImGui::SameLine(0, panel.px(8));
  ImGui::SetNextItemWidth(third);
  ImGui::InputDouble("##high", &draft.high, 0, 0, "%.4g");
  ImGui::SameLine(0, panel.px(8));
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##unit", &draft.unit);
}

void valueField(FactDraft& draft, const Panel& panel) {
  const auto values = valuesOf(draft.organ, draft.property);
  const auto word = [&](const std::string& value) { return valueWord(draft.organ, draft.property, value, panel.state.language); };
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##value", draft.value.empty() ? "–" : word(draft.value).c_str())) return landmark(panel, "fact_value");
  for (const std::string& value : values) {
    if (ImGui::Selectable((word(value) + "##" + value).c_str(), value == draft.value)) draft.value = value;
    landmark(panel, "value_" + value);
  }
  ImGui::EndCombo();
}

/// What a fact of the user's own is about.
void kindField(FactDraft& draft, const Panel& panel) {
  ImGui::SetNextItemWidth(-1);
  const bool open = ImGui::BeginCombo("##kind", draft.organ.empty() ? panel.t("fact_about") : aboutWhat(panel, draft.organ, draft.property).c_str());
  if (!open) return landmark(panel, "fact_kind");
  for (const FactKind& kind : factKinds()) {
    const bool chosen = kind.organ == draft.organ && kind.property == draft.property;
    if (ImGui::Selectable((aboutWhat(panel, kind.organ, kind.property) + "##" + kind.organ + kind.property).c_str(), chosen) && !chosen)
      draft = {.index = {}, .organ = kind.organ, .property = kind.property, .words = "", .isMeasured = kind.isMeasured, .value = "", .low = 0, .high = 0, .unit = kind.isMeasured ? "cm" : ""};
    landmark(panel, "kind_" + kind.organ + "_" + kind.property);
  }
  ImGui::EndCombo();
}

Step stepOf(const FactDraft& draft) {
  if (draft.isMeasured) return {document::ChangeTraitRange{draft.organ, draft.property, draft.words, std::min(draft.low, draft.high), std::max(draft.low, draft.high), draft.unit}};
  return {document::ChangeTrait{draft.organ, draft.property, draft.words, draft.value}};
}

/// The fields of a fact; gives the step when they are applied.
Taken factFields(const Panel& panel) {
  FactDraft& draft = *panel.state.factDraft;
  if (!draft.index) kindField(draft, panel);
  if (!draft.organ.empty()) draft.isMeasured ? sizeFields(draft, panel) : valueField(draft, panel);
  if (draft.property == "shape") leafPreview(panel, draft.value);
  Taken taken;
  const bool isComplete = !draft.organ.empty() && (draft.isMeasured ? draft.high > 0 : !draft.value.empty());
  ImGui::BeginDisabled(!isComplete);
  if (button(panel, "apply", Emphasis::Primary)) taken = stepOf(draft);
  ImGui::EndDisabled();
  ImGui::SameLine(0, panel.px(8));
  if (button(panel, "cancel") || taken) panel.state.factDraft.reset();
  gap(panel, 4);
  return taken;
}

// ---- rows ------------------------------------------------------------------------------------------------------------------

struct FactRow {
  ImVec2 at;
  float width = 0;
  float height = 0;
};

enum class FactState { Open, Accepted, Rejected };

/// A fact on its plate: its value, and below what it is about.
FactRow drawFact(const Panel& panel, const Trait& trait, FactState state, bool isHot) {
  const FactRow row{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail().x, panel.px(42)};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(row.at, {row.at.x + row.width, row.at.y + row.height}, isHot ? panel.palette.hovered : panel.palette.raised, panel.px(6));
  const Colour ink = state == FactState::Rejected ? panel.palette.quiet : panel.palette.text;
  const std::string value = valueWord(trait, panel.state.language);
  list.PushClipRect(row.at, {row.at.x + row.width - panel.px(88), row.at.y + row.height}, true);
  list.AddText({row.at.x + panel.px(10), row.at.y + panel.px(4)}, ink, value.c_str());
  if (state == FactState::Rejected) {
    const float w = ImGui::CalcTextSize(value.c_str()).x, y = row.at.y + panel.px(4) + ImGui::GetFontSize() / 2;
    list.AddLine({row.at.x + panel.px(10), y}, {row.at.x + panel.px(10) + w, y}, ink, 1);
  }
  ImGui::PushFont(font(Face::Small));
  const std::string from = aboutWhat(panel, trait.organ, trait.property) + (trait.qualifier.empty() ? "" : " · " + trait.qualifier);
  list.AddText({row.at.x + panel.px(10), row.at.y + panel.px(23)}, panel.palette.quiet, from.c_str());
  ImGui::PopFont();
  list.PopClipRect();
  return row;
}

/// A small button on a fact's plate, counted from its right end.
bool factButton(const Panel& panel, const FactRow& row, int place, const char* id, Icon icon, const char* tip) {
  const float size = panel.px(24);
  ImGui::SetCursorScreenPos({row.at.x + row.width - static_cast<float>(place + 1) * size - panel.px(static_cast<float>(6 + 4 * place)), row.at.y + (row.height - size) / 2});
  return iconButton(panel, id, icon, tip, size);
}

void below(const Panel& panel, const FactRow& row) {
  ImGui::SetCursorScreenPos({row.at.x, row.at.y + row.height + panel.px(4)});
  ImGui::Dummy({1, 0});
}

/// Where the photos say otherwise: both pieces of evidence.
void contradictionOf(const Panel& panel, const Trait& trait) {
  for (const quantify::PhotoContradiction& against : panel.following.contradictions)
    if (against.start == trait.start && against.end == trait.end)
      say(panel, NoticeKind::Warned, filled(panel.t("photo_against"), {{"words", against.words}, {"measured", panel.texts.translated(against.measured, panel.state.language)}}));
}

Taken traitRow(const Panel& panel, const Trait& read, std::size_t index) {
  Taken taken;
  const Trait trait = decided(read, decisionOn(panel.project, read));
  const document::ProjectTrait* decision = decisionOn(panel.project, trait);
  const bool rejected = decision != nullptr && decision->verdict == document::Verdict::Rejected;
  const bool accepted = decision != nullptr && !rejected;
  ImGui::PushID(static_cast<int>(index));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool hovered = ImGui::IsMouseHoveringRect(at, {at.x + ImGui::GetContentRegionAvail().x, at.y + panel.px(42)}) && ImGui::IsWindowHovered();
  if (hovered) panel.state.hotTrait = index;
  const FactRow row = drawFact(panel, trait, rejected ? FactState::Rejected : accepted ? FactState::Accepted : FactState::Open, hovered);
  const float size = panel.px(24);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (factButton(panel, row, 2, "change", Icon::Pencil, panel.t("trait_change"))) panel.state.factDraft = draftOf(trait, index);
  if (factButton(panel, row, 1, "accept", Icon::Check, panel.t("trait_accept")))
    taken = accepted ? Step{document::ForgetTrait{trait.organ, trait.property, trait.text}} : Step{document::AcceptTrait{trait.organ, trait.property, trait.text}};
  if (accepted) drawIcon(list, Icon::Check, {row.at.x + row.width - 1.5f * size - panel.px(10), row.at.y + row.height / 2}, size * 0.5f, panel.palette.accent);
  if (factButton(panel, row, 0, "reject", Icon::Cross, panel.t("trait_reject")))
    taken = rejected ? Step{document::ForgetTrait{trait.organ, trait.property, trait.text}} : Step{document::RejectTrait{trait.organ, trait.property, trait.text}};
  if (rejected) drawIcon(list, Icon::Cross, {row.at.x + row.width - 0.5f * size - panel.px(6), row.at.y + row.height / 2}, size * 0.5f, panel.palette.error);
  below(panel, row);
  if (!rejected) contradictionOf(panel, trait);
  if (panel.state.factDraft && panel.state.factDraft->index == index)
    if (Taken changed = factFields(panel)) taken = std::move(changed);
  ImGui::PopID();
  return taken;
}

/// What the user knows and the text does not say; it counts instead of all that the text says of the same.
Taken ownFacts(const Panel& panel) {
  Taken taken;
  gap(panel, 6);
  heading(panel, "own_facts");
  for (std::size_t i = 0; i < panel.project.traits.size(); ++i) {
    const document::ProjectTrait& decision = panel.project.traits[i];
    if (!isOwn(decision)) continue;
    ImGui::PushID(static_cast<int>(i) + 100'000);
    const FactRow row = drawFact(panel, ownFact(decision), FactState::Accepted, false);
    if (factButton(panel, row, 0, "forget_own", Icon::Cross, panel.t("own_forget"))) taken = Step{document::ForgetTrait{decision.organ, decision.property, ""}};
    below(panel, row);
    ImGui::PopID();
  }
  auto& draft = panel.state.factDraft;
  if (draft && !draft->index) {
    if (Taken added = factFields(panel)) taken = std::move(added);
    ImGui::SetScrollHereY(1);  // the fields stand at the end of a list that may be long
  } else if (button(panel, "own_add", Emphasis::Plain, -1)) {
    draft = FactDraft{};
  }
  return taken;
}

}  // namespace

Taken describePanel(const Panel& panel) {
  heading(panel, "facts");
  quiet(panel, panel.t("facts_help"));
  gap(panel, 4);
  Taken taken;
  panel.state.hotTrait.reset();
  const auto& said = panel.following.said;
  for (std::size_t i = 0; said && i < said->size(); ++i)
    if (auto step = traitRow(panel, (*said)[i], i)) taken = std::move(step);
  if (said && panel.state.hotTrait && !panel.state.factDraft)
    if (const auto& hot = (*said)[*panel.state.hotTrait]; hot.property == "shape" && !hot.value.empty()) leafPreview(panel, hot.value);
  if (Taken own = ownFacts(panel)) taken = std::move(own);
  return taken;
}

}  // namespace axil::ui
