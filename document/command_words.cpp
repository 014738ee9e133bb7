#include "document/command_words.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace axil::document {

namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool endsWord(char c) { return isBlank(c) || c == ';'; }

bool isPlain(char c) { return static_cast<unsigned char>(c) > 0x20 && c != 0x7f && c != '"' && c != '\\' && c != ';' && c != '='; }

constexpr std::pair<char, char> kEscapes[] = {{'n', '\n'}, {'t', '\t'}, {'r', '\r'}, {'"', '"'}, {'\\', '\\'}};

std::string escaped(char c) {
  for (const auto& [letter, meant] : kEscapes)
    if (c == meant) return {'\\', letter};
  if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) return {c};
  constexpr const char* digits = "0123456789abcdef";
  return {'\\', 'x', digits[static_cast<unsigned char>(c) >> 4], digits[static_cast<unsigned char>(c) & 15]};
}

/// Walks once over a line.
class Cutter {
 public:
  explicit Cutter(std::string_view line) : line_(line) {}

  Result<std::vector<std::vector<Word>>> cut() {
    std::vector<std::vector<Word>> commands(1);
    while (skipBlanks(), at_ < line_.size()) {
      if (line_[at_] == ';') {
        ++at_;
        commands.emplace_back();
        continue;
      }
      auto word = nextWord();
      if (!word) return word.failure();
      commands.back().push_back(std::move(*word));
    }
    return commands;
  }

 private:
  void skipBlanks() {
    while (at_ < line_.size() && isBlank(line_[at_])) ++at_;
  }

  Result<Word> nextWord() {
    Word word;
    bool keyed = false;
    while (at_ < line_.size() && !endsWord(line_[at_])) {
      const char c = line_[at_];
      if (c == '"') {
        const auto text = quotedText();
        if (!text) return text.failure();
        word.text += *text;
      } else if (c == '=' && !keyed) {
        word.key = std::exchange(word.text, {});
        keyed = true;
        ++at_;
      } else {
        word.text += c;
        ++at_;
      }
    }
    return word;
  }

  Result<std::string> quotedText() {
    const std::size_t begin = at_++;
    std::string text;
    while (at_ < line_.size() && line_[at_] != '"') {
      if (line_[at_] != '\\') {
        text += line_[at_++];
        continue;
      }
      const auto c = escape();
      if (!c) return c.failure();
      text += *c;
    }
    if (at_ >= line_.size()) return fail(ErrorCode::BadInput, "the text that begins at byte " + std::to_string(begin + 1) + " has no closing quote");
    ++at_;
    return text;
  }

  Result<char> escape() {
    const char letter = at_ + 1 < line_.size() ? line_[at_ + 1] : '\0';
    for (const auto& [known, meant] : kEscapes)
      if (letter == known) {
        at_ += 2;
        return meant;
      }
    unsigned value = 0;
    const char* digits = line_.data() + std::min(at_ + 2, line_.size());
    const char* end = line_.data() + std::min(at_ + 4, line_.size());
    if (letter == 'x' && end - digits == 2 && std::from_chars(digits, end, value, 16).ptr == end) {
      at_ += 4;
      return static_cast<char>(value);
    }
    return fail(ErrorCode::BadInput, "the backslash at byte " + std::to_string(at_ + 1) + " begins no known escape; there are \\\" \\\\ \\n \\t \\r and \\xNN");
  }

  std::string_view line_;
  std::size_t at_ = 0;
};

}  // namespace

Result<std::vector<std::vector<Word>>> cutLine(std::string_view line) { return Cutter(line).cut(); }

std::string asWord(std::string_view text) {
  if (!text.empty() && text.front() != '#' && std::all_of(text.begin(), text.end(), isPlain)) return std::string(text);
  std::string word = "\"";
  for (const char c : text) word += escaped(c);
  return word + "\"";
}

std::string didYouMean(std::string_view given, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t least = given.size() / 3 + 2;  // further away it is another word
  for (const std::string& name : known) {
    const std::size_t distance = editDistance(given, name);
    if (distance < least) least = distance, nearest = name;
  }
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace axil::document
