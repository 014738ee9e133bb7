#pragma once
/// \file
/// The measurable part: what of a project under work can be measured already, so that its skeleton can be shown while the rest is still
/// being clicked. Nodes with fewer than two clicks, what hangs on them, and what nothing connects with the first stem are left out; leaves
/// go with their stems and nodes. Views, description and settings stay.

#include "document/project.hpp"

#include <optional>

namespace axil::document {

/// Nothing where not even one stem of two nodes is left.
[[nodiscard]] std::optional<Project> measurablePart(const Project& project);

}  // namespace axil::document
