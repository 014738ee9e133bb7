#pragma once
/// \file
/// Growth: a SimEco grammar as a plant over continuous time. A module whose number has a Stage is an *organ*; a module
/// without one (rotr, brackets, counters such as S(1002)) has no body.
///
/// - Derivation step k happens at time k x DeriveTime (1 when missing). An organ is born when its module appears.
/// - length = GrowRate x response x min(age, GrowTime). GrowRate missing: 0; GrowTime missing: 1. Where response or light change
///   on the way, each stretch of time counts with its own.
/// - radius = BroadenRate x min(age, BroadenTime) x modelRadius; BroadenTime missing: GrowTime. A stem whose stage has no BroadenRate
///   gets defaultStemShare x modelRadius when fully grown; other organs without one get 0: as wide as their shape says.
/// - When a rule rewrites an organ its body stays and ages on from its own birth; what the rule made starts at its tip. An organ
///   that is merely copied keeps its birth.
/// - rotr and rotu add up until the next organ. The first organ after `[` is a branch of the organ at whose tip the bracket
///   opened, every other organ is the main child of the organ before it (base/turning.hpp). Before the first organ stands a frame
///   along the plant's Direction, at its Position.
/// - response = the product of bell curves of SoilPH, RainRate, DayLight and Temperature (the host's Environment, else the plant's own
///   attributes, else the ecosystem's; missing ones do not act), each 1 at its optimum: exp(-((x - best) / width)^2 / 2).
/// - An organ's tip is a particle and the organ its trail (growth_path.hpp): tropisms, wind and obstacles turn it while it grows. Where
///   nothing acts the organ is straight. Leaves, flowers and fruits do not bend, they swing. What stands on an organ starts at its tip
///   with the frame that it has there.
/// - Organs unfold, wither and fall as their stage says; what stands on a fallen organ falls with it.
/// - LightResponse: organs grow as their light lets them (light_grid.hpp), computed at every step of any plant of the ecosystem.
///
/// The plant at a time is a pure function of grammar, seed, environment and time: any time in any order; steps and changes of the
/// environment that come later change nothing earlier. Units: lengths as in the grammar, time as in DeriveTime.
/// Fails as `derive` does; with BadGrammar for attributes that are no numbers; with BadInput for a time that is negative or not
/// a number, or later than growth was prepared for, for an environment that makes no sense, for a plant inside an obstacle; with
/// LimitReached where light or a host's environment would be computed more than 100 000 times.
/// Sources: L-Grammar Generator 2005, section 3.4; docs/simeco.md, "Growth".

#include "base/turning.hpp"
#include "simeco/derive.hpp"
#include "simeco/environment.hpp"
#include "simeco/plant.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace axil::simeco {

/// The radius of every model (DefaultStem.i) before BroadenRate acts, in the grammar's unit. Models are not part of the
/// language; with a hundredth the appendix' first stem (BroadenRate 1, GrowTime 1) is a hundredth thick in a plant of height 1.
constexpr double modelRadius = 0.01;
/// Of modelRadius, for stems whose stage has no BroadenRate: as thick as the appendix' outer stems (BroadenRate 0.2).
constexpr double defaultStemShare = 0.2;

struct GrowOptions {
  std::uint64_t seed = 1;
  Limits limits = {};
  Watch watch = {};
  TurningRule turning = TurningRule::Exact;
  std::optional<double> upToTime = {}; ///< derive only the steps up to this time; later times cannot be asked for
  std::optional<std::int64_t> steps = {};  ///< derive so many steps; later times show the same organs grown on
  Environment environment = {};            ///< what it says counts over the grammar's attributes
  std::vector<EnvironmentChange> changes = {};  ///< in time order; each is the whole environment from its time on
  /// Instead of `changes`, where what the plants have become decides: asked at every step of any plant, in order of time from 0 on, with all
  /// plants as they stand and the environment that they stand in; what it answers is the environment from then on. A failure ends growth.
  std::function<Result<Environment>(const Plant& plant, const Environment& now)> betweenSteps = {};
};

struct GrowthData;

/// A derivation with its history, ready to be shown at any time. Immutable; copies share it.
class Growth {
 public:
  explicit Growth(std::shared_ptr<const GrowthData> data) : data_(std::move(data)) {}
  [[nodiscard]] const GrowthData& data() const { return *data_; }

 private:
  std::shared_ptr<const GrowthData> data_;
};

/// Derives all plants of `grammar` and remembers when every organ was born and where it stands. Steps: as given, else up to
/// `upToTime`, else the grammar's own number, else until nothing changes.
[[nodiscard]] Result<Growth> prepareGrowth(const Grammar& grammar, const GrowOptions& options = {});

/// All plants of the grammar at time `time`.
[[nodiscard]] Result<Plant> plantAt(const Growth& growth, double time);

/// The first time from which on nothing grows any more: after the last step, all organs fully grown and unfolded. What withers or
/// falls may do so later.
[[nodiscard]] double completeTime(const Growth& growth);

}  // namespace axil::simeco
