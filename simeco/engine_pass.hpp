#pragma once
/// \file
/// Pass: the general way over a string, one module after the other. Private to engine_general.cpp and engine_interaction.cpp.

#include "simeco/engine_state.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace axil::simeco {

/// One pass over the old string. Its members are the state of the pass; `run` is the recipe.
class Pass {
 public:
  Pass(Engine::State& state, const ModuleString& old, StepTrace* trace)
      : s_(state), program_(*state.program), machine_(state.machine()), trace_(trace), old_{old.codes(), old.parameters(), old.identities()},
        identified_(!old_.identities.empty()) {
    std::size_t frame = 1;
    for (const System& system : program_.systems)
      for (const RuleTable* table : {&system.productions, &system.decomposition, &system.homomorphism})
        for (const CompiledRule& rule : table->rules) frame = std::max<std::size_t>(frame, rule.frame);
    frame_ = frame;
    locals_.resize(frame);
  }

  /// Only these modules are rewritten, by interaction rules (by productions, where there are none), or by that one of them.
  void select(const std::vector<bool>& selected, std::optional<std::size_t> rule) {
    selected_ = &selected;
    onlyRule_ = rule;
  }
  /// The string without the selected modules and all that stands on them.
  bool prune(const std::vector<bool>& selected, Arrays& out) {
    out_ = &out;
    enter(nullptr);
    for (std::size_t at = 0; at < old_.codes.size();) {
      if (!lookUp(at)) return false;
      if (selected[at] && !program_.closes[old_.codes[at]])
        cutAt(at);
      else
        copyModule(at);
    }
    return true;
  }

  /// One derivation step into `out`.
  bool derive(Arrays& out) {
    out_ = &out;
    enter(nullptr);
    for (std::size_t at = 0; at < old_.codes.size();) {
      if (!lookUp(at)) return false;
      const SymbolCode code = old_.codes[at];
      if (code == program_.enter) {
        if (!enterVisit(at)) return false;
        continue;
      }
      if (code == program_.leave && !open_.empty()) {
        if (!leaveVisit(at)) return false;
        continue;
      }
      if (selected_ != nullptr && !(*selected_)[at]) {
        copyModule(at);
        continue;
      }
      if (code == program_.cut && selected_ == nullptr && system_->productions.bySymbol[code].all.empty()) {
        cutAt(at);
        continue;
      }
      if (!rewrite(at)) return false;
    }
    if (trace_ != nullptr) trace_->begin.push_back(static_cast<std::uint32_t>(out_->codes.size()));
    return hasRoom(0, 0, nullptr);
  }

  /// Rewrites the beginning of the string for the sake of the counts of what each rule makes.
  void survey(Arrays& out, std::size_t modules) {
    surveying_ = true;
    out_ = &out;
    old_.codes = old_.codes.first(modules);
    enter(nullptr);
    for (std::size_t at = 0; at < modules;)
      if (!rewrite(at)) return;
  }

  /// The homomorphism of the whole string into `out`, with the source of each module.
  bool draw(Arrays& out, Image& image) {
    out_ = &out;
    source_ = &image.source;
    if (std::any_of(program_.systems.begin(), program_.systems.end(), [](const System& system) { return !system.homomorphism.empty(); }))
      drawnBy_ = &image.drawnBy;
    enter(nullptr);
    for (std::size_t at = 0; at < old_.codes.size();) {
      if (!lookUp(at)) return false;
      if (old_.codes[at] == program_.enter) enter(&openVisit());
      if (old_.codes[at] == program_.leave && !open_.empty()) closeVisit();
      if (!drawModule(at)) return false;
    }
    return true;
  }

  [[nodiscard]] std::vector<Instance> takeVisits() { return std::move(newVisits_); }
  [[nodiscard]] bool depthReached() const { return depthReached_; }
  [[nodiscard]] std::size_t fired() const { return fired_; }
  [[nodiscard]] Failure failure() const { return fail(*error_); }

 private:
  // ---- where we are ------------------------------------------------------------------------------------------------

  /// From time to time: whether to go on at all.
  bool lookUp(std::size_t) {
    constexpr std::size_t betweenLooks = 1 << 14, enoughLooks = 1 << 18;
    ++looks_;
    if (surveying_) return looks_ < enoughLooks;
    if (looks_ % betweenLooks != 0) return true;
    return passOn(s_.mayGoOn());
  }

  void enter(Instance* instance) {
    Instance* now = instance == nullptr ? &s_.main : instance;
    system_ = &program_.systems[now->system];
    machine_.setInstance(now, system_);
    matcher_.emplace(program_, *system_, old_, s_.around, s_.walking);
  }
  /// Sub-L-systems are told apart by the number they are entered with.
  [[nodiscard]] std::optional<std::size_t> systemCalled(double id) const {
    for (std::size_t i = 0; i < program_.systems.size(); ++i) {
      char* end = nullptr;
      const double label = std::strtod(program_.systems[i].label.c_str(), &end);
      if (end != program_.systems[i].label.c_str() && *end == '\0' && label == id) return i;
    }
    return std::nullopt;
  }
  Instance& openVisit() {
    AXIL_ASSERT(nextVisit_ < s_.visits.size(), "every `?` of a string has its instance");
    Instance& visit = s_.visits[nextVisit_++];
    open_.push_back(&visit);
    return visit;
  }
  void closeVisit() {
    open_.pop_back();
    enter(open_.empty() ? nullptr : open_.back());
  }
  /// Variables declared `external` have the values that the calling L-system's variables of that name have.
  void takeExternals(Instance& visit, const Instance& caller) const {
    const System& mine = program_.systems[visit.system];
    const System& theirs = program_.systems[caller.system];
    for (const std::string& external : mine.externals)
      for (std::size_t from = 0; from < theirs.globals.size(); ++from)
        for (std::size_t to = 0; to < mine.globals.size(); ++to)
          if (theirs.globals[from] == external && mine.globals[to] == external) visit.globals[to] = caller.globals[from];
  }
  /// A `?` that stays: its instance goes over to the new string.
  bool enterVisit(std::size_t& at) {
    const Instance& caller = open_.empty() ? s_.main : *open_.back();
    Instance& visit = openVisit();
    newVisits_.push_back({});
    moves_.emplace_back(newVisits_.size() - 1, &visit);
    copyModule(at);
    if (!visit.started)
      if (!passOn(s_.startInstance(visit))) return false;
    takeExternals(visit, caller);
    if (!passOn(s_.runHeader(program_.systems[visit.system].startEach, visit, nextVisit_))) return false;
    enter(&visit);
    return true;
  }
  bool leaveVisit(std::size_t& at) {
    copyModule(at);
    Instance& visit = *open_.back();
    if (!passOn(s_.runHeader(program_.systems[visit.system].endEach, visit, ~std::uint64_t{nextVisit_}))) return false;
    closeVisit();
    return true;
  }

 public:
  /// Instances of `?` modules that stayed move to their place in the new string; call it once, after `derive`.
  void moveVisits() {
    for (auto& [place, visit] : moves_) newVisits_[place] = std::move(*visit);
  }

 private:
  // ---- one module of the old string --------------------------------------------------------------------------------

  /// Notes who wrote the last modules of the new string, up to its end.
  void madeBy(std::int32_t rule) {
    if (trace_ != nullptr) trace_->maker.resize(out_->codes.size(), rule);
  }
  /// Notes what became of `count` modules, whose successor stands from `first` on in the new string.
  void traced(std::size_t count, std::int32_t rule, std::size_t first) {
    if (trace_ == nullptr) return;
    for (std::size_t i = 0; i < count; ++i) {
      trace_->rule.push_back(i == 0 || rule < 0 ? rule : StepTrace::consumed);
      trace_->begin.push_back(static_cast<std::uint32_t>(i == 0 ? first : out_->codes.size()));
    }
  }

  void advance(std::size_t& at, std::size_t modules) {
    for (std::size_t i = 0; i < modules; ++i) parameter_ += program_.parameterCount[old_.codes[at++]];
  }

  void copyModule(std::size_t& at) {
    traced(1, StepTrace::copied, out_->codes.size());
    put(old_.codes[at], old_.parameters.data() + parameter_, old_.who(at));
    madeBy(StepTrace::copied);
    advance(at, 1);
  }

  /// `%`: everything up to the bracket that closes its branch, or to the end of its L-system or of the string, goes.
  void cutAt(std::size_t& at) {
    std::size_t end = at;
    int brackets = 0, visits = 0;
    for (; end < old_.codes.size(); ++end) {
      const SymbolCode code = old_.codes[end];
      if (program_.closes[code] && brackets == 0) break;
      if (code == program_.leave && visits == 0 && !open_.empty()) break;
      brackets += program_.opens[code] ? 1 : program_.closes[code] ? -1 : 0;
      if (code == program_.enter) {
        ++visits;
        ++nextVisit_;
      }
      if (code == program_.leave) --visits;
    }
    ++fired_;
    traced(end - at, StepTrace::removed, out_->codes.size());
    advance(at, end - at);
  }

  bool inTrouble(const CompiledRule& rule) { return stop(s_.failure(*machine_.trouble(), &rule)); }
  /// Notes why the pass ends early.
  bool stop(Failure failure) {
    if (!error_) error_ = std::move(failure.error);
    return false;
  }
  bool passOn(const Result<void>& done) { return done || stop(done.failure()); }

  /// Whether the modules from `at` on are the rule's predecessor; binds their parameters.
  [[nodiscard]] bool predecessorAt(const CompiledRule& rule, std::span<const SymbolCode> codes, const double* parameters, double* locals) const {
    if (rule.predecessor.size() > codes.size()) return false;
    for (std::size_t i = 0; i < rule.predecessor.size(); ++i) {
      const Pattern& pattern = rule.predecessor[i];
      if (codes[i] != pattern.code) return false;
      const std::size_t count = program_.parameterCount[pattern.code];
      if (!Matcher::bind(pattern, parameters, count, locals)) return false;
      parameters += count;
    }
    return true;
  }

  /// `before` and the condition, once predecessor and contexts are bound.
  [[nodiscard]] bool conditionHolds(const CompiledRule& rule, double* locals) {
    for (std::size_t i = rule.bound; i < rule.frame; ++i) locals[i] = 0;
    if (!rule.before.empty()) machine_.run(rule.before, locals);
    if (machine_.trouble()) return false;
    return !rule.hasCondition || machine_.value(rule.condition, locals) != 0;
  }

  [[nodiscard]] const RuleTable& table() const {
    return selected_ != nullptr && !system_->interaction.empty() ? system_->interaction : system_->productions;
  }
  bool rewrite(std::size_t& at) {
    const RuleIndex& index = table().bySymbol[old_.codes[at]];
    if (index.all.empty()) return keep(at);
    if (identified_) machine_.setRandom(s_.stream(selected_ != nullptr ? Stream::Interaction : Stream::Choice, static_cast<std::uint64_t>(s_.steps), old_.who(at)));
    return system_->stochastic ? rewriteByWeight(index, at) : rewriteByFirst(index, at);
  }

  bool keep(std::size_t& at) {
    if (selected_ != nullptr || system_->decomposition.empty() || system_->decomposition.bySymbol[old_.codes[at]].all.empty()) {
      copyModule(at);
      return true;
    }
    const std::size_t first = out_->codes.size();
    pushModule(at);
    expandedFirst_ = StepTrace::copied;
    if (!emptyLists(system_->decomposition, at, at)) return false;
    traced(1, expandedFirst_, first);
    advance(at, 1);
    return true;
  }

  [[nodiscard]] bool applies(const CompiledRule& rule, std::size_t at, double* locals) {
    return predecessorAt(rule, old_.codes.subspan(at), old_.parameters.data() + parameter_, locals) &&
           matcher_->contexts(rule, at, at + rule.predecessor.size() - 1, locals) && conditionHolds(rule, locals);
  }

  bool rewriteByFirst(const RuleIndex& index, std::size_t& at) {
    for (const std::uint32_t number : candidates(index, old_.parameters.data() + parameter_)) {
      const CompiledRule& rule = table().rules[number];
      if (onlyRule_ && *onlyRule_ != number) continue;
      const bool fires = applies(rule, at, locals_.data());
      if (machine_.trouble()) return inTrouble(rule);
      if (fires) return fire(rule, at, locals_.data());
    }
    return keep(at);
  }

  /// Every applicable rule joins the set, with the locals that its `before` left; one is drawn by weight.
  bool rewriteByWeight(const RuleIndex& index, std::size_t& at) {
    applicable_.clear();
    std::size_t used = 0;
    double sum = 0;
    for (const std::uint32_t number : candidates(index, old_.parameters.data() + parameter_)) {
      const CompiledRule& rule = table().rules[number];
      if (onlyRule_ && *onlyRule_ != number) continue;
      if (frames_.size() < used + frame_) frames_.resize(used + frame_);
      double* locals = frames_.data() + used;
      const bool joins = applies(rule, at, locals);
      const double weight = joins ? machine_.value(rule.successors.front().weight, locals) : 0;
      if (!machine_.trouble() && !(weight >= 0)) machine_.giveUp(ErrorCode::NoAnswer, "a probability that is negative or no number");
      if (machine_.trouble()) return inTrouble(rule);
      if (!joins) continue;
      applicable_.push_back({&rule, used, weight});
      sum += weight;
      used += frame_;
    }
    if (applicable_.empty()) return keep(at);
    double left = sum * machine_.rng().uniform();
    std::size_t chosen = 0;
    while (chosen + 1 < applicable_.size() && left >= applicable_[chosen].weight) left -= applicable_[chosen++].weight;
    return fire(*applicable_[chosen].rule, at, frames_.data() + applicable_[chosen].locals);
  }

  /// Which of a rule's successors: by weight, where there is a choice.
  const CompiledSuccessor* choose(const CompiledRule& rule, double* locals) {
    if (rule.successors.size() == 1) return &rule.successors.front();
    double sum = 0;
    weights_.clear();
    for (const CompiledSuccessor& successor : rule.successors) {
      weights_.push_back(machine_.value(successor.weight, locals));
      if (!machine_.trouble() && !(weights_.back() >= 0)) machine_.giveUp(ErrorCode::NoAnswer, "a probability that is negative or no number");
      if (machine_.trouble()) {
        inTrouble(rule);
        return nullptr;
      }
      sum += weights_.back();
    }
    double left = sum * machine_.rng().uniform();
    std::size_t chosen = 0;
    while (chosen + 1 < weights_.size() && left >= weights_[chosen]) left -= weights_[chosen++];
    return &rule.successors[chosen];
  }

  bool fire(const CompiledRule& rule, std::size_t& at, double* locals) {
    ++fired_;
    if (identified_) machine_.setRandom(s_.stream(Stream::Successor, static_cast<std::uint64_t>(s_.steps), old_.who(at)));
    if (!rule.after.empty()) machine_.run(rule.after, locals);
    if (machine_.trouble()) return inTrouble(rule);
    const CompiledSuccessor* successor = choose(rule, locals);
    if (successor == nullptr) return false;
    const std::size_t first = out_->codes.size();
    const std::size_t consumed = rule.predecessor.size();
    if (system_->decomposition.empty()) {
      if (!write(rule, *successor, locals, old_.who(at), *out_)) return false;
      noteVisits(first);
      madeBy(static_cast<std::int32_t>(rule.id));
    } else {
      if (!pushSuccessor(rule, *successor, locals, old_.who(at), 0)) return false;
      if (!emptyLists(system_->decomposition, at, at + consumed - 1)) return false;
    }
    traced(consumed, static_cast<std::int32_t>(rule.id), first);
    advance(at, consumed);
    return true;
  }

  // ---- writing -----------------------------------------------------------------------------------------------------

  [[nodiscard]] double stored(double value) const { return s_.options.singlePrecision ? static_cast<double>(static_cast<float>(value)) : value; }

  /// Appends a successor with its parameters computed; `who` is its parent.
  bool write(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::uint64_t who, Arrays& to) {
    const std::size_t codes = to.codes.size(), parameters = to.parameters.size();
    s_.made[rule.id] += successor.codes.size();
    if (!hasRoom(successor.codes.size(), successor.terms.size(), &rule)) return false;
    if (identified_) {
      to.identities.reserveMore(codes + successor.codes.size());
      writeChildren(to.identities.data() + codes, who, successor.keys.data(), successor.keys.size());
      to.identities.setSize(codes + successor.codes.size());
    }
    to.codes.reserveMore(codes + successor.codes.size());
    to.parameters.reserveMore(parameters + successor.terms.size());
    for (std::size_t i = 0; i < successor.codes.size(); ++i) to.codes[codes + i] = successor.codes[i];
    for (std::size_t i = 0; i < successor.terms.size(); ++i) to.parameters[parameters + i] = stored(machine_.value(successor.terms[i], locals));
    if (machine_.trouble()) return inTrouble(rule);
    if (program_.language == Language::SimEco && !successor.constant)
      for (std::size_t i = 0; i < successor.terms.size(); ++i)
        if (!std::isfinite(to.parameters[parameters + i])) return stop(s_.failure({ErrorCode::NoAnswer, "a parameter that is not a finite number"}, &rule));
    to.codes.setSize(codes + successor.codes.size());
    to.parameters.setSize(parameters + successor.terms.size());
    return true;
  }
  void noteVisits(std::size_t first) {
    if (program_.enter < 0) return;
    for (std::size_t i = first; i < out_->codes.size(); ++i)
      if (out_->codes[i] == program_.enter) newVisits_.emplace_back().system = unknownSystem;
  }
  /// Whether so much more fits into the limits.
  bool hasRoom(std::size_t modules, std::size_t parameters, const CompiledRule* rule) {
    const std::size_t all = out_->codes.size() + lists_.codes.size() + modules;
    constexpr std::size_t enoughMade = 1 << 20;
    if (surveying_) return all < enoughMade && parameters < enoughMade;
    if (all > s_.options.limits.modules) return stop(s_.tooMany("modules", s_.options.limits.modules, rule));
    const std::size_t bytes = out_->used() + lists_.used() + modules * (identified_ ? 1 + sizeof(Identity) : 1) + parameters * sizeof(double);
    return bytes <= bytesLeft_ || stop(s_.tooMany("bytes", s_.options.limits.bytes, rule));
  }
  void put(SymbolCode code, const double* parameters, std::uint64_t who) {
    if (identified_) out_->identities.push(identityOf(who));
    const std::size_t count = program_.parameterCount[code], used = out_->parameters.size();
    out_->codes.push(code);
    if (count == 0) return;
    out_->parameters.reserveMore(used + count);
    for (std::size_t i = 0; i < count; ++i) out_->parameters[used + i] = parameters[i];
    out_->parameters.setSize(used + count);
  }

  // ---- decomposition and homomorphism: lists of modules, each looked up again ----------------------------------------

  /// A list of one: a module of the old string.
  void pushModule(std::size_t at) {
    const SymbolCode code = old_.codes[at];
    const Cursor cursor{lists_.codes.size(), lists_.codes.size() + 1, lists_.parameters.size(), lists_.codes.size(), lists_.parameters.size(), 0};
    lists_.codes.push(code);
    if (identified_) lists_.identities.push(identityOf(old_.who(at)));
    for (std::size_t i = 0; i < program_.parameterCount[code]; ++i) lists_.parameters.push(old_.parameters[parameter_ + i]);
    cursors_.push_back(cursor);
  }
  bool pushSuccessor(const CompiledRule& rule, const CompiledSuccessor& successor, double* locals, std::uint64_t who, int depth) {
    const std::size_t codes = lists_.codes.size(), parameters = lists_.parameters.size();
    if (!write(rule, successor, locals, who, lists_)) return false;
    cursors_.push_back({codes, lists_.codes.size(), parameters, codes, parameters, depth, static_cast<std::int32_t>(rule.id)});
    return true;
  }

  /// Looks up every module of the lists, the innermost list first, until nothing is left; [first, last] are the modules of the
  /// old string whose contexts count.
  bool emptyLists(const RuleTable& table, std::size_t first, std::size_t last) {
    while (!cursors_.empty()) {
      Cursor& cursor = cursors_.back();
      if (cursor.at == cursor.end) {
        lists_.codes.setSize(cursor.listBegin);
        lists_.parameters.setSize(cursor.parameterBegin);
        if (identified_) lists_.identities.setSize(cursor.listBegin);
        cursors_.pop_back();
        continue;
      }
      if (!lookUp(first)) return false;
      if (!lookUpModule(table, first, last)) return false;
    }
    return true;
  }
  bool lookUpModule(const RuleTable& table, std::size_t first, std::size_t last) {
    Cursor& cursor = cursors_.back();
    const SymbolCode code = lists_.codes[cursor.at];
    const RuleIndex& index = table.bySymbol[code];
    if (!index.all.empty()) {
      if (table.draws) machine_.setRandom(listStream(table, whoListed()));
      const std::span<const SymbolCode> codes = lists_.codes.span().subspan(cursor.at, cursor.end - cursor.at);
      for (const std::uint32_t number : candidates(index, lists_.parameters.data() + cursor.parameter)) {
        const CompiledRule& rule = table.rules[number];
        const bool fires = predecessorAt(rule, codes, lists_.parameters.data() + cursor.parameter, locals_.data()) &&
                           matcher_->contexts(rule, first, last, locals_.data()) && holdsAtDepth(rule, table, cursor.depth);
        if (machine_.trouble()) return inTrouble(rule);
        if (fires) return expand(rule);
      }
    }
    return putListed(code);
  }
  /// A rule that only the depth keeps from firing is worth a warning.
  [[nodiscard]] bool holdsAtDepth(const CompiledRule& rule, const RuleTable& table, int depth) {
    if (depth < table.maximumDepth) return conditionHolds(rule, locals_.data());
    depthReached_ = depthReached_ || (table.warn && (!rule.before.empty() || conditionHolds(rule, locals_.data())));
    return false;
  }
  bool expand(const CompiledRule& rule) {
    Cursor& cursor = cursors_.back();
    const int depth = cursor.depth + 1;
    const std::uint64_t who = whoListed();
    for (std::size_t i = 0; i < rule.predecessor.size(); ++i) cursor.parameter += program_.parameterCount[lists_.codes[cursor.at++]];
    if (!rule.after.empty()) machine_.run(rule.after, locals_.data());
    if (machine_.trouble()) return inTrouble(rule);
    ++fired_;
    if (expandedFirst_ == StepTrace::copied) expandedFirst_ = static_cast<std::int32_t>(rule.id);
    const CompiledSuccessor* successor = choose(rule, locals_.data());
    if (successor == nullptr) return false;
    return pushSuccessor(rule, *successor, locals_.data(), who, depth);
  }
  [[nodiscard]] std::uint64_t whoListed() const { return identified_ ? whoIs(lists_.identities[cursors_.back().at]) : 0; }
  /// The draws of a module that is decomposed or drawn: by its own identity, so none shifts those of the modules beside it.
  [[nodiscard]] Rng listStream(const RuleTable& table, std::uint64_t who) const {
    if (source_ != nullptr) return s_.stream(Stream::Homomorphism, table.seed.value_or(0), who);
    return s_.stream(Stream::Decomposition, static_cast<std::uint64_t>(s_.steps), who);
  }
  bool putListed(SymbolCode code) {
    Cursor& cursor = cursors_.back();
    if (!hasRoom(1, program_.parameterCount[code], nullptr)) return false;
    put(code, lists_.parameters.data() + cursor.parameter, whoListed());
    madeBy(cursor.rule);
    if (source_ != nullptr) source_->push_back(sourceNow_);
    if (drawnBy_ != nullptr) drawnBy_->push_back(cursor.rule);
    if (source_ == nullptr && code == program_.enter) newVisits_.emplace_back().system = unknownSystem;
    cursor.parameter += program_.parameterCount[code];
    ++cursor.at;
    return true;
  }

  /// At depth 0 a homomorphism rule may take several modules of the string itself.
  bool drawModule(std::size_t& at) {
    const RuleTable& table = system_->homomorphism;
    sourceNow_ = static_cast<std::uint32_t>(at);
    if (table.empty()) return drawAsItIs(at);
    if (table.draws) machine_.setRandom(listStream(table, old_.who(at)));
    const RuleIndex& index = table.bySymbol[old_.codes[at]];
    if (table.maximumDepth > 0 && !index.all.empty()) {
      for (const std::uint32_t number : candidates(index, old_.parameters.data() + parameter_)) {
        const CompiledRule& rule = table.rules[number];
        const bool fires = applies(rule, at, locals_.data());
        if (machine_.trouble()) return inTrouble(rule);
        if (!fires) continue;
        if (!rule.after.empty()) machine_.run(rule.after, locals_.data());
        if (machine_.trouble()) return inTrouble(rule);
        const CompiledSuccessor* successor = choose(rule, locals_.data());
        if (successor == nullptr) return false;
        if (!pushSuccessor(rule, *successor, locals_.data(), old_.who(at), 1)) return false;
        const std::size_t consumed = rule.predecessor.size();
        if (!emptyLists(table, at, at + consumed - 1)) return false;
        advance(at, consumed);
        return true;
      }
    }
    return drawAsItIs(at);
  }
  bool drawAsItIs(std::size_t& at) {
    if (!hasRoom(1, program_.parameterCount[old_.codes[at]], nullptr)) return false;
    put(old_.codes[at], old_.parameters.data() + parameter_, old_.who(at));
    source_->push_back(sourceNow_);
    if (drawnBy_ != nullptr) drawnBy_->push_back(-1);
    advance(at, 1);
    return true;
  }

 public:
  /// A `?` that a rule has just made: which L-system it enters is read from its parameter when the step is over.
  static constexpr std::size_t unknownSystem = static_cast<std::size_t>(-1);
  bool nameVisits(std::span<const SymbolCode> codes, std::span<const double> parameters) {
    if (program_.enter < 0) return true;
    std::size_t parameter = 0, visit = 0;
    for (const SymbolCode code : codes) {
      if (code == program_.enter) {
        if (visit == newVisits_.size()) newVisits_.emplace_back().system = unknownSystem;
        Instance& instance = newVisits_[visit++];
        const auto system = systemCalled(parameters[parameter]);
        if (!system) return stop(s_.failure({ErrorCode::BadGrammar, "?(id, scale) names an L-system that the file does not have"}, nullptr));
        if (instance.system == unknownSystem) instance.system = *system;
      }
      parameter += program_.parameterCount[code];
    }
    return true;
  }

 private:
  struct Applicable {
    const CompiledRule* rule;
    std::size_t locals;
    double weight;
  };

  Engine::State& s_;
  const Program& program_;
  Machine& machine_;
  StepTrace* trace_;
  OldString old_;
  bool identified_;
  bool surveying_ = false;
  std::size_t bytesLeft_ = s_.bytesLeft();
  const System* system_ = nullptr;
  std::optional<Matcher> matcher_;
  Arrays* out_ = nullptr;
  std::vector<std::uint32_t>* source_ = nullptr;
  std::vector<std::int32_t>* drawnBy_ = nullptr;
  std::int32_t expandedFirst_ = StepTrace::copied;  ///< the rule that decomposed a module of the old string first
  const std::vector<bool>* selected_ = nullptr;
  std::optional<std::size_t> onlyRule_;
  std::uint32_t sourceNow_ = 0;
  std::size_t parameter_ = 0;  ///< of the module at hand
  std::size_t fired_ = 0;
  std::size_t looks_ = 0;
  std::size_t frame_ = 1;
  std::vector<double> locals_, frames_, weights_;
  std::vector<Applicable> applicable_;
  Arrays lists_;
  std::vector<Cursor> cursors_;
  bool depthReached_ = false;
  std::optional<Error> error_;
  std::size_t nextVisit_ = 0;
  std::vector<Instance*> open_;
  std::vector<Instance> newVisits_;
  std::vector<std::pair<std::size_t, Instance*>> moves_;
};

}  // namespace axil::simeco
