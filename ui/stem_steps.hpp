#pragma once
/// \file
/// Stem steps: what can be done to the stem at a node or under the mouse, as steps ready to be taken. Nothing where it makes no sense there.

#include "document/command.hpp"
#include "ui/clicking.hpp"

#include <optional>

namespace axil::ui {

/// The stem of an inner node becomes two.
[[nodiscard]] std::optional<document::Step> splitAt(const document::Project& project, document::NodeId node);
/// The stem of the node, the other way round.
[[nodiscard]] std::optional<document::Step> reverseAt(const document::Project& project, document::NodeId node);
/// `upper` goes on where the stem of `node` ends.
[[nodiscard]] std::optional<document::Step> joinOnto(const document::Project& project, document::StemId upper, document::NodeId node);
/// `stem` begins at `node`.
[[nodiscard]] std::optional<document::Step> attachTo(const document::Project& project, document::StemId stem, document::NodeId node);

}  // namespace axil::ui
