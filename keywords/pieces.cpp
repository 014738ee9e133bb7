// Texts that are too long to be kept: read piece by piece.
#include "keywords/read.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace axil::keywords {

namespace {

constexpr std::size_t pieceBytes = 4'000'000;

// Where a piece of the text so far may end: behind its last empty line, else behind its last line, else, in UTF-8, between two
// characters. 0: more must be read first.
std::size_t cutOf(std::string_view text) {
  const std::size_t paragraph = text.rfind("\n\n");
  if (paragraph != std::string_view::npos && paragraph > text.size() / 2) return paragraph + 2;
  const std::size_t line = text.rfind('\n');
  if (line != std::string_view::npos) return line + 1;
  std::size_t cut = text.size();
  const auto isInside = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80; };
  for (std::size_t back = 1; back <= 4 && back < text.size(); ++back)
    if (!isInside(text.size() - back)) {
      cut = text.size() - back;
      break;
    }
  return isUtf8(text.substr(0, cut)) ? cut : 0;
}

struct Place {
  std::uint32_t bytes = 0;
  std::size_t characters = 0;
};

template <class Statements>
void shift(Statements& statements, const Place& by) {
  for (auto& statement : statements) {
    statement.span.begin += by.bytes;
    statement.span.end += by.bytes;
    statement.start += by.characters;
    statement.end += by.characters;
  }
}

Error tooLong(const char* what) {
  return {ErrorCode::LimitReached, std::string(what) + " can have at most " + std::to_string(descriptionLimitBytes / 1'000'000) + " MB; save the text as UTF-8, or cut it into parts", {}};
}

}  // namespace

Result<std::size_t> readInPieces(const NextBytes& next, const TakeReading& take) {
  std::string waiting;
  Place place;
  std::size_t pieces = 0;
  bool ended = false;
  for (bool last = false; !last;) {
    while (waiting.size() < pieceBytes && !ended) {
      const std::string bytes = next();
      ended = bytes.empty();
      waiting += bytes;
    }
    last = ended && waiting.size() <= pieceBytes;
    if (pieces == 0 && !last && (waiting.starts_with("\xFF\xFE") || waiting.starts_with("\xFE\xFF"))) return fail(tooLong("a description in UTF-16"));
    std::size_t cut = last ? waiting.size() : cutOf(std::string_view(waiting).substr(0, pieceBytes));
    while (cut == 0 && !last) {  // one line in another encoding
      const std::size_t newline = waiting.find('\n', pieceBytes);
      if (newline != std::string::npos) cut = newline + 1;
      else if (ended) last = true;
      if (std::min(newline, waiting.size()) > descriptionLimitBytes) return fail(tooLong("a line that is not UTF-8"));
      if (last) cut = waiting.size();
      if (cut != 0) break;
      const std::string bytes = next();
      ended = bytes.empty();
      waiting += bytes;
    }
    const std::string piece = waiting.substr(0, cut);
    waiting.erase(0, cut);
    const bool blank = piece.find_first_not_of(" \t\r\n\f\v") == std::string::npos;
    if (blank && (!last || pieces > 0)) {
      place.bytes += static_cast<std::uint32_t>(piece.size());
      place.characters += piece.size();
      continue;
    }
    const Result<DecodedText> text = decodeDescription(piece);
    if (!text) return text.failure();
    Result<Reading> reading = readDescription(text->utf8);
    if (!reading) return reading.failure();
    shift(reading->traits, place);
    shift(reading->unknown, place);
    take(*reading);
    if (text->utf8.size() > std::numeric_limits<std::uint32_t>::max() - place.bytes - pieceBytes) return fail(ErrorCode::LimitReached, "a text can have at most 4 GB; cut it into parts");
    place.bytes += static_cast<std::uint32_t>(text->utf8.size());
    place.characters += countCharacters(text->utf8);
    ++pieces;
  }
  return pieces;
}

}  // namespace axil::keywords
