#pragma once
/// \file
/// Leaf steps: leaf arrangements as steps ready to be taken, with what the description says as their beginning.

#include "document/command.hpp"
#include "keywords/types.hpp"

#include <optional>

namespace axil::ui {

/// Leaves for a stem as the description has them; alternate where it says nothing.
[[nodiscard]] quantify::LeafArrangement newLeaves(const std::optional<keywords::Traits>& said, document::StemId stem);
/// The first leaves of a stem; nothing where it has some.
[[nodiscard]] std::optional<document::Step> firstLeaves(const document::Project& project, const std::optional<keywords::Traits>& said, document::StemId stem);
/// The stems, besides its own, that have no leaves yet: where an arrangement is likely to be copied.
[[nodiscard]] std::vector<document::StemId> bareStems(const document::Project& project);

}  // namespace axil::ui
