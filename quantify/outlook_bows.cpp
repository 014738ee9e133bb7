#include "quantify/estimate.hpp"
#include "quantify/outlook_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace axil::quantify {

namespace {

constexpr double kReach = 2;             // deviations beyond which a length counts less
constexpr double kNormalMad = 1.4826;
constexpr double kRounding = 1e-6;       // of logarithms: what is nearer is the same
constexpr double kFewFree = 8;           // lengths beyond axes' levels that a bow wants
constexpr double kMore = 3;              // of the criterion: laws that explain no more than steps do are none
constexpr double kSlowest = 0.03, kFastest = 2;
constexpr int kPaces = 8, kSizes = 8;

struct Point {
  std::size_t place = 0;   ///< of the distinct ones
  double log = 0;
  double weight = 1;
};

/// Lengths of axes at their places. Levels of axes are free: what is compared is how lengths run within them.
struct Points {
  std::vector<double> places;                ///< distinct, ascending
  std::vector<std::vector<Point>> axes;      ///< of two lengths and more
  double free = 0;                           ///< weights, less an axis' level each
};

Points pointsOf(std::span<const AxisLengths> axes, LengthsAlong along) {
  OrderCourse course;
  course.along = along;
  Points points;
  for (const AxisLengths& axis : axes)
    for (std::size_t r = 0; axis.logs.size() > 1 && r < axis.logs.size(); ++r) points.places.push_back(course.placeOf(axis, r));
  std::sort(points.places.begin(), points.places.end());
  points.places.erase(std::unique(points.places.begin(), points.places.end()), points.places.end());
  for (const AxisLengths& axis : axes) {
    if (axis.logs.size() < 2) continue;
    points.axes.emplace_back();
    for (std::size_t r = 0; r < axis.logs.size(); ++r) {
      const auto place = std::lower_bound(points.places.begin(), points.places.end(), course.placeOf(axis, r)) - points.places.begin();
      points.axes.back().push_back({static_cast<std::size_t>(place), axis.logs[r], 1});
    }
  }
  return points;
}

/// Lengths that lie off what is usual at their place and on their axis count less. Both are medians, in turns (Tukey's polish), so that no law has to be known.
void weigh(Points& points) {
  std::vector<double> levels(points.axes.size(), 0), usual(points.places.size(), 0);
  for (int round = 0; round < 4; ++round) {
    for (std::size_t a = 0; a < points.axes.size(); ++a) {
      std::vector<double> offs;
      for (const Point& p : points.axes[a]) offs.push_back(p.log - usual[p.place]);
      levels[a] = medianOf(std::move(offs));
    }
    std::vector<std::vector<double>> at(points.places.size());
    for (std::size_t a = 0; a < points.axes.size(); ++a)
      for (const Point& p : points.axes[a]) at[p.place].push_back(p.log - levels[a]);
    for (std::size_t i = 0; i < at.size(); ++i) usual[i] = medianOf(std::move(at[i]));
  }
  std::vector<double> offs;
  for (std::size_t a = 0; a < points.axes.size(); ++a)
    for (const Point& p : points.axes[a]) offs.push_back(std::abs(p.log - levels[a] - usual[p.place]));
  if (offs.empty()) return;
  const double reach = std::max(kReach * kNormalMad * medianOf(offs), 0.01);
  auto off = offs.begin();
  points.free = 0;
  for (auto& axis : points.axes) {
    points.free -= 1;
    for (Point& p : axis) {
      // No slip, however large, adds more squares than a length at that reach.
      p.weight = std::min(1.0, std::pow(reach / std::max(1e-12, *off++), 2));
      points.free += p.weight;
    }
  }
}

/// Weighted squares left by a course within axes.
template <class Course>
double squaresOf(const Points& points, const Course& courseAt) {
  std::vector<double> course;
  for (const double place : points.places) course.push_back(courseAt(place));
  double squares = 0;
  for (const auto& axis : points.axes) {
    double w = 0, y = 0, yy = 0;
    for (const Point& p : axis) {
      const double off = p.log - course[p.place];
      w += p.weight, y += p.weight * off, yy += p.weight * off * off;
    }
    squares += std::max(0.0, yy - y * y / w);
  }
  return squares;
}

/// Bayes' criterion (Schwarz 1978); of few lengths Akaike's, corrected for them (Hurvich and Tsai 1989), which asks for more.
double criterion(double squares, double free, double numbers) {
  const double all = numbers + 1, left = free - all - 1;
  const double few = left > 0 ? 2 * all * free / left : std::numeric_limits<double>::infinity();
  return free * std::log(std::max(squares / free, kRounding * kRounding)) + std::max(all * std::log(free), few);
}

/// Bows of one kind. Told by two numbers without bounds: the logarithm of the pace, and the size of e where it is largest (of Mitscherlich's rise, which ends at nothing, its log-odds).
struct Kind {
  Bow::Shape shape;
  double sign = 1;
  bool leaves = false;   ///< a level, instead of reaching one
  double anchor = 0;
  using Numbers = std::array<double, 2>;
  /// Of the size: e^-5 is hardly seen; Gompertz' law makes exp(exp(2.5)), 200,000, of the largest.
  [[nodiscard]] double most() const { return risesFromNothing() ? 4 : shape == Bow::Shape::Gompertz ? 2.5 : 9; }
  static constexpr double kLeast = -5;
  [[nodiscard]] bool risesFromNothing() const { return shape == Bow::Shape::Mitscherlich && sign < 0; }
  [[nodiscard]] Bow bow(const Numbers& of) const {
    const double pace = (leaves ? -1 : 1) * std::exp(of[0]);
    const double size = risesFromNothing() ? -std::log1p(std::exp(-of[1])) : of[1];
    return {shape, sign, pace, anchor + size / pace};
  }
};

struct Fit {
  Bow bow;
  double squares = std::numeric_limits<double>::infinity();
};

/// Damped Gauss-Newton steps from the best of a grid (Marquardt 1963); slopes by differences.
class Fitter {
 public:
  Fitter(const Points& points, const Kind& kind) : points_(points), kind_(kind) {}

  Fit fitted() {
    Kind::Numbers best{}, own{};
    double least = std::numeric_limits<double>::infinity();
    for (int p = 0; p < kPaces; ++p)
      for (int s = 0; s < kSizes; ++s) {
        own = {std::log(kSlowest * std::pow(kFastest / kSlowest, (p + 0.5) / kPaces)), Kind::kLeast + (kind_.most() - Kind::kLeast) * (s + 0.5) / kSizes};
        const double squares = squaresAt(own);
        if (squares >= least) continue;
        least = squares;
        best = own;
      }
    double damping = 1e-3;
    for (int step = 0; step < 25 && damping < 1e6; ++step) {
      const auto next = stepped(best, damping);
      const double squares = squaresAt(next);
      if (squares < least) {
        const bool still = least - squares <= 1e-9 * least;
        least = squares;
        best = next;
        damping /= 5;
        if (still) break;
      } else {
        damping *= 6;
      }
    }
    return {kind_.bow(best), least};
  }

 private:
  [[nodiscard]] double squaresAt(const Kind::Numbers& of) const {
    const Bow bow = kind_.bow(of);
    return squaresOf(points_, [&bow](double place) { return bow.at(place); });
  }
  [[nodiscard]] Kind::Numbers within(const Kind::Numbers& of) const {
    return {std::clamp(of[0], std::log(kSlowest), std::log(kFastest)), std::clamp(of[1], Kind::kLeast, kind_.most())};
  }
  [[nodiscard]] Kind::Numbers stepped(const Kind::Numbers& from, double damping) const {
    constexpr double kStep = 1e-4;
    const Bow bow = kind_.bow(from), p = kind_.bow({from[0] + kStep, from[1]}), s = kind_.bow({from[0], from[1] + kStep});
    std::vector<double> at, byPace, bySize;
    for (const double place : points_.places) {
      at.push_back(bow.at(place));
      byPace.push_back((p.at(place) - at.back()) / kStep);
      bySize.push_back((s.at(place) - at.back()) / kStep);
    }
    double pp = 0, ps = 0, ss = 0, py = 0, sy = 0;
    for (const auto& axis : points_.axes) {
      double w = 0, a = 0, b = 0, y = 0;
      for (const Point& q : axis) w += q.weight, a += q.weight * byPace[q.place], b += q.weight * bySize[q.place], y += q.weight * (q.log - at[q.place]);
      a /= w, b /= w, y /= w;
      for (const Point& q : axis) {
        const double da = byPace[q.place] - a, db = bySize[q.place] - b, dy = q.log - at[q.place] - y;
        pp += q.weight * da * da, ps += q.weight * da * db, ss += q.weight * db * db, py += q.weight * da * dy, sy += q.weight * db * dy;
      }
    }
    pp *= 1 + damping, ss *= 1 + damping;
    const double determinant = pp * ss - ps * ps;
    if (!(determinant > 0)) return from;
    return within({from[0] + (py * ss - sy * ps) / determinant, from[1] + (sy * pp - py * ps) / determinant});
  }

  const Points& points_;
  Kind kind_;
};

Fit bestBow(const Points& points) {
  const double low = points.places.front(), high = points.places.back();
  Fit best;
  for (const Kind& kind : {Kind{Bow::Shape::Mitscherlich, -1, false, low}, Kind{Bow::Shape::Mitscherlich, 1, false, low}, Kind{Bow::Shape::Logistic, 1, false, low}, Kind{Bow::Shape::Logistic, 1, true, high},
                           Kind{Bow::Shape::Gompertz, -1, false, low}, Kind{Bow::Shape::Gompertz, 1, false, low}})
    if (const Fit own = Fitter(points, kind).fitted(); own.squares < best.squares) best = own;
  return best;
}

/// Squares left by a line and by a parabola.
std::pair<double, double> evenSquares(const Points& points) {
  double rr = 0, rq = 0, qq = 0, ry = 0, qy = 0, yy = 0;
  for (const auto& axis : points.axes) {
    double w = 0, r = 0, q = 0, y = 0;
    for (const Point& p : axis) {
      const double place = points.places[p.place];
      w += p.weight, r += p.weight * place, q += p.weight * place * place, y += p.weight * p.log;
    }
    r /= w, q /= w, y /= w;
    for (const Point& p : axis) {
      const double place = points.places[p.place], dr = place - r, dq = place * place - q, dy = p.log - y;
      rr += p.weight * dr * dr, rq += p.weight * dr * dq, qq += p.weight * dq * dq, ry += p.weight * dr * dy, qy += p.weight * dq * dy, yy += p.weight * dy * dy;
    }
  }
  const double line = rr > 0 ? yy - ry * ry / rr : yy;
  const double determinant = rr * qq - rq * rq;
  const double parabola = determinant > 1e-9 * rr * qq ? yy - (ry * (ry * qq - qy * rq) + qy * (qy * rr - ry * rq)) / determinant : line;
  return {std::max(0.0, line), std::max(0.0, parabola)};
}

/// Below what a bow's criterion must lie: clearly that of steps that are alike, and that of steps that change evenly, which run off further where nothing is seen any more.
double boundOf(const Points& points) {
  const auto [line, parabola] = evenSquares(points);
  return std::min(criterion(line, points.free, 1) - kMore, criterion(parabola, points.free, 2));
}

/// The course on a bow, with the doubt that points leave about it.
OrderCourse courseOn(const Bow& bow, const Points& points, std::span<const AxisLengths> axes, LengthsAlong along, double numbers) {
  OrderCourse course;
  course.along = along;
  course.bow = bow;
  const double squares = squaresOf(points, [&bow](double place) { return bow.at(place); });
  const double deviation = std::sqrt(squares / std::max(1.0, points.free - numbers));
  if (numbers > 0) {
    double aa = 0, ab = 0, bb = 0;
    for (const auto& axis : points.axes) {
      double w = 0, a = 0, b = 0;
      for (const Point& p : axis) {
        const auto [da, db] = course.slopes(points.places[p.place]);
        w += p.weight, a += p.weight * da, b += p.weight * db;
      }
      for (const Point& p : axis) {
        const auto [da, db] = course.slopes(points.places[p.place]);
        aa += p.weight * (da - a / w) * (da - a / w), ab += p.weight * (da - a / w) * (db - b / w), bb += p.weight * (db - b / w) * (db - b / w);
      }
    }
    const double determinant = aa * bb - ab * ab;
    if (determinant > 1e-12 * aa * bb) course.doubt = {deviation * deviation * bb / determinant, deviation * deviation * aa / determinant, -deviation * deviation * ab / determinant};
  }
  std::vector<double> levels;
  for (const AxisLengths& axis : axes) levels.push_back(course.levelOf(axis, axis.logs.size()));
  const Centre centre = centreOf(levels);
  course.weight = std::min(kMostWeight, std::pow(deviation / std::max(centre.deviation, 1e-9), 2));
  course.start = centre.value;
  return course;
}

}  // namespace

SharedBows sharedBows(std::span<const AxisLengths> axes) {
  SharedBows shared;
  for (const LengthsAlong along : {LengthsAlong::Rank, LengthsAlong::Stage}) {
    Points points = pointsOf(axes, along);
    weigh(points);
    if (points.free < kFewFree) continue;
    const Fit fit = bestBow(points);
    if (criterion(fit.squares, points.free, 2) >= boundOf(points)) continue;
    (along == LengthsAlong::Rank ? shared.byRank : shared.byStage) = fit.bow;
  }
  return shared;
}

std::optional<OrderCourse> bowedCourse(std::span<const AxisLengths> axes, LengthsAlong along, const SharedBows& shared) {
  Points points = pointsOf(axes, along);
  weigh(points);
  if (points.free < 4) return std::nullopt;
  double least = boundOf(points);
  std::optional<OrderCourse> best;
  if (points.free >= kFewFree) {
    const Fit own = bestBow(points);
    if (const double value = criterion(own.squares, points.free, 2); value < least) {
      least = value;
      best = courseOn(own.bow, points, axes, along, 2);
    }
  }
  const auto& bow = along == LengthsAlong::Rank ? shared.byRank : shared.byStage;
  if (bow && criterion(squaresOf(points, [&bow](double place) { return bow->at(place); }), points.free, 0) < least) best = courseOn(*bow, points, axes, along, 0);
  return best;
}

}  // namespace axil::quantify
