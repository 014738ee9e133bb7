#pragma once
/// \file
/// Machine: runs the instructions of expressions and statements for one thread. Private to the engine.
///
/// Trouble (a division by zero, a loop without end, a host that failed) is noted, the rest of the block is given up, and
/// whoever started the block asks `trouble()` once; so the inner loop carries no Results.

#include "simeco/derive.hpp"
#include "simeco/engine_arithmetic.hpp"
#include "simeco/program.hpp"

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axil::simeco {

/// The variables of one L-system: the plant's own, or those between one `?` and its `$`.
struct Instance {
  std::size_t system = 0;
  std::vector<double> globals;
  std::vector<double> elements;  ///< of all arrays, one after the other
  bool started = false;
};

/// What all threads of one derivation share.
struct SharedSettings {
  const Program* program = nullptr;
  const Limits* limits = nullptr;
  const Watch* watch = nullptr;
  const Host* host = nullptr;
  std::chrono::steady_clock::time_point deadline{};

  [[nodiscard]] bool late() const { return std::chrono::steady_clock::now() > deadline; }
  /// What is said when it is.
  [[nodiscard]] std::string tooLate() const;
};

class Machine {
 public:
  explicit Machine(const SharedSettings& shared);

  /// The value that `term` has for these locals.
  double value(const Term& term, double* locals) {
    switch (term.kind) {
      case Term::Kind::Constant: return term.value;
      case Term::Kind::Local: return locals[term.slot];
      case Term::Kind::LocalTimes: return locals[term.slot] * term.value;
      case Term::Kind::LocalPlus: return locals[term.slot] + term.value;
      case Term::Kind::LocalOver: return locals[term.slot] / term.value;
      case Term::Kind::LocalCompared: return compared(term.comparison, locals[term.slot], term.value) ? 1 : 0;
      case Term::Kind::Coded: return run(shared_->program->codes[static_cast<std::size_t>(term.code)], locals);
    }
    return 0;
  }
  /// Runs a block or an expression; 0 and `trouble()` when it could not be finished.
  double run(const Code& code, double* locals);

  void setInstance(Instance* instance, const System* system) {
    instance_ = instance;
    system_ = system;
  }
  [[nodiscard]] Instance* instance() const { return instance_; }
  void setRandom(const Rng& rng) { rng_ = rng; }
  [[nodiscard]] Rng& rng() { return rng_; }

  [[nodiscard]] const std::optional<Error>& trouble() const { return trouble_; }
  void giveUp(ErrorCode code, std::string message) {
    if (!trouble_) trouble_ = Error{code, std::move(message)};
  }
  void clearTrouble() { trouble_.reset(); }

  /// What statements asked of the derivation.
  std::optional<std::uint64_t> newSeed;
  std::optional<std::int64_t> newLength;
  bool stopAsked = false;
  std::int64_t length = 0;
  std::size_t clampedIndices = 0;  ///< array indices that were outside and were moved to the nearest end

 private:
  [[nodiscard]] std::size_t elementAt(const Instruction& instruction, const double* indices);
  double called(const Instruction& instruction, const double* arguments);
  double hostFunction(std::span<const double> arguments);
  void hostExchange(std::span<double> variables);
  void hostFile(const Instruction& instruction, std::span<double> values);
  void hostPrint(const std::string& format, std::span<const double> values);
  bool mayLoop(std::int64_t& loops);

  const SharedSettings* shared_;
  std::vector<double> stack_;
  Instance* instance_ = nullptr;
  const System* system_ = nullptr;
  Rng rng_{0};
  std::optional<Error> trouble_;
};

}  // namespace axil::simeco
