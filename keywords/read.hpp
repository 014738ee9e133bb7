#pragma once
/// \file
/// Reading a description: English, Traditional and Simplified Chinese, mixed as they come. Every trait quotes the words it was
/// read from; where there are no words there is no trait. Time is linear in the length of the text.
///
/// What a statement is about is the organ named before it ("Leaves opposite, ovate"), or right after an adjective ("opposite
/// leaves"); a part ("base cordate", "cordate at base") makes a shape the shape of that part, and a piece ("lobes 5, ovate")
/// makes the statement one about that piece of the organ named before. Negated statements yield nothing, doubtful ones carry
/// their qualifier.
///
/// A paragraph is read only where it is about a plant, and it must say so itself: parts of plants with statements beside them,
/// or nothing but the words of the vocabulary. A paragraph that names things of other fields (animals, machines, law) must say
/// much more of plants.

#include "base/result.hpp"
#include "base/text.hpp"
#include "keywords/types.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace axil::keywords {

/// A description of this length that is dense with statements takes about a gigabyte with its traits; longer
/// ones are read in pieces.
constexpr std::size_t descriptionLimitBytes = 20'000'000;

/// A file's bytes as text; `encoding` says what they were: "UTF-8", "UTF-16", "Big5", "GB18030", or several joined with " and "
/// where lines differ. Fails with BadInput on what is no text or has no words, and with LimitReached above
/// descriptionLimitBytes.
[[nodiscard]] Result<DecodedText> decodeDescription(std::string_view bytes);

/// What `text` says, in reading order. Text that is not UTF-8 is decoded first; spans are places in the UTF-8 text. Fails as
/// decodeDescription does.
[[nodiscard]] Result<Reading> readDescription(std::string_view text);

/// Gives the next bytes of a text; nothing at its end.
using NextBytes = std::function<std::string()>;
using TakeReading = std::function<void(const Reading&)>;
/// What a text of any length says: `take` gets the reading of one piece after another, with places in the whole text. A piece is a few
/// megabytes and ends where a line ends, so memory does not grow with the text; contradictions are looked for within a piece. Fails
/// as readDescription does, and with LimitReached on UTF-16 and on a line in another encoding than UTF-8 that is longer than a
/// description may be: what was taken before stands. Returns the number of pieces.
[[nodiscard]] Result<std::size_t> readInPieces(const NextBytes& next, const TakeReading& take);
/// Only its traits.
[[nodiscard]] Result<Traits> readTraits(std::string_view text);

}  // namespace axil::keywords
