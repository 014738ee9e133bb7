#pragma once
/// \file
/// The arithmetic of expressions, in one place, so that folding a constant and running an instruction give the same bits.
/// Private to fold, program and engine.

#include "base/rng.hpp"
#include "simeco/program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace axil::simeco {

/// Towards zero, and 0 for what no whole number holds; indices and remainders are made of it.
[[nodiscard]] inline double truncated(double x) { return std::isfinite(x) ? std::trunc(x) : 0; }

/// Whether the result would be a division by zero, which no language of ours defines.
[[nodiscard]] inline bool dividesByZero(Op op, double b) { return (op == Op::Divide && b == 0) || (op == Op::Remainder && truncated(b) == 0); }

/// Both sides truncated, the sign of the left (-7 % 3 is -1, but -6 % 3 is 0 as of whole numbers, never -0). `b` must not be 0 when truncated.
[[nodiscard]] inline double remainder(double a, double b) { return std::fmod(truncated(a), truncated(b)) + 0.0; }

/// The instruction of an operator that is no jump.
[[nodiscard]] inline Op opOf(BinaryOp op) {
  switch (op) {
    case BinaryOp::Add: return Op::Add;
    case BinaryOp::Subtract: return Op::Subtract;
    case BinaryOp::Multiply: return Op::Multiply;
    case BinaryOp::Divide: return Op::Divide;
    case BinaryOp::Remainder: return Op::Remainder;
    case BinaryOp::Power: return Op::Power;
    case BinaryOp::Less: return Op::Less;
    case BinaryOp::LessEqual: return Op::LessEqual;
    case BinaryOp::Greater: return Op::Greater;
    case BinaryOp::GreaterEqual: return Op::GreaterEqual;
    case BinaryOp::Equal: return Op::Equal;
    case BinaryOp::NotEqual: return Op::NotEqual;
    case BinaryOp::And:
    case BinaryOp::Or: break;
  }
  AXIL_ASSERT(false, "&& and || are jumps, not operators");
  return Op::Add;
}

[[nodiscard]] inline bool compared(Op op, double a, double b) {
  switch (op) {
    case Op::Less: return a < b;
    case Op::LessEqual: return a <= b;
    case Op::Greater: return a > b;
    case Op::GreaterEqual: return a >= b;
    case Op::Equal: return a == b;
    case Op::NotEqual: return a != b;
    default: AXIL_ASSERT(false, "not a comparison"); return false;
  }
}

[[nodiscard]] inline double arithmetic(Op op, double a, double b) {
  switch (op) {
    case Op::Add: return a + b;
    case Op::Subtract: return a - b;
    case Op::Multiply: return a * b;
    case Op::Divide: return a / b;
    case Op::Remainder: return remainder(a, b);
    case Op::Power: return std::pow(a, b);
    default: return compared(op, a, b) ? 1 : 0;
  }
}

[[nodiscard]] inline double inRadians(double degrees) { return degrees * (std::numbers::pi / 180); }
[[nodiscard]] inline double inDegrees(double radians) { return radians * (180 / std::numbers::pi); }

/// The functions that depend on nothing but their arguments; nothing for the others.
[[nodiscard]] inline std::optional<double> pureFunction(Function function, const double* x) {
  switch (function) {
    case Function::Sin: return std::sin(x[0]);
    case Function::Cos: return std::cos(x[0]);
    case Function::Tan: return std::tan(x[0]);
    case Function::Asin: return std::asin(x[0]);
    case Function::Acos: return std::acos(x[0]);
    case Function::Atan: return std::atan(x[0]);
    case Function::Atan2: return std::atan2(x[0], x[1]);
    case Function::SinDegrees: return std::sin(inRadians(x[0]));
    case Function::CosDegrees: return std::cos(inRadians(x[0]));
    case Function::TanDegrees: return std::tan(inRadians(x[0]));
    case Function::AsinDegrees: return inDegrees(std::asin(x[0]));
    case Function::AcosDegrees: return inDegrees(std::acos(x[0]));
    case Function::AtanDegrees: return inDegrees(std::atan(x[0]));
    case Function::Atan2Degrees: return inDegrees(std::atan2(x[0], x[1]));
    case Function::Exp: return std::exp(x[0]);
    case Function::Log: return std::log(x[0]);
    case Function::Sqrt: return std::sqrt(x[0]);
    case Function::Absolute: return std::fabs(x[0]);
    case Function::Floor: return std::floor(x[0]);
    case Function::Ceil: return std::ceil(x[0]);
    case Function::Round: return std::floor(x[0] + 0.5);
    case Function::Sign: return x[0] > 0 ? 1 : x[0] < 0 ? -1 : 0;
    case Function::Minimum: return std::fmin(x[0], x[1]);
    case Function::Maximum: return std::fmax(x[0], x[1]);
    case Function::Power: return std::pow(x[0], x[1]);
    default: return std::nullopt;
  }
}

/// Gamma-distributed with the given shape and scale 1 (Marsaglia and Tsang 2000); for the beta distribution.
[[nodiscard]] inline double gammaDraw(Rng& rng, double shape) {
  if (!(shape > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (shape < 1) return gammaDraw(rng, shape + 1) * std::pow(1 - rng.uniform(), 1 / shape);
  const double d = shape - 1.0 / 3, c = 1 / std::sqrt(9 * d);
  for (;;) {
    const double x = rng.normal();
    const double v = (1 + c * x) * (1 + c * x) * (1 + c * x);
    if (v > 0 && std::log(1 - rng.uniform()) < 0.5 * x * x + d - d * v + d * std::log(v)) return d * v;
  }
}

[[nodiscard]] inline double betaDraw(Rng& rng, double a, double b) {
  const double x = gammaDraw(rng, a), y = gammaDraw(rng, b);
  return x / (x + y);
}

/// Successes among `trials`; trials are limited so that no grammar can wait here for ever.
[[nodiscard]] inline double binomialDraw(Rng& rng, double trials, double chance) {
  constexpr double most = 1e6;
  double successes = 0;
  for (double i = 0; i < std::fmin(trials, most); ++i) successes += rng.uniform() < chance ? 1 : 0;
  return successes;
}

/// The functions that draw; `function` must be one of them.
[[nodiscard]] inline double drawn(Function function, const double* x, Rng& rng) {
  switch (function) {
    case Function::Random: return rng.uniform(x[0], x[1]);
    case Function::Normal: return rng.normal(x[0], x[1]);
    case Function::Ran: return x[0] * rng.uniform();
    case Function::Nran: return rng.normal(x[0], x[1]);
    case Function::Bran: return betaDraw(rng, x[0], x[1]);
    case Function::Biran: return binomialDraw(rng, x[0], x[1]);
    default: AXIL_ASSERT(false, "not a random function"); return 0;
  }
}

[[nodiscard]] inline bool drawsRandom(Function function) { return function >= Function::Random && function <= Function::Biran; }

}  // namespace axil::simeco
