#pragma once
/// \file
/// The layers of the turtle, third: what each letter does. Internal to the turtle.

#include "base/text.hpp"
#include "simeco/turtle_curves.hpp"

#include <string_view>

namespace axil::simeco::turtle {

inline constexpr std::size_t kWatchEvery = 1 << 16;
/// So many modules a command takes at most.
inline constexpr std::size_t kLongestCommand = 4;

class Turtle : private Curves {
 public:
  using Curves::Curves;

  Result<TurtleReport> run() {
    while (commandFollows()) {
      if (at_ % kWatchEvery == 0 && watch_.cancelled()) return fail(ErrorCode::Cancelled, "drawing the string was cancelled");
      const std::size_t module = number(at_);
      command(take(), module);
      if (broken_) return fail(ErrorCode::NoAnswer, "module " + std::to_string(module + 1) + " of the string takes the turtle to a place or size that is not a finite number; look for a division by zero in its parameters");
    }
    flush();
    if (!stack_.empty()) report_.warnings.push_back(std::to_string(stack_.size()) + " [ without ]");
    if (!braces_.empty()) report_.warnings.push_back(std::to_string(braces_.size()) + " { without }");
    if (unmatched_ > 0) report_.warnings.push_back(std::to_string(unmatched_) + " ] or } that close nothing; they are passed over");
    return std::move(report_);
  }

  // ---- starting in the middle of a string

  void startAt(TurtleStand stand) {
    state_ = std::move(stand.state);
    stack_ = std::move(stand.stack);
    segments_ = stand.segments;
  }
  /// Reads without drawing to an end.
  Result<TurtleStand> standAtEnd() {
    if (auto read = run(); !read) return read.failure();
    return TurtleStand{std::move(state_), std::move(stack_), segments_};
  }
  /// Whether anything was done that reaches beyond its branch, or that a ] does not undo.
  [[nodiscard]] bool leavesBranch() const { return leavesBranch_; }

 private:
  bool commandFollows() {
    if (at_ + kLongestCommand > codes_.size() && !ended_) ended_ = !refill();
    return at_ < codes_.size();
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

  // ---- ~s

  void surface(std::size_t module) {
    flush();
    const auto named = takeName();
    if (!named) return;
    const Token t = *named;
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
    const auto named = takeName();
    if (!named) return;
    const Token t = *named;
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

  void elasticity() {
    const auto named = takeName();
    if (!named) return;
    const Token t = *named;
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
    const auto t = takeName();
    if (!t) return;
    if (t->letter == 'o') disc(*t, {0, 0, 1}, true, true, module);
    if (t->letter == 'c') disc(*t, state_.frame.up, false, true, module);
  }
  void sphere(const Token& t, std::size_t module) {
    const double d = diameter(t);
    if (!broken_) sink_.sphere({state_.frame.position, d, state_.colour, module});
  }

  // ---- queries and sub-L-systems

  void question(const Token& t) {
    if (t.count() == 2) return enter(t.parameters[1]);
    const char c = peek();
    if (t.count() != 0 || c == '\0' || std::string_view("PHLUE").find(c) == std::string_view::npos) return;
    const std::size_t module = number(at_);
    take();
    sink_.query({c, state_.frame, state_.width, state_.scale, module});
  }
  void enter(double by) {
    leavesBranch_ = true;
    if (!std::isfinite(by)) broken_ = true;
    scales_.push_back({state_.scale, by});
    state_.scale *= by;
    state_.width *= by;
  }
  void leave() {
    leavesBranch_ = true;
    if (scales_.empty()) return;
    state_.scale = scales_.back().before;
    if (scales_.back().by != 0) state_.width /= scales_.back().by;
    scales_.pop_back();
  }

  struct Scaled {
    double before = 1;
    double by = 1;
  };

  std::vector<Scaled> scales_;
  bool ended_ = false;  ///< the input has nothing more
  TurtleReport report_;
};

}  // namespace axil::simeco::turtle
