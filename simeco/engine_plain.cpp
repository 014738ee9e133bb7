// The plain way: the string is cut into as many parts as there are threads, each thread rewrites its part into a lane of its own,
// and the lanes are put together. Rules have no effects here, so nothing depends on who comes first.

#include "simeco/engine_part_pass.hpp"

#include <algorithm>

namespace axil::simeco {

namespace {

std::size_t parametersBefore(const Engine::State& s, std::size_t module) {
  if (!s.plans->parameters) return 0;
  const SymbolCode* const codes = s.string.codes().data();
  std::size_t sum = 0;
  for (std::size_t i = 0; i < module; ++i) sum += s.program->parameterCount[codes[i]];
  return sum;
}

/// The tables that contexts need, each by another thread.
void readSurroundings(Engine::State& s, int threads) {
  const SurroundingNeeds& needs = s.plans->needs;
  if (!needs.left && !needs.right && !needs.brackets && !needs.offsets) return;
  const auto& ignored = s.program->main().ignored;
  const auto read = [&](int thread) {
    const auto mine = [&](int table) { return table % threads == thread; };
    if (needs.left && mine(0)) s.around.readLeft(*s.program, ignored, s.string.codes());
    if (needs.right && mine(1)) s.around.readRight(*s.program, ignored, s.string.codes());
    if (needs.offsets && mine(2)) s.around.readOffsets(*s.program, s.string.codes());
    if (needs.brackets && mine(3)) s.around.readBrackets(*s.program, s.string.codes());
  };
  threads == 1 ? read(0) : s.workers->each(read);
}

/// So many that the lanes, before they are put together, stay within twice 8 bytes a module and 8 a parameter.
int threadsFor(const Engine::State& s) {
  const std::size_t size = s.string.size();
  const auto most = static_cast<int>(std::clamp<std::size_t>(size / s.options.modulesPerThread, 1, static_cast<std::size_t>(s.workers->count())));
  const double who = s.identified ? sizeof(Identity) : 0, codes = static_cast<double>(size), numbers = static_cast<double>(s.string.parameters().size());
  const double newCodes = s.grownCodes * codes, newNumbers = s.grownNumbers * codes;
  const double before = codes * (1 + who) + 8 * numbers, after = newCodes * (1 + who) + 8 * newNumbers;
  const double allowed = 16 * (std::max(codes, newCodes) + std::max(numbers, newNumbers));
  const auto fits = [&](int threads) { return before + after * (2 - 1.0 / threads) <= allowed; };
  int threads = most;
  while (threads > 1 && !fits(threads)) --threads;
  return threads;
}

/// Puts the lanes behind each other; the first is in its place already.
void joinLanes(Engine::State& s, int threads) {
  std::vector<std::size_t> codes{s.spare.codes.size()}, parameters{s.spare.parameters.size()};
  for (int i = 1; i < threads; ++i) {
    codes.push_back(codes.back() + s.lanes[static_cast<std::size_t>(i)].own.codes.size());
    parameters.push_back(parameters.back() + s.lanes[static_cast<std::size_t>(i)].own.parameters.size());
  }
  s.spare.codes.setSize(codes.back());
  s.spare.parameters.setSize(parameters.back());
  if (s.identified) s.spare.identities.setSize(codes.back());
  const auto join = [&](int thread) {
    if (thread == 0) return;
    const Arrays& own = s.lanes[static_cast<std::size_t>(thread)].own;
    const auto before = static_cast<std::size_t>(thread - 1);
    if (own.codes.size() > 0) std::memcpy(s.spare.codes.data() + codes[before], own.codes.data(), own.codes.size());
    if (own.parameters.size() > 0) std::memcpy(s.spare.parameters.data() + parameters[before], own.parameters.data(), own.parameters.size() * sizeof(double));
    if (own.identities.size() > 0) std::memcpy(s.spare.identities.data() + codes[before], own.identities.data(), own.identities.size() * sizeof(Identity));
  };
  constexpr std::size_t small = 1 << 18;
  if (threads > 2 && codes.back() + 8 * parameters.back() > small) return s.workers->each(join);
  for (int i = 1; i < threads; ++i) join(i);
}

/// A step in place has tables of its own and needs none of the room that rewriting needs.
void giveRoomBack(Engine::State& s) {
  s.spare = {};
  s.spare.parameters.reserve(1);  // so that there always is a place to read from
  s.rightCodes = {};
  s.around = {};
  for (Lane& lane : s.lanes) lane.own = {};
}

}  // namespace

Result<std::size_t> Engine::State::plainStep() {
  const std::size_t size = string.size();
  if (timeless && !identified && calm->worthTrying(size)) {
    if (!calm->known()) giveRoomBack(*this);
    if (const auto changed = calm->step(string, machine(), options.singlePrecision)) {
      inPlace = true;
      if (calm->lastRule() != nullptr) lastRule = calm->lastRule();
      return *changed;
    }
  }
  const int threads = threadsFor(*this);
  readSurroundings(*this, threads == 1 ? 1 : workers->count());
  if (plans->rightCodes) rightCodes.setSize(size);
  const auto part = [&](int thread) {
    if (thread >= threads) return;
    const auto t = static_cast<std::size_t>(thread), n = static_cast<std::size_t>(threads);
    Lane& lane = lanes[t];
    lane.out = thread == 0 ? &spare : &lane.own;
    lane.error.reset();
    lane.limit = Lane::Limit::None;
    lane.out->clear();
    // Room for as much as the last step's growth promises: the first lane writes where all lanes are put together.
    const std::size_t share = thread == 0 ? 1 : n;
    lane.out->codes.reserve(expectedModules() / share);
    if (identified) lane.out->identities.reserve(lane.out->codes.capacity());
    lane.out->parameters.reserve(expectedNumbers() / share);
    const std::size_t begin = size * t / n, end = size * (t + 1) / n;
    PartPass(*this, machines[t], lane).run(begin, end, parametersBefore(*this, begin));
  };
  threads == 1 ? part(0) : workers->each(part);
  written = 0;
  std::size_t fired_ = 0;
  for (int i = 0; i < threads; ++i) {
    const Lane& lane = lanes[static_cast<std::size_t>(i)];
    if (lane.error) return fail(*lane.error);
    if (lane.limit == Lane::Limit::Modules) return tooMany("modules", options.limits.modules, nullptr);
    if (lane.limit == Lane::Limit::Bytes) return tooMany("bytes", options.limits.bytes, nullptr);
    if (lane.limit == Lane::Limit::Time) {
      if (options.watch.cancelled()) return fail(ErrorCode::Cancelled, "the derivation was cancelled");
      return tooLate();
    }
    fired_ += lane.fired;
    if (lane.lastRule != nullptr) lastRule = lane.lastRule;
    if (lane.depthReached) note("the maximum depth of the decomposition kept rules from being applied");
  }
  calm->disturbed(fired_);
  joinLanes(*this, threads);
  if (spare.codes.size() > options.limits.modules) return tooMany("modules", options.limits.modules, nullptr);
  noteGrowth();
  return fired_;
}

}  // namespace axil::simeco
