#include "quantify/csv.hpp"

#include "base/text.hpp"

namespace axil::quantify {

namespace {

const char* wordOf(SegmentKind kind) {
  switch (kind) {
    case SegmentKind::Root: return "root";
    case SegmentKind::Main: return "main";
    case SegmentKind::Branch: return "branch";
  }
  return "";
}

std::string threeOf(const glm::dvec3& v) { return shortest(v.x) + "," + shortest(v.y) + "," + shortest(v.z); }

std::string row(std::size_t number, const Segment& s) {
  return std::to_string(number) + "," + std::to_string(s.stem.value) + "," + (s.parent ? std::to_string(s.parent->value) : "") + "," +
         std::to_string(s.level) + "," + wordOf(s.kind) + "," + shortest(s.length) + "," + (s.radius ? shortest(*s.radius) : "") + "," +
         shortest(s.rotr.radians()) + "," + shortest(s.rotu.radians()) + "," + threeOf(s.rAxis.unit()) + "," + threeOf(s.direction.unit()) + "," +
         std::to_string(s.leaves.size()) + "\n";
}

}  // namespace

std::string segmentsCsv(const Measurements& measurements) {
  std::string text = "segment,stem,parent,level,kind,length,radius,rotr,rotu,rx,ry,rz,dx,dy,dz,leaves\n";
  for (std::size_t s = 0; s < measurements.segments.size(); ++s) text += row(s, measurements.segments[s]);
  return text;
}

}  // namespace axil::quantify
