// The general way: one module after the other, so that statements run in their order. Decomposition, cuts, sub-L-systems,
// rings, predecessors of several modules.

#include "base/large_array.hpp"
#include "simeco/engine_pass.hpp"

namespace axil::simeco {

Result<std::size_t> Engine::State::generalStep(StepTrace* trace) {
  if (trace != nullptr) {
    trace->rule.clear();
    trace->begin.clear();
    trace->maker.clear();
    growRoom(trace->rule, string.size());
    growRoom(trace->begin, string.size() + 1);
    growRoom(trace->maker, expectedModules());
  }
  around.read(*program, program->main().ignored, needs, string.codes());
  spare.codes.reserve(expectedModules());
  spare.parameters.reserve(expectedNumbers());
  if (identified) spare.identities.reserve(expectedModules());
  Pass pass(*this, string, trace);
  if (!pass.derive(spare)) return pass.failure();
  if (!pass.nameVisits(spare.codes.span(), spare.parameters.span())) return pass.failure();
  pass.moveVisits();
  visits = pass.takeVisits();
  noteGrowth();
  if (pass.depthReached()) note("the maximum depth of the decomposition kept rules from being applied");
  return pass.fired();
}

void Engine::State::survey() {
  Arrays out;
  out.parameters.reserve(1);
  const std::size_t modules = std::min<std::size_t>(string.size(), 1 << 16);
  around.read(*program, program->main().ignored, needs, string.codes().first(modules));
  Pass(*this, string, nullptr).survey(out, modules);
  machine().clearTrouble();
}

Result<std::size_t> Engine::State::interactWith(const std::vector<bool>& selected, std::optional<std::size_t> rule) {
  std::fill(made.begin(), made.end(), 0);
  spare.clear();
  around.read(*program, program->main().ignored, needs, string.codes());
  Pass pass(*this, string, nullptr);
  pass.select(selected, rule);
  if (!pass.derive(spare) || !pass.nameVisits(spare.codes.span(), spare.parameters.span())) return pass.failure();
  pass.moveVisits();
  visits = pass.takeVisits();
  exchange();
  if (calm) calm->disturbed(string.size());
  return pass.fired();
}

Result<void> Engine::State::pruneAt(const std::vector<bool>& selected) {
  spare.clear();
  Pass pass(*this, string, nullptr);
  if (!pass.prune(selected, spare)) return pass.failure();
  exchange();
  if (calm) calm->disturbed(string.size());
  return findVisits();
}

Result<void> Engine::State::findVisits() {
  Pass pass(*this, string, nullptr);
  if (!pass.nameVisits(string.codes(), string.parameters())) return pass.failure();
  visits = pass.takeVisits();
  return {};
}

}  // namespace axil::simeco
