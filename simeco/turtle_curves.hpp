#pragma once
/// \file
/// The layers of the turtle, second: polygons, generalised cylinders, patches. Internal to the turtle.

#include "simeco/turtle_walk.hpp"

#include <map>

namespace axil::simeco::turtle {

inline constexpr double kTangent = 1.2;

/// An open { or {(t).
struct Brace {
  int curve = 0;   ///< 0: polygon; 1 open, 2 closed Hermite; 3 open, 4 closed B-spline
  std::size_t module = 0;
  std::vector<CurvePoint> points;
};

struct RadiusTangents {
  bool given = false;
  double start = 0;   ///< change of the radius per unit of the curve parameter
  double end = 0;
};

using Patch = std::array<glm::dvec3, 16>;

class Curves : protected Walk {
 public:
  using Walk::Walk;

 protected:
  // ---- polygons and braces

  void record(int strips) {
    if (braces_.empty()) return;
    braces_.back().points.push_back(here());
    braces_.back().points.back().strips = std::clamp(strips, 1, kMostStrips);
  }
  void openBrace(const Token& t, std::size_t module) {
    flush();
    const double type = t.value(0, 0);
    braces_.push_back({type >= 1 && type <= 4 ? static_cast<int>(type) : 0, module, std::exchange(points_, {})});
    braces_.back().points.clear();
    if (braces_.back().curve == 0) return;
    leavesBranch_ = true;
    record(1);
  }
  void closeBrace(const Token&) {
    flush();
    if (braces_.empty()) {
      ++unmatched_;
      return;
    }
    Brace brace = std::move(braces_.back());
    braces_.pop_back();
    if (brace.curve == 0) polygon(brace);
    else if (brace.curve <= 2) hermite(brace);
    else bSpline(brace);
    points_ = std::move(brace.points);
  }
  void polygon(const Brace& brace) {
    polygon_.vertices.clear();
    for (const CurvePoint& point : brace.points) polygon_.vertices.push_back(point.frame.position);
    polygon_.frame = state_.frame;
    polygon_.colour = state_.colour;
    polygon_.module = brace.module;
    sink_.polygon(polygon_);
  }

  // ---- generalised cylinders: a centre line cut into strips

  void hermite(const Brace& brace) {
    for (std::size_t i = 1; i < brace.points.size(); ++i) curve(brace.points[i - 1], brace.points[i], brace.module);
    if (brace.curve == 2 && brace.points.size() > 2) curve(brace.points.back(), brace.points.front(), brace.module);
  }

  /// One cubic Hermite piece, cut at equal parameter steps.
  void curve(const CurvePoint& a, const CurvePoint& b, std::size_t module) {
    const double distance = glm::length(b.frame.position - a.frame.position);
    const glm::dvec3 leaving = a.frame.heading * (distance * tangentStart_), arriving = b.frame.heading * (distance * tangentEnd_);
    const double radiusScale = radiusByLength_ ? distance : 1;
    const auto pointAt = [&](double t) {
      const double t2 = t * t, t3 = t2 * t;
      const double h00 = 2 * t3 - 3 * t2 + 1, h10 = t3 - 2 * t2 + t, h01 = 3 * t2 - 2 * t3, h11 = t3 - t2;
      CurvePoint p = a;
      p.frame.position = a.frame.position * h00 + leaving * h10 + b.frame.position * h01 + arriving * h11;
      p.width = a.width + (b.width - a.width) * t;
      if (radius_.given) p.width = std::max(kLeastWidth, a.width * h00 + b.width * h01 + 2 * radiusScale * (radius_.start * h10 + radius_.end * h11));
      return p;
    };
    CurvePoint last = a;
    for (int i = 1; i <= b.strips; ++i) {
      const CurvePoint next = i == b.strips ? b : pointAt(static_cast<double>(i) / b.strips);
      strip(last, next, module);
      last = next;
    }
  }
  void strip(const CurvePoint& a, const CurvePoint& b, std::size_t module) {
    TurtleSegment s;
    s.start = a.frame.position;
    s.end = b.frame.position;
    s.startWidth = a.width;
    s.endWidth = view_.taperedLines ? b.width : a.width;
    s.frame = a.frame;
    const glm::dvec3 along = s.end - s.start;
    if (glm::length(along) > 0) s.frame.heading = glm::normalize(along);
    s.colour = state_.colour;
    s.sides = state_.sides;
    s.parent = state_.segment;
    s.branch = state_.branch;
    s.module = module;
    sink_.segment(s);
    state_.segment = segments_++;
    state_.branch = false;
  }
  /// A uniform cubic B-spline; open ones start and end at their first and last points.
  void bSpline(const Brace& brace) {
    std::vector<CurvePoint> points = brace.points;
    if (points.size() < 2) return;
    if (brace.curve == 4) points.insert(points.end(), brace.points.begin(), brace.points.begin() + std::min<std::ptrdiff_t>(3, std::ssize(brace.points)));
    else points.insert(points.begin(), 2, brace.points.front()), points.insert(points.end(), 2, brace.points.back());
    std::optional<CurvePoint> last;
    for (std::size_t i = 0; i + 3 < points.size(); ++i) {
      const int strips = points[i + 2].strips;
      for (int k = last ? 1 : 0; k <= strips; ++k) {
        const CurvePoint next = onBSpline(&points[i], static_cast<double>(k) / strips);
        if (last) strip(*last, next, brace.module);
        last = next;
      }
    }
  }
  static CurvePoint onBSpline(const CurvePoint* p, double t) {
    const double u = 1 - t;
    const double w[] = {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
    CurvePoint result = p[1];
    result.frame.position = {0, 0, 0};
    result.width = 0;
    for (int i = 0; i < 4; ++i) {
      result.frame.position += p[i].frame.position * w[i];
      result.width += p[i].width * w[i];
    }
    return result;
  }

  void generalised(std::size_t module) {
    leavesBranch_ = true;
    if (at_ >= codes_.size()) return;
    const Token t = take();
    CurvePoint now = here();
    now.strips = static_cast<int>(std::clamp(t.value(0, kStrips), 1.0, static_cast<double>(kMostStrips)));
    switch (t.letter) {
      case 's': curveFrom_ = now; return;
      case 'c':
      case 'e':
        if (curveFrom_) curve(*curveFrom_, now, module);
        curveFrom_ = now;
        if (t.letter == 'e') curveFrom_.reset();
        return;
      case 't':
        tangentStart_ = t.value(0, kTangent);
        tangentEnd_ = t.value(1, tangentStart_);
        return;
      case 'r': return radiusTangents(t);
      default: return;
    }
  }
  void radiusTangents(const Token& t) {
    if (t.count() == 1) radiusByLength_ = t.parameters[0] != 0;
    if (t.count() < 2) return;
    radius_.given = true;
    radius_.start = t.parameters[1] * sineCosine(t.parameters[0]).sine;
    radius_.end = t.count() >= 4 ? t.parameters[3] * sineCosine(t.parameters[2]).sine : radius_.start;
    if (!std::isfinite(radius_.start) || !std::isfinite(radius_.end)) broken_ = true;
  }

  // ---- bicubic patches

  void patch(std::size_t module) {
    leavesBranch_ = true;
    if (at_ >= codes_.size()) return;
    const Token t = take();
    const double id = t.value(0, 0);
    if (!(std::fabs(id) < 1e6)) return;
    Patch& points = patches_[static_cast<int>(id)];
    if (t.letter == 'S') points = {};
    const double row = t.value(1, 1), column = t.value(2, 1);
    if (t.letter == 'C' && row >= 1 && row <= 4 && column >= 1 && column <= 4)
      points[(static_cast<std::size_t>(row) - 1) * 4 + static_cast<std::size_t>(column) - 1] = state_.frame.position;
    if (t.letter == 'D') drawPatch(points, static_cast<int>(std::clamp(t.value(1, 4), 1.0, 100.0)), static_cast<int>(std::clamp(t.value(2, 4), 1.0, 100.0)), module);
  }
  void drawPatch(const Patch& points, int rows, int columns, std::size_t module) {
    const auto corner = [&](int r, int c) { return onPatch(points, static_cast<double>(r) / rows, static_cast<double>(c) / columns); };
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) sink_.polygon({{corner(r, c), corner(r, c + 1), corner(r + 1, c + 1), corner(r + 1, c)}, state_.frame, state_.colour, module});
  }
  static glm::dvec3 onPatch(const Patch& points, double s, double t) {
    const auto weights = [](double x) {
      const double y = 1 - x;
      return std::array<double, 4>{y * y * y, 3 * x * y * y, 3 * x * x * y, x * x * x};
    };
    const auto a = weights(s), b = weights(t);
    glm::dvec3 result{0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) result += points[i * 4 + j] * (a[i] * b[j]);
    return result;
  }

  std::vector<Brace> braces_;

 private:
  std::vector<CurvePoint> points_;   ///< room that closed braces gave back
  TurtlePolygon polygon_;            ///< the last one
  std::optional<CurvePoint> curveFrom_;
  double tangentStart_ = kTangent;
  double tangentEnd_ = kTangent;
  RadiusTangents radius_;
  bool radiusByLength_ = false;
  std::map<int, Patch> patches_;
};

}  // namespace axil::simeco::turtle
