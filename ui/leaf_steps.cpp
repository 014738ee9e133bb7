#include "ui/leaf_steps.hpp"

#include "keywords/presets.hpp"

#include <algorithm>

namespace axil::ui {
namespace {

bool hasLeaves(const document::Project& project, document::StemId stem) {
  return std::any_of(project.leaves.begin(), project.leaves.end(), [&](const auto& entry) { return entry.arrangement.stem == stem; });
}

}  // namespace

quantify::LeafArrangement newLeaves(const std::optional<keywords::Traits>& said, document::StemId stem) {
  quantify::LeafArrangement leaves;
  leaves.stem = stem;
  leaves.nodes = 3;
  leaves.arrangement = "alternate";
  if (said)
    if (const auto presets = keywords::presetsOf(*said); presets.arrangement) leaves.arrangement = presets.arrangement->name;
  return leaves;
}

std::optional<document::Step> firstLeaves(const document::Project& project, const std::optional<keywords::Traits>& said, document::StemId stem) {
  if (hasLeaves(project, stem)) return std::nullopt;
  return document::Step{document::AddLeaves{newLeaves(said, stem)}};
}

std::vector<document::StemId> bareStems(const document::Project& project) {
  std::vector<document::StemId> bare;
  for (const auto& entry : project.stems)
    if (!hasLeaves(project, entry.stem.id)) bare.push_back(entry.stem.id);
  return bare;
}

}  // namespace axil::ui
