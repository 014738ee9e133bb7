#pragma once
/// \file
/// Deriving an L-system that asks where its turtle is: before each step, and once after the last, the string is interpreted as
/// it is drawn, and `?P ?H ?L ?U` receive their values (docs/lsystem.md, "Queries"). Grammars without queries are derived
/// exactly as by `derive`. Communication modules `?E` are answered by an environment program before each step.

#include "simeco/derive.hpp"
#include "simeco/lsystem_environment.hpp"
#include "simeco/lsystem_view.hpp"

namespace axil::simeco {

struct DeriveLSystemOptions {
  DeriveOptions derive = {};
  LSystemView view = {};
  EnvironmentProgram environment = {};  ///< answers `?E`; without one nothing does
};

/// Fails as `derive` and `interpret` do.
[[nodiscard]] Result<Derivation> deriveLSystem(const Grammar& grammar, const DeriveLSystemOptions& options = {});

}  // namespace axil::simeco
