#pragma once
/// \file
/// Derivation: a grammar's string, step by step. All modules are rewritten in parallel; the first rule in text order whose
/// predecessor, contexts and condition hold fires, a module without one is copied. The engine knows no syntax.

#include "base/progress.hpp"
#include "base/result.hpp"
#include "simeco/grammar.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco {

/// Stated limits, so that no grammar can eat the machine. A limit that is met ends the work with LimitReached and names
/// the rule that was growing.
struct Limits {
  std::size_t modules = 20'000'000;       ///< in one string
  std::size_t bytes = std::size_t{2} << 30;
  std::int64_t steps = 100'000;
  std::int64_t loopIterations = 10'000'000;  ///< of all loops of one statement block
  int expressionDepth = 200;
  double seconds = 600;                   ///< of wall time; the only limit that a slower machine meets earlier
};

struct DeriveOptions {
  std::optional<std::int64_t> steps;      ///< none: the file's own derivation length, else until nothing changes
  std::uint64_t seed = 1;
  Limits limits = {};
  Watch watch = {};
  int threads = 0;                        ///< 0: as many as the machine has; the result does not depend on it
  bool singlePrecision = false;           ///< keep parameters in single precision, as the classic program does
};

/// A module of a derived string.
struct ModuleView {
  std::string_view letter;
  std::span<const double> parameters;
};

}  // namespace axil::simeco
