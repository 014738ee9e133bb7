#pragma once
/// \file
/// Environment programs: what answers the communication modules `?E(p1, ..., pn)` of an L-system. Before each step the string is drawn
/// and for every `?E` one message goes out: where it is in the string, its parameters, the turtle's state there, the module behind it.
/// The program changes the parameters it wants to; they are in the string when the rules run. A `?E` that only a homomorphism makes
/// is sent, but has no parameters in the string, so its answer is lost. Without a program nothing changes.
///
/// Frame: the plant's; the unit is the L-system's.
/// Sources: Mech and Prusinkiewicz 1996 (open L-systems); docs/lsystem.md, "Communication".

#include "base/result.hpp"
#include "simeco/lsystem_turtle.hpp"
#include "simeco/module_string.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace axil::simeco {

/// One `?E` of the string as it is drawn.
struct Message {
  std::size_t module = 0;            ///< of the derived string; of a homomorphism's `?E`, the module it draws
  std::span<double> parameters = {}; ///< p1 ... pn; what is written here is the answer
  TurtleFrame frame = {};
  double width = 1;
  double scale = 1;
  std::optional<ModuleView> following = {};  ///< the module behind it, as it is drawn
};

/// A piece of what is drawn, that takes light away from what is below it.
struct DrawnPatch {
  glm::dvec3 at{0};
  double area = 0;
};

/// What an environment program is given once before every step: all messages, in string order, and what stands there.
struct Communication {
  std::int64_t step = 0;             ///< steps done so far
  std::span<Message> messages = {};
  std::span<const DrawnPatch> patches = {};  ///< leaves, faces, discs, balls; stems only where widths are lengths
};

/// Fails with whatever is wrong; the derivation ends with it.
using EnvironmentProgram = std::function<Result<void>(const Communication&)>;

/// Writes into p1 of every `?E` the share of the full light that reaches it, 0 to 1, with everything that is drawn taking light
/// away (light_grid.hpp). `toLight` points to where the light comes from and must not be 0.
[[nodiscard]] EnvironmentProgram lightProgram(const glm::dvec3& toLight = {0, 1, 0});

}  // namespace axil::simeco
