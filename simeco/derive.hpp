#pragma once
/// \file
/// Derivation: a grammar's string, step by step. All modules are rewritten in parallel; the first rule in text order whose
/// predecessor, contexts and condition hold fires, a module without one is copied. The engine knows no syntax.
///
/// The same grammar, seed and steps give the same bytes for any number of threads. Random draws belong to (seed, step, module):
/// a draw more in one rule shifts no other module's draws.
///
/// Fails with BadGrammar when the grammar cannot be run (`compile` lists why), with NoAnswer when it divides by zero or, in SimEco, makes
/// a number that is not finite (the classic language keeps inf and nan), with LimitReached at a stated limit, with
/// Cancelled. Each names the rule that was at work.
/// Sources: L-Grammar Generator 2005, section 3.4; The Algorithmic Beauty of Plants, chapter 1; docs/simeco.md.

#include "base/progress.hpp"
#include "base/result.hpp"
#include "simeco/grammar.hpp"
#include "simeco/lsystem_files.hpp"
#include "simeco/module_string.hpp"
#include "simeco/rule_info.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
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
  std::int64_t settlingSteps = 10'000;    ///< where nobody says how many steps to do: by then nothing may change any more
  std::int64_t loopIterations = 10'000'000;  ///< of all loops of one statement block
  int expressionDepth = 200;
  double seconds = 600;                   ///< of wall time; the only limit that a slower machine meets earlier
};

class Engine;

/// A string as it is drawn: the homomorphism applied. `source[i]` is the module of the derived string that became module i, `drawnBy[i]` the
/// homomorphism rule that wrote it (-1: none, it is drawn as it is); empty where there is no homomorphism.
struct Image {
  ModuleString string;
  std::vector<std::uint32_t> source;
  std::vector<std::int32_t> drawnBy = {};
};

/// What a host may look at and change between two steps.
class HostStep {
 public:
  explicit HostStep(Engine& engine) : engine_(engine) {}
  [[nodiscard]] std::int64_t step() const;            ///< steps done so far
  [[nodiscard]] bool finished() const;                ///< the last step is done, nothing follows
  [[nodiscard]] const ModuleString& string() const;
  /// All parameters of the string, in order; a host writes the answers to query and communication modules here.
  [[nodiscard]] std::span<double> parameters();
  [[nodiscard]] Result<Image> image() const;          ///< the string after the homomorphism
  [[nodiscard]] std::optional<double> variable(std::string_view name) const;
  /// False when the grammar has no such variable.
  [[nodiscard]] bool setVariable(std::string_view name, double value);
  /// Rewrites the selected modules by the first interaction rule that applies to each, or by rule number `rule` of them alone; without
  /// interaction rules by the productions. All others are copied. Not a step of the derivation; how many modules were rewritten.
  /// Fails with BadInput for a module or a rule that is not there. (RTIL-system 2010, interaction)
  [[nodiscard]] Result<std::size_t> interact(std::span<const std::size_t> modules, std::optional<std::size_t> rule = {});
  /// Removes the selected modules with all that stands on them: up to the bracket that closes their branch. Branches before them stay.
  [[nodiscard]] Result<void> prune(std::span<const std::size_t> modules);

 private:
  Engine& engine_;
};

/// What the program around the engine answers. Every member may be empty; then func and com are errors and nothing else differs.
struct Host {
  std::function<Result<double>(std::int64_t id, std::span<const double> arguments)> function;  ///< func(id, ...)
  std::function<Result<void>(std::span<double> variables)> exchange;                           ///< com(...), changes them in place
  std::function<Result<void>(HostStep& step)> betweenSteps;  ///< before every step, and once after the last
  std::function<void(std::string_view text)> print;          ///< printf
  FileHost files;                                            ///< fopen, fclose, fscanf; none: no file can be opened
};

struct DeriveOptions {
  std::optional<std::int64_t> steps = {};  ///< none: the file's own derivation length, else until nothing changes
  std::uint64_t seed = 1;
  Limits limits = {};
  Watch watch = {};
  int threads = 0;                        ///< 0: as many as the machine has; the result does not depend on it
  bool singlePrecision = false;           ///< keep parameters in single precision, as the classic program does
  std::size_t plant = 0;                  ///< which plant of the ecosystem
  bool traced = false;                    ///< fill Derivation::origins
  Host host = {};
};

/// Where a module comes from: the rule that wrote it (index into Derivation::rules, where the productions of the plant's own L-system
/// come first, in text order; -1: the axiom) and the step that made it.
struct Origin {
  std::int32_t production = -1;
  std::int32_t step = 0;
  friend bool operator==(const Origin&, const Origin&) = default;
};

struct Derivation {
  ModuleString string;
  std::vector<std::size_t> modulesPerStep;  ///< after each step: its size is the number of steps
  bool settled = false;                     ///< a further step would change nothing
  double seconds = 0;                       ///< of the derivation alone
  std::size_t peakBytes = 0;                ///< strings, and the tables that a step needs
  int threads = 1;
  std::map<std::string, double> variables;  ///< the global variables of the L-system at the end
  std::vector<std::string> warnings;        ///< what only deriving shows; what a grammar's text shows, `check` and `checkLSystem` say
  std::vector<Origin> origins;              ///< one a module when `traced`
  RuleList rules;                           ///< all rules of the plant, by number
  std::shared_ptr<const Engine> engine;     ///< what `imageOf` needs
};

/// Derives one plant of `grammar`.
[[nodiscard]] Result<Derivation> derive(const Grammar& grammar, const DeriveOptions& options = {});

/// The derived string as it is drawn: after the homomorphism, with the module that each of its modules comes from.
[[nodiscard]] Result<Image> imageOf(const Derivation& derivation);

}  // namespace axil::simeco
