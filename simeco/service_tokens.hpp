#pragma once
/// \file
/// Tokens of the two languages for an editor and for laying out. Internal; `tokensOf` chooses.

#include "simeco/language_service.hpp"

namespace axil::simeco {

[[nodiscard]] std::vector<ServiceToken> simecoTokens(std::string_view text);
[[nodiscard]] std::vector<ServiceToken> lsystemTokens(std::string_view text);

/// The end of a classic keyword at byte `at` of `text`, its colon included; nothing when none stands there.
[[nodiscard]] std::optional<std::size_t> lsystemKeywordEnd(std::string_view text, std::size_t at);

}  // namespace axil::simeco
