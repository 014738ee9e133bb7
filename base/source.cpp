#include "base/source.hpp"

#include "base/text.hpp"

#include <algorithm>

namespace axil {

namespace {

std::size_t lineStart(std::string_view text, std::size_t offset) {
  const std::size_t newline = offset == 0 ? std::string_view::npos : text.rfind('\n', offset - 1);
  return newline == std::string_view::npos ? 0 : newline + 1;
}

std::string_view lineAt(std::string_view text, std::size_t start) {
  std::string_view line = text.substr(start, text.find('\n', start) - start);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::uint32_t codePointAt(std::string_view text, std::size_t at, std::size_t length) {
  const auto first = static_cast<unsigned char>(text[at]);
  std::uint32_t code = length == 1 ? first : first & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length && at + i < text.size(); ++i) code = (code << 6u) | (static_cast<unsigned char>(text[at + i]) & 0x3fu);
  return code;
}

/// Whether a terminal gives a character two cells: the East Asian wide and full-width blocks, and pictures.
bool isWide(std::uint32_t code) {
  static constexpr struct {
    std::uint32_t first, last;
  } kBlocks[] = {{0x1100, 0x115f}, {0x2e80, 0x303e}, {0x3041, 0x33ff}, {0x3400, 0x4dbf}, {0x4e00, 0x9fff}, {0xa000, 0xa4cf}, {0xac00, 0xd7a3},
                 {0xf900, 0xfaff}, {0xfe30, 0xfe4f}, {0xff00, 0xff60}, {0xffe0, 0xffe6}, {0x1f300, 0x1faff}, {0x20000, 0x3fffd}};
  return std::any_of(std::begin(kBlocks), std::end(kBlocks), [&](const auto& block) { return block.first <= code && code <= block.last; });
}

// East Asian wide characters take two cells of a terminal; the caret line must too.
std::string blankLike(std::string_view text) {
  std::string blank;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8Length(text[i]);
    blank += text[i] == '\t' ? "\t" : isWide(codePointAt(text, i, length)) ? "  " : " ";
    i += length;
  }
  return blank;
}

/// The last place up to `at` where a character begins.
std::size_t characterAt(std::string_view text, std::size_t at) {
  while (at > 0 && at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u) --at;
  return std::min(at, text.size());
}

/// What is shown of the line around a span: all of it, or so much that a terminal can hold it.
struct Excerpt {
  std::size_t begin = 0, end = 0;
};
Excerpt excerptOf(std::string_view line, std::size_t at) {
  constexpr std::size_t before = 100, after = 140;  // bytes
  return {at > before ? characterAt(line, at - before) : 0, line.size() - at > after ? characterAt(line, at + after) : line.size()};
}

}  // namespace

SourcePlace placeOf(std::string_view text, std::uint32_t offset) {
  const std::size_t at = std::min<std::size_t>(offset, text.size());
  const std::size_t start = lineStart(text, at);
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(start), '\n') + 1;
  return {static_cast<int>(line), static_cast<int>(countCharacters(text.substr(start, at - start))) + 1};
}

bool hasErrors(const std::vector<Diagnostic>& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

std::string formatDiagnostic(const Diagnostic& diagnostic, std::string_view text, std::string_view fileName) {
  const SourcePlace place = placeOf(text, diagnostic.span.begin);
  std::string line(fileName);
  line += ':' + std::to_string(place.line) + ':' + std::to_string(place.column);
  line += diagnostic.severity == Severity::Error ? ": error: " : ": warning: ";
  line += diagnostic.message;
  if (!diagnostic.hint.empty()) line += " (" + diagnostic.hint + ")";
  return line;
}

std::string formatWithCaret(const Diagnostic& diagnostic, std::string_view text, std::string_view fileName) {
  const std::size_t begin = std::min<std::size_t>(diagnostic.span.begin, text.size());
  const std::size_t start = lineStart(text, begin);
  const std::string_view line = lineAt(text, start);
  const std::size_t from = std::min(begin - start, line.size());
  const std::size_t to = std::clamp<std::size_t>(diagnostic.span.end > begin ? diagnostic.span.end - start : from, from, line.size());
  const Excerpt shown = excerptOf(line, from);
  const std::string left = shown.begin > 0 ? "..." : "", right = shown.end < line.size() ? "..." : "";
  const std::size_t width = std::max<std::size_t>(1, blankLike(line.substr(from, std::min(to, shown.end) - from)).size());
  return formatDiagnostic(diagnostic, text, fileName) + "\n  " + left + std::string(line.substr(shown.begin, shown.end - shown.begin)) + right + "\n  " +
         blankLike(left) + blankLike(line.substr(shown.begin, from - shown.begin)) + std::string(width, '^');
}

}  // namespace axil
