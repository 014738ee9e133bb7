#include "render/tube.hpp"

#include "base/result.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axil::render {
namespace {

/// Rings between two nodes, at most; keeps a wild curve from filling the memory.
constexpr int maximumSteps = 16;
/// How much wider a branch is where it leaves its parent.
constexpr double collarWidening = 0.28;
/// How fast one that is thicker than its parent widens outside it.
constexpr double funnelSlope = 0.7;

double angleOf(const glm::dvec3& a, const glm::dvec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

using Chord = TubeChord;

void setChords(std::vector<Chord>& chords, const std::vector<TubeNode>& nodes) {
  chords.resize(nodes.size() - 1);
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const glm::dvec3 step = nodes[i + 1].at - nodes[i].at;
    chords[i].length = glm::length(step);
    chords[i].direction = step / chords[i].length;
  }
}

/// Whether a tube of `radius` can follow the bend between two chords without folding into itself: the arc that fits the
/// shorter one must be wider than the tube.
bool needsBall(const Chord& before, const Chord& after, double radius, Angle sharpestBend) {
  const double bend = angleOf(before.direction, after.direction);
  if (bend > sharpestBend.radians()) return true;
  return std::min(before.length, after.length) < 2 * radius * std::tan(bend / 2);
}

/// The centre line between two nodes: a cubic by its control points.
struct Cubic {
  glm::dvec3 b0, b1, b2, b3;
};

/// From node `i` to the next. Where a run starts or ends the curve runs out straight (no bend at its end).
Cubic cubicAt(const std::vector<TubeNode>& nodes, const std::vector<Chord>& chords, std::size_t i, bool startsRun, bool endsRun) {
  const double third = chords[i].length / 3;
  Cubic c{.b0 = nodes[i].at, .b1 = nodes[i].at + chords[i].direction * third, .b2 = nodes[i + 1].at - chords[i].direction * third, .b3 = nodes[i + 1].at};
  if (!startsRun) c.b1 = c.b0 + glm::normalize(chords[i - 1].direction + chords[i].direction) * third;
  if (!endsRun) c.b2 = c.b3 - glm::normalize(chords[i].direction + chords[i + 1].direction) * third;
  if (startsRun && !endsRun) c.b1 = (c.b0 + c.b2) * 0.5;
  if (endsRun && !startsRun) c.b2 = (c.b1 + c.b3) * 0.5;
  return c;
}

int stepsFor(const Cubic& c, const TubeDetail& detail) {
  const double turn = angleOf(c.b1 - c.b0, c.b2 - c.b1) + angleOf(c.b2 - c.b1, c.b3 - c.b2);
  return std::clamp(static_cast<int>(std::ceil(turn / detail.turnPerRing.radians() - 1e-6)), 1, maximumSteps);
}

TubeRing ringAt(const TubeNode& from, const TubeNode& to, const Cubic& c, double u, std::int32_t segment) {
  const double v = 1 - u;
  const glm::dvec3 at = u >= 1 ? c.b3 : c.b0 * (v * v * v) + c.b1 * (3 * v * v * u) + c.b2 * (3 * v * u * u) + c.b3 * (u * u * u);
  const glm::dvec3 tangent = glm::normalize((c.b1 - c.b0) * (v * v) + (c.b2 - c.b1) * (2 * v * u) + (c.b3 - c.b2) * (u * u));
  return {.at = at, .tangent = tangent, .radius = from.radius + (to.radius - from.radius) * u, .tilt = 0,
          .colour = from.colour + (to.colour - from.colour) * static_cast<float>(u), .segment = segment};
}

double smoothStep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// What of a tube of `radius` its parent hides.
double hiddenRadius(double radius, const TubeCollar& collar) {
  return collar.parentRadius <= 0 ? radius : std::min(radius * (1 + collarWidening), std::max(0.98 * collar.parentRadius, 0.3 * radius));
}

/// How wide a tube of `radius` is at `along` from its base on its parent's axis: never wider than the parent inside it, and a thick
/// one opens outside like a funnel, so that no blunt base shows at the fork.
double collaredRadius(double radius, double along, const TubeCollar& collar) {
  if (collar.parentRadius <= 0) return radius;
  const double out = collar.parentRadius;
  const double widening = 1 - smoothStep(out, out + 2.5 * radius, along);
  const double widened = radius * (1 + collarWidening * widening);
  return std::min(widened, hiddenRadius(radius, collar) + funnelSlope * std::max(along - out, 0.0));
}

/// Where along the first segment a collar needs rings, as shares of the segment, beside the even steps.
void setShares(std::vector<double>& shares, int steps, double length, double radius, const TubeCollar& collar) {
  shares.clear();
  for (int k = 1; k <= steps; ++k) shares.push_back(static_cast<double>(k) / steps);
  if (collar.parentRadius <= 0) return;
  for (const double along : {0.6 * collar.parentRadius, collar.parentRadius, collar.parentRadius + 0.8 * radius,
                             collar.parentRadius + 1.6 * radius, collar.parentRadius + 2.5 * radius})
    if (along < 0.97 * length) shares.push_back(along / length);
  std::sort(shares.begin(), shares.end());
  shares.erase(std::unique(shares.begin(), shares.end(), [](double a, double b) { return b - a < 0.01; }), shares.end());
  shares.back() = 1;
}

/// The double reflection method: the ring normal carried from one ring to the next without twist.
glm::dvec3 carriedNormal(const TubeRing& from, const TubeRing& to, const glm::dvec3& normal) {
  const glm::dvec3 v1 = to.at - from.at;
  const double c1 = glm::dot(v1, v1);
  if (c1 <= 0) return normal;
  const glm::dvec3 reflectedNormal = normal - v1 * (2 / c1 * glm::dot(v1, normal));
  const glm::dvec3 reflectedTangent = from.tangent - v1 * (2 / c1 * glm::dot(v1, from.tangent));
  const glm::dvec3 v2 = to.tangent - reflectedTangent;
  const double c2 = glm::dot(v2, v2);
  const glm::dvec3 carried = c2 <= 0 ? reflectedNormal : reflectedNormal - v2 * (2 / c2 * glm::dot(v2, reflectedNormal));
  return glm::normalize(carried - to.tangent * glm::dot(carried, to.tangent));
}

glm::dvec3 anyNormal(const glm::dvec3& tangent) {
  const glm::dvec3 helper = std::abs(tangent.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  return glm::normalize(helper - tangent * glm::dot(helper, tangent));
}

/// How far the surface leans out of the ring's plane, for its normals: by the taper between the neighbours.
void setTilts(std::span<TubeRing> rings) {
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const TubeRing& before = rings[i == 0 ? 0 : i - 1];
    const TubeRing& after = rings[i + 1 == rings.size() ? i : i + 1];
    rings[i].tilt = std::atan2(before.radius - after.radius, glm::distance(before.at, after.at));
  }
}

/// Ring `k` of `count` of the ball at an end: `sign` -1 below the base, +1 beyond the tip.
TubeRing capRing(const TubeRing& end, int k, int count, double sign) {
  TubeRing ring = end;
  const double latitude = std::numbers::pi / 2 * k / count;
  ring.at = end.at + end.tangent * (sign * end.radius * std::sin(latitude));
  ring.radius = end.radius * std::cos(latitude);
  ring.tilt = sign * latitude;
  return ring;
}

/// Appends a run with the rings of the balls at both ends; the poles themselves are vertices, not rings.
void appendWithRoundEnds(std::vector<TubeRing>& rings, std::span<const TubeRing> run, int capRings) {
  for (int k = capRings - 1; k >= 1; --k) rings.push_back(capRing(run.front(), k, capRings, -1));
  rings.insert(rings.end(), run.begin(), run.end());
  for (int k = 1; k < capRings; ++k) rings.push_back(capRing(run.back(), k, capRings, 1));
}

/// The top of the ball whose outermost ring is `ring`: as far on as the ball's radius is more than its height there.
glm::dvec3 poleOf(const TubeRing& ring, double sign) {
  const double latitude = std::abs(ring.tilt);
  const double ball = ring.radius / std::cos(latitude);
  return ring.at + ring.tangent * (sign * ball * (1 - std::sin(latitude)));
}

}  // namespace

void CentreLines::trace(const TubePath& path, const TubeDetail& detail) {
  const std::vector<TubeNode>& nodes = path.nodes;
  setChords(chords_, nodes);
  rings_.clear();
  firsts_.clear();
  bool startsRun = true;
  for (std::size_t i = 0; i < chords_.size(); ++i) {
    const bool endsRun = i + 1 == chords_.size() || needsBall(chords_[i], chords_[i + 1], nodes[i + 1].radius, path.sharpestBend);
    const Cubic cubic = cubicAt(nodes, chords_, i, startsRun, endsRun);
    const auto segment = static_cast<std::int32_t>(i);
    const TubeCollar collar = i == 0 && detail.capRings > 1 ? path.collar : TubeCollar{};
    if (startsRun) {
      firsts_.push_back(rings_.size());
      rings_.push_back(ringAt(nodes[i], nodes[i + 1], cubic, 0, segment));
      if (i == 0) rings_.back().radius = std::min(collaredRadius(nodes[i].radius, 0, collar), hiddenRadius(nodes[i].radius, path.collar));
    }
    setShares(shares_, stepsFor(cubic, detail), chords_[i].length, nodes[i].radius, collar);
    for (const double u : shares_) {
      rings_.push_back(ringAt(nodes[i], nodes[i + 1], cubic, u, segment));
      rings_.back().radius = collaredRadius(rings_.back().radius, u * chords_[i].length, collar);
    }
    if (endsRun) setTilts(std::span(rings_).subspan(firsts_.back()));
    startsRun = endsRun;
  }
}

std::span<const TubeRing> CentreLines::run(std::size_t index) const {
  const std::size_t end = index + 1 < firsts_.size() ? firsts_[index + 1] : rings_.size();
  return std::span(rings_).subspan(firsts_[index], end - firsts_[index]);
}

std::vector<std::vector<TubeRing>> centreLine(const TubePath& path, const TubeDetail& detail) {
  CentreLines lines;
  lines.trace(path, detail);
  std::vector<std::vector<TubeRing>> runs;
  for (std::size_t k = 0; k < lines.runs(); ++k) runs.emplace_back(lines.run(k).begin(), lines.run(k).end());
  return runs;
}

namespace {

/// The sides of a tube around its centre line, cosine and sine; kept while the number of sides stays.
class Circle {
 public:
  const std::vector<glm::dvec2>& of(std::uint32_t sides) {
    if (sides_.size() == sides) return sides_;
    sides_.resize(sides);
    for (std::uint32_t s = 0; s < sides; ++s) {
      const double angle = 2 * std::numbers::pi * s / sides;
      sides_[s] = {std::cos(angle), std::sin(angle)};
    }
    return sides_;
  }

 private:
  std::vector<glm::dvec2> sides_;
};

/// Writes one run after the other into arrays that have room.
class Sweeper {
 public:
  Sweeper(StemMesh& mesh, std::size_t firstVertex, std::size_t firstTriangle)
      : positions_(mesh.positions.data() + firstVertex), normals_(mesh.normals.data() + firstVertex), colours_(mesh.colours.data() + firstVertex),
        corners_(mesh.triangles.data() + 3 * firstTriangle), sources_(mesh.sources.data() + firstTriangle), vertex_(static_cast<std::uint32_t>(firstVertex)) {}

  void sweep(std::span<const TubeRing> rings, std::span<const TriangleSource> sources, const std::vector<glm::dvec2>& circle) {
    const auto sides = static_cast<std::uint32_t>(circle.size());
    const TubeRing& base = rings.front();
    const TubeRing& tip = rings.back();
    const std::uint32_t basePole = pole(poleOf(base, -1), -base.tangent, base.colour);
    std::uint32_t lower = basePole + 1;
    glm::dvec3 normal = anyNormal(base.tangent);
    ring(base, normal, circle);
    for (std::uint32_t s = 0; s < sides; ++s) triangle(basePole, lower + next(s, sides), lower + s, sources.front());
    for (std::size_t i = 1; i < rings.size(); ++i, lower += sides) {
      normal = carriedNormal(rings[i - 1], rings[i], normal);
      ring(rings[i], normal, circle);
      for (std::uint32_t s = 0; s < sides; ++s) {
        triangle(lower + s, lower + next(s, sides), lower + sides + next(s, sides), sources[i]);
        triangle(lower + s, lower + sides + next(s, sides), lower + sides + s, sources[i]);
      }
    }
    const std::uint32_t tipPole = pole(poleOf(tip, 1), tip.tangent, tip.colour);
    for (std::uint32_t s = 0; s < sides; ++s) triangle(tipPole, lower + s, lower + next(s, sides), sources.back());
  }

 private:
  static std::uint32_t next(std::uint32_t s, std::uint32_t sides) { return s + 1 == sides ? 0 : s + 1; }

  void vertex(const glm::dvec3& at, const glm::dvec3& normal, const glm::vec3& colour) {
    *positions_++ = glm::vec3(at);
    *normals_++ = glm::vec3(normal);
    *colours_++ = colour;
    ++vertex_;
  }
  void ring(const TubeRing& ring, const glm::dvec3& normal, const std::vector<glm::dvec2>& circle) {
    const glm::dvec3 across = glm::cross(ring.tangent, normal);
    const double lean = std::sin(ring.tilt), out = std::cos(ring.tilt);
    for (const glm::dvec2& side : circle) {
      const glm::dvec3 radial = normal * side.x + across * side.y;
      vertex(ring.at + radial * ring.radius, radial * out + ring.tangent * lean, ring.colour);
    }
  }
  /// A vertex on the centre line that closes an end; returns its number.
  std::uint32_t pole(const glm::dvec3& at, const glm::dvec3& normal, const glm::vec3& colour) {
    vertex(at, normal, colour);
    return vertex_ - 1;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const TriangleSource& source) {
    *corners_++ = a;
    *corners_++ = b;
    *corners_++ = c;
    *sources_++ = source;
  }

  glm::vec3* positions_;
  glm::vec3* normals_;
  glm::vec3* colours_;
  std::uint32_t* corners_;
  TriangleSource* sources_;
  std::uint32_t vertex_;
};

}  // namespace

void TubeRings::add(const TubePath& path, const TubeDetail& detail) {
  AXIL_ASSERT(path.nodes.size() >= 2 && path.segments.size() + 1 == path.nodes.size(), "a tube has two nodes, and a segment between each two");
  lines_.trace(path, detail);
  for (std::size_t k = 0; k < lines_.runs(); ++k) {
    const std::size_t first = rings_.size();
    appendWithRoundEnds(rings_, lines_.run(k), detail.capRings);
    for (std::size_t i = first; i < rings_.size(); ++i) sources_.push_back(path.segments[static_cast<std::size_t>(rings_[i].segment)]);
    const std::size_t count = rings_.size() - first, sides = static_cast<std::size_t>(detail.sides);
    runs_.push_back({first, count, static_cast<std::uint32_t>(sides)});
    vertices_ += count * sides + 2;
    triangles_ += count * sides * 2;
  }
}

void TubeRings::sweepInto(StemMesh& mesh, std::size_t firstVertex, std::size_t firstTriangle) const {
  Sweeper sweeper(mesh, firstVertex, firstTriangle);
  Circle circle;
  for (const Run& run : runs_)
    sweeper.sweep(std::span(rings_).subspan(run.firstRing, run.rings), std::span(sources_).subspan(run.firstRing, run.rings), circle.of(run.sides));
}

}  // namespace axil::render
