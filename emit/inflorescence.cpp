#include "emit/inflorescence.hpp"

#include "base/source.hpp"
#include "base/text.hpp"
#include "emit/text_grammar.hpp"
#include "simeco/growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace axil::emit {

namespace {

using Type = InflorescenceType;

constexpr std::array<std::pair<std::string_view, Type>, 18> typeWords{{{"solitary", Type::Solitary},
                                                                       {"raceme", Type::Raceme},
                                                                       {"spike", Type::Spike},
                                                                       {"panicle", Type::Panicle},
                                                                       {"corymb", Type::Corymb},
                                                                       {"umbel", Type::Umbel},
                                                                       {"compound umbel", Type::CompoundUmbel},
                                                                       {"head", Type::Head},
                                                                       {"cyme", Type::Cyme},
                                                                       {"catkin", Type::Catkin},
                                                                       {"spadix", Type::Spadix},
                                                                       {"fascicle", Type::Fascicle},
                                                                       {"thyrse", Type::Panicle},
                                                                       {"scorpioid cyme", Type::Cyme},
                                                                       {"verticillaster", Type::Fascicle},
                                                                       {"capitulum", Type::Head},
                                                                       {"cyathium", Type::Head},
                                                                       {"hypanthodium", Type::Head}}};
constexpr std::size_t typeCount = 12;

int usualFlowers(Type type) {
  switch (type) {
    case Type::Solitary: return 1;
    case Type::Raceme: return 18;
    case Type::Spike: return 36;
    case Type::Panicle: return 42;
    case Type::Corymb: return 18;
    case Type::Umbel: return 16;
    case Type::CompoundUmbel: return 72;
    case Type::Head: return 30;
    case Type::Cyme: return 15;
    case Type::Catkin: return 60;
    case Type::Spadix: return 90;
    case Type::Fascicle: return 4;
  }
  return 1;
}

/// Writes one inflorescence. Stage numbers: stalk, axis, pedicel, floret-bearing axis; leaf stage: a spathe.
class Writer {
 public:
  Writer(const InflorescencePlan& plan, int firstApex, int firstStage)
      : plan_(plan), apex_(firstApex), stalk_(firstStage), axis_(firstStage + 1), pedicel_(firstStage + 2), rod_(firstStage + 3),
        flowers_(std::clamp(plan.flowers > 0 ? plan.flowers : usualFlowers(plan.type), 1, 200)), reach_(std::max(plan.flowerLength, 0.5 * plan.flowerWidth)) {}

  InflorescenceText written() {
    writeType();
    if (!plan_.fruit.model.empty()) writeFruit();
    writeStages();
    return std::move(out_);
  }

 private:
  static constexpr int kFruitApex = 5, kFruitGrowTime = 4;

  // ---- words
  [[nodiscard]] std::string a(int kind) const { return "A(" + std::to_string(apex_ + kind) + ")"; }
  [[nodiscard]] std::string a(int kind, const std::string& argument) const { return "A(" + std::to_string(apex_ + kind) + ", " + argument + ")"; }
  [[nodiscard]] std::string s(int stage) const { return "S(" + std::to_string(stage) + ")"; }
  [[nodiscard]] std::string s(int stage, const std::string& length) const { return "S(" + std::to_string(stage) + ", " + length + ")"; }
  /// A flower; where fruits are set, beside a counter that becomes one when the flower is over.
  [[nodiscard]] std::string flower(int ring = 0) const {
    const std::string open = "W(" + std::to_string(1 + ring) + ")";
    return plan_.fruit.model.empty() ? open : "[" + open + "] " + a(kFruitApex, std::to_string(plan_.fruit.bloom));
  }
  [[nodiscard]] std::size_t rings() const { return std::clamp<std::size_t>(plan_.colours.size(), 1, 4); }
  void rule(const std::string& text) { out_.rules += "            " + text + " ;\n"; }
  void atOnce(const std::string& text) { out_.decomposition += "                " + text + " ;\n"; }
  [[nodiscard]] double lengthOr(double usual) const { return plan_.length > 0 ? plan_.length : usual; }

  /// The flower at place i of n from the centre outwards: rings of different colour, the first colour outside.
  void ringRules(int kind, const std::string& before, const std::string& after, int n) {
    const std::size_t count = rings();
    for (std::size_t ring = 0; ring < count; ++ring) {
      const bool last = ring + 1 == count;
      const std::string limit = last ? std::to_string(n) : num(n * static_cast<double>(ring + 1) / static_cast<double>(count));
      atOnce(a(kind, "i") + " : i < " + limit + " -> " + before + flower(static_cast<int>(count - 1 - ring)) + after);
    }
    atOnce(a(kind, "i") + " -> ");
  }

  void writeType() {
    switch (plan_.type) {
      case Type::Solitary: return solitary();
      case Type::Raceme: return raceme(1.3 * reach_, 1.0);
      case Type::Spike: return raceme(0, 0.9);
      case Type::Panicle: return panicle();
      case Type::Corymb: return corymb();
      case Type::Umbel: return umbel(1, 3.2 * reach_);
      case Type::CompoundUmbel: return compoundUmbel();
      case Type::Head: return head();
      case Type::Cyme: return cyme();
      case Type::Catkin: return catkin();
      case Type::Spadix: return spadix();
      case Type::Fascicle: return fascicle();
    }
  }

  void solitary() {
    stalkLength_ = lengthOr(1.2 * reach_);
    rule(a(0) + " -> " + s(stalk_) + " " + flower());
    out_.steps = 1;
  }

  /// Flowers one after another up an axis, the lowest first, in a spiral.
  void raceme(double pedicel, double lean) {
    // A length without a count: as many flowers as stand close along it.
    if (plan_.length > 0 && plan_.flowers == 0) flowers_ = std::clamp(static_cast<int>(std::lround(plan_.length / ((pedicel > 0 ? 0.4 : 0.3) * reach_))), 6, 80);
    const double spacing = lengthOr(flowers_ * (pedicel > 0 ? 0.7 : 0.33) * reach_) / flowers_;
    stalkLength_ = 4 * spacing + reach_;
    axisLength_ = spacing;
    pedicelLength_ = pedicel;
    rule(a(0) + " -> " + s(stalk_) + " " + a(1, "0"));
    const std::string standing = pedicel > 0 ? s(pedicel_, num(pedicel) + "*(1-0.6*i/" + std::to_string(flowers_) + ")") + " " : "";
    rule(a(1, "i") + " : i < " + std::to_string(flowers_) + " -> " + s(axis_) + " [" + turn(lean) + standing + flower() + "] rotr(0)rotu(2.399963)" + a(1, "i+1"));
    rule(a(1, "i") + " -> " + flower());
    out_.steps = flowers_ + 2;
  }

  /// Side axes of the second order that get shorter upwards.
  void panicle() {
    const int branches = std::clamp(static_cast<int>(std::lround(std::sqrt(1.6 * flowers_))), 4, 16);
    const double length = lengthOr(std::sqrt(static_cast<double>(flowers_)) * 1.4 * reach_);
    const double perFlower = 0.42 * length / std::max(2.0, 2.0 * flowers_ / branches);
    stalkLength_ = 0.15 * length;
    axisLength_ = length / branches;
    pedicelLength_ = 0.8 * reach_;
    sideLength_ = std::max(perFlower, 0.35 * reach_);
    rule(a(0) + " -> " + s(stalk_) + " " + a(1, "0"));
    const std::string n = std::to_string(branches);
    rule(a(1, "i") + " : i < " + n + " -> " + s(axis_) + " [" + turn(0.85) + s(rod_) + " " + a(2, num(2.0 * flowers_ / branches) + "*(1-i/" + n + ")") + "] rotr(0)rotu(2.399963)" + a(1, "i+1"));
    rule(a(1, "i") + " -> " + flower());
    rule(a(2, "k") + " : k > 1 -> " + s(rod_) + " [rotr(0.8)rotu(random(0, 6.28))" + s(pedicel_, num(pedicelLength_)) + " " + flower() + "] rotr(0)rotu(2.399963)" + a(2, "k-1"));
    rule(a(2, "k") + " -> " + s(pedicel_, num(0.6 * pedicelLength_)) + " " + flower());
    out_.steps = branches + 2 + static_cast<int>(2.0 * flowers_ / branches / 2);
  }

  /// Stalks from different heights that end at one height; the farther out the longer.
  void corymb() {
    const double across = lengthOr(1.02 * plan_.flowerWidth * std::sqrt(static_cast<double>(flowers_)));
    const double height = 0.42 * across;
    stalkLength_ = 1.5 * reach_;
    axisLength_ = 0.35 * height / flowers_;
    pedicelLength_ = height;
    rule(a(0) + " -> " + s(stalk_) + " " + a(1, std::to_string(flowers_)));
    // Place i from the centre outwards stands at radius r = R sqrt(i / n); its stalk leaves the axis below the level top.
    const std::string n = std::to_string(flowers_);
    const std::string r = num(0.5 * across) + "*sqrt((i-0.5)/" + n + ")";
    const std::string h = "(" + num(0.65 * height) + "+" + num(0.35 * height) + "*i/" + n + ")";
    ringsByPlace(1, n, [&](const std::string& w) { return s(axis_) + " [rotr(atan2(" + r + ", " + h + "))rotu(0)" + s(pedicel_, "sqrt((" + r + ")^2+" + h + "^2)") + " " + w + "] rotr(0)rotu(2.399963)" + a(1, "i-1"); });
    out_.steps = 2;
  }

  /// As ringRules, for a count that runs down from n: what is born first stands lowest and goes farthest out.
  template <class Successor>
  void ringsByPlace(int kind, const std::string& n, Successor successor) {
    const std::size_t count = rings();
    for (std::size_t ring = 0; ring < count; ++ring) {
      const double limit = static_cast<double>(flowers_) * (1 - static_cast<double>(ring + 1) / static_cast<double>(count));
      atOnce(a(kind, "i") + " : i > " + (ring + 1 == count ? std::string("0") : num(std::max(0.5, limit))) + " -> " + successor(flower(static_cast<int>(ring))));
    }
    atOnce(a(kind, "i") + " -> ");
    (void)n;
  }

  /// Stalks of equal length from one point, spread over a dome.
  void umbel(int kind, double ray) {
    const double length = plan_.length > 0 ? plan_.length : std::max(ray, 0.42 * plan_.flowerWidth * std::sqrt(static_cast<double>(flowers_)) / 0.9);
    stalkLength_ = 2.2 * length;
    pedicelLength_ = length;
    rule(a(0) + " -> " + s(stalk_) + " " + a(kind, "0"));
    ringRules(kind, "[rotr(1.15*sqrt((i+0.5)/" + std::to_string(flowers_) + "))rotu(2.399963*i)" + s(pedicel_, num(length)) + " ", "] " + a(kind, "i+1"), flowers_);
    out_.steps = 2;
  }

  void compoundUmbel() {
    const int rays = 12;
    const int each = std::max(4, flowers_ / rays);
    const double ray = lengthOr(0.55 * plan_.flowerWidth * std::sqrt(static_cast<double>(flowers_)) * 1.25);
    stalkLength_ = 1.6 * ray;
    axisLength_ = ray;
    pedicelLength_ = 0.24 * ray;
    rule(a(0) + " -> " + s(stalk_) + " " + a(1, "0"));
    atOnce(a(1, "i") + " : i < " + std::to_string(rays) + " -> [rotr(1.0*sqrt((i+0.3)/" + std::to_string(rays) + "))rotu(2.399963*i)" + s(axis_) + " " + a(2, "0") + "] " + a(1, "i+1"));
    atOnce(a(1, "i") + " -> ");
    ringRules(2, "[rotr(1.1*sqrt((i+0.5)/" + std::to_string(each) + "))rotu(2.399963*i)" + s(pedicel_, num(pedicelLength_)) + " ", "] " + a(2, "i+1"), each);
    out_.steps = 3;
  }

  /// Flowers without stalks, crowded over a dome.
  void head() {
    const double across = plan_.length > 0 ? plan_.length : 0.95 * plan_.flowerWidth * std::sqrt(static_cast<double>(flowers_));
    const double ray = std::max(0.12 * reach_, 0.5 * across - 0.9 * plan_.flowerLength);
    stalkLength_ = 2.2 * std::max(across, reach_);
    pedicelLength_ = ray;
    rule(a(0) + " -> " + s(stalk_) + " " + a(1, "0"));
    ringRules(1, "[rotr(1.45*sqrt((i+0.3)/" + std::to_string(flowers_) + "))rotu(2.399963*i)" + s(pedicel_, num(ray)) + " ", "] " + a(1, "i+1"), flowers_);
    out_.steps = 2;
  }

  /// The middle flower ends its axis; two side axes below it go on, each pair across the last.
  void cyme() {
    const int depth = std::clamp(static_cast<int>(std::lround(std::log2(flowers_ + 1.0))), 2, 6);
    const double length = lengthOr(2.2 * reach_ * depth);
    stalkLength_ = 0.5 * length;
    rule(a(0) + " -> " + s(stalk_) + " " + a(1, std::to_string(depth)));
    const std::string axis = s(axis_, num(0.42 * length) + "*0.75^(" + std::to_string(depth) + "-d)");
    rule(a(1, "d") + " : d > 1 -> [" + s(pedicel_, num(0.9 * reach_)) + " " + flower() + "] [rotr(0.8)rotu(1.570796)" + axis + " rotr(0)rotu(1.570796)" + a(1, "d-1") + "] [rotr(0.8)rotu(-1.570796)" + axis + " rotr(0)rotu(1.570796)" + a(1, "d-1") + "]");
    rule(a(1, "d") + " -> " + s(pedicel_, num(0.7 * reach_)) + " " + flower());
    axisTakesLength_ = true;
    out_.steps = depth + 2;
  }

  /// A hanging spike of many small flowers.
  void catkin() {
    const double length = lengthOr(flowers_ * 0.16 * reach_ + 2 * reach_);
    stalkLength_ = 0.12 * length;
    axisLength_ = length / (flowers_ / 3.0);
    axisHangs_ = true;
    rule(a(0) + " -> " + s(stalk_) + " " + a(1, "0"));
    rule(a(1, "i") + " : i < " + std::to_string(flowers_ / 3) + " -> " + s(axis_) + " [rotr(1.1)rotu(0)" + flower() + "] [rotr(1.1)rotu(2.094395)" + flower() + "] [rotr(1.1)rotu(4.18879)" + flower() + "] rotr(0)rotu(0.9)" + a(1, "i+1"));
    out_.steps = flowers_ / 3 + 2;
  }

  /// A fleshy spike of tiny flowers with a large bract around it.
  void spadix() {
    const double length = lengthOr(0.12 * plan_.metre);
    stalkLength_ = 1.6 * length;
    axisLength_ = length / (flowers_ / 5.0);
    axisIsThick_ = true;
    spatheLength_ = 1.75 * length;
    rule(a(0) + " -> " + s(stalk_) + " [rotr(0.3)rotu(-2.356194)L(" + std::to_string(stalk_) + ")] " + a(1, "0"));
    std::string whorl;
    for (int k = 0; k < 5; ++k) whorl += "[rotr(1.45)rotu(" + num(2 * 3.14159265 * k / 5) + ")" + flower() + "] ";
    rule(a(1, "i") + " : i < " + std::to_string(flowers_ / 5) + " -> " + s(axis_) + " " + whorl + "rotr(0)rotu(0.628319)" + a(1, "i+1"));
    out_.steps = flowers_ / 5 + 2;
  }

  void fascicle() {
    stalkLength_ = 0.1 * reach_;
    pedicelLength_ = lengthOr(1.1 * reach_);
    rule(a(0) + " -> " + s(stalk_) + " " + a(1, "0"));
    ringRules(1, "[rotr(0.9*sqrt((i+0.5)/" + std::to_string(flowers_) + "))rotu(2.399963*i)" + s(pedicel_, num(pedicelLength_)) + " ", "] " + a(1, "i+1"), flowers_);
    out_.steps = 2;
  }

  /// As many flowers of a crowded inflorescence set fruit as its fruits have room.
  void writeFruit() {
    const FruitPlan& fruit = plan_.fruit;
    const double room = plan_.type == Type::Solitary ? 1 : std::clamp(plan_.flowerWidth / std::max(fruit.width, 0.35 * fruit.length), 0.1, 1.0);
    rule(a(kFruitApex, "k") + " : k > 0 -> " + a(kFruitApex, "k-1"));
    rule(a(kFruitApex, "k") + " -> " + (room < 1 ? num(room) + ": F(1) | " + num(1 - room) + ": rotu(0)" : "F(1)"));
    const bool pod = fruit.length > 3 * fruit.width;
    out_.fruitStages = leafStage(1, fruit.model, fruit.length, kFruitGrowTime, fruit.colour, pod ? "GravityTropism = 0.6; " : "");
    out_.ripening = fruit.bloom + 1 + kFruitGrowTime;
  }

  // ---- stages
  [[nodiscard]] double thickness() const { return std::clamp(0.045 * reach_, 0.0002 * plan_.metre, 0.003 * plan_.metre); }

  void writeStages() {
    const double thick = thickness();
    const auto uses = [&](int stage) {
      const std::string word = "S(" + std::to_string(stage);
      const std::string all = out_.rules + out_.decomposition;
      return all.find(word + ")") != std::string::npos || all.find(word + ",") != std::string::npos;
    };
    if (uses(stalk_)) out_.stemStages += stemStage(stalk_, "", num(stalkLength_), 1.5 * thick, 3, "");
    if (uses(axis_)) out_.stemStages += stemStage(axis_, axisTakesLength_ ? "(length)" : "", axisTakesLength_ ? "length" : num(axisLength_), axisIsThick_ ? 0.055 * lengthOr(0.12 * plan_.metre) : 1.2 * thick, 3,
                                 axisHangs_ ? "GravityTropism = 0.9; " : "");
    if (uses(pedicel_)) out_.stemStages += stemStage(pedicel_, "(length)", "length", 0.8 * thick, 3, "");
    if (uses(rod_)) out_.stemStages += stemStage(rod_, "", num(sideLength_ > 0 ? sideLength_ : axisLength_), thick, 3, "");
    if (spatheLength_ > 0)
      out_.leafStages += leafStage(stalk_, "ovate, apex cuspidate, base rounded, width 80, veins arcuate", spatheLength_, 3, glm::dvec3{0.78, 0.86, 0.55});
    for (std::size_t ring = 0; ring < rings(); ++ring)
      out_.flowerStages += flowerStage(static_cast<int>(ring) + 1, plan_.flowerModel, plan_.flowerLength, 3, ring < plan_.colours.size() ? std::optional(plan_.colours[ring]) : std::nullopt,
                                       plan_.fruit.model.empty() ? "" : "FallAge = " + num((plan_.fruit.bloom + 1) * plan_.stepTime) + "; ");
  }

  const InflorescencePlan& plan_;
  int apex_, stalk_, axis_, pedicel_, rod_;
  int flowers_;
  double reach_;  ///< the room that a flower takes
  double stalkLength_ = 0, axisLength_ = 0, pedicelLength_ = 0, sideLength_ = 0, spatheLength_ = 0;
  bool axisTakesLength_ = false, axisHangs_ = false, axisIsThick_ = false;
  InflorescenceText out_;
};

}  // namespace

std::optional<InflorescenceType> inflorescenceNamed(std::string_view name) {
  const auto found = std::find_if(typeWords.begin(), typeWords.end(), [&](const auto& w) { return w.first == name; });
  return found == typeWords.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> inflorescenceNames() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < typeCount; ++i) names.emplace_back(typeWords[i].first);
  return names;
}

InflorescenceText inflorescenceText(const InflorescencePlan& plan, int firstApex, int firstStage) { return Writer(plan, firstApex, firstStage).written(); }

Result<simeco::Grammar> inflorescenceGrammar(const InflorescencePlan& plan, int firstApex, int firstStage) {
  const InflorescenceText text = inflorescenceText(plan, firstApex, firstStage);
  PlantText plant;
  plant.name = "inflorescence";
  plant.stems = text.stemStages;
  plant.leaves = text.leafStages;
  plant.flowers = text.flowerStages;
  plant.fruits = text.fruitStages;
  plant.axiom = "A(" + std::to_string(firstApex) + ")";
  plant.rules = text.rules;
  plant.decomposition = text.decomposition;
  return grammarOf(plant);
}

}  // namespace axil::emit
