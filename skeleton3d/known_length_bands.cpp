#include "skeleton3d/known_length_bands.hpp"

#include "skeleton3d/statistics.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace axil::skeleton3d::detail {
namespace {

constexpr double kStep_px = 0.5;
constexpr double kLeastContrast = 30;  // grey levels between the two colours of the bands
constexpr int kFewestBands = 4, kMostBands = 24;
constexpr double kSeenEdges = 0.65;    // of the bands' edges, at least
constexpr double kShortestBand_px = 5;

/// A line from beside one clicked end to beside the other, followed a little beyond both.
struct Line {
  glm::dvec2 start{0, 0};
  glm::dvec2 along{1, 0};
  double length = 0;
  double beyond = 0;

  [[nodiscard]] glm::dvec2 at(double t) const { return start + t * along; }
};

struct Crossing {
  double at = 0;     ///< px from the line's start
  bool rises = false;
};

struct Fit {
  double first = 0, band = 0;  ///< edge k is at first + k * band
  double rms = 0;
  int bands = 0;
  std::size_t edges = 0;
  double score = 0;  ///< edges, less the further the ends are from the clicks
};

glm::dvec3 meanOf(const std::vector<glm::dvec3>& colours) {
  glm::dvec3 sum{0, 0, 0};
  for (const glm::dvec3& c : colours) sum += c / static_cast<double>(colours.size());
  return sum;
}

/// The axis in colour space on which `colours` differ most.
glm::dvec3 mainAxisOf(const std::vector<glm::dvec3>& colours, const glm::dvec3& mean) {
  glm::dmat3 spread(0.0);
  for (const glm::dvec3& c : colours) spread += glm::outerProduct(c - mean, c - mean);
  glm::dvec3 axis{0.5, 0.6, 0.62};
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 next = spread * axis;
    if (!(glm::length(next) > 0)) return axis;
    axis = glm::normalize(next);
  }
  return axis;
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Where the colour goes from one band's to the next's; a ripple that does not reach the other level counts for nothing.
std::vector<Crossing> crossingsOf(const Photo& photo, const Line& line) {
  std::vector<glm::dvec3> colours, inside;
  std::vector<double> places;
  for (double t = -line.beyond; t <= line.length + line.beyond; t += kStep_px) {
    places.push_back(t);
    colours.push_back(colourAt(photo, line.at(t)));
    if (t > 0.08 * line.length && t < 0.92 * line.length) inside.push_back(colours.back());
  }
  const glm::dvec3 mean = meanOf(inside), axis = mainAxisOf(inside, mean);
  std::vector<double> values, levels;
  for (const glm::dvec3& c : colours) values.push_back(glm::dot(c - mean, axis));
  for (const glm::dvec3& c : inside) levels.push_back(glm::dot(c - mean, axis));
  const double low = quantile(levels, 0.15), high = quantile(levels, 0.85), middle = (low + high) / 2;
  if (high - low < kLeastContrast) return {};
  std::vector<Crossing> crossings;
  int side = 0;         // of the middle, where the colour was last clearly one of both
  std::size_t last = 0; // where it last crossed the middle
  for (std::size_t i = 1; i < values.size(); ++i) {
    if ((values[i - 1] < middle) != (values[i] < middle)) last = i;
    const int now = values[i] > middle + 0.25 * (high - low) ? 1 : values[i] < middle - 0.25 * (high - low) ? -1 : 0;
    if (now == 0) continue;
    if (side != 0 && now != side && last > 0)
      crossings.push_back({places[last] - kStep_px * (values[last] - middle) / (values[last] - values[last - 1]), now > 0});
    side = now;
  }
  return crossings;
}

struct Edge {
  double number = 0;  ///< 1 is the one after the first band
  double at = 0;
};

/// The crossings that are where `fit` wants an edge, in the direction that `odd` edges have.
std::vector<Edge> edgesOf(const std::vector<Crossing>& crossings, const Fit& fit, bool oddRises) {
  std::vector<Edge> edges;
  const double tolerance = 0.5 + 0.06 * fit.band;
  for (const Crossing& c : crossings) {
    const double number = std::round((c.at - fit.first) / fit.band);
    if (number < 1 || number > fit.bands - 1 || std::abs(c.at - fit.first - number * fit.band) > tolerance) continue;
    if (c.rises != (oddRises == (static_cast<int>(number) % 2 == 1))) continue;
    if (edges.empty() || edges.back().number != number) edges.push_back({number, c.at});
  }
  return edges;
}

Fit straightened(const std::vector<Edge>& edges, Fit fit) {
  const auto n = static_cast<double>(edges.size());
  double k1 = 0, k2 = 0, y0 = 0, y1 = 0;
  for (const Edge& e : edges) k1 += e.number, k2 += e.number * e.number, y0 += e.at, y1 += e.number * e.at;
  fit.band = (n * y1 - k1 * y0) / (n * k2 - k1 * k1);
  fit.first = (y0 - fit.band * k1) / n;
  fit.edges = edges.size();
  fit.rms = 0;
  for (const Edge& e : edges) fit.rms += std::pow(e.at - fit.first - e.number * fit.band, 2) / n;
  fit.rms = std::sqrt(fit.rms);
  return fit;
}

/// A band more or less at an end is a reading of its own; the clicks decide.
double scoreOf(const Fit& fit, const Line& line) {
  constexpr double kUsualMiss_px = 4;
  const double from = fit.first / kUsualMiss_px, to = (fit.first + fit.bands * fit.band - line.length) / kUsualMiss_px;
  return static_cast<double>(fit.edges) - 0.5 * (from * from + to * to);
}

bool endsNearClicks(const Fit& fit, const Line& line, double reach_px) {
  return std::abs(fit.first) <= reach_px && std::abs(fit.first + fit.bands * fit.band - line.length) <= reach_px;
}

/// `bands` bands whose edges most crossings are; a twig before the rod may hide some of them and add its own.
std::optional<Fit> fitted(const std::vector<Crossing>& crossings, const Line& line, int bands, double reach_px) {
  const double expected = line.length / bands;
  const double mostCrossings = 1.5 * (bands - 1) + 4;  // twigs before a rod add some; texture adds many
  if (expected < kShortestBand_px || static_cast<double>(crossings.size()) > mostCrossings) return std::nullopt;
  const auto fewest = static_cast<std::size_t>(std::max(3.0, std::ceil(kSeenEdges * (bands - 1))));
  std::optional<Fit> best;
  for (std::size_t i = 0; i < crossings.size(); ++i)
    for (std::size_t j = i + 1; j < crossings.size(); ++j) {
      const double a = std::round(crossings[i].at / expected), b = std::round(crossings[j].at / expected);
      if (a < 1 || b > bands - 1 || b - a < 0.5 * (bands - 2)) continue;
      Fit fit{0, (crossings[j].at - crossings[i].at) / (b - a), 0, bands, 0};
      fit.first = crossings[i].at - a * fit.band;
      if (!(fit.band > 0) || !endsNearClicks(fit, line, reach_px)) continue;
      const std::vector<Edge> edges = edgesOf(crossings, fit, crossings[i].rises == (static_cast<int>(a) % 2 == 1));
      if (edges.size() < fewest || edges.back().number - edges.front().number < 0.5 * (bands - 2)) continue;
      fit = straightened(edges, fit);
      if (!endsNearClicks(fit, line, reach_px) || fit.rms > 0.4 + 0.01 * fit.band) continue;
      fit.score = scoreOf(fit, line);
      if (!best || fit.score > best->score) best = fit;
    }
  return best;
}

std::optional<Fit> bestFit(const Photo& photo, const Line& line, double reach_px) {
  const std::vector<Crossing> crossings = crossingsOf(photo, line);
  std::optional<Fit> best;
  for (int bands = kFewestBands; bands <= kMostBands; ++bands)
    if (const auto fit = fitted(crossings, line, bands, reach_px); fit && (!best || fit->score > best->score)) best = fit;
  return best;
}

/// A line on which the bands were found, with how far its ends are beside the clicked ones.
struct Found {
  double besideFrom = 0, besideTo = 0;
  Fit fit;
};

int commonestOf(const std::vector<Found>& found) {
  std::array<int, kMostBands + 1> lines{};
  for (const Found& f : found) ++lines[static_cast<std::size_t>(f.fit.bands)];
  return static_cast<int>(std::max_element(lines.begin(), lines.end()) - lines.begin());
}

}  // namespace

glm::dvec3 colourAt(const Photo& photo, glm::dvec2 px) {
  const double x = std::clamp(px.x - 0.5, 0.0, photo.width - 1.0), y = std::clamp(px.y - 0.5, 0.0, photo.height - 1.0);
  const int left = std::min(static_cast<int>(x), std::max(photo.width - 2, 0)), top = std::min(static_cast<int>(y), std::max(photo.height - 2, 0));
  const auto pixel = [&](int column, int row) {
    const std::size_t at = 3 * (static_cast<std::size_t>(std::min(row, photo.height - 1)) * static_cast<std::size_t>(photo.width) + static_cast<std::size_t>(std::min(column, photo.width - 1)));
    return glm::dvec3{photo.rgb[at], photo.rgb[at + 1], photo.rgb[at + 2]};
  };
  const double fx = x - left, fy = y - top;
  return (1 - fy) * ((1 - fx) * pixel(left, top) + fx * pixel(left + 1, top)) + fy * ((1 - fx) * pixel(left, top + 1) + fx * pixel(left + 1, top + 1));
}

std::optional<BandedEnds> bandedEnds(const Photo& photo, glm::dvec2 from, glm::dvec2 to, double reach_px) {
  const glm::dvec2 along = glm::normalize(to - from), side{-along.y, along.x};
  std::vector<Found> found;
  for (double a = -reach_px; a <= reach_px; a += 1)
    for (double b = -reach_px; b <= reach_px; b += 1) {
      const glm::dvec2 start = from + a * side, end = to + b * side;
      const Line line{start, glm::normalize(end - start), glm::length(end - start), reach_px};
      if (const auto fit = bestFit(photo, line, reach_px)) found.push_back({a, b, *fit});
    }
  constexpr std::size_t kFewestLines = 5;
  if (found.size() < kFewestLines) return std::nullopt;
  const int bands = commonestOf(found);
  std::vector<double> froms, tos, firsts, lasts, rms;
  for (const Found& f : found) {
    if (f.fit.bands != bands) continue;
    froms.push_back(f.besideFrom), tos.push_back(f.besideTo), rms.push_back(f.fit.rms);
    firsts.push_back(f.fit.first), lasts.push_back(f.fit.first + bands * f.fit.band);
  }
  if (froms.size() < std::max(kFewestLines, 2 * found.size() / 3)) return std::nullopt;
  const auto meanBeside = [](const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v / static_cast<double>(values.size());
    return sum;
  };
  const double besideFrom = meanBeside(froms), besideTo = meanBeside(tos);
  const glm::dvec2 start = from + besideFrom * side, end = to + besideTo * side, axis = glm::normalize(end - start);
  BandedEnds ends{start + medianOf(firsts) * axis, start + medianOf(lasts) * axis, 0, 0, bands};
  double spread = 0;
  for (std::size_t i = 0; i < froms.size(); ++i) spread += std::pow((froms[i] + tos[i]) / 2 - (besideFrom + besideTo) / 2, 2) / static_cast<double>(froms.size());
  ends.half_px = std::sqrt(spread) * 1.9;  // lines fill the rod's width evenly in their middle; measured as such
  const double n = bands - 1, perEdge = std::max(medianOf(rms), 0.15);
  ends.sigma_px = std::hypot(0.2, perEdge * std::sqrt(1 / n + std::pow((n + 1) / 2, 2) * 12 / (n * (n * n - 1) + 1e-9)));
  return ends;
}

}  // namespace axil::skeleton3d::detail
