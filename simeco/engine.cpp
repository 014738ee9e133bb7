#include "simeco/engine.hpp"

#include "simeco/engine_state.hpp"

#include <algorithm>

namespace axil::simeco {

namespace {

/// Bytes of everything a step holds at once.
std::size_t held(const Engine::State& s) {
  std::size_t bytes = s.string.bytes() + s.spare.bytes() + s.around.bytes() + s.rightCodes.bytes();
  if (s.calm) bytes += s.calm->bytes();
  for (const Lane& lane : s.lanes) bytes += lane.own.bytes() + lane.lists.bytes() + lane.stack.bytes();
  return bytes;
}

std::string stepText(std::int64_t step) { return "in step " + std::to_string(step + 1); }

/// The block of statements that `runHeader` runs.
const char* headerName(std::uint64_t which) {
  static constexpr const char* kNames[] = {"Start", "StartEach", "EndEach", "End"};
  return kNames[which - 1];
}

bool hasStatements(const RuleTable& table) {
  return std::any_of(table.rules.begin(), table.rules.end(), [](const CompiledRule& rule) { return rule.statements; });
}

bool hasHeaders(const System& system) { return !system.startEach.empty() || !system.endEach.empty(); }

bool sameArrays(const ModuleString& string, const Arrays& other) {
  return string.size() == other.codes.size() && string.parameters().size() == other.parameters.size() &&
         std::equal(string.codes().begin(), string.codes().end(), other.codes.data()) &&
         (other.parameters.size() == 0 ||
          std::memcmp(string.parameters().data(), other.parameters.data(), other.parameters.size() * sizeof(double)) == 0);
}

/// What the rules of a program allow: whether a string that stays can ever change again, and by chance.
void describeRules(Engine::State& s) {
  s.timeless = !s.options.host.betweenSteps;
  for (const System& system : s.program->systems) {
    s.timeless = s.timeless && !hasHeaders(system);
    for (const RuleTable* table : {&system.productions, &system.decomposition}) {
      s.timeless = s.timeless && !hasStatements(*table);
      for (const CompiledRule& rule : table->rules) {
        s.drawsConditions = s.drawsConditions || rule.randomCondition;
        s.drawsResults = s.drawsResults || rule.random || system.stochastic;
      }
    }
  }
}

bool isPlain(const Engine::State& s) {
  const Program& program = *s.program;
  const System& main = program.main();
  if (s.options.generalWay || program.systems.size() > 1 || program.enter >= 0 || main.ring) return false;
  if (hasStatements(main.productions) || hasStatements(main.decomposition)) return false;
  if (program.cut >= 0 && main.productions.bySymbol[static_cast<std::size_t>(program.cut)].all.empty()) return false;
  const auto single = [](const CompiledRule& rule) { return rule.predecessor.size() == 1; };
  return std::all_of(main.productions.rules.begin(), main.productions.rules.end(), single) &&
         std::all_of(main.decomposition.rules.begin(), main.decomposition.rules.end(), single);
}

}  // namespace

// ---- Engine::State ---------------------------------------------------------------------------------------------------

Failure Engine::State::failure(const Error& error, const CompiledRule* rule) const {
  if (error.code == ErrorCode::Cancelled) return fail(error);
  const std::string where = rule == nullptr ? "" : ", by the rule " + rule->name;
  return fail(error.code, error.message + " " + stepText(steps) + where);
}

Failure Engine::State::tooMany(const char* what, std::size_t limit, const CompiledRule* rule) {
  return limitReached("the derivation would need more than " + std::to_string(limit) + " " + what + " " + stepText(steps), rule);
}

Failure Engine::State::limitReached(std::string message, const CompiledRule* rule) {
  const auto mostMade = [&] { return std::max_element(made.begin(), made.end()); };
  if (plain && rule == nullptr && (made.empty() || *mostMade() == 0)) survey();
  if (rule == nullptr) rule = lastRule;
  const auto most = mostMade();
  const bool counted = most != made.end() && *most > 0;
  if (counted || rule != nullptr)
    message += "; the rule that was growing it is " + (counted ? program->rules[static_cast<std::size_t>(most - made.begin())].name : rule->name);
  return fail(ErrorCode::LimitReached, message + "; derive fewer steps or raise the limit");
}

Failure Engine::State::tooLate() {
  return limitReached(shared.tooLate() + ", " + stepText(steps), nullptr);
}

Result<void> Engine::State::mayGoOn() {
  if (options.watch.cancelled()) return fail(ErrorCode::Cancelled, "the derivation was cancelled");
  if (!shared.late()) return {};
  return tooLate();
}

std::size_t Engine::State::bytesLeft() const {
  const std::size_t limit = options.limits.bytes, taken = string.size() + string.parameters().size() * sizeof(double) + string.identities().size() * sizeof(Identity);
  return limit > taken ? limit - taken : 0;
}

void Engine::State::note(const std::string& text) {
  if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
}

Result<void> Engine::State::runHeader(const Code& code, Instance& instance, std::uint64_t which) {
  if (code.empty()) return {};
  Machine& m = machine();
  m.setInstance(&instance, &program->systems[instance.system]);
  m.setRandom(stream(Stream::Header, static_cast<std::uint64_t>(steps), which));
  m.run(code, nullptr);
  if (m.newSeed) random = Rng(*m.newSeed);
  m.newSeed.reset();
  if (!m.trouble()) return {};
  const Error& error = *m.trouble();
  return error.code == ErrorCode::Cancelled ? fail(error) : fail(error.code, error.message + " in " + headerName(which) + (which == 2 || which == 3 ? ", " + stepText(steps) : ""));
}

Result<void> Engine::State::startInstance(Instance& instance) {
  const System& system = program->systems[instance.system];
  instance.globals.assign(system.globals.size(), 0);
  instance.elements.assign(system.arrayElements, 0);
  instance.started = true;
  Machine& m = machine();
  m.setInstance(&instance, &system);
  for (const ArrayLayout& array : system.arrays)
    for (std::size_t i = 0; i < array.initial.size(); ++i) instance.elements[array.first + i] = m.value(array.initial[i], nullptr);
  if (m.trouble()) return failure(*m.trouble(), nullptr);
  return runHeader(system.start, instance, 1);
}

void Engine::State::exchange() {
  string.codeBuffer().swap(spare.codes);
  string.parameterBuffer().swap(spare.parameters);
  string.identityBuffer().swap(spare.identities);
}

std::size_t Engine::State::expectedModules() const {
  return std::min(static_cast<std::size_t>(grownCodes * static_cast<double>(string.size())), options.limits.modules);
}
std::size_t Engine::State::expectedNumbers() const {
  return std::min(static_cast<std::size_t>(grownNumbers * static_cast<double>(string.size())), options.limits.bytes / sizeof(double));
}

void Engine::State::noteGrowth() {
  constexpr double spareRoom = 1.06;
  const auto size = static_cast<double>(std::max<std::size_t>(string.size(), 1));
  const double codes = spareRoom * static_cast<double>(spare.codes.size()) / size, numbers = spareRoom * static_cast<double>(spare.parameters.size()) / size;
  // A step that grew much is no promise; two of them are.
  grownCodes = std::min(codes, std::exchange(lastGrownCodes, codes));
  grownNumbers = std::min(numbers, std::exchange(lastGrownNumbers, numbers));
}

void Engine::State::notePeak(std::size_t more) { peak = std::max(peak, held(*this) + more); }

// ---- Engine ----------------------------------------------------------------------------------------------------------

Engine::Engine(std::unique_ptr<State> state) : state_(std::move(state)) {}
Engine::~Engine() = default;

Result<std::shared_ptr<Engine>> Engine::create(std::shared_ptr<const Program> program, EngineOptions options) {
  auto state = std::make_unique<State>();
  State& s = *state;
  s.program = std::move(program);
  s.options = std::move(options);
  s.shared = {s.program.get(), &s.options.limits, &s.options.watch, &s.options.host, {}};
  const double seconds = std::clamp(s.options.limits.seconds, 0.0, 1e8);
  s.shared.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
  for (int i = 0; i < std::max(1, s.options.threads); ++i) s.machines.emplace_back(s.shared);
  s.random = Rng(s.options.seed);
  if (const auto own = s.program->main().seed) s.random = s.random.split(*own);
  s.needs = needsOf(*s.program);
  s.walking = s.program->systems.size() > 1;
  s.needs.brackets = s.needs.brackets || s.walking;
  s.made.assign(s.program->rules.size(), 0);
  s.identified = s.program->draws || s.options.identified;
  describeRules(s);
  s.plain = isPlain(s);
  if (s.plain) {
    s.plans = planFor(*s.program);
    s.calm = std::make_unique<Calm>(*s.program, *s.plans, s.options.modulesForCalm);
    s.workers = std::make_unique<Workers>(s.options.threads);
    s.lanes.resize(s.machines.size());
  }
  return std::shared_ptr<Engine>(new Engine(std::move(state)));
}

Result<void> Engine::start() {
  State& s = *state_;
  s.string = ModuleString(s.program->symbols);
  s.string.parameterBuffer().reserve(1);  // so that there always is a place to read from
  s.spare.parameters.reserve(1);
  s.steps = 0;
  s.main = {};
  s.visits.clear();
  if (auto done = s.startInstance(s.main); !done) return done;
  const System& main = s.program->main();
  Machine& m = s.machine();
  m.setInstance(&s.main, &main);
  m.setRandom(s.stream(Stream::Axiom, 0));
  s.string.codeBuffer().assign(main.axiomCodes);
  if (s.identified) {
    s.string.identityBuffer().setSize(main.axiomCodes.size());
    writeChildren(s.string.identityBuffer().data(), 0, main.axiomKeys.data(), main.axiomKeys.size());
  }
  for (const Term& term : main.axiomTerms) {
    const double value = m.value(term, nullptr);
    s.string.parameterBuffer().push(s.options.singlePrecision ? static_cast<double>(static_cast<float>(value)) : value);
    if (!m.trouble() && s.program->language == Language::SimEco && !std::isfinite(value)) m.giveUp(ErrorCode::NoAnswer, "a parameter that is not a finite number");
    if (m.trouble()) return fail(m.trouble()->code, m.trouble()->message + " in the axiom");
  }
  if (main.derivationLength) {
    const double length = m.value(*main.derivationLength, nullptr);
    if (m.trouble() || !(length >= 0) || length > 1e15)
      return fail(ErrorCode::BadGrammar, "the derivation length must be a whole number of at least 0");
    s.wantedLength = static_cast<std::int64_t>(length);
  }
  m.length = s.wantedLength.value_or(0);
  s.random = m.newSeed ? Rng(*m.newSeed) : s.random;
  m.newSeed.reset();
  s.notePeak(0);
  return s.findVisits();
}

Result<Engine::Outcome> Engine::step(StepTrace* trace) {
  State& s = *state_;
  if (auto go = s.mayGoOn(); !go) return go.failure();
  if (s.options.host.betweenSteps) {
    HostStep view(*this);
    if (auto done = s.options.host.betweenSteps(view); !done) return done.failure();
  }
  const System& main = s.program->main();
  if (auto done = s.runHeader(main.startEach, s.main, 2); !done) return done.failure();
  std::fill(s.made.begin(), s.made.end(), 0);
  s.inPlace = false;
  s.spare.clear();
  const auto fired = s.plain && trace == nullptr ? s.plainStep() : s.generalStep(trace);
  if (!fired) return fired.failure();
  // Room that a growth promised which then did not come.
  if (!s.inPlace) s.spare.trim();
  for (Lane& lane : s.lanes) lane.own.trim();
  s.notePeak(0);
  if (held(s) > s.options.limits.bytes) return s.tooMany("bytes", s.options.limits.bytes, nullptr);
  const bool still = s.timeless && !s.drawsConditions && (*fired == 0 || (!s.inPlace && !s.drawsResults && sameArrays(s.string, s.spare)));
  if (still) return Outcome::Settled;
  if (!s.inPlace) s.exchange();
  if (auto done = s.runHeader(main.endEach, s.main, 3); !done) return done.failure();
  Machine& m = s.machine();
  if (m.newSeed) s.random = Rng(*m.newSeed);
  m.newSeed.reset();
  s.stopped = s.stopped || m.stopAsked;
  ++s.steps;
  return Outcome::Changed;
}

Result<Engine::Outcome> Engine::run(std::optional<std::int64_t> count, std::vector<std::size_t>& modulesPerStep) {
  State& s = *state_;
  const std::int64_t limit = stepLimit(count);
  Machine& m = s.machine();
  const auto wanted = [&] { return m.newLength ? m.newLength : count; };
  if (count && *count > s.steps && *count <= limit && s.canLeap()) return s.leap(*count - s.steps, modulesPerStep);
  while (!s.stopped && (!wanted() || s.steps < *wanted())) {
    if (s.steps >= limit) return tooManySteps(count);
    const auto outcome = step();
    if (!outcome) return outcome.failure();
    if (*outcome == Outcome::Settled) {
      if (!count) return Outcome::Settled;
      // The remaining steps change nothing: they are only counted.
      if (*count > limit) return tooManySteps(count);
      modulesPerStep.resize(modulesPerStep.size() + static_cast<std::size_t>(*count - s.steps), s.string.size());
      s.steps = *count;
      return Outcome::Settled;
    }
    modulesPerStep.push_back(s.string.size());
    const double known = wanted() ? static_cast<double>(*wanted()) : static_cast<double>(limit);
    s.options.watch.report("deriving", static_cast<double>(s.steps) / std::max(1.0, known));
  }
  return Outcome::Changed;
}

std::int64_t Engine::stepLimit(const std::optional<std::int64_t>& count) const {
  const Limits& limits = state_->options.limits;
  return count ? limits.steps : std::min(limits.steps, limits.settlingSteps);
}

Failure Engine::tooManyBytes() const { return state_->tooMany("bytes", state_->options.limits.bytes, nullptr); }

Failure Engine::tooManySteps(const std::optional<std::int64_t>& count) const {
  const std::string limit = std::to_string(stepLimit(count)) + " steps";
  return state_->limitReached(count ? "the derivation is limited to " + limit : "the string still changes after " + limit + ", and no number of steps was given", nullptr);
}

Result<void> Engine::finish() {
  State& s = *state_;
  if (s.steps > 0)
    if (auto done = s.runHeader(s.program->main().end, s.main, 4); !done) return done;
  s.finished = true;
  if (!s.options.host.betweenSteps) return {};
  HostStep view(*this);
  return s.options.host.betweenSteps(view);
}

Result<Image> Engine::imageOf(const ModuleString& string) const { return state_->makeImage(string); }

ModuleString Engine::takeString() {
  // Of a finished string only a homomorphism that draws still asks who is who.
  if (!state_->program->imageDraws && !state_->options.identified) state_->string.identityBuffer() = {};
  return std::move(state_->string);
}

const ModuleString& Engine::string() const { return state_->string; }
std::span<double> Engine::parameters() { return {state_->string.parameterBuffer().data(), state_->string.parameterBuffer().size()}; }
std::int64_t Engine::stepsDone() const { return state_->steps; }
std::optional<std::int64_t> Engine::ownLength() const { return state_->wantedLength; }
std::size_t Engine::peakBytes() const { return state_->peak; }
const Program& Engine::program() const { return *state_->program; }

std::vector<std::string> Engine::warnings() const {
  std::vector<std::string> all = state_->notes;
  std::size_t clamped = 0;
  for (const Machine& machine : state_->machines) clamped += machine.clampedIndices;
  if (clamped > 0) all.push_back(std::to_string(clamped) + " array indices were outside their array; the nearest element was taken");
  return all;
}

std::map<std::string, double> Engine::variables() const {
  std::map<std::string, double> values;
  const std::vector<std::string>& names = state_->program->main().globals;
  for (std::size_t i = 0; i < names.size() && i < state_->main.globals.size(); ++i) values[names[i]] = state_->main.globals[i];
  return values;
}

bool Engine::setVariable(std::string_view name, double value) {
  const std::vector<std::string>& names = state_->program->main().globals;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return false;
  state_->main.globals[static_cast<std::size_t>(found - names.begin())] = value;
  return true;
}

namespace {

/// Which of `size` modules are selected; fails when one is not there.
Result<std::vector<bool>> selectionOf(std::span<const std::size_t> modules, std::size_t size) {
  std::vector<bool> selected(size);
  for (const std::size_t module : modules) {
    if (module >= size)
      return fail(ErrorCode::BadInput, "module " + std::to_string(module) + " is selected, but the string has " + std::to_string(size) + " modules, counted from 0");
    selected[module] = true;
  }
  return selected;
}

}  // namespace

Result<std::size_t> Engine::interact(std::span<const std::size_t> modules, std::optional<std::size_t> rule) {
  State& s = *state_;
  const auto selected = selectionOf(modules, s.string.size());
  if (!selected) return selected.failure();
  const System& main = s.program->main();
  const std::size_t rules = (main.interaction.empty() ? main.productions : main.interaction).rules.size();
  if (rule && *rule >= rules)
    return fail(ErrorCode::BadInput, "interaction rule number " + std::to_string(*rule) + " is asked for, but there are " + std::to_string(rules) + ", counted from 0");
  return s.interactWith(*selected, rule);
}

Result<void> Engine::prune(std::span<const std::size_t> modules) {
  const auto selected = selectionOf(modules, state_->string.size());
  if (!selected) return selected.failure();
  return state_->pruneAt(*selected);
}

bool Engine::finished() const { return state_->finished; }

// ---- HostStep --------------------------------------------------------------------------------------------------------

bool HostStep::finished() const { return engine_.finished(); }
Result<std::size_t> HostStep::interact(std::span<const std::size_t> modules, std::optional<std::size_t> rule) { return engine_.interact(modules, rule); }
Result<void> HostStep::prune(std::span<const std::size_t> modules) { return engine_.prune(modules); }
std::int64_t HostStep::step() const { return engine_.stepsDone(); }
const ModuleString& HostStep::string() const { return engine_.string(); }
std::span<double> HostStep::parameters() { return engine_.parameters(); }
Result<Image> HostStep::image() const { return engine_.imageOf(engine_.string()); }
std::optional<double> HostStep::variable(std::string_view name) const {
  const auto values = engine_.variables();
  const auto found = values.find(std::string(name));
  return found == values.end() ? std::nullopt : std::optional(found->second);
}
bool HostStep::setVariable(std::string_view name, double value) { return engine_.setVariable(name, value); }

}  // namespace axil::simeco
