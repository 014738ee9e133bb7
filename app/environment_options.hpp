#pragma once
/// \file
/// The options of `axil grow` that say what surrounds the plants: --light, --wind, --obstacle and their like.

#include "simeco/environment.hpp"

namespace CLI {
class App;
}

namespace axil::app {

/// Adds the options to `sub`; what is given lands in `environment`, which must outlive the parsing.
void addEnvironment(CLI::App& sub, simeco::Environment& environment);

}  // namespace axil::app
