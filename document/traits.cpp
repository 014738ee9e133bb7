#include "document/traits.hpp"

#include "keywords/keywords.hpp"

#include <algorithm>

namespace axil::document {

using keywords::Trait;
using keywords::Traits;

namespace {

bool isOwn(const ProjectTrait& decision) { return decision.words.empty() && decision.verdict == Verdict::Changed; }

const ProjectTrait* decisionAbout(const Trait& trait, const SharedList<ProjectTrait>& decisions) {
  const auto found = std::find_if(decisions.begin(), decisions.end(), [&](const ProjectTrait& d) {
    return !d.words.empty() && d.organ == trait.organ && d.property == trait.property && d.words == trait.text;
  });
  return found == decisions.end() ? nullptr : &*found;
}

Trait withValueOf(Trait trait, const ProjectTrait& decision) {
  trait.value = decision.value;
  trait.low = decision.low;
  trait.high = decision.high;
  trait.unit = decision.unit;
  trait.minimum = trait.maximum = std::nullopt;
  return trait;
}

Trait ownFact(const ProjectTrait& decision) {
  Trait trait;
  trait.organ = decision.organ;
  trait.property = decision.property;
  return withValueOf(std::move(trait), decision);
}

bool overruled(const Trait& trait, const SharedList<ProjectTrait>& decisions) {
  return std::any_of(decisions.begin(), decisions.end(),
                     [&](const ProjectTrait& d) { return isOwn(d) && d.organ == trait.organ && d.property == trait.property; });
}

}  // namespace

Traits decided(const Traits& said, const SharedList<ProjectTrait>& decisions) {
  Traits traits;
  for (const Trait& trait : said) {
    const ProjectTrait* decision = decisionAbout(trait, decisions);
    if (overruled(trait, decisions) || (decision != nullptr && decision->verdict == Verdict::Rejected)) continue;
    traits.push_back(decision != nullptr && decision->verdict == Verdict::Changed ? withValueOf(trait, *decision) : trait);
    if (decision != nullptr) traits.back().qualifier.clear();
  }
  for (const ProjectTrait& decision : decisions)
    if (isOwn(decision)) traits.push_back(ownFact(decision));
  return traits;
}

Result<Traits> traitsOf(const Project& project) {
  if (project.description.empty()) return decided({}, project.traits);
  const auto said = keywords::readTraits(project.description);
  if (!said) return said.failure();
  return decided(*said, project.traits);
}

}  // namespace axil::document
