#include "document/statistics_file.hpp"

#include "base/text.hpp"
#include "document/json_lines.hpp"

#include <nlohmann/json.hpp>

#include <numbers>

namespace axil::document {

namespace {

using Json = nlohmann::ordered_json;
using quantify::Estimate;
using quantify::LayeredStatistics;
using quantify::Phyllotaxis;
using quantify::QuantityName;
using Kind = QuantityName::Kind;

constexpr double kDegrees = 180 / std::numbers::pi;

double factorOf(Kind kind) { return kind == Kind::Angle ? kDegrees : 1; }
double short6(double value) { return roundedTo(value, 9); }

Json estimateJson(const Estimate& e, Kind kind) {
  const double f = factorOf(kind);
  return {{"value", short6(e.value * f)}, {"own", short6(e.own * f)}, {"error", short6(e.error * f)}, {"deviation", short6(e.deviation * f)}, {"between_plants", short6(e.between * f)},
          {"low", short6(e.low * f)}, {"high", short6(e.high * f)}, {"pooled", short6(e.pooled)}, {"samples", e.samples}, {"plants", e.plants}};
}

Json trendJson(const quantify::Trend& t, Kind kind) {
  const double f = t.logarithmic ? 1 : factorOf(kind);
  return {{"at_rank_0", short6(t.at(0) * f)}, {t.logarithmic ? "factor_per_rank" : "step_per_rank", short6(t.step() * f)}, {"slope_error", short6(t.slopeError * f)},
          {"residual", short6(t.residual * f)}, {"clear", t.clear()}, {"last_rank", t.lastRank}, {"next", short6(t.at(t.lastRank + 1) * f)}};
}

const char* windingName(quantify::Winding winding) {
  switch (winding) {
    case quantify::Winding::Left: return "left";
    case quantify::Winding::Right: return "right";
    case quantify::Winding::Either: return "either";
    case quantify::Winding::None: return "none";
  }
  return "none";
}

const char* branchingName(quantify::Branching branching) {
  switch (branching) {
    case quantify::Branching::None: return "unbranched";
    case quantify::Branching::Monopodial: return "monopodial";
    case quantify::Branching::Sympodial: return "sympodial";
  }
  return "unbranched";
}

Json phyllotaxisJson(const Phyllotaxis& p) {
  Json json = {{"per_node", p.perNode}, {"per_node_share", short6(p.perNodeShare)}, {"samples", p.samples}};
  if (p.samples == 0) return json;
  json["divergence"] = short6(p.divergence.degrees());
  json["deviation"] = short6(p.deviation.degrees());
  json["error"] = short6(p.error.degrees());
  json["concentration"] = short6(p.concentration);
  json["chance"] = short6(p.chance);
  json["winding"] = windingName(p.winding);
  if (p.preset.empty()) return json;
  json["preset"] = p.preset;
  if (p.preset != "irregular") json["off_preset"] = short6(p.off.degrees());
  return json;
}

Json arrangementsJson(const std::vector<Phyllotaxis>& all) {
  Json orders = Json::array();
  for (std::size_t order = 0; order + 1 < all.size(); ++order) {
    if (all[order].perNode == 0) continue;
    Json json = {{"order", order}};
    json.update(phyllotaxisJson(all[order]));
    orders.push_back(json);
  }
  return {{"all", phyllotaxisJson(all.back())}, {"orders", orders}};
}

Json quantityJson(const LayeredStatistics& s, const QuantityName& name) {
  const auto& layers = s.of(name.quantity);
  Json orders = Json::array();
  for (const auto& layer : layers.orders) {
    Json json = {{"order", layer.order}, {"estimate", estimateJson(layer.estimate, name.kind)}};
    // Ratios are trends already, and a share's ranks are its own story.
    if (name.kind == Kind::Size || name.kind == Kind::Angle) json["trend"] = trendJson(layer.trend, name.kind);
    json["ranks"] = Json::array();
    for (const auto& rank : layer.ranks) {
      Json row = {{"rank", rank.rank}};
      row.update(estimateJson(rank.estimate, name.kind));
      json["ranks"].push_back(row);
    }
    orders.push_back(json);
  }
  return {{"words", name.words}, {"all", estimateJson(layers.all, name.kind)}, {"orders", orders}};
}

Json structureJson(const LayeredStatistics& s) {
  Json structure = {{"branching", Json::array()}, {"straightness", short6(s.straightness)}, {"patterns", Json::array()}, {"branches_at_node", Json::array()},
                    {"fates", Json::array()}, {"schedule", Json::array()}};
  for (const auto branching : s.branching) structure["branching"].push_back(branchingName(branching));
  for (const auto& p : s.patterns)
    structure["patterns"].push_back({{"order", p.order}, {"habit", quantify::nameOf(p.habit)}, {"period", p.period}, {"phase", p.phase}, {"delay", p.delay},
                                     {"shares", p.shares}, {"sizes", p.sizes}, {"nodes", p.nodes}, {"branched", p.branched}, {"growth_unit", short6(p.growthUnit)}});
  for (const auto& b : s.branches) structure["branches_at_node"].push_back({{"order", b.order}, {"shares", b.shares}, {"nodes", b.nodes}});
  for (const auto& f : s.fates) {
    Json fates = Json::array();
    for (const auto& fate : f.fates) fates.push_back({{"goes_on", fate.goesOn}, {"branches", fate.branches}, {"share", short6(fate.share)}, {"count", fate.count}});
    structure["fates"].push_back({{"order", f.order}, {"fates", fates}, {"segments", f.segments}});
  }
  structure["arms"] = Json::array();
  for (const auto& layers : s.arms) {
    Json arms = Json::array();
    for (const auto& arm : layers.arms) arms.push_back({{"insertion", estimateJson(arm.insertion, Kind::Angle)}, {"lateral_ratio", estimateJson(arm.lateralRatio, Kind::Ratio)}});
    structure["arms"].push_back({{"order", layers.order ? Json(*layers.order) : Json("all")}, {"arms", arms}});
  }
  for (const auto& o : s.schedule.orders) {
    Json json = {{"order", o.order}, {"steady", o.steady}, {"delay", o.delay}, {"rate", short6(o.rate)}};
    if (o.lasting) json["lasting"] = *o.lasting;
    structure["schedule"].push_back(json);
  }
  return structure;
}

// ---- for people ------------------------------------------------------------------------------------------------------

std::string number(double value, Kind kind) {
  switch (kind) {
    case Kind::Angle: return fixed(value * kDegrees, 1);
    case Kind::Share: return fixed(value, 3);
    case Kind::Ratio: return fixed(value, 3);
    case Kind::Count: return fixed(value, 1);
    case Kind::Size: return shortest(roundedTo(value, 4));
  }
  return shortest(value);
}

std::string padded(std::string text, std::size_t width) { return text.size() < width ? std::string(width - text.size(), ' ') + text : text; }

std::string rowText(const std::string& label, const Estimate& e, Kind kind) {
  std::string line = "  " + label + std::string(label.size() < 24 ? 24 - label.size() : 1, ' ');
  for (const std::string& cell : {number(e.value, kind), number(e.error, kind), number(e.deviation, kind), number(e.between, kind), fixed(100 * e.pooled, 0) + " %", std::to_string(e.samples)})
    line += padded(cell, 11);
  return line + "\n";
}

std::string arrangementText(const char* organs, const Phyllotaxis& p) {
  if (p.perNode == 0) return std::string(organs) + ": none\n";
  std::string text = std::string(organs) + ": " + std::to_string(p.perNode) + " at a node (" + fixed(100 * p.perNodeShare, 0) + " % of the nodes that have any)";
  if (p.samples == 0) return text + "; no two neighbouring nodes to measure a divergence on\n";
  text += ", divergence " + fixed(p.divergence.degrees(), 1) + " +- " + fixed(p.error.degrees(), 1) + " degrees (single steps vary by " + fixed(p.deviation.degrees(), 1) + ", " +
          std::to_string(p.samples) + " steps)";
  if (p.preset == "irregular") return text + "; no regular arrangement\n";
  if (p.preset == "none") return text + "; no arrangement known fits (" + p.nearest + " is " + fixed(p.off.degrees(), 1) + " degrees off)\n";
  return text + (p.preset.empty() ? "\n" : "; fits " + p.preset + ", " + fixed(p.off.degrees(), 1) + " degrees off\n");
}

std::string patternText(const quantify::BranchingPattern& p) {
  std::string text = "order " + std::to_string(p.order) + ": ";
  if (p.nodes == 0) return text + "no node old enough to branch\n";
  text += std::to_string(p.branched) + " of " + std::to_string(p.nodes) + " nodes branch";
  if (p.branched == 0) return text + "\n";
  text += p.habit == quantify::BranchingHabit::EveryKth ? ", every " + std::to_string(p.period) + ". from rank " + std::to_string(p.phase) : std::string(", ") + quantify::nameOf(p.habit);
  text += " (lower, middle, upper third: " + fixed(p.shares[0], 2) + ", " + fixed(p.shares[1], 2) + ", " + fixed(p.shares[2], 2) + ")";
  return text + (p.delay > 0 ? "; the youngest " + std::to_string(p.delay) + " nodes do not yet\n" : "\n");
}

std::string scheduleText(const quantify::OrderSchedule& o) {
  std::string text = "order " + std::to_string(o.order) + ": ";
  if (o.steady) return text + "a segment a stage" + (o.delay > 0 ? ", begins " + std::to_string(o.delay) + " stages late" : "") + "\n";
  return text + fixed(o.rate, 2) + " segments a stage" + (o.lasting ? ", for " + fixed(*o.lasting, 0) + " stages" : "") + "\n";
}

std::string armText(const quantify::ArmLayers& layers) {
  std::string text = layers.order ? "order " + std::to_string(*layers.order) : std::string("all orders");
  text += ", nodes of " + std::to_string(layers.arms.size()) + " axes: ";
  for (const auto& arm : layers.arms)
    text += (&arm == &layers.arms.front() ? "one leaves at " : ", one at ") + fixed(arm.insertion.value * kDegrees, 1) + " +- " + fixed(arm.insertion.error * kDegrees, 1) + " degrees, x " +
            fixed(arm.lateralRatio.value, 3) + " as long as its bearer";
  return text + " (" + std::to_string(layers.arms.front().insertion.samples) + " nodes)\n";
}

std::string habitText(const LayeredStatistics& s) {
  std::size_t monopodial = 0;
  std::size_t sympodial = 0;
  for (const auto b : s.branching) {
    monopodial += b == quantify::Branching::Monopodial ? 1 : 0;
    sympodial += b == quantify::Branching::Sympodial ? 1 : 0;
  }
  std::string text = std::to_string(s.plants) + (s.plants == 1 ? " plant" : " plants") + ": " + std::to_string(monopodial) + " monopodial, " + std::to_string(sympodial) + " sympodial, " +
                     std::to_string(s.plants - monopodial - sympodial) + " unbranched\n";
  text += arrangementText("leaves", s.leaves.back()) + arrangementText("branches", s.branchesAround.back());
  text += "\nbranching pattern\n";
  for (const auto& p : s.patterns) text += "  " + patternText(p);
  if (!s.arms.empty()) text += "arms that differ\n";
  for (const auto& layers : s.arms) text += "  " + armText(layers);
  text += "growth\n";
  for (const auto& o : s.schedule.orders) text += "  " + scheduleText(o);
  return text;
}

}  // namespace

std::string statisticsText(const LayeredStatistics& s) {
  std::string text = habitText(s);
  text += "\n                               value      error  deviation    between     pooled    samples   (sizes in " + s.unit + ", angles in degrees)\n";
  for (const QuantityName& name : quantify::quantityNames()) {
    const auto& layers = s.of(name.quantity);
    if (layers.all.samples == 0) continue;
    text += rowText(name.name, layers.all, name.kind);
    for (const auto& layer : layers.orders) {
      text += rowText("  order " + std::to_string(layer.order), layer.estimate, name.kind);
      if (name.kind == Kind::Size && layer.trend.clear())
        text += "      x " + fixed(layer.trend.step(), 4) + " a rank, from " + number(layer.trend.at(0), name.kind) + "; at rank " + std::to_string(layer.trend.lastRank + 1) + ": " +
                number(layer.trend.at(layer.trend.lastRank + 1), name.kind) + "\n";
    }
  }
  return text;
}

std::string statisticsJson(const LayeredStatistics& s) {
  Json json = {{"axil_statistics", 1}, {"unit", s.unit}, {"plants", s.plants}, {"structure", structureJson(s)}};
  json["leaves"] = arrangementsJson(s.leaves);
  json["branches"] = arrangementsJson(s.branchesAround);
  json["quantities"] = Json::object();
  for (const QuantityName& name : quantify::quantityNames())
    if (s.of(name.quantity).all.samples > 0) json["quantities"][name.name] = quantityJson(s, name);
  json["warnings"] = s.warnings;
  return jsonLines(json);
}

}  // namespace axil::document
