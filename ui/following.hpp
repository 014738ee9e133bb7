#pragma once
/// \file
/// What follows from the project, worked out in the background: cameras, skeleton, numbers, grammars, and their growth ready to be shown
/// at any time. Every answer keeps the last good value beside the trouble of the present project.

#include "document/derived.hpp"
#include "quantify/contradictions.hpp"
#include "render/types.hpp"
#include "simeco/environment.hpp"
#include "simeco/growth.hpp"
#include "simeco/language.hpp"
#include "skeleton3d/doubts.hpp"
#include "ui/worker.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace axil::ui {

/// A grammar as text, what is wrong with it, and its growth.
struct GrownGrammar {
  std::string text;
  std::vector<Diagnostic> diagnostics;   ///< of the text, read back
  std::vector<int> segments;             ///< for each line the measured segment it speaks of; -1: none (ui/grammar_links.hpp)
  std::optional<simeco::Growth> growth;
  double end = 0;                        ///< when all is grown
  PlantPoint middle;                     ///< of the grown plant
  double reach = 1;                      ///< of the grown plant, from its middle
  std::optional<Error> trouble;          ///< why it does not grow
};

/// The moment that is shown of it: `time`, or when all is grown.
[[nodiscard]] inline double timeShown(double time, const GrownGrammar& grown) { return time < 0 ? grown.end : std::min(time, grown.end); }

struct Following {
  std::uint64_t revision = 0;            ///< of the project it was worked out from
  std::optional<keywords::Traits> said;  ///< all that the description says, before any decision
  document::Shown<document::Measured> measured;
  document::Shown<skeleton3d::Skeleton> skeleton;
  document::Shown<quantify::Measurements> measurements;
  std::vector<quantify::PhotoContradiction> contradictions;  ///< of the description with what was measured
  std::vector<document::PhotoTrouble> photos;
  std::array<std::shared_ptr<const GrownGrammar>, 3> grammars;       ///< by GrammarKind; null: there has not been one yet
  std::array<std::optional<Error>, 3> grammarTroubles;
  skeleton3d::Doubts doubts;             ///< what to look at again in the skeleton; clicks that were left out are not among them
  bool partly = false;                   ///< skeleton and all after it are of the part that can be measured already
  double seconds = 0;                    ///< how long it took

  [[nodiscard]] const GrownGrammar* grammar(document::GrammarKind kind) const { return grammars[static_cast<std::size_t>(kind)].get(); }
};

struct FollowQuestion {
  document::OpenProject open;
  std::uint64_t revision = 0;
  simeco::Environment environment = {};
};

using Follower = Worker<FollowQuestion, std::shared_ptr<const Following>>;
/// What a Follower does, question after question; what has not changed is kept between them.
[[nodiscard]] Follower::Work followingWork();

/// A text that is being written: what is wrong with it, and its growth where there is one.
[[nodiscard]] std::shared_ptr<const GrownGrammar> grownFrom(std::string text, std::uint64_t seed, const simeco::Environment& environment);

struct DraftQuestion {
  std::string text;
  std::uint64_t seed = 1;
  simeco::Environment environment = {};
};
using DraftGrower = Worker<DraftQuestion, std::shared_ptr<const GrownGrammar>>;

}  // namespace axil::ui
