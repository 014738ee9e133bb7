#include "skeleton3d/stem_line.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace axil::skeleton3d::detail {
namespace {

/// Lengths along the clicks, less what their scatter adds: a step of d true pixels is seen as sqrt(d^2 + 4 sigma^2) on average.
std::vector<double> lengthsOf(std::span<const glm::dvec2> clicks, double click_px) {
  std::vector<double> lengths{0};
  for (std::size_t i = 1; i < clicks.size(); ++i) {
    const double seen = glm::length(clicks[i] - clicks[i - 1]);
    lengths.push_back(lengths.back() + std::sqrt(std::max(seen * seen - 4 * click_px * click_px, 0.09 * seen * seen)) + 1e-6);
  }
  return lengths;
}

/// Weighted line through the clicks about each of them, evaluated there.
std::vector<glm::dvec2> smoothed(std::span<const glm::dvec2> clicks, const std::vector<double>& t, double click_px) {
  const double width = 2.5 * click_px;
  std::vector<glm::dvec2> result;
  for (std::size_t i = 0; i < clicks.size(); ++i) {
    double s0 = 0, s1 = 0, s2 = 0;
    glm::dvec2 y0(0.0), y1(0.0);
    for (std::size_t j = 0; j < clicks.size(); ++j) {
      const double d = t[j] - t[i], w = width > 0 ? std::exp(-0.5 * d * d / (width * width)) : i == j;
      s0 += w, s1 += w * d, s2 += w * d * d;
      y0 += w * clicks[j], y1 += w * d * clicks[j];
    }
    const double determinant = s0 * s2 - s1 * s1;
    result.push_back(determinant > 1e-9 * s0 * s0 * width * width ? (s2 * y0 - s1 * y1) / determinant : y0 / s0);
  }
  return result;
}

/// Between points i and i + 1 (Catmull and Rom's curve).
glm::dvec2 between(const std::vector<glm::dvec2>& points, std::size_t i, double f) {
  const glm::dvec2 p1 = points[i], p2 = points[i + 1];
  const glm::dvec2 p0 = i > 0 ? points[i - 1] : 2.0 * p1 - p2, p3 = i + 2 < points.size() ? points[i + 2] : 2.0 * p2 - p1;
  const double chord = glm::length(p2 - p1);
  const auto slope = [chord](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {  // by chords, so that a short step beside a long one makes no loop
    const double ab = glm::length(b - a), bc = glm::length(c - b);
    return ab + bc > 0 ? (c - a) / (ab + bc) * chord : glm::dvec2(0.0);
  };
  const glm::dvec2 m1 = slope(p0, p1, p2), m2 = slope(p1, p2, p3);
  const double f2 = f * f, f3 = f2 * f;
  return (2 * f3 - 3 * f2 + 1) * p1 + (f3 - 2 * f2 + f) * m1 + (3 * f2 - 2 * f3) * p2 + (f3 - f2) * m2;
}

}  // namespace

StemLine lineThroughPlaces(std::vector<glm::dvec2> places, std::vector<std::size_t> clicks) {
  StemLine line;
  line.at = std::move(places);
  line.placeOf = std::move(clicks);
  line.length_px.assign(line.at.size(), 0);
  for (std::size_t i = 1; i < line.at.size(); ++i) line.length_px[i] = line.length_px[i - 1] + glm::length(line.at[i] - line.at[i - 1]);
  glm::dvec2 last{1, 0};
  for (std::size_t i = 0; i < line.at.size(); ++i) {
    const std::size_t a = i < 2 ? 0 : i - 2, b = std::min(i + 2, line.at.size() - 1);
    const glm::dvec2 d = line.at[b] - line.at[a];
    if (glm::length(d) > 1e-9) last = glm::normalize(d);
    line.along.push_back(last);
  }
  return line;
}

StemLine stemLine(std::span<const glm::dvec2> clicks, double click_px, double step_px) {
  if (clicks.size() < 2) return {};
  const std::vector<double> t = lengthsOf(clicks, click_px);
  const std::vector<glm::dvec2> points = smoothed(clicks, t, click_px);
  double total = 0;
  for (std::size_t i = 1; i < points.size(); ++i) total += glm::length(points[i] - points[i - 1]);
  if (total < std::max(2.5 * click_px, 2 * step_px) || glm::length(points.back() - points.front()) < 1.5 * click_px) return {};

  std::vector<glm::dvec2> places;
  std::vector<std::size_t> placeOf;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    placeOf.push_back(places.size());
    const int steps = std::max(1, static_cast<int>(std::lround(glm::length(points[i + 1] - points[i]) / step_px)));
    for (int k = 0; k < steps; ++k) places.push_back(between(points, i, static_cast<double>(k) / steps));
  }
  placeOf.push_back(places.size());
  places.push_back(points.back());
  return lineThroughPlaces(std::move(places), std::move(placeOf));
}

}  // namespace axil::skeleton3d::detail
