#pragma once
/// \file
/// Engine: one plant's string and the rules that rewrite it, step by step. `derive` and `prepareGrowth` are the doors to it;
/// it is of use alone to whoever needs every step (growth, tracing).
///
/// A step reads the old string and writes the new one beside it; both buffers are kept. Grammars without statements, cuts,
/// sub-L-systems, rings, decomposition and predecessors of several modules take the *plain* way: rules are chosen for all
/// modules, sizes are added up, then everything is written at its place, each part by any number of threads. The others take
/// the *general* way, one module after the other, since statements make the order count.

#include "simeco/derive.hpp"
#include "simeco/program.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace axil::simeco {

/// What became of every module of the string before a step.
struct StepTrace {
  static constexpr std::int32_t copied = -1;
  static constexpr std::int32_t removed = -2;   ///< cut off
  static constexpr std::int32_t consumed = -3;  ///< a further module of the predecessor before it
  std::vector<std::int32_t> rule;               ///< production number, or one of the above
  std::vector<std::uint32_t> begin;             ///< first module that it became, one more entry than `rule`
  std::vector<std::int32_t> maker;              ///< of every new module the rule that wrote it (decomposition rules too), or `copied`
};

struct EngineOptions {
  std::uint64_t seed = 1;
  Limits limits = {};
  Watch watch = {};
  int threads = 1;
  bool singlePrecision = false;
  bool identified = false;                  ///< modules carry identities even where no rule draws (growth draws for organs)
  // Tests make these small, to compare all ways on short strings.
  bool generalWay = false;                  ///< always take the general way
  std::size_t modulesPerThread = 4096;      ///< fewer are not worth another thread
  std::size_t modulesForCalm = 512;         ///< fewer are not worth remembering what moved
  Host host = {};
};

class ImageReader;  ///< engine_image.hpp

class Engine {
 public:
  static Result<std::shared_ptr<Engine>> create(std::shared_ptr<const Program> program, EngineOptions options);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Array initialisers, Start, axiom.
  Result<void> start();
  enum class Outcome { Changed, Settled };
  /// One step. Settled: the string stays as it is, for ever; then the step does not count. A trace needs the general way.
  Result<Outcome> step(StepTrace* trace = nullptr);
  /// `count` steps, or until settled without a count; appends the modules after each to `modulesPerStep`.
  Result<Outcome> run(std::optional<std::int64_t> count, std::vector<std::size_t>& modulesPerStep);
  /// The End block, and the last call of the host.
  Result<void> finish();

  /// The error for a derivation that needs more steps than its limit, with the rule that was growing.
  /// The limit on steps in force: of a stated number of steps, or of steps until nothing changes.
  [[nodiscard]] std::int64_t stepLimit(const std::optional<std::int64_t>& count) const;
  [[nodiscard]] Failure tooManyBytes() const;
  [[nodiscard]] Failure tooManySteps(const std::optional<std::int64_t>& count) const;
  /// The homomorphism of `string`, which must be one that this engine made.
  [[nodiscard]] Result<Image> imageOf(const ModuleString& string) const;
  /// The same for any stretch of a finished string by itself; null where the rules need more than a module's own parameters.
  [[nodiscard]] std::unique_ptr<ImageReader> imageReader() const;

  [[nodiscard]] const ModuleString& string() const;
  [[nodiscard]] ModuleString takeString();
  [[nodiscard]] std::span<double> parameters();
  [[nodiscard]] std::int64_t stepsDone() const;
  [[nodiscard]] std::optional<std::int64_t> ownLength() const;  ///< the file's derivation length
  [[nodiscard]] std::size_t peakBytes() const;
  [[nodiscard]] const Program& program() const;
  [[nodiscard]] std::vector<std::string> warnings() const;
  [[nodiscard]] std::map<std::string, double> variables() const;
  [[nodiscard]] bool setVariable(std::string_view name, double value);
  /// As HostStep's.
  [[nodiscard]] Result<std::size_t> interact(std::span<const std::size_t> modules, std::optional<std::size_t> rule);
  [[nodiscard]] Result<void> prune(std::span<const std::size_t> modules);
  [[nodiscard]] bool finished() const;

  struct State;  ///< engine_state.hpp

 private:
  explicit Engine(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace axil::simeco
