#include "emit/mtg.hpp"

#include "base/text.hpp"
#include "base/turning.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace axil::emit {

namespace {

using simeco::Organ;
using simeco::OrganKind;
using simeco::Plant;

constexpr double kUnseen = 1e-6;  // of the plant's largest organ: growing points, which are no nodes of the architecture

/// Numbers without '+', which the format's readers take for a branch.
std::string number(double value) {
  std::string text = shortest(value);
  std::erase(text, '+');
  return text;
}

struct Row {
  const Organ* organ = nullptr;
  int parent = -1;             ///< row; -1: leaves the plant's base
  bool branch = false;
  int order = 0;
  std::vector<int> children = {};
};

char classOf(OrganKind kind) { return kind == OrganKind::Stem ? 'S' : kind == OrganKind::Leaf ? 'L' : 'O'; }

/// The organs that are to be seen, bearers found past growing points.
std::vector<Row> rowsOf(const Plant& plant) {
  double longest = 0;
  for (const Organ& organ : plant.organs) longest = std::max(longest, organ.length);
  struct Link {
    int row = -1;
    bool branch = false;
  };
  std::vector<Link> links;  // of each organ: the row that stands for its tip
  std::vector<Row> rows;
  for (const Organ& organ : plant.organs) {
    Link from = organ.parent ? links[static_cast<std::size_t>(organ.parent->value)] : Link{};
    from.branch = from.branch || organ.branch;
    if (organ.length <= kUnseen * longest) {
      links.push_back(from);
      continue;
    }
    rows.push_back({&organ, from.row, from.branch || plant.styleOf(organ).kind != OrganKind::Stem});
    links.push_back({static_cast<int>(rows.size()) - 1, false});
  }
  return rows;
}

class MtgTable {
 public:
  MtgTable(const Plant& plant, std::vector<Row> rows) : plant_(plant), rows_(std::move(rows)) {
    first_ = mainStem();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Row& row = rows_[r];
      // What leaves the collar beside the first stem hangs on that stem: the format knows no nodes.
      if (row.parent < 0 && static_cast<int>(r) != first_) row.parent = first_, row.branch = true;
      if (static_cast<int>(r) == first_) row.branch = false;
    }
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Row& row = rows_[r];
      if (row.parent >= 0) {
        row.order = row.parent == first_ ? (row.branch ? 1 : 0) : rows_[static_cast<std::size_t>(row.parent)].order + (row.branch ? 1 : 0);
        rows_[static_cast<std::size_t>(row.parent)].children.push_back(static_cast<int>(r));
      }
      columns_ = std::max(columns_, row.order + 1);
    }
  }

  std::string text(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) text_ += "# " + note + "\n";
    text_ +=
        "# P plant, S stem segment, L leaf, O other organ; XX YY ZZ the tip of a segment or the base of a blade, Y up; rotr radians from the\n"
        "# bearer, rotu around it; Length and Radius in the plant's unit. This format has no growth and no rules: it is the plant full grown.\n"
        "CODE:\tFORM-A\n\n"
        "CLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n$\t0\tFREE\tFREE\tIMPLICIT\nP\t1\tFREE\tFREE\tEXPLICIT\n"
        "S\t2\tFREE\tFREE\tEXPLICIT\nL\t2\tFREE\tFREE\tEXPLICIT\nO\t2\tFREE\tFREE\tEXPLICIT\n\n"
        "DESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX\nS\tS\t<\t?\nS\tS\t+\t?\nS\tL\t+\t?\nS\tO\t+\t?\nL\tL\t+\t?\nO\tO\t+\t?\n\nFEATURES:\nNAME\tTYPE\n";
    for (const char* name : kFeatures) text_ += std::string(name) + "\tREAL\n";
    text_ += "\nMTG:\nENTITY-CODE" + std::string(static_cast<std::size_t>(columns_), '\t');
    for (std::size_t f = 0; f < kFeatures.size(); ++f) text_ += (f == 0 ? "" : "\t") + std::string(kFeatures[f]);
    const glm::dvec3& base = rows_[static_cast<std::size_t>(first_)].organ->base.at;
    text_ += "\n";
    line(0, "/P1", base, {});
    depthFirst();
    return std::move(text_);
  }

 private:
  static constexpr std::array<const char*, 8> kFeatures{"XX", "YY", "ZZ", "Length", "Radius", "Width", "rotr", "rotu"};
  struct Values {
    std::optional<double> length = {}, radius = {}, width = {}, rotr = {}, rotu = {};
  };

  /// The first stem that leaves the base and is no branch; else the first stem.
  [[nodiscard]] int mainStem() const {
    int best = -1;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (plant_.styleOf(*rows_[r].organ).kind != OrganKind::Stem) continue;
      if (rows_[r].parent < 0 && !rows_[r].branch) return static_cast<int>(r);
      if (best < 0) best = static_cast<int>(r);
    }
    return best;
  }

  void line(int column, const std::string& code, const glm::dvec3& at, const Values& v) {
    text_ += std::string(static_cast<std::size_t>(column), '\t') + code + std::string(static_cast<std::size_t>(columns_ - column), '\t') + number(at.x) + "\t" +
             number(at.y) + "\t" + number(at.z);
    for (const auto& value : {v.length, v.radius, v.width, v.rotr, v.rotu}) text_ += "\t" + (value ? number(*value) : "");
    text_ += "\n";
  }

  void organLine(const Row& row, int place) {
    const Organ& organ = *row.organ;
    const OrganKind kind = plant_.styleOf(organ).kind;
    Values values{organ.length};
    if (kind == OrganKind::Stem) values.radius = organ.radius;
    else if (organ.radius > 0) values.width = 2 * organ.radius;
    StemFrame bearer = firstFrame(PlantDirection::up());
    if (row.parent >= 0) {
      const Organ& parent = *rows_[static_cast<std::size_t>(row.parent)].organ;
      bearer = {parent.tipDirection(), parent.rAxis, parent.adaxial};
    }
    const Turn turn = measuredTurn(bearer, organ.direction);
    values.rotr = turn.rotr.radians();
    values.rotu = turn.rotu.radians();
    const std::string link = row.parent < 0 ? "^/" : row.branch ? "+" : "^<";
    line(row.order, link + classOf(kind) + std::to_string(place + 1), kind == OrganKind::Leaf ? organ.base.at : organ.tip().at, values);
  }

  /// Branches before what goes on, on a stack, since axes may be long.
  void depthFirst() {
    std::vector<int> open{first_};
    while (!open.empty()) {
      const int place = open.back();
      open.pop_back();
      const Row& row = rows_[static_cast<std::size_t>(place)];
      organLine(row, place);
      std::vector<int> next = row.children;
      std::stable_partition(next.begin(), next.end(), [&](int child) { return rows_[static_cast<std::size_t>(child)].branch; });
      open.insert(open.end(), next.rbegin(), next.rend());
    }
  }

  const Plant& plant_;
  std::vector<Row> rows_;
  int first_ = 0;
  int columns_ = 1;
  std::string text_;
};

}  // namespace

Result<std::string> mtgText(const Plant& plant, const std::vector<std::string>& notes) {
  std::vector<Row> rows = rowsOf(plant);
  const bool hasStem = std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return plant.styleOf(*row.organ).kind == OrganKind::Stem; });
  if (!hasStem) return fail(ErrorCode::NoAnswer, "the grammar grows no stem, so there is no architecture to write down");
  return MtgTable(plant, std::move(rows)).text(notes);
}

}  // namespace axil::emit
