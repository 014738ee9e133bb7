#include "skeleton3d/snap_tip.hpp"

#include "skeleton3d/known_length_bands.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kStep_px = 0.5;
constexpr double kMargin_px = 7;          // beyond the reach to both sides: what is surely stem, and surely not
constexpr double kLeastContrast = 20;     // grey levels between the two
constexpr double kMostRest = 0.14;        // root mean square of what the step leaves unexplained, as a share of it

struct Along {
  double first = 0;
  std::vector<glm::dvec3> colour;

  [[nodiscard]] double place(std::size_t i) const { return first + kStep_px * static_cast<double>(i); }
};

Along colourAlong(const Photo& photo, const RidgeReading& reading, glm::dvec2 out, double reach_px) {
  const glm::dvec2 side{-out.y, out.x};
  Along along{-reach_px - kMargin_px, {}};
  constexpr std::array kLines = {-0.25, 0.0, 0.25};  // of the stem's width
  for (double s = along.first; s <= reach_px + kMargin_px; s += kStep_px) {
    glm::dvec3 sum{0, 0, 0};
    for (const double line : kLines) sum += colourAt(photo, reading.at.px + s * out + line * reading.width_px * side) / static_cast<double>(kLines.size());
    along.colour.push_back(sum);
  }
  return along;
}

template <class Wanted>
glm::dvec3 meanWhere(const Along& along, Wanted wanted) {
  glm::dvec3 sum{0, 0, 0};
  double count = 0;
  for (std::size_t i = 0; i < along.colour.size(); ++i)
    if (wanted(along.place(i))) sum += along.colour[i], ++count;
  return sum / std::max(count, 1.0);
}

/// 1 on the stem, 0 beyond it.
std::vector<double> sharesOf(const Along& along, const glm::dvec3& stem, const glm::dvec3& beyond) {
  std::vector<double> shares;
  const glm::dvec3 step = stem - beyond;
  for (const glm::dvec3& c : along.colour) shares.push_back(glm::dot(c - beyond, step) / glm::dot(step, step));
  return shares;
}

/// What is left where the stem is taken to end at `end`, its edge as soft as photos are.
double restAt(const Along& along, const std::vector<double>& shares, double end) {
  double squares = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double ideal = std::clamp(0.5 - (along.place(i) - end) / 3, 0.0, 1.0);
    squares += std::pow(shares[i] - ideal, 2);
  }
  return std::sqrt(squares / static_cast<double>(shares.size()));
}

}  // namespace

std::optional<double> tipBeyond(const Photo& photo, const RidgeReading& reading, glm::dvec2 out, double reach_px) {
  const Along along = colourAlong(photo, reading, out, reach_px);
  const glm::dvec3 stem = meanWhere(along, [&](double s) { return s < -reach_px; }), beyond = meanWhere(along, [&](double s) { return s > reach_px; });
  if (glm::length(stem - beyond) < kLeastContrast) return std::nullopt;
  const std::vector<double> shares = sharesOf(along, stem, beyond);
  double best = 0, least = restAt(along, shares, 0);
  for (double end = -reach_px; end <= reach_px; end += 0.25)
    if (const double rest = restAt(along, shares, end); rest < least) least = rest, best = end;
  if (least > kMostRest || std::abs(best) > reach_px - 0.5) return std::nullopt;
  return best;
}

}  // namespace axil::skeleton3d::detail
