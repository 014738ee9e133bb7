#include "emit/predictive_words.hpp"

#include "base/text.hpp"
#include "emit/assembly.hpp"

#include <cmath>

namespace axil::emit {

namespace {

constexpr double kNinety = 1.6448536269514722;

std::string courseWords(const quantify::LengthOutlook& course) {
  const std::string place = course.along == quantify::LengthsAlong::Stage ? "stage" : "rank";
  const std::string along = course.along == quantify::LengthsAlong::Stage ? "a stage of the plant" : "a rank";
  if (!course.bow) return "x " + fixed(course.step, 4) + " " + along + (course.curve == 1 ? "" : ", itself x " + fixed(course.curve, 4) + " " + along);
  const bool falls = course.bow->at(1) < course.bow->at(0);
  const std::string what = course.bow->pace < 0 ? "which fall from a level" : falls ? "which fall to a level" : "which rise to a level";
  return what + " by the " + place + " (" + quantify::nameOf(course.bow->shape) + ", pace " + fixed(course.bow->pace, 3) + " " + along + ", middle at " + place + " " + fixed(course.bow->middle, 1) + ")";
}

std::string shapeWords(const quantify::FateTable& table) {
  using Shape = quantify::FateTable::Shape;
  switch (table.shape) {
    case Shape::Alike: return "";
    case Shape::FirstRanks: return " on average; the first " + std::to_string(table.byRank.size() - 1) + " of an axis are their own";
    case Shape::Periodic: return " on average; every " + std::to_string(table.byRank.size()) + ". node is alike";
    case Shape::Rising: return std::string(" on average; branches come ") + (table.branchingAt(1) > table.branchingAt(0) ? "oftener" : "seldomer") + " the higher a node stands";
  }
  return "";
}

}  // namespace

std::vector<std::string> commentsFor(const quantify::OrderOutlook& o) {
  std::string fates;
  for (const quantify::Fate& fate : o.fates.fates) {
    if (fate.share < kRare) continue;
    const std::string branches = fate.branches == 0 ? "" : " with " + countOf(static_cast<std::size_t>(fate.branches), "branch", "branches");
    fates += (fates.empty() ? "" : ", ") + (fate.goesOn ? "goes on" + branches : fate.branches > 0 ? "forks into " + std::to_string(fate.branches) : std::string("ends")) + " " + fixed(100 * fate.share, 0) + " %";
  }
  std::vector<std::string> lines{"// Order " + std::to_string(o.order) + ", from " + countOf(o.segments, "segment", "segments") + ": an apex " + fates + shapeWords(o.fates) + "."};
  std::string growth = "// Its next length is foretold from " + std::string(quantify::nameOf(o.length.rule)) + ", " + courseWords(o.length) + "; 90 % within a factor of " +
                       fixed(std::exp(kNinety * o.length.miss), 3) + " (" + countOf(o.length.samples, "sample", "samples") + ").";
  if (!o.schedule.steady) growth += " It makes " + fixed(o.schedule.rate, 2) + " segments a stage" + (o.schedule.lasting ? " for " + fixed(*o.schedule.lasting, 0) + " stages." : ".");
  if (o.most) growth += " Axes end after " + countOf(static_cast<std::size_t>(*o.most), "segment", "segments") + ".";
  lines.push_back(growth);
  return lines;
}

}  // namespace axil::emit
