#include "ui/following.hpp"

#include "document/measurable.hpp"
#include "ui/grammar_links.hpp"

#include <algorithm>
#include <chrono>
#include <future>

namespace axil::ui {
namespace {

using document::GrammarKind;

constexpr GrammarKind kKinds[] = {GrammarKind::Initial, GrammarKind::Predictive, GrammarKind::Structured};

/// Where a plant stands and how far it reaches, so that a camera can be put before it.
void measureReach(GrownGrammar& grown, const simeco::Plant& plant) {
  render::Bounds box;
  for (const simeco::Organ& organ : plant.organs) {
    box.add(organ.base.at);
    box.add(organ.tip().at);
  }
  if (box.empty()) return;
  grown.middle = {box.centre()};
  grown.reach = std::max(glm::length(box.size()) / 2, 1e-9);
}

/// A grammar that has been grown, and what it was made of.
struct Kept {
  std::shared_ptr<const simeco::Grammar> grammar;
  std::uint64_t seed = 0;
  simeco::Environment environment = {};
  std::shared_ptr<const GrownGrammar> grown;
};

/// Clicks that were left out are said already.
skeleton3d::Doubts doubtsBeside(const Following& following) {
  skeleton3d::Doubts doubts = skeleton3d::doubtsOf(*following.skeleton.good);
  if (!following.measured.good) return doubts;
  const auto& leftOut = following.measured.good->suspects;
  std::erase_if(doubts.clicks, [&](const skeleton3d::DoubtfulClick& click) {
    return std::any_of(leftOut.begin(), leftOut.end(), [&](const skeleton3d::SuspectClick& s) { return s.node == click.node && s.view == click.view; });
  });
  return doubts;
}

class Follow {
 public:
  std::shared_ptr<const Following> operator()(const FollowQuestion& question) {
    const auto begun = std::chrono::steady_clock::now();
    auto following = std::make_shared<Following>();
    following->revision = question.revision;
    if (auto said = keywords::readTraits(question.open.project.description); said) following->said = std::move(*said);
    following->measured = derived_.measured(question.open);
    following->skeleton = derived_.skeleton(question.open);
    following->measurements = derived_.measurements(question.open);
    const auto part = following->skeleton.trouble ? showPart(*following, question.open) : std::nullopt;
    if (following->skeleton.good) following->doubts = doubtsBeside(*following);
    if (following->said && following->measurements.good)
      following->contradictions = quantify::contradictionsWith(document::decided(*following->said, question.open.project.traits), *following->measurements.good);
    following->photos = derived_.photoTroubles(question.open);
    document::Derived& source = part ? part_ : derived_;
    addGrammars(*following, source, part ? *part : question.open, question.environment);
    following->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    return following;
  }

 private:
  /// While something is still missing, what is there already is shown: its skeleton stands in for the last good one.
  std::optional<document::OpenProject> showPart(Following& following, const document::OpenProject& open) {
    auto part = document::measurablePart(open.project);
    if (!part) return std::nullopt;
    document::OpenProject shown{std::move(*part), open.folder};
    const auto skeleton = part_.skeleton(shown);
    if (!skeleton.isCurrent()) return std::nullopt;
    following.partly = true;
    following.skeleton.good = skeleton.good;
    following.measurements = part_.measurements(shown);
    if (!following.measured.isCurrent()) following.measured.good = part_.measured(shown).good;
    return shown;
  }

  /// The texts one after the other, since what they follow from is kept; their growth side by side.
  void addGrammars(Following& following, document::Derived& derived, const document::OpenProject& open, const simeco::Environment& environment) {
    std::array<std::future<std::shared_ptr<const GrownGrammar>>, 3> growing;
    const std::uint64_t seed = open.project.seed;
    for (const GrammarKind kind : kKinds) {
      const auto at = static_cast<std::size_t>(kind);
      const auto grammar = derived.grammar(open, kind);
      const auto text = derived.grammarText(open, kind);
      following.grammarTroubles[at] = grammar.trouble;
      Kept& kept = kept_[at];
      if (!grammar.good || !text.good || (kept.grammar == grammar.good && kept.seed == seed && kept.environment == environment)) continue;
      kept = {grammar.good, seed, environment, nullptr};
      growing[at] = std::async(std::launch::async, [text = text.good, seed, environment] { return grownFrom(*text, seed, environment); });
    }
    for (std::size_t at = 0; at < growing.size(); ++at) {
      if (growing[at].valid()) kept_[at].grown = growing[at].get();
      following.grammars[at] = kept_[at].grown;
    }
  }

  document::Derived derived_;
  document::Derived part_;
  std::array<Kept, 3> kept_;
};

}  // namespace

std::shared_ptr<const GrownGrammar> grownFrom(std::string text, std::uint64_t seed, const simeco::Environment& environment) {
  auto grown = std::make_shared<GrownGrammar>();
  grown->text = std::move(text);
  const simeco::Parsed parsed = simeco::parseSimeco(grown->text);
  grown->diagnostics = parsed.diagnostics;
  if (!parsed.ok()) {
    grown->trouble = Error{ErrorCode::BadGrammar, parsed.diagnostics.front().message, {}};
    return grown;
  }
  for (const Diagnostic& d : simeco::check(parsed.grammar)) grown->diagnostics.push_back(d);
  grown->segments = segmentsOfLines(grown->text, parsed.grammar);
  simeco::GrowOptions options;
  options.seed = seed;
  options.environment = environment;
  const auto growth = simeco::prepareGrowth(parsed.grammar, options);
  if (!growth) {
    grown->trouble = growth.error();
    return grown;
  }
  grown->growth = *growth;
  grown->end = simeco::completeTime(*growth);
  if (const auto plant = simeco::plantAt(*growth, grown->end)) measureReach(*grown, *plant);
  else grown->trouble = plant.error();
  return grown;
}

Follower::Work followingWork() {
  auto follow = std::make_shared<Follow>();
  return [follow](const FollowQuestion& question) { return (*follow)(question); };
}

}  // namespace axil::ui
