#pragma once
/// \file
/// Random commands for the property tests: of every kind, most of them fit for the project at hand, some not.

#include "base/rng.hpp"
#include "document/command.hpp"

#include <string>

namespace axil::test {

/// A command of the `kind`-th sort of the variant, whatever project it is for: any text, any finite numbers.
[[nodiscard]] document::Command anyCommand(Rng& rng, std::size_t kind);

/// A command that means something for `project` most of the time. The project stays small: nothing grows beyond a few dozen.
[[nodiscard]] document::Command likelyCommand(Rng& rng, const document::Project& project);

/// A plant of `segments` segments: one main stem and branches of ten, three clicks a node, leaves on every stem.
[[nodiscard]] document::Project plantOf(int segments);

/// A text of up to a dozen characters: letters, blanks, quotes, escapes, controls, Chinese.
[[nodiscard]] std::string anyText(Rng& rng);

}  // namespace axil::test
