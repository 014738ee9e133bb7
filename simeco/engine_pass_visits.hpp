#pragma once
/// \file
/// The layers of a pass, second: sub-L-systems, each `?` of a string with variables of its own. Private to the general way.

#include "simeco/engine_pass_ground.hpp"

namespace axil::simeco {

class PassVisits : public PassGround {
 public:
  using PassGround::PassGround;

  /// Instances of `?` modules that stayed move to their place in the new string; call it once, after `derive`.
  void moveVisits() {
    for (auto& [place, visit] : moves_) newVisits_[place] = std::move(*visit);
  }
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
  [[nodiscard]] std::vector<Instance> takeVisits() { return std::move(newVisits_); }

 protected:
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
  void noteVisits(std::size_t first) {
    if (program_.enter < 0) return;
    for (std::size_t i = first; i < out_->codes.size(); ++i)
      if (out_->codes[i] == program_.enter) newVisits_.emplace_back().system = unknownSystem;
  }

  std::size_t nextVisit_ = 0;
  std::vector<Instance*> open_;
  std::vector<Instance> newVisits_;

 private:
  std::vector<std::pair<std::size_t, Instance*>> moves_;
};

}  // namespace axil::simeco
