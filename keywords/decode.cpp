// Bytes to text: UTF-8, UTF-16 with a mark, Big5, GB18030, and files whose lines differ.
#include "keywords/lexicon.hpp"
#include "keywords/read.hpp"
#include "keywords/vocabulary.hpp"

#include <iconv.h>

#include <algorithm>
#include <memory>
#include <set>
#include <unordered_set>

namespace axil::keywords {

namespace {

constexpr std::string_view blanks = " \t\r\n\f\v";

struct CloseIconv {
  void operator()(void* converter) const { iconv_close(converter); }
};

std::optional<std::string> converted(std::string_view bytes, const char* from) {
  const iconv_t opened = iconv_open("UTF-8", from);
  if (opened == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  const std::unique_ptr<void, CloseIconv> converter(opened);
  std::string input(bytes);
  std::string output(bytes.size() * 3 + 16, '\0');
  char* in = input.data();
  char* out = output.data();
  std::size_t inLeft = input.size();
  std::size_t outLeft = output.size();
  if (iconv(opened, &in, &inLeft, &out, &outLeft) == static_cast<std::size_t>(-1) || inLeft != 0) return std::nullopt;
  output.resize(output.size() - outLeft);
  return output;
}

// The characters that descriptions use: those of the vocabulary and the commonest ones of any text.
const std::unordered_set<std::string>& expectedCharacters() {
  static const std::unordered_set<std::string> characters = [] {
    std::unordered_set<std::string> all;
    const auto take = [&](std::string_view text) {
      for (std::size_t i = 0; i < text.size(); i += utf8Length(text[i]))
        if (utf8Length(text[i]) == 3) all.emplace(text.substr(i, 3));
    };
    for (const Category& category : vocabulary())
      for (const Concept& entry : category.concepts)
        for (const std::vector<Term>* terms : {&entry.traditional, &entry.simplified})
          for (const Term& term : *terms) take(term.words);
    take("的一是不了在有和之與与為为及或於于約约可達达，。、；：（）～至高長长寬宽公分厘米毫釐尺葉叶花果對对枚片");
    return all;
  }();
  return characters;
}

// How many of its characters are expected ones, 0 to 1.
double plausibility(std::string_view text) {
  double expected = 0;
  double all = 0;
  for (std::size_t i = 0; i < text.size() && all < 20000; i += utf8Length(text[i])) {
    if (utf8Length(text[i]) == 1) continue;
    ++all;
    if (expectedCharacters().contains(std::string(text.substr(i, utf8Length(text[i]))))) ++expected;
  }
  return all == 0 ? 1 : expected / all;
}

// Big5 or GB18030, whichever reads more like a description. Both map most byte pairs to some character.
std::optional<DecodedText> chineseText(std::string_view bytes) {
  std::optional<std::string> big5 = converted(bytes, "BIG5-HKSCS");
  std::optional<std::string> gb = converted(bytes, "GB18030");
  if (big5 && (!gb || plausibility(*big5) >= plausibility(*gb))) return DecodedText{std::move(*big5), "Big5"};
  if (gb) return DecodedText{std::move(*gb), "GB18030"};
  return std::nullopt;
}

// Line by line, for files put together from several.
std::optional<DecodedText> mixedText(std::string_view bytes) {
  DecodedText text;
  std::set<std::string> encodings;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t newline = bytes.find('\n', begin);
    const std::size_t end = newline == std::string_view::npos ? bytes.size() : newline + 1;
    const std::string_view line = bytes.substr(begin, end - begin);
    begin = end;
    if (isUtf8(line)) {
      text.utf8 += line;
      if (std::any_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; })) encodings.insert("UTF-8");
      continue;
    }
    std::optional<DecodedText> decoded = chineseText(line);
    if (!decoded) return std::nullopt;
    text.utf8 += decoded->utf8;
    encodings.insert(decoded->encoding);
  }
  for (const std::string& name : encodings) text.encoding += (text.encoding.empty() ? "" : " and ") + name;
  return text;
}

bool looksLikeText(std::string_view utf8) {
  std::size_t controls = 0;
  for (const char c : utf8) controls += (static_cast<unsigned char>(c) < 0x20 && blanks.find(c) == std::string_view::npos) || c == 0x7F;
  return controls * 100 <= utf8.size();
}

// A file that was cut off inside a character: what stands before that, where it is UTF-8 and more than plain ASCII.
std::optional<std::string_view> beforeBrokenEnd(std::string_view bytes) {
  constexpr std::size_t longestPiece = 3;
  for (std::size_t cut = 1; cut <= longestPiece && cut < bytes.size(); ++cut) {
    const std::string_view kept = bytes.substr(0, bytes.size() - cut);
    if (isUtf8(kept) && std::any_of(kept.begin(), kept.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; })) return kept;
  }
  return std::nullopt;
}

std::optional<DecodedText> decoded(std::string_view bytes) {
  if (isUtf8(bytes) || bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) return decodeText(bytes);
  if (bytes.find('\0') != std::string_view::npos) return std::nullopt;
  if (const auto kept = beforeBrokenEnd(bytes)) return DecodedText{std::string(*kept), "UTF-8"};
  // One encoding for the whole file reads best; lines are looked at alone where some of them are UTF-8 already.
  bool someUtf8 = false;
  for (std::size_t begin = 0; begin < bytes.size() && !someUtf8;) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string_view line = bytes.substr(begin, end - begin);
    someUtf8 = isUtf8(line) && std::any_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
    begin = end + 1;
  }
  if (std::optional<DecodedText> mixed = mixedText(bytes); mixed && (someUtf8 || mixed->encoding.find(" and ") != std::string::npos)) return mixed;
  return chineseText(bytes);
}

}  // namespace

Result<DecodedText> decodeDescription(std::string_view bytes) {
  if (bytes.size() > descriptionLimitBytes)
    return fail(ErrorCode::LimitReached, "the description has " + std::to_string(bytes.size() / 1'000'000) + " MB; the limit is " + std::to_string(descriptionLimitBytes / 1'000'000) + " MB, so cut it into parts, for example with `split -C 10M`");
  std::optional<DecodedText> text = decoded(bytes);
  if (!text || text->utf8.find('\0') != std::string::npos || !looksLikeText(text->utf8))
    return fail(ErrorCode::BadInput, "the description is no text; it must be UTF-8, UTF-16 with a byte-order mark, Big5 or GB18030");
  if (text->utf8.find_first_not_of(blanks) == std::string::npos)
    return fail(ErrorCode::BadInput, "the description is empty; write what the plant looks like, for example \"Leaves opposite, ovate, 3-8 cm long.\"");
  return std::move(*text);
}

}  // namespace axil::keywords
