#include "ui/ghosts.hpp"

#include "simeco/growth.hpp"

namespace axil::ui {
namespace {

/// Growths are kept while only the time changes.
class Ghosts {
 public:
  std::vector<Ghost> operator()(const GhostQuestion& question) {
    if (question.grammar != grammar_ || question.seed != seed_ || question.environment != environment_) grown_.clear();
    grammar_ = question.grammar;
    seed_ = question.seed;
    environment_ = question.environment;
    std::vector<Ghost> ghosts;
    for (int i = 0; i < question.ghosts; ++i) ghosts.push_back(at(static_cast<std::size_t>(i), question.time));
    return ghosts;
  }

 private:
  Ghost at(std::size_t which, double time) {
    while (grown_.size() <= which) grown_.push_back(grownFrom(grammar_->text, seed_ + 1 + grown_.size(), environment_));
    Ghost ghost;
    if (!grown_[which]->growth) return ghost;
    const auto plant = simeco::plantAt(*grown_[which]->growth, time);
    if (!plant) return ghost;
    for (const simeco::Organ& organ : plant->organs)
      if (organ.kind == simeco::OrganKind::Stem && organ.length > 0) ghost.emplace_back(organ.base, organ.tip());
    return ghost;
  }

  std::shared_ptr<const GrownGrammar> grammar_;
  std::uint64_t seed_ = 0;
  simeco::Environment environment_;
  std::vector<std::shared_ptr<const GrownGrammar>> grown_;
};

}  // namespace

GhostGrower::Work ghostWork() {
  auto ghosts = std::make_shared<Ghosts>();
  return [ghosts](const GhostQuestion& question) { return (*ghosts)(question); };
}

}  // namespace axil::ui
