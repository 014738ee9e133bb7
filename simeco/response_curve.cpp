#include "simeco/response_curve.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace axil::simeco {
namespace {

constexpr std::size_t kMostPoints = 10'000;
constexpr std::size_t kDegree = 3;

/// Knot `i` of the spline over `count` points: the ends are as often there as makes the curve start and end in its points.
double knot(std::size_t i, std::size_t count, std::size_t degree) {
  const std::size_t pieces = count - degree;
  return static_cast<double>(std::clamp(i, degree, degree + pieces) - degree);
}

/// The point of the spline at parameter `t`, by de Boor's scheme.
glm::dvec2 pointAt(const std::vector<glm::dvec2>& points, double t) {
  const std::size_t degree = std::min(kDegree, points.size() - 1), pieces = points.size() - degree;
  const std::size_t piece = std::min(static_cast<std::size_t>(t), pieces - 1), span = piece + degree;
  glm::dvec2 d[kDegree + 1];
  for (std::size_t j = 0; j <= degree; ++j) d[j] = points[piece + j];
  for (std::size_t r = 1; r <= degree; ++r)
    for (std::size_t j = degree; j >= r; --j) {
      const double low = knot(span + j - degree, points.size(), degree), high = knot(span + j + 1 - r, points.size(), degree);
      const double share = (t - low) / (high - low);
      d[j] = d[j - 1] * (1 - share) + d[j] * share;
    }
  return d[degree];
}

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view blanks = " \t\r,";
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos; at = line.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

}  // namespace

double ResponseCurve::at(double x) const {
  const double wanted = std::isnan(x) ? 0 : std::clamp(x, 0.0, 1.0);
  if (wanted <= points.front().x) return points.front().y;
  if (wanted >= points.back().x) return points.back().y;
  double low = 0, high = static_cast<double>(points.size() - std::min(kDegree, points.size() - 1));
  // x only grows along the curve.
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (pointAt(points, middle).x < wanted ? low : high) = middle;
  }
  return pointAt(points, high).y;
}

Result<ResponseCurve> responseCurve(const std::vector<double>& numbers) {
  if (numbers.size() < 4 || numbers.size() % 2 != 0) return fail(ErrorCode::BadInput, "a function is two points or more, x and y of each");
  if (numbers.size() > 2 * kMostPoints) return fail(ErrorCode::BadInput, "a function has at most " + std::to_string(kMostPoints) + " points");
  ResponseCurve curve;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    if (!curve.points.empty() && numbers[i] < curve.points.back().x)
      return fail(ErrorCode::BadInput, "point " + std::to_string(i / 2 + 1) + " of the function lies left of the point before it; give them from left to right");
    curve.points.emplace_back(numbers[i], numbers[i + 1]);
  }
  if (!(curve.points.back().x > curve.points.front().x)) return fail(ErrorCode::BadInput, "all points of the function stand over one x");
  return curve;
}

Result<ResponseCurve> parseResponseCurve(std::string_view text) {
  std::vector<double> numbers;
  bool points = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::vector<std::string_view> words = wordsOf(text.substr(at, end - at));
    at = end + 1;
    if (words.empty()) continue;
    if (!points) {
      points = words.front() == "points:";
      continue;
    }
    for (const std::string_view word : words) {
      const auto value = parseNumber(word);
      if (!value || !std::isfinite(*value)) return fail(ErrorCode::BadInput, "'" + std::string(word) + "' is not a number of a point");
      numbers.push_back(*value);
    }
  }
  if (!points) return fail(ErrorCode::BadInput, "the line 'points: n' is missing");
  return responseCurve(numbers);
}

}  // namespace axil::simeco
