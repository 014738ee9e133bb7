#include "quantify/backtest.hpp"

#include "quantify/backtest_parts.hpp"
#include "quantify/prepared.hpp"
#include "quantify/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace axil::quantify {

namespace {

constexpr double kNinety = 1.6448536269514722;

std::size_t placeOf(SegmentId id) { return static_cast<std::size_t>(id.value); }

// ---- earlier and later -------------------------------------------------------------------------------------------------

/// Which segment of the later plant each segment of the earlier one is.
class Matcher {
 public:
  Matcher(const Measurements& early, const PlantStructure& earlyStructure, const Measurements& late, const PlantStructure& lateStructure)
      : early_(early), es_(earlyStructure), late_(late), ls_(lateStructure), of_(early.segments.size()) {}

  std::vector<std::optional<SegmentId>> matched() {
    axes(AxisId{0}, AxisId{0});
    // What else leaves the collar.
    std::vector<AxisId> ours, theirs;
    for (std::size_t a = 1; a < es_.axes.size(); ++a)
      if (!es_.axes[a].bearer) ours.push_back(AxisId{static_cast<std::int32_t>(a)});
    for (std::size_t a = 1; a < ls_.axes.size(); ++a)
      if (!ls_.axes[a].bearer) theirs.push_back(AxisId{static_cast<std::int32_t>(a)});
    pair(ours, std::move(theirs));
    return of_;
  }

 private:
  void axes(AxisId a, AxisId b) {
    const Axis& ours = es_.at(a);
    const Axis& theirs = ls_.at(b);
    for (std::size_t r = 0; r < std::min(ours.segments.size(), theirs.segments.size()); ++r) {
      of_[placeOf(ours.segments[r])] = theirs.segments[r];
      pair(lateralsAt(es_, ours, ours.segments[r]), lateralsAt(ls_, theirs, theirs.segments[r]));
    }
  }
  static std::vector<AxisId> lateralsAt(const PlantStructure& structure, const Axis& axis, SegmentId at) {
    std::vector<AxisId> here;
    for (const AxisId lateral : axis.laterals)
      if (structure.at(lateral).bearer == at) here.push_back(lateral);
    return here;
  }
  void pair(const std::vector<AxisId>& ours, std::vector<AxisId> theirs) {
    for (const AxisId a : ours) {
      const auto angle = [&](AxisId b) { return angleBetween(early_.at(es_.at(a).base()).direction, late_.at(ls_.at(b).base()).direction).radians(); };
      const auto nearest = std::min_element(theirs.begin(), theirs.end(), [&](AxisId x, AxisId y) { return angle(x) < angle(y); });
      if (nearest == theirs.end()) return;
      const AxisId b = *nearest;
      theirs.erase(nearest);
      axes(a, b);
    }
  }

  const Measurements& early_;
  const PlantStructure& es_;
  const Measurements& late_;
  const PlantStructure& ls_;
  std::vector<std::optional<SegmentId>> of_;
};

std::size_t leavesOf(const Measurements& m) {
  std::size_t leaves = m.rootLeaves.size();
  for (const Segment& s : m.segments) leaves += s.leaves.size();
  return leaves;
}

// ---- the thesis' form --------------------------------------------------------------------------------------------------

const RuleTemplate* templateFor(const Measurements& m, const std::vector<RuleTemplate>& templates, SegmentId tip) {
  const RuleTemplate* commonest = nullptr;
  for (const RuleTemplate& t : templates) {
    if (const auto& parent = m.at(tip).parent; parent && t.structure == structureOf(m.at(*parent))) return &t;
    if (commonest == nullptr || t.members.size() > commonest->members.size()) commonest = &t;
  }
  return commonest;
}

double middleOf(const Spread& s) { return (s.low + s.high) / 2; }

void addThesisCounts(BacktestOfPlant& result, const Measurements& m, const std::vector<RuleTemplate>& templates) {
  for (std::size_t s = 0; s < m.segments.size(); ++s) {
    if (!m.segments[s].children.empty()) continue;
    const RuleTemplate* t = templateFor(m, templates, SegmentId{static_cast<std::int32_t>(s)});
    if (t == nullptr) continue;
    result.newSegments.thesis += static_cast<double>(t->children.size());
    result.newLeaves.thesis += static_cast<double>(t->leaves.size());
  }
}

// ---- lengths -----------------------------------------------------------------------------------------------------------

double widened(double miss, std::size_t samples) { return kNinety * miss * (samples < 2 ? 2 : 1 + 1.5 / static_cast<double>(samples - 1)); }

/// How much longer an arm is than the usual branch, told by how it leans among its sisters.
double armFactor(const OrderOutlook& bearer, const OrderOutlook& own, const MeasuredPlant& late, SegmentId child) {
  const Measurements& m = *late.measurements;
  const Segment& node = m.at(*m.at(child).parent);
  int axes = 0;
  std::size_t before = 0;
  for (const SegmentId sister : node.children) {
    if (late.structure->at(sister).axis == late.structure->at(*m.at(child).parent).axis) continue;
    ++axes;
    before += m.at(sister).rotr.radians() < m.at(child).rotr.radians() ? 1 : 0;
  }
  const auto arms = bearer.arms.find(axes);
  if (arms == bearer.arms.end() || own.start == StartRule::Usual || own.start == StartRule::Stage) return 1;
  return arms->second[std::min(before, arms->second.size() - 1)].ratio / own.bearerRatio;
}

void compareLengths(BacktestOfPlant& result, const Outlook& outlook, const MeasuredPlant& early, const MeasuredPlant& late, const std::vector<RuleTemplate>& templates) {
  const Measurements& m = *early.measurements;
  const auto match = Matcher(m, *early.structure, *late.measurements, *late.structure).matched();
  std::vector<bool> known(late.measurements->segments.size(), false);
  for (const auto& there : match)
    if (there) known[placeOf(*there)] = true;
  std::map<SegmentId, const TipOutlook*> tips;
  for (const TipOutlook& tip : outlook.tips) tips[tip.tip] = &tip;
  for (std::size_t s = 0; s < m.segments.size(); ++s) {
    if (!match[s]) continue;
    const SegmentId own{static_cast<std::int32_t>(s)};
    const RuleTemplate* thesis = m.at(own).children.empty() ? templateFor(m, templates, own) : nullptr;
    for (const SegmentId child : late.measurements->at(*match[s]).children) {
      if (known[placeOf(child)]) continue;
      ForetoldLength length;
      length.order = late.structure->at(child).order;
      length.first = late.structure->at(child).axis != late.structure->at(*match[s]).axis;
      length.truth = late.measurements->at(child).length;
      length.repeated = m.at(own).length;
      if (thesis != nullptr && !thesis->children.empty()) length.thesis = middleOf(length.first ? thesis->children.front().length : thesis->children.back().length);
      if (length.first) {
        const OrderOutlook& o = outlook.of(length.order);
        length.foretold = o.firstLength(m.at(own).length, outlook.levels[s], outlook.now() + 1) * armFactor(outlook.of(length.order - 1), o, late, child);
        const double reach = widened(o.startMiss, o.starts);
        length.low = length.foretold * std::exp(-reach);
        length.high = length.foretold * std::exp(reach);
      } else if (const auto tip = tips.find(own); tip != tips.end()) {
        length.foretold = tip->second->length;
        length.low = tip->second->low;
        length.high = tip->second->high;
      } else {
        ++result.unforeseen;
        continue;
      }
      result.lengths.push_back(length);
    }
  }
}

/// How many organs the last stage of a plant made.
Organs lastStage(const Measurements& m, const PlantSchedule& schedule, int stages) {
  Organs organs;
  for (std::size_t s = 0; s < m.segments.size(); ++s) {
    if (schedule.birth[s] <= schedule.now - stages + 1e-9) continue;
    organs.segments += 1;
    organs.leaves += static_cast<double>(m.segments[s].leaves.size());
  }
  return organs;
}

BacktestOfPlant tested(const Outlook& outlook, const Measurements& early, const Measurements& late, int stages) {
  BacktestOfPlant result;
  result.segments = early.segments.size();
  // What is known at the earlier time says what axes are at both.
  const StemEnds ends = outlook.statistics.stemEnds;
  const PlantStructure es = plantStructure(early, ends);
  const PlantStructure ls = plantStructure(late, ends);
  const std::vector<RuleTemplate> templates = templatesOf(early);
  countOrgans(result, {static_cast<double>(early.segments.size()), static_cast<double>(leavesOf(early))}, outlook, stages);
  result.newSegments.truth = static_cast<double>(late.segments.size()) - static_cast<double>(early.segments.size());
  result.newLeaves.truth = static_cast<double>(leavesOf(late)) - static_cast<double>(leavesOf(early));
  const Organs last = lastStage(early, outlook.statistics.schedule.plants[outlook.plant], stages);
  result.newSegments.repeated = last.segments;
  result.newLeaves.repeated = last.leaves;
  addThesisCounts(result, early, templates);
  compareLengths(result, outlook, {&early, &es}, {&late, &ls}, templates);
  return result;
}

// ---- skill -------------------------------------------------------------------------------------------------------------

class Mean {
 public:
  void add(double value) {
    sum_ += value;
    count_ += 1;
  }
  [[nodiscard]] double value() const { return count_ > 0 ? sum_ / count_ : 0; }

 private:
  double sum_ = 0;
  double count_ = 0;
};

bool within(double low, double high, double truth) {
  const double slack = 1e-6 * std::abs(truth);
  return truth >= low - slack && truth <= high + slack;
}

BacktestSkill skillOf(const std::vector<BacktestOfPlant>& plants, const std::vector<double>& earlierOrgans) {
  BacktestSkill skill;
  Mean length, repeated, thesis, covered, count, countRepeated, countThesis, fresh, freshRepeated, freshThesis, countCovered;
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const BacktestOfPlant& plant = plants[p];
    for (const ForetoldLength& l : plant.lengths) {
      ++skill.lengths;
      length.add(std::abs(l.foretold - l.truth) / l.truth);
      repeated.add(std::abs(l.repeated - l.truth) / l.truth);
      if (l.thesis > 0) thesis.add(std::abs(l.thesis - l.truth) / l.truth);
      covered.add(within(l.low, l.high, l.truth) ? 1 : 0);
      if (l.high - l.low < 1e-6 * l.truth && std::abs(l.foretold - l.truth) < 1e-6 * l.truth) ++skill.exact;
    }
    const double truth = plant.newSegments.truth + plant.newLeaves.truth;
    const auto off = [&](double ForetoldCount::*by) { return std::abs(plant.newSegments.*by + plant.newLeaves.*by - truth); };
    count.add(off(&ForetoldCount::foretold) / (earlierOrgans[p] + truth));
    countRepeated.add(off(&ForetoldCount::repeated) / (earlierOrgans[p] + truth));
    countThesis.add(off(&ForetoldCount::thesis) / (earlierOrgans[p] + truth));
    if (truth > 0) {
      fresh.add(off(&ForetoldCount::foretold) / truth);
      freshRepeated.add(off(&ForetoldCount::repeated) / truth);
      freshThesis.add(off(&ForetoldCount::thesis) / truth);
    }
    countCovered.add(within(plant.newSegments.low, plant.newSegments.high, plant.newSegments.truth) ? 1 : 0);
  }
  const auto together = [&plants](double ForetoldCount::*by) {
    double foretold = 0, truth = 0;
    for (const BacktestOfPlant& plant : plants) {
      foretold += plant.newSegments.*by + plant.newLeaves.*by;
      truth += plant.newSegments.truth + plant.newLeaves.truth;
    }
    return truth > 0 ? std::abs(foretold - truth) / truth : 0;
  };
  skill.togetherError = together(&ForetoldCount::mean);
  skill.togetherErrorRepeated = together(&ForetoldCount::repeated);
  skill.togetherErrorThesis = together(&ForetoldCount::thesis);
  Mean chance;
  for (const BacktestOfPlant& plant : plants)
    if (const double truth = plant.newSegments.truth + plant.newLeaves.truth; truth > 0) chance.add((plant.newSegments.chance + plant.newLeaves.chance) / truth);
  skill.newErrorByChance = chance.value();
  skill.lengthError = length.value();
  skill.lengthErrorRepeated = repeated.value();
  skill.lengthErrorThesis = thesis.value();
  skill.lengthCoverage = covered.value();
  skill.countError = count.value();
  skill.countErrorRepeated = countRepeated.value();
  skill.countErrorThesis = countThesis.value();
  skill.newError = fresh.value();
  skill.newErrorRepeated = freshRepeated.value();
  skill.newErrorThesis = freshThesis.value();
  skill.countCoverage = countCovered.value();
  return skill;
}

Result<Backtest> testedAll(const std::vector<Measurements>& early, const std::vector<Measurements>& late, const std::vector<std::size_t>& numbers, int stages, std::vector<std::string> notes) {
  Backtest result;
  result.notes = std::move(notes);
  std::vector<double> organs;
  const auto ready = prepared(early);
  if (!ready) return ready.failure();
  const std::vector<Outlook> outlooks = outlooksOf(*ready);
  for (std::size_t p = 0; p < early.size(); ++p) {
    result.plants.push_back(tested(outlooks[p], early[p], late[p], stages));
    result.plants.back().plant = numbers[p];
    organs.push_back(static_cast<double>(early[p].segments.size() + leavesOf(early[p])));
  }
  for (const std::string& warning : outlooks.front().statistics.warnings) result.notes.push_back(warning);
  result.skill = skillOf(result.plants, organs);
  return result;
}

bool showsGrowth(const Measurements& m) {
  return std::any_of(m.segments.begin(), m.segments.end(), [](const Segment& s) { return !s.children.empty(); });
}

Failure badStages(int stages) { return fail(ErrorCode::BadInput, std::to_string(stages) + " stages cannot be cut off; give 1 or more"); }

}  // namespace

Result<Measurements> withoutYoungest(const Measurements& plant, const PlantSchedule& schedule, int stages) {
  const double last = schedule.now - stages + 1e-9;
  Measurements cut;
  cut.unit = plant.unit;
  cut.origin = plant.origin;
  cut.rootLeaves = plant.rootLeaves;
  std::vector<std::optional<SegmentId>> kept(plant.segments.size());
  for (std::size_t s = 0; s < plant.segments.size(); ++s) {
    const Segment& segment = plant.segments[s];
    const bool orphan = segment.parent && !kept[placeOf(*segment.parent)];
    if (schedule.birth[s] > last || orphan) continue;
    kept[s] = SegmentId{static_cast<std::int32_t>(cut.segments.size())};
    cut.segments.push_back(segment);
  }
  if (cut.segments.empty() || !kept.front()) return fail(ErrorCode::NoAnswer, "nothing is left of the plant without its last " + std::to_string(stages) + (stages == 1 ? " stage" : " stages"));
  for (Segment& segment : cut.segments) {
    if (segment.parent) segment.parent = kept[placeOf(*segment.parent)];
    std::vector<SegmentId> children;
    for (const SegmentId child : segment.children)
      if (kept[placeOf(child)]) children.push_back(*kept[placeOf(child)]);
    segment.children = std::move(children);
  }
  return cut;
}

Result<Backtest> backtest(std::span<const Measurements> given, int stages) {
  if (stages < 1) return badStages(stages);
  std::vector<std::string> notes;
  const auto plants = inOneUnit(given, notes);
  if (!plants) return plants.failure();
  const std::vector<PlantStructure> structures = plantStructures(*plants);
  std::vector<MeasuredPlant> measured;
  for (std::size_t p = 0; p < plants->size(); ++p) measured.push_back({&(*plants)[p], &structures[p]});
  if (measured.empty()) return fail(ErrorCode::NoAnswer, "there is no plant to test on");
  const Schedule schedule = scheduleOf(measured);
  std::vector<Measurements> early;
  std::vector<Measurements> late;
  std::vector<std::size_t> numbers;
  for (std::size_t p = 0; p < plants->size(); ++p) {
    auto cut = withoutYoungest((*plants)[p], schedule.plants[p], stages);
    if (!cut || !showsGrowth(*cut)) {
      notes.push_back("plant " + std::to_string(p + 1) + " is too small to cut " + std::to_string(stages) + (stages == 1 ? " stage" : " stages") + " off; it was left out");
      continue;
    }
    early.push_back(std::move(*cut));
    late.push_back((*plants)[p]);
    numbers.push_back(p);
  }
  if (early.empty()) return fail(ErrorCode::NoAnswer, "no plant has stages enough to cut off and foretell; measure plants of three segments in a row at least");
  return testedAll(early, late, numbers, stages, std::move(notes));
}

Result<Backtest> backtest(std::span<const Measurements> earlier, std::span<const Measurements> later, int stages) {
  if (stages < 1) return badStages(stages);
  if (earlier.size() != later.size() || earlier.empty())
    return fail(ErrorCode::BadInput, "there are " + std::to_string(earlier.size()) + " earlier and " + std::to_string(later.size()) + " later measurements; give one later for each earlier");
  std::vector<Measurements> all(earlier.begin(), earlier.end());
  all.insert(all.end(), later.begin(), later.end());
  std::vector<std::string> notes;
  const auto same = inOneUnit(all, notes);
  if (!same) return same.failure();
  const auto half = same->begin() + static_cast<std::ptrdiff_t>(earlier.size());
  std::vector<std::size_t> numbers;
  for (std::size_t p = 0; p < earlier.size(); ++p) numbers.push_back(p);
  if (std::none_of(earlier.begin(), earlier.end(), showsGrowth))
    return fail(ErrorCode::NoAnswer, "nothing can be foretold: no segment of the earlier plants has a child, so nothing shows how they go on; measure them with more nodes");
  return testedAll({same->begin(), half}, {half, same->end()}, numbers, stages, std::move(notes));
}

}  // namespace axil::quantify
