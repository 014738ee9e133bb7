#include "render/highlight.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <map>

namespace axil::render {
namespace {

struct Highlighting {
  const std::vector<bool>& chosen;
  const Highlight& highlight;

  [[nodiscard]] bool isChosen(simeco::OrganId organ) const {
    const auto at = static_cast<std::size_t>(organ.value);
    return organ.value >= 0 && at < chosen.size() && chosen[at];
  }
  [[nodiscard]] glm::vec3 of(const glm::vec3& colour) const { return glm::mix(colour, highlight.colour, highlight.share); }
};

void highlightStems(StemMesh& stems, const Highlighting& highlighting) {
  std::vector<bool> vertices(stems.positions.size(), false);
  for (std::size_t t = 0; t < stems.sources.size(); ++t)
    if (highlighting.isChosen(stems.sources[t].organ))
      for (std::size_t corner = 0; corner < 3; ++corner) vertices[stems.triangles[3 * t + corner]] = true;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (vertices[i]) stems.colours[i] = highlighting.of(stems.colours[i]);
}

/// The chosen copies of a model: the same parts in other colours, which are made once each.
class HighlightedModels {
 public:
  HighlightedModels(PlantMesh& mesh, const Highlighting& highlighting) : mesh_(mesh), highlighting_(highlighting) {}

  [[nodiscard]] OrganModel of(const OrganModel& model, std::vector<Placement> placements) {
    OrganModel copy{.name = model.name + ", highlighted", .parts = model.parts, .placements = std::move(placements)};
    for (ModelPart& part : copy.parts) part.material = highlightedMaterial(part.material);
    return copy;
  }

 private:
  std::int32_t highlightedMaterial(std::int32_t material) {
    const auto [at, isNew] = known_.try_emplace(material, static_cast<std::int32_t>(mesh_.materials.size()));
    if (isNew) {
      Material copy = mesh_.materials[static_cast<std::size_t>(material)];
      copy.name += ", highlighted";
      copy.colour = highlighting_.of(copy.colour);
      mesh_.materials.push_back(std::move(copy));
    }
    return at->second;
  }

  PlantMesh& mesh_;
  const Highlighting& highlighting_;
  std::map<std::int32_t, std::int32_t> known_;
};

void highlightModels(PlantMesh& mesh, const Highlighting& highlighting) {
  HighlightedModels models(mesh, highlighting);
  std::vector<OrganModel> split;
  for (OrganModel& model : mesh.models) {
    const auto others = std::stable_partition(model.placements.begin(), model.placements.end(), [&](const Placement& p) { return !highlighting.isChosen(p.organ); });
    std::vector<Placement> chosen(others, model.placements.end());
    model.placements.erase(others, model.placements.end());
    if (!chosen.empty()) split.push_back(models.of(model, std::move(chosen)));
    if (!model.placements.empty()) split.push_back(std::move(model));
  }
  mesh.models = std::move(split);
}

}  // namespace

PlantMesh highlighted(PlantMesh mesh, const std::vector<bool>& chosen, const Highlight& highlight) {
  const Highlighting highlighting{chosen, highlight};
  highlightStems(mesh.stems, highlighting);
  highlightStems(mesh.faces, highlighting);
  highlightModels(mesh, highlighting);
  return mesh;
}

}  // namespace axil::render
