#include "simeco/lsystem_turtle.hpp"

#include "base/text.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <utility>

namespace axil::simeco {

namespace {

constexpr double kLeastWidth = 1e-7;
constexpr int kStrips = 4;              // of a spline without a number
constexpr int kMostStrips = 10'000;
constexpr double kTangent = 1.2;
constexpr std::size_t kWatchEvery = 1 << 16;

struct SineCosine {
  double sine = 0;
  double cosine = 1;
};
/// Exact at multiples of 90 degrees.
SineCosine sineCosine(double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  const double quarters = turn / 90.0;
  if (quarters == std::floor(quarters)) {
    static constexpr SineCosine kQuarter[] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
    return kQuarter[(static_cast<int>(quarters) % 4 + 4) % 4];
  }
  const double radians = Angle::fromDegrees(turn).radians();
  return {std::sin(radians), std::cos(radians)};
}

/// `a` turned towards `b`, and `b` away from `a`.
void turn(glm::dvec3& a, glm::dvec3& b, SineCosine angle) {
  const glm::dvec3 old = a;
  a = old * angle.cosine + b * angle.sine;
  b = b * angle.cosine - old * angle.sine;
}

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// `v` turned about the unit vector `axis` (Rodrigues).
glm::dvec3 turnedAbout(const glm::dvec3& v, const glm::dvec3& axis, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

void turnFrame(TurtleFrame& frame, const glm::dvec3& axis, double radians) {
  frame.heading = turnedAbout(frame.heading, axis, radians);
  frame.left = turnedAbout(frame.left, axis, radians);
  frame.up = turnedAbout(frame.up, axis, radians);
}

glm::dvec3 anyPerpendicular(const glm::dvec3& v) {
  const glm::dvec3 other = std::fabs(v.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0};
  return glm::normalize(glm::cross(v, other));
}

/// What [ keeps and ] brings back.
struct TurtleState {
  TurtleFrame frame;
  double width = 1;
  double scale = 1;
  int colour = 128;
  int backColour = 128;
  int sides = 8;
  std::vector<double> elasticities;        ///< of the view's tropisms
  std::optional<std::size_t> segment;      ///< whose end the turtle stands on
  bool branch = false;                     ///< no segment since the last [
};

/// A point of a generalised cylinder.
struct CurvePoint {
  TurtleFrame frame;
  double width = 1;
  int strips = kStrips;
};

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

class Turtle {
 public:
  Turtle(const ModuleString& string, const LSystemView& view, TurtleSink& sink, const Watch& watch)
      : symbols_(string.symbols()), codes_(string.codes()), parameters_(string.parameters().data()), view_(view), sink_(sink), watch_(watch) {
    state_.width = view.lineWidth;
    state_.scale = view.scale;
    state_.colour = state_.backColour = view.colour;
    for (const Tropism& t : view.tropisms) state_.elasticities.push_back(t.elasticity);
  }

  Result<TurtleReport> run() {
    while (at_ < codes_.size()) {
      if (at_ % kWatchEvery == 0 && watch_.cancelled()) return fail(ErrorCode::Cancelled, "drawing the string was cancelled");
      const std::size_t module = at_;
      command(take(), module);
      if (broken_) return fail(ErrorCode::NoAnswer, "module " + std::to_string(module + 1) + " of the string takes the turtle to a place or size that is not a finite number; look for a division by zero in its parameters");
    }
    flush();
    if (!stack_.empty()) report_.warnings.push_back(std::to_string(stack_.size()) + " [ without ]");
    if (!braces_.empty()) report_.warnings.push_back(std::to_string(braces_.size()) + " { without }");
    if (unmatched_ > 0) report_.warnings.push_back(std::to_string(unmatched_) + " ] or } that close nothing; they are passed over");
    return std::move(report_);
  }

 private:
  struct Token {
    char letter = '\0';
    std::span<const double> parameters;
    [[nodiscard]] std::size_t count() const { return parameters.size(); }
    [[nodiscard]] double value(std::size_t i, double otherwise) const { return i < parameters.size() ? parameters[i] : otherwise; }
  };

  // ---- the string

  Token take() {
    const Symbol& symbol = symbols_[codes_[at_++]];
    const Token token{symbol.letter.size() == 1 ? symbol.letter[0] : '\0', {parameters_, static_cast<std::size_t>(symbol.parameters)}};
    parameters_ += symbol.parameters;
    return token;
  }
  [[nodiscard]] char peek() const {
    if (at_ >= codes_.size()) return '\0';
    const std::string& letter = symbols_[codes_[at_]].letter;
    return letter.size() == 1 ? letter[0] : '\0';
  }
  bool takeIf(char letter, Token& token) {
    if (peek() != letter) return false;
    token = take();
    return true;
  }

  // ---- one command

  void command(const Token& t, std::size_t module) {
    switch (t.letter) {
      case 'F': case 'G': return draw(t, module);
      case 'f': case 'g': return move(t);
      case '+': return turn(state_.frame.heading, state_.frame.left, angle(t));
      case '-': return turn(state_.frame.left, state_.frame.heading, angle(t));
      case '&': return turn(state_.frame.heading, state_.frame.up, angle(t));
      case '^': return turn(state_.frame.up, state_.frame.heading, angle(t));
      case '/': return turn(state_.frame.left, state_.frame.up, angle(t));
      case '\\': return turn(state_.frame.up, state_.frame.left, angle(t));
      case '|': state_.frame.heading = -state_.frame.heading, state_.frame.left = -state_.frame.left; return;
      case '[': return push();
      case ']': return pop();
      case '!': return width(t, -1);
      case '#': return width(t, 1);
      case ';': state_.colour = colour(t, state_.colour, 1); return;
      case ',': state_.colour = colour(t, state_.colour, -1); return;
      case '{': return openBrace(t, module);
      case '}': return closeBrace(t);
      case '.': return record(static_cast<int>(t.value(0, kStrips)));
      case '~': return surface(module);
      case '@': return at(module);
      case '?': return question(t);
      case '$': return leave();
      case '%': if (!view_.pastCut) skipBranch(); return;
      default: return;
    }
  }

  [[nodiscard]] SineCosine angle(const Token& t) {
    const double degrees = t.count() > 0 ? t.parameters[0] : view_.angleIncrement.degrees();
    if (!std::isfinite(degrees)) broken_ = true;
    if (broken_) return {};
    // A plant turns by the same few angles over and over.
    KnownAngle& known = angles_[(std::bit_cast<std::uint64_t>(degrees) * 0x9E3779B97F4A7C15ull) >> 58];
    if (known.degrees != degrees) known = {degrees, sineCosine(degrees)};
    return known.turn;
  }
  struct KnownAngle {
    double degrees = std::numeric_limits<double>::quiet_NaN();
    SineCosine turn;
  };

  // ---- moving

  void draw(const Token& t, std::size_t module) {
    flush();
    const CurvePoint from = here();
    step(t);
    const bool inCurve = !braces_.empty() && braces_.back().curve != 0;
    if (!inCurve) begin(from, module);
    afterStep();
    if (t.letter == 'F') record(kStrips);
    if (inCurve) state_.segment.reset();
  }
  void move(const Token& t) {
    flush();
    step(t);
    state_.segment.reset();
    afterStep();
    if (t.letter == 'f') record(kStrips);
  }

  void step(const Token& t) {
    for (std::size_t i = 0; i < view_.tropisms.size(); ++i) bend(view_.tropisms[i], state_.elasticities[i]);
    state_.frame.position += state_.frame.heading * (t.value(0, 1) * state_.scale);
    if (!isFinite(state_.frame.position)) broken_ = true;
  }
  void afterStep() {
    if (!view_.oldTropism) return;
    TurtleFrame& f = state_.frame;
    for (glm::dvec3* side : {&f.up, &f.left}) {
      const double s = std::clamp(view_.oldTropism->elasticity * glm::dot(view_.oldTropism->direction, *side), -1.0, 1.0);
      simeco::turn(f.heading, *side, {s, std::sqrt(1 - s * s)});
    }
  }

  /// Turns the frame by as many radians as heading x pull is long, at most 1.
  void bend(const Tropism& tropism, double elasticity) {
    const glm::dvec3 pull = target(tropism) * (tropism.intensity * elasticity);
    TurtleFrame& f = state_.frame;
    if (tropism.torque) {
      const double radians = std::clamp(glm::dot(glm::cross(f.up, pull), f.heading), -1.0, 1.0);
      if (radians != 0) turnFrame(f, f.heading, radians);
      return;
    }
    const glm::dvec3 axis = glm::cross(f.heading, pull);
    const double sine = glm::length(axis);
    if (sine > 1e-12) turnFrame(f, axis / sine, std::min(sine, 1.0));
  }
  /// Where the heading is drawn: the tropism's direction, or the nearest direction at the tropism's angle to it.
  [[nodiscard]] glm::dvec3 target(const Tropism& tropism) const {
    if (tropism.angle == Angle{}) return tropism.direction;
    const glm::dvec3 axis = glm::cross(tropism.direction, state_.frame.heading);
    const double sine = glm::length(axis);
    return turnedAbout(tropism.direction, sine > 1e-12 ? axis / sine : anyPerpendicular(tropism.direction), tropism.angle.radians());
  }

  static void turn(glm::dvec3& a, glm::dvec3& b, SineCosine angle) { simeco::turn(a, b, angle); }

  // ---- segments: one waits for its end width

  [[nodiscard]] CurvePoint here() const { return {state_.frame, state_.width, kStrips}; }

  void begin(const CurvePoint& from, std::size_t module) {
    TurtleSegment s;
    s.start = from.frame.position;
    s.end = state_.frame.position;
    s.startWidth = s.endWidth = from.width;
    s.frame = state_.frame;
    s.frame.position = s.start;
    s.colour = state_.colour;
    s.sides = state_.sides;
    s.parent = state_.segment;
    s.branch = state_.branch;
    s.module = module;
    waiting_ = s;
    state_.segment = segments_++;
    state_.branch = false;
  }
  void flush() {
    if (!waiting_) return;
    if (view_.taperedLines) waiting_->endWidth = state_.width;
    sink_.segment(*waiting_);
    waiting_.reset();
  }

  void width(const Token& t, double sign) {
    const double w = t.count() > 0 ? t.parameters[0] * state_.scale : state_.width + sign * view_.widthIncrement * state_.scale;
    if (!std::isfinite(w)) broken_ = true;
    state_.width = std::max(w, kLeastWidth);
  }
  [[nodiscard]] int colour(const Token& t, int now, int sign) {
    const double c = t.count() > 0 ? t.parameters[0] : now + sign * view_.colourIncrement;
    if (!std::isfinite(c)) broken_ = true;
    return broken_ ? now : (static_cast<int>(std::fmod(c, 256.0)) + 256) % 256;
  }

  // ---- branches

  void push() {
    flush();
    stack_.push_back(state_);
    state_.branch = true;
  }
  void pop() {
    flush();
    if (stack_.empty()) {
      ++unmatched_;
      return;
    }
    state_ = std::move(stack_.back());
    stack_.pop_back();
  }
  /// Behind %: nothing is drawn up to the ] of this branch.
  void skipBranch() {
    for (int depth = 0; at_ < codes_.size(); take()) {
      const char c = peek();
      if (c == ']' && depth-- == 0) return;
      if (c == '[') ++depth;
    }
  }

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
    if (braces_.back().curve != 0) record(1);
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

  // ---- ~s

  void surface(std::size_t module) {
    flush();
    if (at_ >= codes_.size()) return;
    const Token t = take();
    TurtleSurface s;
    s.name = t.letter;
    s.frame = state_.frame;
    const double k = t.value(0, 1);
    s.size = (t.count() >= 3 ? glm::dvec3{k, t.parameters[1], t.parameters[2]} : glm::dvec3{k, k, k}) * state_.scale;
    s.colour = state_.colour;
    s.module = module;
    if (!isFinite(s.size)) broken_ = true;
    else sink_.surface(s);
  }

  // ---- @ commands

  void at(std::size_t module) {
    flush();
    if (at_ >= codes_.size()) return;
    const Token t = take();
    switch (t.letter) {
      case 'M': return setPosition(t);
      case 'R': return setHeading(t);
      case 'v': return levelLeft();
      case 'D': return scale(t);
      case 'G': return generalised(module);
      case 'T': return elasticity();
      case 'P': return patch(module);
      case 'o': return disc(t, {0, 0, 1}, true, false, module);
      case 'c': return disc(t, state_.frame.up, false, false, module);
      case 'O': return sphere(t, module);
      case 'b': return outlined(module);
      case '!': state_.sides = static_cast<int>(std::clamp(t.value(0, 8), 3.0, 1000.0)); return;
      case ';': state_.backColour = colour(t, state_.backColour, 1); return;
      case ',': state_.backColour = colour(t, state_.backColour, -1); return;
      default: return;
    }
  }

  void setPosition(const Token& t) {
    if (t.count() < 2) return;
    state_.frame.position = {t.parameters[0], t.parameters[1], t.value(2, 0)};
    state_.segment.reset();
    if (!isFinite(state_.frame.position)) broken_ = true;
  }
  void setHeading(const Token& t) {
    if (t.count() < 2) return;
    const glm::dvec3 wanted{t.parameters[0], t.parameters[1], t.value(2, 0)};
    const double length = glm::length(wanted);
    if (!std::isfinite(length)) broken_ = true;
    if (broken_ || !(length > 0)) return;
    TurtleFrame& f = state_.frame;
    const glm::dvec3 heading = wanted / length;
    if (t.count() >= 6 && headWithUp(heading, {t.parameters[3], t.parameters[4], t.parameters[5]})) return;
    const glm::dvec3 axis = glm::cross(f.heading, heading);
    const double sine = glm::length(axis);
    if (sine > 1e-12) turnFrame(f, axis / sine, std::atan2(sine, glm::dot(f.heading, heading)));
    else if (glm::dot(f.heading, heading) < 0) turnFrame(f, f.up, Angle::fromDegrees(180).radians());
    f.heading = heading;
  }
  bool headWithUp(const glm::dvec3& heading, const glm::dvec3& up) {
    const glm::dvec3 across = up - heading * glm::dot(up, heading);
    const double length = glm::length(across);
    if (!(length > 1e-12) || !std::isfinite(length)) return false;
    state_.frame.heading = heading;
    state_.frame.up = across / length;
    state_.frame.left = glm::cross(heading, state_.frame.up);
    return true;
  }
  /// @v: L horizontal, unless the turtle stands upright.
  void levelLeft() {
    TurtleFrame& f = state_.frame;
    const glm::dvec3 left = glm::cross(glm::dvec3{0, 1, 0}, f.heading);
    const double length = glm::length(left);
    if (length < 1e-9) return;
    f.left = left / length;
    f.up = glm::cross(f.left, f.heading);
  }
  void scale(const Token& t) {
    Token by = t;
    double scale = t.count() > 0 ? t.parameters[0] : state_.scale;
    if (t.count() == 0 && takeIf('i', by)) scale = state_.scale * by.value(0, view_.scaleMultiplier);
    else if (t.count() == 0 && takeIf('d', by)) scale = state_.scale / by.value(0, view_.scaleMultiplier);
    if (!std::isfinite(scale)) broken_ = true;
    state_.scale = scale;
  }

  void generalised(std::size_t module) {
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

  void elasticity() {
    if (at_ >= codes_.size()) return;
    const Token t = take();
    const double number = t.value(0, 1);
    if (!(number >= 1) || number > static_cast<double>(state_.elasticities.size())) return;
    const auto i = static_cast<std::size_t>(number) - 1;
    const double step = t.value(1, view_.tropisms[i].step);
    if (t.letter == 's' && t.count() > 1) state_.elasticities[i] = t.parameters[1];
    if (t.letter == 'i') state_.elasticities[i] += step;
    if (t.letter == 'd') state_.elasticities[i] -= step;
  }

  [[nodiscard]] double diameter(const Token& t) {
    const double d = t.count() > 0 ? t.parameters[0] * state_.scale : state_.width;
    if (!std::isfinite(d)) broken_ = true;
    return d;
  }
  void disc(const Token& t, const glm::dvec3& normal, bool facesViewer, bool outline, std::size_t module) {
    const double d = diameter(t);
    if (!broken_) sink_.disc({state_.frame.position, normal, d, facesViewer, outline, state_.colour, module});
  }
  void outlined(std::size_t module) {
    if (at_ >= codes_.size()) return;
    const Token t = take();
    if (t.letter == 'o') disc(t, {0, 0, 1}, true, true, module);
    if (t.letter == 'c') disc(t, state_.frame.up, false, true, module);
  }
  void sphere(const Token& t, std::size_t module) {
    const double d = diameter(t);
    if (!broken_) sink_.sphere({state_.frame.position, d, state_.colour, module});
  }

  // ---- bicubic patches

  void patch(std::size_t module) {
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

  // ---- queries and sub-L-systems

  void question(const Token& t) {
    if (t.count() == 2) return enter(t.parameters[1]);
    const char c = peek();
    if (t.count() != 0 || c == '\0' || std::string_view("PHLUE").find(c) == std::string_view::npos) return;
    const std::size_t module = at_;
    take();
    sink_.query({c, state_.frame, state_.width, state_.scale, module});
  }
  void enter(double by) {
    if (!std::isfinite(by)) broken_ = true;
    scales_.push_back({state_.scale, by});
    state_.scale *= by;
    state_.width *= by;
  }
  void leave() {
    if (scales_.empty()) return;
    state_.scale = scales_.back().before;
    if (scales_.back().by != 0) state_.width /= scales_.back().by;
    scales_.pop_back();
  }

  struct Scaled {
    double before = 1;
    double by = 1;
  };

  const std::vector<Symbol>& symbols_;
  std::span<const SymbolCode> codes_;
  const double* parameters_;
  const LSystemView& view_;
  TurtleSink& sink_;
  const Watch& watch_;
  std::size_t at_ = 0;
  TurtleState state_;
  std::vector<TurtleState> stack_;
  std::vector<Brace> braces_;
  std::vector<CurvePoint> points_;   ///< room that closed braces gave back
  TurtlePolygon polygon_;            ///< the last one
  std::vector<Scaled> scales_;
  std::optional<TurtleSegment> waiting_;
  std::size_t segments_ = 0;
  std::optional<CurvePoint> curveFrom_;
  double tangentStart_ = kTangent;
  double tangentEnd_ = kTangent;
  RadiusTangents radius_;
  bool radiusByLength_ = false;
  std::map<int, Patch> patches_;
  std::array<KnownAngle, 64> angles_;
  std::size_t unmatched_ = 0;
  bool broken_ = false;
  TurtleReport report_;
};

std::string word(double value) { return " " + fixed(value, 6); }
std::string word(const glm::dvec3& v) { return " " + word(v.x) + word(v.y) + word(v.z); }

}  // namespace

Result<TurtleReport> interpret(const ModuleString& string, const LSystemView& view, TurtleSink& sink, const Watch& watch) {
  return Turtle(string, view, sink, watch).run();
}

void TurtleLog::segment(const TurtleSegment& s) { text_ += "segment" + word(s.start) + word(s.end) + "  width" + word(s.startWidth) + word(s.endWidth) + "\n"; }
void TurtleLog::polygon(const TurtlePolygon& p) {
  text_ += "polygon";
  for (const glm::dvec3& vertex : p.vertices) text_ += word(vertex);
  text_ += "\n";
}
void TurtleLog::sphere(const TurtleSphere& s) { text_ += "sphere" + word(s.centre) + "  diameter" + word(s.diameter) + "\n"; }
void TurtleLog::disc(const TurtleDisc& d) { text_ += "disc" + word(d.centre) + word(d.normal) + "  diameter" + word(d.diameter) + "\n"; }
void TurtleLog::surface(const TurtleSurface& s) { text_ += std::string("surface ") + s.name + word(s.frame.position) + word(s.size) + "\n"; }

}  // namespace axil::simeco
