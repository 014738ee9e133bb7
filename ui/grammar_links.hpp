#pragma once
/// \file
/// Grammar links: which lines of a grammar speak of which measured segment, and back. Axil's own grammars number their stem stages so
/// that stage k + 2 is segment k (emit/initial.hpp); the lines of such a stage and of the rules that rewrite its modules belong together.
/// And the way back into the photos: what an edited grammar grows elsewhere, as moved clicks.

#include "document/command.hpp"
#include "document/derived.hpp"
#include "simeco/growth.hpp"
#include "simeco/language.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace axil::ui {

/// For each line of the text the segment it speaks of; -1: of none.
[[nodiscard]] std::vector<int> segmentsOfLines(std::string_view text, const simeco::Grammar& grammar);

/// The stage of stem bodies of segment `segment`, and back.
[[nodiscard]] constexpr int stageOfSegment(int segment) { return segment + 2; }

/// What must be clicked elsewhere so that the photos show the plant as `plant` has grown: every node whose stem segment ends in another
/// place than the skeleton has it, in each view where it is clicked, moved by as much as its projection. Empty: nothing moves.
[[nodiscard]] document::Step clicksFollowing(const document::Project& project, const document::Measured& measured, const skeleton3d::Skeleton& skeleton,
                                             const quantify::Measurements& measurements, const simeco::Plant& plant);

}  // namespace axil::ui
