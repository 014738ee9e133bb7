#include "document/command.hpp"

#include "base/text.hpp"
#include "document/command_parts.hpp"

#include <algorithm>
#include <cmath>

namespace axil::document {

namespace {

constexpr std::uint64_t kMaximumSeed = std::uint64_t{1} << 53;

bool hasControlCharacter(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

// ---- decisions -------------------------------------------------------------------------------------------------------

Result<void> checkDecision(const ProjectTrait& trait) {
  if (auto checked = checkName("the organ", trait.organ); !checked) return checked;
  if (auto checked = checkName("the property", trait.property); !checked) return checked;
  if (trait.words.empty()) return {};
  return checkName("the words", trait.words);
}

bool sameFact(const ProjectTrait& a, const ProjectTrait& b) { return a.organ == b.organ && a.property == b.property && a.words == b.words; }

std::optional<std::size_t> decisionLike(const Project& project, const ProjectTrait& trait) {
  for (std::size_t i = 0; i < project.traits.size(); ++i)
    if (sameFact(project.traits[i], trait)) return i;
  return std::nullopt;
}

Result<Project> decided(Project project, ProjectTrait trait) {
  if (auto checked = checkDecision(trait); !checked) return checked.failure();
  if (const auto at = decisionLike(project, trait)) {
    trait.extras = project.traits[*at].extras;
    project.traits.set(*at, std::move(trait));
  } else {
    project.traits.push_back(std::move(trait));
  }
  return project;
}

template <class C>
ProjectTrait decision(const C& command, Verdict verdict) {
  ProjectTrait trait;
  trait.organ = command.organ;
  trait.property = command.property;
  trait.words = command.words;
  trait.verdict = verdict;
  return trait;
}

}  // namespace

Result<void> checkName(const std::string& what, std::string_view text) {
  if (text.empty()) return fail(ErrorCode::BadInput, what + " must not be empty");
  if (text.size() > kMaximumNameBytes)
    return fail(ErrorCode::LimitReached, what + " is longer than " + std::to_string(kMaximumNameBytes) + " bytes; shorten it");
  if (!isUtf8(text)) return fail(ErrorCode::BadInput, what + " is not UTF-8 text");
  if (hasControlCharacter(text)) return fail(ErrorCode::BadInput, what + " must be one line without control characters");
  return {};
}

Result<void> checkNumber(const std::string& what, double value, double low, double high) {
  if (std::isfinite(value) && value >= low && value <= high) return {};
  return fail(ErrorCode::BadInput, what + " is " + shortest(value) + "; it must be from " + shortest(low) + " to " + shortest(high));
}

Result<Project> after(Project project, const SetName& command) {
  if (auto checked = checkName("the plant's name", command.name); !checked) return checked.failure();
  project.name = command.name;
  return project;
}

Result<Project> after(Project project, const SetDescription& command) {
  if (command.text.size() > kMaximumDescriptionBytes) return fail(ErrorCode::LimitReached, "the description is longer than 1 MiB; keep to one plant's");
  if (!isUtf8(command.text.text())) return fail(ErrorCode::BadInput, "the description is not UTF-8 text");
  project.description = command.text;
  return project;
}

Result<Project> after(Project project, const SetSeed& command) {
  if (command.seed > kMaximumSeed) return fail(ErrorCode::BadInput, "the seed must be from 0 to " + std::to_string(kMaximumSeed));
  project.seed = command.seed;
  return project;
}

Result<Project> after(Project project, const SetUnit& command) {
  if (auto checked = checkName("the unit", command.unit); !checked) return checked.failure();
  project.unit = command.unit;
  return project;
}

Result<Project> after(Project project, const AcceptTrait& command) {
  if (command.words.empty()) return fail(ErrorCode::BadInput, "only what the description says can be accepted; name its words");
  return decided(std::move(project), decision(command, Verdict::Accepted));
}

Result<Project> after(Project project, const ChangeTrait& command) {
  if (auto checked = checkName("the value", command.value); !checked) return checked.failure();
  ProjectTrait trait = decision(command, Verdict::Changed);
  trait.value = command.value;
  return decided(std::move(project), std::move(trait));
}

Result<Project> after(Project project, const ChangeTraitRange& command) {
  if (!std::isfinite(command.low) || !std::isfinite(command.high) || command.low > command.high)
    return fail(ErrorCode::BadInput, "the range from " + shortest(command.low) + " to " + shortest(command.high) + " is none; give the smaller number first");
  if (!command.unit.empty())
    if (auto checked = checkName("the unit", command.unit); !checked) return checked.failure();
  ProjectTrait trait = decision(command, Verdict::Changed);
  trait.low = command.low;
  trait.high = command.high;
  trait.unit = command.unit;
  return decided(std::move(project), std::move(trait));
}

Result<Project> after(Project project, const RejectTrait& command) {
  if (command.words.empty()) return fail(ErrorCode::BadInput, "only what the description says can be rejected; forget_trait takes back a fact of your own");
  return decided(std::move(project), decision(command, Verdict::Rejected));
}

Result<Project> after(Project project, const ForgetTrait& command) {
  const auto at = decisionLike(project, decision(command, Verdict::Accepted));
  if (!at) return fail(ErrorCode::NotFound, "nothing was decided about " + command.organ + " " + command.property + " " + inQuotes(command.words));
  project.traits.erase(*at);
  return project;
}

Result<Project> apply(const Project& project, const Command& command) {
  return std::visit([&](const auto& one) { return after(project, one); }, command);
}

Result<Project> apply(const Project& project, std::span<const Command> step) {
  Project next = project;
  for (const Command& command : step) {
    auto result = document::apply(next, command);
    if (!result) return result;
    next = std::move(*result);
  }
  return next;
}

}  // namespace axil::document
