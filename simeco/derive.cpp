#include "simeco/derive.hpp"

#include "base/large_array.hpp"
#include "simeco/engine.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace axil::simeco {

namespace {

int threadsFor(const DeriveOptions& options) {
  if (options.threads > 0) return std::min(options.threads, 64);
  return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 64u));
}

/// The origins of a string's modules, step after step; the room of the string before is used again.
class Origins {
 public:
  explicit Origins(std::size_t modules) : now_(modules) {}

  void step(const StepTrace& trace, std::int64_t step) {
    const std::size_t modules = trace.begin.back();
    if (modules > next_.capacity()) growRoom(next_, modules + modules / 4);
    next_.resize(modules);
    for (std::size_t i = 0; i < trace.rule.size(); ++i)
      for (std::size_t module = trace.begin[i]; module < trace.begin[i + 1]; ++module)
        next_[module] = trace.maker[module] == StepTrace::copied ? now_[i] : Origin{trace.maker[module], static_cast<std::int32_t>(step)};
    std::swap(now_, next_);
  }
  [[nodiscard]] std::vector<Origin> take() { return std::move(now_); }

 private:
  std::vector<Origin> now_, next_;
};

/// As Engine::run, noting where every module comes from.
Result<Engine::Outcome> runTraced(Engine& engine, std::optional<std::int64_t> count, Derivation& derivation) {
  Origins origins(engine.string().size());
  StepTrace trace;
  while (!count || engine.stepsDone() < *count) {
    if (engine.stepsDone() >= engine.stepLimit(count)) return engine.tooManySteps(count);
    const auto outcome = engine.step(&trace);
    if (!outcome) return outcome.failure();
    if (*outcome == Engine::Outcome::Settled) {
      derivation.origins = origins.take();
      return Engine::Outcome::Settled;
    }
    origins.step(trace, engine.stepsDone());
    derivation.modulesPerStep.push_back(engine.string().size());
  }
  derivation.origins = origins.take();
  return Engine::Outcome::Changed;
}

}  // namespace

Result<Derivation> derive(const Grammar& grammar, const DeriveOptions& options) {
  auto program = compile(grammar, options.plant, {options.limits.expressionDepth});
  if (!program) return program.failure();
  const EngineOptions engineOptions{.seed = options.seed,
                                    .limits = options.limits,
                                    .watch = options.watch,
                                    .threads = threadsFor(options),
                                    .singlePrecision = options.singlePrecision,
                                    .host = options.host};
  auto engine = Engine::create(*std::move(program), engineOptions);
  if (!engine) return engine.failure();
  Derivation derivation;
  derivation.threads = engineOptions.threads;
  const auto begin = std::chrono::steady_clock::now();
  if (auto started = (*engine)->start(); !started) return started.failure();
  const std::optional<std::int64_t> count = options.steps ? options.steps : (*engine)->ownLength();
  if (count && *count < 0) return fail(ErrorCode::BadInput, "a derivation cannot have " + std::to_string(*count) + " steps");
  const auto outcome = options.traced ? runTraced(**engine, count, derivation) : (*engine)->run(count, derivation.modulesPerStep);
  if (!outcome) return outcome.failure();
  derivation.settled = *outcome == Engine::Outcome::Settled;
  derivation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (auto finished = (*engine)->finish(); !finished) return finished.failure();
  derivation.variables = (*engine)->variables();
  derivation.rules = RuleList((*engine)->program().rules);
  derivation.peakBytes = (*engine)->peakBytes();
  derivation.warnings = (*engine)->warnings();
  derivation.string = (*engine)->takeString();
  derivation.engine = *engine;
  return derivation;
}

Result<Image> imageOf(const Derivation& derivation) {
  if (!derivation.engine) return fail(ErrorCode::BadInput, "an image needs a derivation, and nothing has been derived");
  return derivation.engine->imageOf(derivation.string);
}

}  // namespace axil::simeco
