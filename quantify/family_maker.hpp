#pragma once
/// \file
/// How a family (family.hpp) is worked out of plants, step by step: what one step finds the next ones use. Private to this room; family.cpp has the recipe, how axes end and branch, angles and bodies,
/// family_lengths.cpp how long segments are.

#include "quantify/family.hpp"
#include "quantify/prepared.hpp"

#include <compare>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace axil::quantify {

/// One axis and what it could have made.
struct AxisCase {
  std::size_t plant = 0;
  const Axis* axis = nullptr;
  double potential = 0;        ///< segments it may make in all
  double bearerLeft = 0;       ///< of its bearer, after the node it stands at
  double bearerRank = 0;
  [[nodiscard]] double count() const { return static_cast<double>(axis->segments.size()); }
};
class FamilyMaker {
 public:
  FamilyMaker(std::span<const MeasuredPlant> plants, Outlook outlook) : plants_(plants), outlook_(std::move(outlook)) {}

  Family made();

 private:
  [[nodiscard]] const Schedule& schedule() const { return outlook_.statistics.schedule; }
  [[nodiscard]] std::size_t groupOf(int order) const;

  /// Stages of each plant. Where most plants are of one age and none is older, smaller ones have ended early.
  void setAges();

  void setGroups();

  /// Whether first axes are as long as the modules above them.
  [[nodiscard]] bool modulesAlike() const;

  template <class Visit>
  void eachCase(std::size_t g, Visit visit) {
    for (auto& plant : cases_)
      for (AxisCase& c : plant)
        if (groupOf(c.axis->order) == g) visit(c);
  }

  // ---- how many segments -----------------------------------------------------------------------------------------------

  void setExtent(std::size_t g);
  [[nodiscard]] bool forksOften() const;

  void setPotential(const FamilyOrder& o, AxisCase& c);

  /// A number of segments that axes end at too often for chance.
  void setMost(std::size_t g);

  /// Left as a line along the bearer, or alike everywhere.
  void setOwn(std::size_t g);

  // ---- what becomes of a node --------------------------------------------------------------------------------------------

  void setFates(std::size_t g);

  // ---- lengths -----------------------------------------------------------------------------------------------------------

  static std::vector<double> logsOf(const Measurements& m, const Axis& axis);

  void setLengths(std::size_t g);

  /// Of an axis: its first length, or the level its lengths vary around.
  double levelOf(const AxisCase& c);
  double lengthAt(const AxisCase& c, int rank);

  /// Where each axis that is an arm stands among its sisters.
  void setArmPlaces();
  struct ArmPlace {
    std::size_t bearers = 0;   ///< group of what bears it
    int count = 0;             ///< 0: no arm
    std::size_t arm = 0;
    friend auto operator<=>(const ArmPlace&, const ArmPlace&) = default;
  };
  [[nodiscard]] ArmPlace armOf(const AxisCase& c) const;

  void setStart(std::size_t g);
  /// Where axes have one segment each, sisters tell a bearer's own chance from the level that they inherit: all of them are short against a bearer that is long by chance.
  static double noiseOfBearers(const std::map<std::pair<std::size_t, SegmentId>, std::vector<std::pair<ArmPlace, double>>>& sisters, const std::map<ArmPlace, std::vector<double>>& ratios);
  /// Where levels follow from one another, all axes tell that of the first ones.
  double levelOfFirst(const std::map<ArmPlace, std::vector<double>>& ratios);
  /// Gives lengths of axes of one segment a chance of their own, and those of the only bearer below them, which are told by nothing else.
  void giveNoise(std::size_t g, double noise, std::size_t samples);
  /// Around the mean of each arm.
  static double deviationWithin(const std::map<ArmPlace, std::vector<double>>& groups);

  // ---- angles ------------------------------------------------------------------------------------------------------------

  void setAngles(std::size_t g);

  // ---- bodies ------------------------------------------------------------------------------------------------------------

  void setRadius(std::size_t g);

  void setLeaves(std::size_t g);

  std::span<const MeasuredPlant> plants_;
  Outlook outlook_;
  Family family_;
  std::vector<std::vector<AxisCase>> cases_;   ///< of each plant, by AxisId
  std::vector<double> ages_;                   ///< of each plant, stages
  std::map<std::size_t, bool> alike_;          ///< axes of a group share one level
  std::map<std::size_t, double> residual_;
  std::map<std::pair<std::size_t, SegmentId>, ArmPlace> armOf_;
};

}  // namespace axil::quantify
