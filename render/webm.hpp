#pragma once
/// \file
/// Private to render: the numbers that a WebM writer draws by chance to name a film and its tracks (Matroska's SegmentUID
/// and TrackUID), replaced by fixed ones, so that the same film is the same file.
/// Source: RFC 8794 (EBML), RFC 9559 (Matroska), section 5.

#include <string>

namespace axil::render {

/// `bytes` of a WebM file; what is not one comes back as it is.
[[nodiscard]] std::string withFixedIds(std::string bytes);

}  // namespace axil::render
