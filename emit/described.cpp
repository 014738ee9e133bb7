#include "emit/described.hpp"

#include "base/angle.hpp"
#include "base/text.hpp"
#include "emit/flowering.hpp"
#include "emit/inflorescence.hpp"
#include "emit/text_grammar.hpp"
#include "keywords/keywords.hpp"
#include "keywords/models.hpp"
#include "organs/model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace axil::emit {

namespace {

using keywords::PresetRange;
using keywords::Presets;
using keywords::Traits;

constexpr double kPi = std::numbers::pi;

/// How a plant of a life form stands, where the text says nothing else. Counts are of nodes, angles in radians.
struct Habit {
  const char* name;
  double height_m;      ///< usual height
  double mostDrawn_m;   ///< a taller plant is drawn young
  double leaf_m;        ///< usual length of a leaf
  int stems;            ///< from the ground
  int nodes;            ///< of the longest axis
  int orders;           ///< of branches upon the main stem
  double firstBranch;   ///< the share of the main stem that stays bare
  double branching;     ///< chance that a node above it branches
  double branchAngle;
  double thickness;     ///< radius of the stem's foot to its height
  int crown = 0;        ///< nodes that a branch has more than what is left of its parent's count
};
constexpr Habit kTree{"tree", 8, 3.2, 0.12, 1, 17, 2, 0.30, 0.95, 0.80, 0.0075, 4};
constexpr Habit kShrub{"shrub", 1.5, 1.8, 0.06, 4, 13, 2, 0.15, 0.50, 0.72, 0.0048};
constexpr Habit kSubshrub{"subshrub", 0.6, 0.9, 0.05, 5, 9, 1, 0.10, 0.40, 0.62, 0.005};
constexpr Habit kHerb{"herb", 0.4, 1.0, 0.06, 3, 8, 1, 0.15, 0.35, 0.65, 0.0055};
constexpr Habit kVine{"vine", 2.5, 2.2, 0.07, 2, 22, 1, 0.2, 0.25, 0.9, 0.003};

/// All that the grammar is written from.
struct Design {
  Habit habit = kHerb;
  std::string heading;
  double height_m = 0.4;
  int nodes = 8;
  double internode_m = 0.05;
  int leavesPerNode = 1;
  std::vector<double> turns{2.399963};  ///< from node to node, repeated
  bool rosette = false;
  double leaf_m = 0.05;
  double petiole_m = 0;
  double leafAngle = 0.95;
  std::string leafModel = "defaultleaf";
  std::optional<glm::dvec3> leafColour;
  bool creeps = false, hangs = false, climbs = false, branched = true;
  bool flowers = false;
  bool axillary = false, terminal = true;
  InflorescencePlan inflorescence;
};

std::string cm(double metres) { return num(std::round(metres * 1000) / 10) + " cm"; }

class Designer {
 public:
  Designer(const Traits& traits, const Presets& presets) : traits_(traits), presets_(presets) {}

  Design designed() {
    setHabit();
    setLeaves();
    setSize();
    setFlowers();
    return std::move(design_);
  }

 private:
  [[nodiscard]] bool says(std::string_view organ, std::string_view property, std::string_view value) const {
    return std::any_of(traits_.begin(), traits_.end(), [&](const keywords::Trait& t) {
      return (organ.empty() || t.organ == organ) && t.property == property && t.value == value && t.qualifier != "rarely" && t.qualifier != "sometimes";
    });
  }
  [[nodiscard]] bool saysHabit(std::string_view value) const {
    return presets_.plant.habit == value || presets_.plant.branching == value || says("plant", "habit", value) || says("stem", "habit", value) || says("plant", "branching", value) ||
           says("stem", "branching", value) || says("plant", "orientation", value) || says("stem", "orientation", value);
  }
  void note(const std::string& line) { design_.heading += "// " + line + "\n"; }
  [[nodiscard]] std::string words(const std::string& preset) const {
    const auto found = presets_.evidence.find(preset);
    return found == presets_.evidence.end() ? "" : " (\"" + found->second + "\")";
  }
  static double middleOr(const std::optional<PresetRange>& range, double usual) { return range && range->middle() > 0 ? range->middle() : usual; }

  static const Habit& habitOf(const std::string& lifeForm) {
    if (lifeForm == "tree" || lifeForm == "palm") return kTree;
    if (lifeForm == "shrub") return kShrub;
    if (lifeForm == "subshrub") return kSubshrub;
    if (lifeForm == "vine" || lifeForm == "liana") return kVine;
    return kHerb;
  }

  void setHabit() {
    const std::string& form = presets_.plant.lifeForm;
    design_.habit = habitOf(form);
    note(form.empty() ? std::string("Grows as a herb: the text names no life form.") : "Grows as a " + std::string(design_.habit.name) + words("plant.lifeForm") + ".");
    design_.creeps = saysHabit("prostrate") || saysHabit("creeping") || saysHabit("decumbent");
    design_.hangs = saysHabit("pendulous");
    design_.climbs = design_.habit.name == kVine.name || saysHabit("climbing") || saysHabit("twining");
    if (saysHabit("unbranched")) design_.branched = false;
    if (saysHabit("sparsely branched")) design_.habit.branching *= 0.4;
    if (saysHabit("branched") || saysHabit("much-branched")) design_.habit.branching = std::min(0.9, design_.habit.branching * 1.5);
    if (design_.creeps) design_.habit.stems = std::max(design_.habit.stems, 5);
    if (const auto& angle = presets_.plant.branchAngle_deg) design_.habit.branchAngle = Angle::fromDegrees(std::clamp(angle->middle(), 5.0, 150.0)).radians();
  }

  void setLeaves() {
    const keywords::LeafPreset& leaf = presets_.leaf;
    const auto length = leaf.length_m ? std::optional(leaf.length_m->middle()) : presets_.leafLength_m;
    design_.leaf_m = std::clamp(length.value_or(design_.habit.leaf_m), 0.001, 6.0);
    const bool compound = organs::leafTypeNamed(leaf.type).has_value();
    if (compound && !length && leaf.leafletLength_m) design_.leaf_m = std::clamp(3.2 * leaf.leafletLength_m->middle(), 0.005, 3.0);
    const bool sessile = leaf.attachment == "sessile" || leaf.attachment == "amplexicaul" || leaf.attachment == "perfoliate" || leaf.attachment == "decurrent";
    design_.petiole_m = compound || sessile ? 0 : std::clamp(middleOr(leaf.petiole_m, 0.15 * design_.leaf_m), 0.0, 2 * design_.leaf_m);
    design_.leafModel = keywords::leafModelOf(traits_, presets_);
    if (design_.leafModel.empty()) design_.leafModel = "defaultleaf";
    const auto colours = keywords::leafColours(traits_);
    if (!colours.empty()) design_.leafColour = colours.front();
    if (leaf.angle_deg) design_.leafAngle = Angle::fromDegrees(std::clamp(leaf.angle_deg->middle(), 3.0, 170.0)).radians();
    note("Leaves " + cm(design_.leaf_m) + " long" + (length ? words("leafLength_m") : std::string(": usual, the text does not say")) + ", model \"" + design_.leafModel + "\".");
    setArrangement();
  }

  void setArrangement() {
    if (!presets_.arrangement) {
      note("Leaves in a spiral: the text names no arrangement.");
      return;
    }
    const keywords::ArrangementPreset& arrangement = *presets_.arrangement;
    design_.leavesPerNode = std::clamp(arrangement.leavesPerNode, 1, 24);
    design_.turns = {arrangement.divergence.radians()};
    if (!arrangement.cycle.empty()) {
      design_.turns.clear();
      for (const Angle& angle : arrangement.cycle) design_.turns.push_back(angle.radians());
    }
    design_.rosette = arrangement.name == "rosette" || saysHabit("rosette-forming");
    note("Leaves " + arrangement.name + words("arrangement") + ": " + std::to_string(design_.leavesPerNode) + " at a node, each node turned by " + num(std::round(arrangement.divergence.degrees() * 100) / 100) + " degrees.");
  }

  void setSize() {
    const Habit& habit = design_.habit;
    const double said = middleOr(presets_.plant.height_m, 0);
    const double whole = said > 0 ? said : std::max(habit.height_m, 4 * design_.leaf_m);
    const double most = std::max({habit.mostDrawn_m, 7 * design_.leaf_m});
    design_.height_m = std::clamp(whole, 0.01, most);
    // Internodes near half a leaf, as many as the habit can carry.
    const double internode = std::clamp(design_.height_m / habit.nodes, 0.15 * design_.leaf_m, std::max(1.4 * design_.leaf_m, design_.height_m / 22));
    design_.nodes = std::clamp(static_cast<int>(std::lround(design_.height_m / internode)), 4, 34);
    design_.internode_m = design_.height_m / design_.nodes;
    if (design_.rosette) design_.internode_m = 0.004 * std::max(design_.leaf_m, 0.02);
    if (design_.rosette) design_.nodes = std::max(10, 18 / design_.leavesPerNode);
    note("Height " + cm(design_.height_m) + (said > 0 ? words("plant.height_m") : std::string(": usual, the text does not say")) + (said > design_.height_m * 1.001 ? "; drawn as a young plant" : "") + ".");
  }

  void setFlowers() {
    auto flowering = floweringOf(traits_, presets_, {design_.leaf_m, design_.height_m});
    design_.flowers = flowering.has_value();
    if (!flowering) return note("No flowers: the text says nothing of any.");
    design_.axillary = flowering->axillary;
    design_.terminal = flowering->terminal;
    design_.inflorescence = std::move(flowering->plan);
    for (const std::string& line : flowering->notes) note(line);
  }

  const Traits& traits_;
  const Presets& presets_;
  Design design_;
};

/// Writes a design as a grammar. Apices: A(0) the whole plant, A(1 + order, n) a growing axis with n nodes; A(20) an inflorescence.
class DesignWriter {
 public:
  explicit DesignWriter(const Design& design) : d_(design) {}

  PlantText written(const std::string& name) {
    text_.name = name;
    if (d_.flowers) addInflorescence();
    text_.heading = d_.heading + moments();
    addStages();
    addStart();
    const int orders = d_.branched && !d_.rosette ? d_.habit.orders : 0;
    for (int order = 0; order <= orders; ++order) addAxis(order, order < orders);
    text_.axiom = "A(0)";
    text_.steps = inFlower() + inflorescence_.ripening;
    return std::move(text_);
  }

  /// When the youngest flowers are open.
  [[nodiscard]] int inFlower() const { return d_.nodes + 3 + d_.habit.crown * d_.habit.orders + inflorescence_.steps + growTime(); }

 private:
  static constexpr int kInflorescenceApex = 20, kInflorescenceStage = 40, kPetiole = 30, kScape = 31;
  [[nodiscard]] int growTime() const { return 4; }
  [[nodiscard]] static std::string apex(int order, const std::string& n) { return "A(" + std::to_string(1 + order) + ", " + n + ")"; }
  [[nodiscard]] std::string moments() const {
    if (!d_.flowers) return {};
    return "// In flower at time " + std::to_string(inFlower()) + (inflorescence_.ripening > 0 ? ", in fruit at time " + std::to_string(inFlower() + inflorescence_.ripening) : "") + ".\n";
  }
  void rule(const std::string& words) { text_.rules += "            " + words + " ;\n"; }
  /// Internodes that a branch of a crown makes in a step: shorter ones than the trunk's, with more leaves.
  [[nodiscard]] int internodesAtOnce(int order) const { return d_.habit.crown > 0 && order > 0 ? 2 : 1; }
  /// Nodes of an axis that starts with the plant; axes that start later have as many less.
  [[nodiscard]] int nodesOf(int order) const { return std::max(2, static_cast<int>(std::lround(d_.nodes * (order == 0 ? 1 : order == 1 ? 0.9 : 0.8)))); }
  [[nodiscard]] bool flowersIn(int order) const { return d_.flowers && (d_.terminal || order >= 0); }

  void addInflorescence() {
    InflorescencePlan plan = d_.inflorescence;
    // The first flowers, half way up the plant, are just over when the last ones open.
    plan.fruit.bloom = inflorescenceText(plan, kInflorescenceApex, kInflorescenceStage).steps + growTime() + 4 * d_.nodes / 10 + d_.habit.crown * d_.habit.orders;
    inflorescence_ = inflorescenceText(plan, kInflorescenceApex, kInflorescenceStage);
    text_.flowers += inflorescence_.flowerStages;
    text_.fruits += inflorescence_.fruitStages;
    text_.leaves += inflorescence_.leafStages;
    text_.decomposition += inflorescence_.decomposition;
  }

  /// Trunks and boughs of woody plants are brown, what is young is green.
  [[nodiscard]] glm::dvec3 stemColour(int order) const {
    const glm::dvec3 green{0.36, 0.45, 0.22}, brown{0.40, 0.33, 0.24};
    const double wood = d_.habit.name == kTree.name ? 1 - 0.35 * order : d_.habit.name == kShrub.name ? 0.5 - 0.25 * order : 0;
    return green + (brown - green) * std::max(0.0, wood);
  }

  void addStages() {
    const double foot = d_.habit.thickness * d_.height_m;
    for (int order = 0; order <= (d_.branched && !d_.rosette ? d_.habit.orders : 0); ++order) {
      const double radius = foot * std::pow(0.62, order);
      const double length = d_.internode_m * std::pow(0.85, order) / internodesAtOnce(order);
      std::string more = "BroadenTime = " + std::to_string(d_.nodes + 4) + "; ";
      if (d_.creeps) more += "GravityTropism = 0.25; ";
      else if (d_.hangs && order > 0) more += "GravityTropism = 0.35; ";
      else if (order > 0) more += "GravityTropism = -0.07; ";
      // As thick as its age: at BroadenTime it has the radius of a foot.
      text_.stems += stemStage(1 + order, "", num(length) + "*random(0.9, 1.1)", radius * 4 / (d_.nodes + 4), growTime(), more, stemColour(order));
    }
    if (d_.petiole_m > 0) text_.stems += stemStage(kPetiole, "", num(d_.petiole_m), std::clamp(0.012 * d_.leaf_m, 0.0003, 0.004), growTime(), "");
    if (d_.rosette && d_.flowers) text_.stems += stemStage(kScape, "", num(0.12 * std::max(d_.height_m, d_.leaf_m)), 0.012 * d_.leaf_m + 0.0005, growTime(), "");
    text_.stems += inflorescence_.stemStages;
    const std::string old = d_.habit.name == kTree.name ? "FallAge = " + std::to_string(4 * d_.nodes / 5 + 6 + inflorescence_.steps + inflorescence_.ripening) + "+random(0, 3); " : "";
    text_.leaves += leafStage(1, d_.leafModel, d_.leaf_m, growTime(), d_.leafColour.value_or(glm::dvec3{0.24, 0.46, 0.15}), old);
    text_.rules += inflorescence_.rules;
  }

  void addStart() {
    const int stems = d_.rosette ? 1 : d_.habit.stems;
    std::string start;
    for (int i = 1; i < stems; ++i)
      start += "[" + turn(d_.creeps ? 1.25 : 0.28 + 0.12 * (i % 3), std::remainder(2.399963 * i, 2 * kPi)) + apex(0, std::to_string(1 + i % 3)) + "] ";
    rule("A(0) -> " + start + (d_.creeps ? turn(1.2) : d_.climbs ? turn(0.15) : turn(0.03)) + apex(0, "0"));
  }

  /// The leaves of a node, and what stands in their axils.
  [[nodiscard]] std::string leaves(const std::string& axil) const {
    std::string text;
    for (int i = 0; i < d_.leavesPerNode; ++i) {
      const double around = 2 * kPi * i / d_.leavesPerNode;
      const std::string lean = "rotr(normal(" + num(d_.rosette ? 1.25 : d_.leafAngle) + ", 0.08))rotu(" + num(around) + "+normal(0, 0.06))";
      text += "[" + lean + (d_.petiole_m > 0 ? "S(" + std::to_string(kPetiole) + ") " + turn(0.12) : "") + "L(1)] ";
      if (!axil.empty() && i < (d_.inflorescence.type == InflorescenceType::Solitary ? 2 : 1)) text += "[rotr(0.5)rotu(" + num(around) + ")" + axil + "] ";
    }
    return text;
  }

  [[nodiscard]] std::string toNextNode() const {
    const std::string wander = d_.climbs ? "normal(0.18, 0.1)" : "normal(0, " + num(d_.habit.name == kTree.name ? 0.07 : 0.045) + ")";
    if (d_.turns.size() == 1) return "rotr(" + wander + ")rotu(" + num(d_.turns.front()) + ")";
    std::string choice = num(d_.turns.back());
    for (std::size_t i = d_.turns.size() - 1; i-- > 0;) choice = "(n%" + std::to_string(d_.turns.size()) + " == " + std::to_string(i) + " ? " + num(d_.turns[i]) + " : " + choice + ")";
    return "rotr(" + wander + ")rotu(" + choice + ")";
  }

  void addAxis(int order, bool branches) {
    const int nodes = nodesOf(order);
    std::string body = "S(" + std::to_string(1 + order) + ") ";
    if (internodesAtOnce(order) == 2) body += leaves("") + toNextNode() + body;
    const std::string limit = std::to_string(nodes);
    const int bare = order == 0 ? static_cast<int>(std::lround(d_.habit.firstBranch * nodes)) : 0;
    const std::string on = toNextNode() + apex(order, "n+1");
    const bool axillary = d_.flowers && d_.axillary;
    const int flowering = std::max(bare + 1, static_cast<int>(std::lround(0.55 * nodes)));
    if (axillary) {
      // Large inflorescences stand in a few axils, single flowers in most.
      const double share = d_.inflorescence.type == InflorescenceType::Solitary ? 0.85 : 0.22;
      rule(apex(order, "n") + " : " + std::to_string(flowering) + " <= n < " + limit + " -> " + num(share) + ": " + body + leaves(inflorescence()) + on + " | " + num(1 - share) + ": " + body + leaves("") + on);
    }
    if (branches) {
      const int until = axillary ? flowering : nodes - 2;
      const std::string first = d_.habit.crown == 0 ? "n+1" : "n+1-" + std::to_string(d_.habit.crown);
      const std::string branch = "[rotr(normal(" + num(d_.habit.branchAngle) + ", 0.1))rotu(random(0.2, 1.2))" + apex(order + 1, first) + "] ";
      const std::string pair = d_.leavesPerNode == 2 ? "[rotr(normal(" + num(d_.habit.branchAngle) + ", 0.1))rotu(3.141593+random(0.2, 1.2))" + apex(order + 1, "n+2") + "] " : "";
      const double chance = d_.habit.branching * (order == 0 ? 1 : 0.7);
      if (until > bare)
        rule(apex(order, "n") + " : " + std::to_string(bare) + " <= n < " + std::to_string(until) + " -> " + num(chance) + ": " + body + leaves("") + branch + pair + on + " | " + num(1 - chance) + ": " + body + leaves("") + on);
    }
    rule(apex(order, "n") + " : n < " + limit + " -> " + body + leaves("") + on);
    const std::string scape = d_.rosette ? "S(" + std::to_string(kScape) + ") S(" + std::to_string(kScape) + ") S(" + std::to_string(kScape) + ") " : "";
    if (d_.flowers && d_.terminal) rule(apex(order, "n") + " -> " + scape + inflorescence());
    else rule(apex(order, "n") + " -> " + std::string(d_.rosette && d_.flowers ? scape + inflorescence() : "L(1)"));
  }

  [[nodiscard]] static std::string inflorescence() { return "A(" + std::to_string(kInflorescenceApex) + ")"; }

  const Design& d_;
  PlantText text_;
  InflorescenceText inflorescence_;
};

}  // namespace

Result<DescribedPlant> describedPlant(const Traits& traits, const DescribedOptions& options) {
  if (traits.empty()) return fail(ErrorCode::NoAnswer, "the description names no trait of a plant; say how its leaves, stems or flowers look");
  const Presets presets = keywords::presetsOf(traits);
  const Design design = Designer(traits, presets).designed();
  DesignWriter writer(design);
  auto grammar = grammarOf(writer.written(options.name));
  if (!grammar) return grammar.failure();
  return DescribedPlant{std::move(*grammar), static_cast<double>(writer.inFlower())};
}

Result<simeco::Grammar> describedGrammar(const Traits& traits, const DescribedOptions& options) {
  auto plant = describedPlant(traits, options);
  if (!plant) return plant.failure();
  return std::move(plant->grammar);
}

}  // namespace axil::emit
