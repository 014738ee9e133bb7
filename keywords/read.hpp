#pragma once
/// \file
/// Reading a description: English, Traditional and Simplified Chinese, mixed as they come. Every trait quotes the words it was
/// read from; where there are no words there is no trait. Time is linear in the length of the text.
///
/// What a statement is about is the organ named before it ("Leaves opposite, ovate"), or right after an adjective ("opposite
/// leaves"); a part ("base cordate", "cordate at base") makes a shape the shape of that part. Negated statements yield
/// nothing, doubtful ones carry their qualifier.

#include "base/result.hpp"
#include "base/text.hpp"
#include "keywords/types.hpp"

#include <cstddef>
#include <string_view>

namespace axil::keywords {

constexpr std::size_t descriptionLimitBytes = 100'000'000;

/// A file's bytes as text; `encoding` says what they were. Fails with BadInput on what is no text or has no words, and with
/// LimitReached above descriptionLimitBytes.
[[nodiscard]] Result<DecodedText> decodeDescription(std::string_view bytes);

/// The traits of `text` in reading order. `text` must be UTF-8; fails as decodeDescription does.
[[nodiscard]] Result<Traits> readTraits(std::string_view text);

}  // namespace axil::keywords
