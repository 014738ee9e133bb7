#include "keywords/read.hpp"

#include "keywords/contradictions.hpp"
#include "keywords/paragraph.hpp"
#include "keywords/repair.hpp"

#include <algorithm>
#include <iterator>

namespace axil::keywords {

namespace {

constexpr std::size_t blockBytes = 64 * 1024;

bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

struct Block {
  std::size_t end = 0;
  bool endsParagraph = false;
};

// Up to the next empty line, but not much more than blockBytes: a longer paragraph is cut at a blank, an endless line between
// two characters.
Block blockFrom(std::string_view text, std::size_t begin) {
  // Nothing beyond this window is looked at, or an endless line would be read again for every block.
  const std::string_view window = text.substr(begin, blockBytes);
  for (std::size_t at = window.find('\n'); at != std::string_view::npos; at = window.find('\n', at + 1)) {
    const std::size_t next = window.find_first_not_of(" \t\r", at + 1);
    if (next != std::string_view::npos && window[next] == '\n') return {begin + next + 1, true};
  }
  if (begin + window.size() == text.size()) return {text.size(), true};
  const std::size_t blank = window.find_last_of(" \n");
  if (blank != std::string_view::npos && blank > window.size() / 2) return {begin + blank + 1, false};
  std::size_t length = window.size();
  while (length > 1 && isContinuation(text[begin + length])) --length;
  return {begin + length, false};
}

template <class T>
void append(std::vector<T>& to, std::vector<T>& from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

struct ReadBlock {
  ParagraphResult result;
  const Concept* organ = nullptr;
};

ReadBlock readBlock(std::string_view piece, std::uint32_t firstByte, TokenList& list, const Concept* organBefore) {
  ParagraphReader reader(piece, firstByte, list, organBefore);
  ParagraphResult result = reader.read();
  if (!reader.isUnsure() || !list.anyHan) return {std::move(result), reader.organ()};
  markWords(piece, firstByte, list);
  ParagraphReader again(piece, firstByte, list, organBefore);
  result = again.read();
  return {std::move(result), again.organ()};
}

Reading readUtf8(std::string_view text) {
  Reading reading;
  std::vector<Denial> denials;
  const Concept* organ = nullptr;
  std::size_t character = 0;
  TokenList list;
  for (std::size_t begin = 0; begin < text.size();) {
    const Block block = blockFrom(text, begin);
    const std::string_view piece = text.substr(begin, block.end - begin);
    tokenize(piece, static_cast<std::uint32_t>(begin), character, list);
    repairTokens(list);
    ReadBlock read = readBlock(piece, static_cast<std::uint32_t>(begin), list, organ);
    append(reading.traits, read.result.traits);
    append(denials, read.result.denials);
    append(reading.unknown, read.result.unknown);
    organ = block.endsParagraph ? nullptr : read.organ;
    character += countCharacters(piece);
    begin = block.end;
  }
  reading.contradictions = contradictionsIn(reading.traits, denials, text);
  return reading;
}

}  // namespace

Result<Reading> readDescription(std::string_view text) {
  const bool controls = std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 && (c < '\t' || c > '\r'); });
  const bool plain = text.size() <= descriptionLimitBytes && !controls && isUtf8(text);
  const bool saysSomething = text.find_first_not_of(" \t\r\n\f\v") != std::string_view::npos;
  if (plain && saysSomething) return readUtf8(text);
  const Result<DecodedText> decoded = decodeDescription(text);
  if (!decoded) return decoded.failure();
  return readUtf8(decoded->utf8);
}

Result<Traits> readTraits(std::string_view text) {
  Result<Reading> reading = readDescription(text);
  if (!reading) return reading.failure();
  return std::move(reading->traits);
}

}  // namespace axil::keywords
