#include "document/skeleton_file.hpp"

#include "document/json_lines.hpp"

#include <nlohmann/json.hpp>

#include <numeric>

namespace axil::document {

using Json = nlohmann::ordered_json;

namespace {

// Adding zero turns -0 into 0, which other readers would otherwise show.
Json vectorJson(const glm::dvec3& v) { return Json::array({v.x + 0.0, v.y + 0.0, v.z + 0.0}); }

Json nodeJson(const skeleton3d::Node& node) {
  Json json = {{"id", node.id.value}, {"position", vectorJson(node.position.at)}};
  if (node.radius) json["radius"] = *node.radius;
  json["sigma"] = vectorJson(node.sigma);
  if (!node.reprojection_px.empty()) json["reprojection_px"] = node.reprojection_px;
  return json;
}

Json stemJson(const skeleton3d::Stem& stem) {
  Json nodes = Json::array();
  for (const skeleton3d::NodeId id : stem.nodes) nodes.push_back(id.value);
  return {{"id", stem.id.value}, {"parent", stem.parent ? Json(stem.parent->value) : Json(nullptr)}, {"nodes", nodes}};
}

Json leafJson(const skeleton3d::Leaf& leaf) {
  Json json = {{"stem", leaf.stem.value}, {"position", vectorJson(leaf.position.at)}, {"direction", vectorJson(leaf.direction.unit())},
               {"normal", vectorJson(leaf.normal.unit())}, {"length", leaf.length}};
  if (leaf.width > 0) json["width"] = leaf.width;
  if (!leaf.shape.empty()) json["shape"] = leaf.shape;
  return json;
}

}  // namespace

std::string skeletonText(const skeleton3d::Skeleton& skeleton, std::span<const skeleton3d::SuspectClick> suspects) {
  Json json = {{"axil_skeleton", 1}, {"unit", skeleton.unit}, {"root", skeleton.root.value}};
  json["nodes"] = json["stems"] = json["leaves"] = Json::array();
  for (const auto& node : skeleton.nodes) json["nodes"].push_back(nodeJson(node));
  for (const auto& stem : skeleton.stems) json["stems"].push_back(stemJson(stem));
  for (const auto& leaf : skeleton.leaves) json["leaves"].push_back(leafJson(leaf));
  for (const auto& node : skeleton.incomplete) json["incomplete"].push_back({{"id", node.id.value}, {"views", node.views}});
  for (const auto stem : skeleton.waiting) json["waiting_stems"].push_back(stem.value);
  for (const auto& click : suspects)
    json["suspect_clicks"].push_back({{"node", click.node.value}, {"view", click.view}, {"off_px", click.off_px}, {"chance", click.chance}});
  return jsonLines(json);
}

std::vector<std::string> waitingLines(const skeleton3d::Skeleton& skeleton, std::span<const skeleton3d::SuspectClick> suspects) {
  std::vector<std::string> lines;
  for (const auto& node : skeleton.incomplete) {
    const auto listed = [](std::string list, const std::string& view) { return list.empty() ? view : std::move(list) + ", " + view; };
    const std::string views = std::accumulate(node.views.begin(), node.views.end(), std::string(), listed);
    std::string doubted;
    for (const auto& click : suspects)
      if (click.node == node.id) doubted = listed(std::move(doubted), click.view);
    const std::string why = !views.empty()     ? "its clicks (" + views + ") give it no place; click it in another view"
                            : doubted.empty() ? "it is not clicked; click it in two views"
                                              : "its clicks (" + doubted + ") contradict one another, so none is trusted; correct them, or click it in another view";
    lines.push_back("node " + std::to_string(node.id.value) + " waits: " + why);
  }
  return lines;
}

}  // namespace axil::document
