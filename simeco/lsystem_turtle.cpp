#include "simeco/lsystem_turtle.hpp"

#include "base/text.hpp"
#include "simeco/turtle_commands.hpp"

namespace axil::simeco {

namespace {

std::string word(double value) { return " " + fixed(value, 6); }
std::string word(const glm::dvec3& v) { return " " + word(v.x) + word(v.y) + word(v.z); }

}  // namespace

Result<TurtleReport> interpret(const ModuleString& string, const LSystemView& view, TurtleSink& sink, const Watch& watch) {
  turtle::WholeString whole(string.codes(), string.parameters().data());
  return turtle::Turtle(string.symbols(), whole, view, sink, watch).run();
}

void TurtleLog::segment(const TurtleSegment& s) { text_ += "segment" + word(s.start) + word(s.end) + "  width" + word(s.startWidth) + word(s.endWidth) + "\n"; }
void TurtleLog::polygon(const TurtlePolygon& p) {
  text_ += "polygon";
  for (const glm::dvec3& vertex : p.vertices) text_ += word(vertex);
  text_ += "\n";
}
void TurtleLog::sphere(const TurtleSphere& s) { text_ += "sphere" + word(s.centre) + "  diameter" + word(s.diameter) + "\n"; }
void TurtleLog::disc(const TurtleDisc& d) { text_ += "disc" + word(d.centre) + word(d.normal) + "  diameter" + word(d.diameter) + "\n"; }
void TurtleLog::surface(const TurtleSurface& s) { text_ += std::string("surface ") + s.name + word(s.frame.position) + word(s.size) + "\n"; }

}  // namespace axil::simeco
