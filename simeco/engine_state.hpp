#pragma once
/// \file
/// What an Engine holds. Private to the engine: engine.cpp is the door, engine_general.cpp and engine_plain.cpp are the two ways.

#include "simeco/engine.hpp"
#include "simeco/engine_calm.hpp"
#include "simeco/engine_identity.hpp"
#include "simeco/engine_machine.hpp"
#include "simeco/engine_match.hpp"
#include "simeco/engine_plan.hpp"
#include "simeco/engine_surroundings.hpp"
#include "simeco/engine_workers.hpp"

#include <atomic>
#include <optional>
#include <vector>

namespace axil::simeco {

/// What a step fills.
struct Arrays {
  Buffer<SymbolCode> codes;
  Buffer<double> parameters;
  Buffer<Identity> identities;  ///< only where something draws

  void clear() {
    codes.clear();
    parameters.clear();
    identities.clear();
  }
  void trim() {
    codes.trim();
    parameters.trim();
    identities.trim();
  }
  [[nodiscard]] std::size_t bytes() const { return codes.bytes() + parameters.bytes() + identities.bytes(); }
  /// Of what is filled.
  [[nodiscard]] std::size_t used() const {
    return codes.size() + parameters.size() * sizeof(double) + identities.size() * sizeof(Identity);
  }
};

/// The image of a string or of a stretch of it: its modules, the number of the module that each comes from, the rule that wrote it.
struct ImagePiece {
  Arrays modules;
  std::vector<std::uint32_t> source;
  std::vector<std::int32_t> drawnBy;
};

/// Modules still to be looked up: [at, end) of the stack of lists, made by `depth` nested applications.
struct Cursor {
  std::size_t at = 0;
  std::size_t end = 0;
  std::size_t parameter = 0;        ///< of the module at `at`
  std::size_t listBegin = 0;        ///< where the list starts, to give its room back
  std::size_t parameterBegin = 0;
  int depth = 0;
  std::int32_t rule = -1;           ///< id of the rule that made the list; -1: a module of the old string
};

/// What one thread makes in a step of the plain way.
struct Lane {
  Arrays own;                        ///< not used by the first lane, which writes in place
  Arrays* out = nullptr;
  Buffer<SymbolCode> stack;
  std::vector<double> locals, frames;
  std::vector<std::pair<const CompiledRule*, double*>> applicable;
  Arrays lists;                      ///< decomposition: lists within lists
  std::vector<Cursor> cursors;
  bool depthReached = false;
  std::size_t fired = 0;
  const CompiledRule* lastRule = nullptr;
  enum class Limit { None, Modules, Bytes, Time } limit = Limit::None;  ///< the one that it met
  std::optional<Error> error;

  [[nodiscard]] bool ended() const { return error.has_value() || limit != Limit::None; }
};

/// Which draws belong to what: each has its own streams, so none shifts another.
enum class Stream : std::uint64_t { Axiom, Header, Choice, Successor, Homomorphism, Decomposition, Interaction };

struct Engine::State {
  std::shared_ptr<const Program> program;
  EngineOptions options;
  SharedSettings shared;
  ModuleString string;
  Arrays spare;                    ///< the buffers of the string before
  Surroundings around;
  SurroundingNeeds needs;
  Instance main;
  std::vector<Instance> visits;    ///< of the string, in the order of its `?`
  std::vector<Machine> machines;   ///< one a thread
  std::vector<std::uint64_t> made; ///< by rule id: modules that it made in this step of the general way; for messages
  std::vector<std::string> notes;
  Rng random{0};
  std::int64_t steps = 0;
  std::size_t peak = 0;
  std::unique_ptr<Plans> plans;    ///< of the plain way
  std::unique_ptr<Workers> workers;
  std::vector<Lane> lanes;
  std::unique_ptr<Calm> calm;
  double grownCodes = 0;           ///< modules and parameters that a module became in the last two steps at least, and a little more
  double grownNumbers = 0;
  double lastGrownCodes = 0, lastGrownNumbers = 0;
  std::atomic<std::size_t> written{0};  ///< bytes that all lanes have written in this step
  bool inPlace = false;            ///< the last step changed `string` itself
  const CompiledRule* lastRule = nullptr;  ///< one that fired lately; for messages
  Buffer<SymbolCode> rightCodes;   ///< right neighbour of every module
  bool walking = false;            ///< sub-L-systems: contexts walk, since ignored letters differ
  bool plain = false;
  bool timeless = false;           ///< a string that one step leaves as it is stays so
  bool identified = false;         ///< modules carry identities
  bool drawsConditions = false;    ///< rules that did not fire may fire at the next step by chance
  bool drawsResults = false;
  bool stopped = false;
  bool finished = false;           ///< the last step is done
  std::optional<std::int64_t> wantedLength;

  [[nodiscard]] Machine& machine() { return machines.front(); }
  [[nodiscard]] OldString oldString() const { return {string.codes(), string.parameters(), string.identities()}; }
  [[nodiscard]] Rng stream(Stream which) const { return random.split(static_cast<std::uint64_t>(which)); }
  [[nodiscard]] Rng stream(Stream which, std::uint64_t a, std::uint64_t b = 0) const { return stream(which).split(a, b); }

  /// The error of a machine in trouble, with the rule and step it happened at.
  [[nodiscard]] Failure failure(const Error& error, const CompiledRule* rule) const;
  [[nodiscard]] Failure tooMany(const char* what, std::size_t limit, const CompiledRule* rule);
  /// A failure that also names the rule that was growing the string: the one that made most in this step, else `rule`, else
  /// one that fired lately.
  [[nodiscard]] Failure limitReached(std::string message, const CompiledRule* rule);
  [[nodiscard]] Failure tooLate();
  [[nodiscard]] Result<void> mayGoOn();
  /// Counts what the rules would make of the beginning of the string, where the plain way does not count.
  void survey();
  /// The new string becomes the old one.
  void exchange();
  /// Bytes that the new string may have beside the old one.
  [[nodiscard]] std::size_t bytesLeft() const;
  [[nodiscard]] Result<void> runHeader(const Code& code, Instance& instance, std::uint64_t which);
  [[nodiscard]] Result<void> startInstance(Instance& instance);
  void notePeak(std::size_t more);
  /// How much a module became in this step, `spare` against `string`; the next step makes room by it.
  void noteGrowth();
  [[nodiscard]] std::size_t expectedModules() const;
  [[nodiscard]] std::size_t expectedNumbers() const;
  void note(const std::string& text);

  /// Rewrites the whole string into `spare`; returns how many rules fired.
  [[nodiscard]] Result<std::size_t> generalStep(StepTrace* trace);
  [[nodiscard]] Result<std::size_t> plainStep();
  /// Many steps at once, where rules are so simple that they can be multiplied.
  [[nodiscard]] bool canLeap() const;
  [[nodiscard]] Result<Outcome> leap(std::int64_t count, std::vector<std::size_t>& modulesPerStep);
  /// Rewrites the selected modules by interaction rules; how many fired.
  [[nodiscard]] Result<std::size_t> interactWith(const std::vector<bool>& selected, std::optional<std::size_t> rule);
  [[nodiscard]] Result<void> pruneAt(const std::vector<bool>& selected);
  [[nodiscard]] Result<Image> makeImage(const ModuleString& of);
  /// Instances for the `?` modules of the axiom.
  [[nodiscard]] Result<void> findVisits();
};

/// The rules that may apply to a module with this code and first parameter.
[[nodiscard]] inline const std::vector<std::uint32_t>& candidates(const RuleIndex& index, const double* parameters) {
  if (!index.numbered) return index.all;
  const auto found = index.byNumber.find(std::bit_cast<std::uint64_t>(parameters[0] == 0 ? 0.0 : parameters[0]));
  return found == index.byNumber.end() ? index.otherwise : found->second;
}

}  // namespace axil::simeco
