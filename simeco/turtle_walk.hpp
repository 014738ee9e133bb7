#pragma once
/// \file
/// The layers of the turtle, first: reading modules, moving under tropisms, segments with their widths, branches. Internal to the turtle.

#include "simeco/turtle_frame.hpp"
#include "simeco/turtle_input.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace axil::simeco::turtle {

inline constexpr double kLeastWidth = 1e-7;
inline constexpr int kStrips = 4;  // of a spline without a number
inline constexpr int kMostStrips = 10'000;

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

/// Where a turtle stands in the middle of a string, and what it goes back to at every ] that is still to come.
struct TurtleStand {
  TurtleState state;
  std::vector<TurtleState> stack;
  std::size_t segments = 0;                ///< drawn so far, as far as this turtle has drawn them
};

class Walk {
 public:
  Walk(const std::vector<Symbol>& symbols, TurtleInput& input, const LSystemView& view, TurtleSink& sink, const Watch& watch)
      : input_(input), view_(view), sink_(sink), watch_(watch) {
    for (std::size_t code = 0; code < symbols.size(); ++code)
      letters_[code] = {symbols[code].letter.size() == 1 ? symbols[code].letter[0] : '\0', static_cast<std::uint32_t>(symbols[code].parameters)};
    state_.width = view.lineWidth;
    state_.scale = view.scale;
    state_.colour = state_.backColour = view.colour;
    for (const Tropism& t : view.tropisms) state_.elasticities.push_back(t.elasticity);
  }

 protected:
  struct Token {
    char letter = '\0';
    std::span<const double> parameters;
    [[nodiscard]] std::size_t count() const { return parameters.size(); }
    [[nodiscard]] double value(std::size_t i, double otherwise) const { return i < parameters.size() ? parameters[i] : otherwise; }
  };

  // ---- the string

  /// Whether a module follows; the window moves on where it ends.
  bool follows() { return at_ < codes_.size() || refill(); }
  bool refill() {
    TurtleWindow window;
    if (!input_.more(at_, static_cast<std::size_t>(parameters_ - firstParameter_), window)) return false;
    codes_ = window.codes;
    sources_ = window.sources;
    parameters_ = firstParameter_ = window.parameters;
    at_ = 0;
    return !codes_.empty();
  }
  /// The number of the module at hand, by which what is drawn knows it.
  [[nodiscard]] std::size_t number(std::size_t at) const { return sources_ == nullptr ? at : sources_[at]; }

  Token take() {
    const Letter letter = letters_[codes_[at_++]];
    const Token token{letter.letter, {parameters_, letter.parameters}};
    parameters_ += letter.parameters;
    return token;
  }
  /// The letter that belongs to an @, ~ or ? before it; none at the end. One that is a bracket or brace has lost its meaning.
  std::optional<Token> takeName() {
    if (at_ >= codes_.size()) {
      leavesBranch_ = true;
      return std::nullopt;
    }
    const Token token = take();
    leavesBranch_ = leavesBranch_ || token.letter == '[' || token.letter == ']' || token.letter == '{' || token.letter == '}';
    return token;
  }
  [[nodiscard]] char peek() const { return at_ >= codes_.size() ? '\0' : letters_[codes_[at_]].letter; }
  bool takeIf(char letter, Token& token) {
    if (peek() != letter) return false;
    token = take();
    return true;
  }

  // ---- moving

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
      turtle::turn(f.heading, *side, {s, std::sqrt(1 - s * s)});
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

  static void turn(glm::dvec3& a, glm::dvec3& b, SineCosine angle) { turtle::turn(a, b, angle); }

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
    leavesBranch_ = true;
    for (int depth = 0; follows(); take()) {
      const char c = peek();
      if (c == ']' && depth-- == 0) return;
      if (c == '[') ++depth;
    }
  }

  /// What a code of the string stands for.
  struct Letter {
    char letter = '\0';
    std::uint32_t parameters = 0;
  };

  std::array<Letter, 256> letters_{};
  TurtleInput& input_;
  std::span<const SymbolCode> codes_;          ///< of the window at hand
  const std::uint32_t* sources_ = nullptr;
  const double* firstParameter_ = nullptr;
  const double* parameters_ = nullptr;         ///< of the module at `at_`
  const LSystemView& view_;
  TurtleSink& sink_;
  const Watch& watch_;
  std::size_t at_ = 0;
  TurtleState state_;
  std::vector<TurtleState> stack_;
  std::optional<TurtleSegment> waiting_;
  std::size_t segments_ = 0;
  std::array<KnownAngle, 64> angles_;
  std::size_t unmatched_ = 0;
  bool broken_ = false;
  bool leavesBranch_ = false;  ///< something was done that the ] of its branch does not undo
};

}  // namespace axil::simeco::turtle
