// What the contact sheet shows: every shape that organs, keywords and emit have, with its names.
#include "app/commands.hpp"
#include "app/terminal.hpp"
#include "base/text.hpp"
#include "emit/arrangement.hpp"
#include "emit/inflorescence.hpp"
#include "keywords/keywords.hpp"
#include "organs/organs.hpp"
#include "render/gallery.hpp"
#include "render/picture.hpp"
#include "simeco/simeco.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axil::app {

namespace {

using organs::LeafFeature;
using render::GalleryCell;
using render::GallerySection;

/// Shapes that are no concept of the vocabulary: nothing that one says of a plant, only how it is drawn.
constexpr std::pair<std::string_view, std::string_view> drawnNames[] = {
    {"five-petalled", "五瓣花"}, {"four-petalled", "四瓣花"}, {"six-petalled", "六瓣花"}, {"three-petalled", "三瓣花"}, {"stellate", "星形"},
    {"rose", "重瓣花"}, {"head", "頭狀花"}, {"ligulate head", "舌狀頭花"}, {"urceolate", "壺形"}, {"floret", "小花"},
    {"compound umbel", "複繖形花序"}, {"amplexicaul", "抱莖"}, {"perfoliate", "穿莖"}, {"palmatifid", "掌狀中裂"}, {"palmatipartite", "掌狀深裂"}, {"palmatisect", "掌狀全裂"},
    {"pinnatifid", "羽狀中裂"}, {"pinnatipartite", "羽狀深裂"}, {"pinnatisect", "羽狀全裂"}, {"runcinate", "倒向羽裂"}, {"obcordate", "倒心形"}, {"subcordate", "淺心形"}};

/// The first Traditional Chinese word of a concept; empty where there is none.
std::string chineseOf(std::initializer_list<const char*> properties, const std::string& name) {
  for (const char* property : properties)
    for (const keywords::Category& category : keywords::vocabulary())
      if (category.property == property)
        for (const keywords::Concept& entry : category.concepts)
          if (entry.name == name && !entry.traditional.empty()) return entry.traditional.front().words;
  for (const auto& [shape, words] : drawnNames)
    if (shape == name) return std::string(words);
  return {};
}

GallerySection leafShapes() {
  GallerySection section{"Leaf shapes", "葉形", {}};
  for (const organs::LeafShape& shape : organs::leafShapes()) section.cells.push_back({shape.name, chineseOf({"shape"}, shape.name), render::FlatLeaf{shape, -0.3 - shape.shield}});
  return section;
}

/// One feature in all its kinds, upon the same blade; `from` and `to` say which end of it is shown.
GallerySection featureSection(const char* english, const char* chinese, LeafFeature feature, const char* property, const char* blade, double width, double from, double to) {
  GallerySection section{english, chinese, {}};
  const organs::LeafShape plain = organs::withWidth(*organs::leafShapeNamed(blade), width);
  for (const std::string& name : organs::leafFeatureNames(feature))
    section.cells.push_back({name, chineseOf({property}, name), render::FlatLeaf{*organs::withFeature(plain, feature, name), from, to}});
  return section;
}

/// Venation is drawn on a blade that has it.
GallerySection venations() {
  GallerySection section{"Venation", "葉脈", {}};
  for (const std::string& name : organs::leafFeatureNames(LeafFeature::Veins)) {
    const char* blade = name == "parallel-veined" ? "lanceolate" : name == "dichotomous" ? "flabellate" : name == "palmate-veined" ? "cordate" : name == "one-veined" ? "linear" : "ovate";
    section.cells.push_back({name, chineseOf({"venation"}, name), render::FlatLeaf{*organs::withFeature(*organs::leafShapeNamed(blade), LeafFeature::Veins, name)}});
  }
  return section;
}

GallerySection compoundLeaves() {
  GallerySection section{"Compound leaves", "複葉", {}};
  for (const std::string& name : organs::leafTypeNames()) {
    if (name == "pinnate" || name == "compound") continue;  // drawn as odd-pinnate
    const auto type = *organs::leafTypeNamed(name);
    const char* leaflet = type == organs::LeafType::EvenPinnate || type == organs::LeafType::Bipinnate ? "oblong" : type == organs::LeafType::Palmate ? "obovate" : "ovate";
    const organs::CompoundLeaf leaf{.type = type, .leaflet = *organs::leafShapeNamed(leaflet)};
    section.cells.push_back({name, chineseOf({"type"}, name), render::meshOfParts(organs::compoundParts(leaf, organs::Detail::Close), name), render::ViewPreset::Front});
  }
  return section;
}

Result<render::PlantMesh> grownMesh(const Result<simeco::Grammar>& grammar) {
  if (!grammar) return grammar.failure();
  const auto growth = simeco::prepareGrowth(*grammar, {});
  if (!growth) return growth.failure();
  const auto plant = simeco::plantAt(*growth, simeco::completeTime(*growth));
  if (!plant) return plant.failure();
  return render::meshOf(*plant, {.detail = organs::Detail::Close});
}

Result<GallerySection> arrangements(const char* english, const char* chinese, render::ViewPreset view) {
  GallerySection section{english, chinese, {}};
  for (const std::string& name : keywords::arrangementNames()) {
    auto mesh = grownMesh(emit::arrangementGrammar(*keywords::arrangementNamed(name)));
    if (!mesh) return mesh.failure();
    section.cells.push_back({name, chineseOf({"arrangement"}, name), std::move(*mesh), view});
  }
  return section;
}

/// A flower turned so that one looks into it from a little aside.
render::PlantMesh turnedToTheViewer(render::PlantMesh mesh) {
  const glm::vec3 across = glm::normalize(glm::vec3{1, 0, -1});
  for (render::OrganModel& model : mesh.models)
    for (render::Placement& placement : model.placements) placement.rotation = glm::angleAxis(0.75f, across);
  return mesh;
}

GallerySection flowers() {
  GallerySection section{"Flowers", "花", {}};
  for (const organs::FlowerShape& shape : organs::flowerShapes())
    section.cells.push_back({shape.name, chineseOf({"form", "flower plan"}, shape.name), turnedToTheViewer(render::meshOfParts(organs::flowerParts(shape, organs::Detail::Close), shape.name))});
  return section;
}

Result<GallerySection> inflorescences() {
  GallerySection section{"Inflorescences", "花序", {}};
  for (const std::string& name : emit::inflorescenceNames()) {
    emit::InflorescencePlan plan;
    plan.type = *emit::inflorescenceNamed(name);
    plan.flowerModel = plan.type == emit::InflorescenceType::Catkin || plan.type == emit::InflorescenceType::Spadix ? "floret" : "five-petalled";
    plan.flowerLength = plan.type == emit::InflorescenceType::Spadix ? 0.0035 : 0.01;
    plan.flowerWidth = 2 * plan.flowerLength;
    if (plan.flowerModel != "floret") plan.colours = {{0.85, 0.42, 0.60}};
    auto mesh = grownMesh(emit::inflorescenceGrammar(plan));
    if (!mesh) return mesh.failure();
    section.cells.push_back({name, chineseOf({"type"}, name), std::move(*mesh)});
  }
  return section;
}

GallerySection fruits() {
  GallerySection section{"Fruits", "果實", {}};
  for (const organs::FruitShape& shape : organs::fruitShapes())
    section.cells.push_back({shape.name, chineseOf({"type"}, shape.name), render::meshOfParts(organs::fruitParts(shape, organs::Detail::Close), shape.name)});
  return section;
}

Result<std::vector<GallerySection>> sections() {
  std::vector<GallerySection> all{leafShapes(),
                                  featureSection("Apexes", "葉尖", LeafFeature::Apex, "apex", "elliptic", 0.62, 0.52, 1.5),
                                  featureSection("Bases", "葉基", LeafFeature::Base, "base", "elliptic", 0.62, -0.6, 0.5),
                                  featureSection("Margins", "葉緣", LeafFeature::Margin, "margin", "ovate", 0.6, -0.3, 1.2),
                                  venations(), compoundLeaves()};
  auto stems = arrangements("Arrangement of leaves", "葉序", render::ViewPreset::ThreeQuarter);
  if (!stems) return stems.failure();
  auto above = arrangements("The same from above", "葉序俯視", render::ViewPreset::Top);
  if (!above) return above.failure();
  auto flowering = inflorescences();
  if (!flowering) return flowering.failure();
  all.push_back(std::move(*stems));
  all.push_back(std::move(*above));
  all.push_back(flowers());
  all.push_back(std::move(*flowering));
  all.push_back(fruits());
  return all;
}

}  // namespace

int drawShapeGallery(const std::string& out) {
  const auto all = sections();
  if (!all) return report(all.error());
  const auto image = render::drawGallery(*all);
  if (!image) return report(image.error());
  const auto written = render::writePng(out, *image);
  return written ? 0 : report(written.error());
}

}  // namespace axil::app
