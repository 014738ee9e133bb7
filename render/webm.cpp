#include "render/webm.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace axil::render {
namespace {

/// Elements that hold others on the way to the identifiers: Segment, Info, Tracks, TrackEntry, Tags, Tag, Targets.
constexpr std::array<std::uint32_t, 7> holders{0x18538067, 0x1549A966, 0x1654AE6B, 0xAE, 0x1254C367, 0x7373, 0x63C0};
/// SegmentUID, TrackUID, TagTrackUID.
constexpr std::array<std::uint32_t, 3> identifiers{0x73A4, 0x73C5, 0x63C5};

struct Element {
  std::uint32_t id = 0;
  std::size_t content = 0;
  std::size_t end = 0;
};

/// Bytes of a number that says its own length by its leading zeros; 0 for none.
std::size_t lengthOf(unsigned char first) {
  for (std::size_t n = 1; n <= 8; ++n)
    if ((first & (0x100u >> n)) != 0) return n;
  return 0;
}

/// The element that starts at `at`, which must end by `limit`. A size of all ones means "to the end".
std::optional<Element> elementAt(const std::string& bytes, std::size_t at, std::size_t limit) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  if (at >= limit) return std::nullopt;
  const std::size_t idLength = lengthOf(byte(at));
  if (idLength == 0 || idLength > 4 || at + idLength >= limit) return std::nullopt;
  Element element;
  for (std::size_t i = 0; i < idLength; ++i) element.id = (element.id << 8) | byte(at + i);
  const std::size_t sizeAt = at + idLength, sizeLength = lengthOf(byte(sizeAt));
  if (sizeLength == 0 || sizeAt + sizeLength > limit) return std::nullopt;
  std::uint64_t size = byte(sizeAt) & (0xFFu >> sizeLength), unknown = 0xFFu >> sizeLength;
  for (std::size_t i = 1; i < sizeLength; ++i) {
    size = (size << 8) | byte(sizeAt + i);
    unknown = (unknown << 8) | 0xFFu;
  }
  element.content = sizeAt + sizeLength;
  if (size == unknown) element.end = limit;
  else if (size > limit - element.content) return std::nullopt;
  else element.end = element.content + static_cast<std::size_t>(size);
  return element;
}

void fixWithin(std::string& bytes, std::size_t from, std::size_t to) {
  const auto among = [](const auto& list, std::uint32_t id) { return std::find(list.begin(), list.end(), id) != list.end(); };
  for (auto element = elementAt(bytes, from, to); element; element = elementAt(bytes, element->end, to)) {
    if (among(holders, element->id)) fixWithin(bytes, element->content, element->end);
    if (!among(identifiers, element->id)) continue;
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(element->content), bytes.begin() + static_cast<std::ptrdiff_t>(element->end), '\0');
    if (element->end > element->content) bytes[element->end - 1] = 1;
  }
}

}  // namespace

std::string withFixedIds(std::string bytes) {
  fixWithin(bytes, 0, bytes.size());
  return bytes;
}

}  // namespace axil::render
