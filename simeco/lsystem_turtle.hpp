#pragma once
/// \file
/// The turtle: reads a string letter by letter and tells a sink what it draws. Letters it does not know do nothing, and
/// parameters beyond those a letter takes are passed over (docs/lsystem.md, "The turtle").
///
/// Frame: the plant's. The turtle starts at the origin with heading H = (0,1,0), left L = (-1,0,0) and up U = L x H = (0,0,-1). Lengths
/// and widths are in the L-system's unit, angles in degrees.
/// Fails with NoAnswer when a position or a size is no longer a finite number, with Cancelled.

#include "base/progress.hpp"
#include "base/result.hpp"
#include "simeco/lsystem_view.hpp"
#include "simeco/module_string.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace axil::simeco {

struct TurtleFrame {
  glm::dvec3 position{0, 0, 0};
  glm::dvec3 heading{0, 1, 0};
  glm::dvec3 left{-1, 0, 0};
  glm::dvec3 up{0, 0, -1};
};

/// A piece of stem. Every drawn thing knows `module`, its place in the string that was read.
struct TurtleSegment {
  glm::dvec3 start;
  glm::dvec3 end;
  double startWidth = 1;
  double endWidth = 1;
  TurtleFrame frame;          ///< at its start
  int colour = 128;
  int sides = 8;
  std::optional<std::size_t> parent;  ///< the segment, counted from 0, at whose end it starts
  bool branch = false;        ///< the first one behind a [
  std::size_t module = 0;
};
struct TurtlePolygon {
  std::vector<glm::dvec3> vertices;
  TurtleFrame frame;          ///< where it was closed
  int colour = 128;
  std::size_t module = 0;     ///< its {
};
struct TurtleSphere {
  glm::dvec3 centre;
  double diameter = 1;
  int colour = 128;
  std::size_t module = 0;
};
struct TurtleDisc {
  glm::dvec3 centre;
  glm::dvec3 normal;
  double diameter = 1;
  bool facesViewer = false;   ///< @o: it turns with the viewer; `normal` is +z
  bool outline = false;       ///< @bo, @bc
  int colour = 128;
  std::size_t module = 0;
};
/// `~s(kx, ky, kz)`: a predefined surface, named by its letter.
struct TurtleSurface {
  char name = 's';
  TurtleFrame frame;
  glm::dvec3 size{1, 1, 1};   ///< along left, heading, up
  int colour = 128;
  std::size_t module = 0;
};
/// `?P(x, y, z)` and its kin: the string wants to know where the turtle is.
struct TurtleQuery {
  char asked = 'P';           ///< P position, H heading, L left, U up, E everything (communication)
  TurtleFrame frame;
  double width = 1;
  double scale = 1;
  std::size_t module = 0;     ///< of the letter that has the parameters
};

/// What becomes of what is drawn. Calls come in string order; a segment comes when its end width is known.
class TurtleSink {
 public:
  virtual ~TurtleSink() = default;
  virtual void segment(const TurtleSegment&) {}
  virtual void polygon(const TurtlePolygon&) {}
  virtual void sphere(const TurtleSphere&) {}
  virtual void disc(const TurtleDisc&) {}
  virtual void surface(const TurtleSurface&) {}
  virtual void query(const TurtleQuery&) {}
};

struct TurtleReport {
  std::vector<std::string> warnings;  ///< brackets and braces that do not pair
};

[[nodiscard]] Result<TurtleReport> interpret(const ModuleString& string, const LSystemView& view, TurtleSink& sink, const Watch& watch = {});

/// One line a thing, for people and tests: `segment 0 0 0  0 1 0  width 1 1`.
class TurtleLog : public TurtleSink {
 public:
  void segment(const TurtleSegment& s) override;
  void polygon(const TurtlePolygon& p) override;
  void sphere(const TurtleSphere& s) override;
  void disc(const TurtleDisc& d) override;
  void surface(const TurtleSurface& s) override;
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace axil::simeco
