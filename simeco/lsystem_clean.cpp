#include "simeco/lsystem_clean.hpp"

#include "simeco/lsystem_scan.hpp"

namespace axil::simeco::preprocess {

namespace {

constexpr std::string_view kArrow = "\u2192";
static_assert(kArrow.size() == 3);

class Cleaner {
 public:
  explicit Cleaner(std::string_view text) : text_(text) { clean_.text.reserve(text.size()); }

  Clean run() {
    clean_.moves.emplace_back(0, 0);
    while (at_ < text_.size()) step();
    return std::move(clean_);
  }

 private:
  void step() {
    const char c = text_[at_];
    const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    if (c == '\r' && (next == '\n' || at_ + 1 == text_.size())) return skip(1);
    if (c == '\\' && (next == '\n' || (next == '\r' && at_ + 2 < text_.size() && text_[at_ + 2] == '\n'))) return skip(next == '\n' ? 2 : 3);
    if (c == '/' && next == '*') return comment(text_.find("*/", at_ + 2), 2);
    if (c == '/' && next == '/') return comment(std::min(text_.find('\n', at_), text_.size()), 0);
    if (c == '"') {
      if (const auto end = quotedEnd(text_, at_)) return copy(*end - at_);
    }
    if (text_.substr(at_).starts_with(kArrow)) return arrow();
    if (c == '\n') ownLine_ = true;
    else if (!isBlank(c)) ownLine_ = false;
    copy(1);
  }

  /// RTIL's arrow is as many bytes as ours, so places stay.
  void arrow() {
    clean_.text += "-->";
    at_ += kArrow.size();
    ownLine_ = false;
  }

  void copy(std::size_t count) {
    clean_.text.append(text_.substr(at_, count));
    at_ += count;
  }

  void skip(std::size_t count) {
    at_ += count;
    clean_.moves.emplace_back(clean_.text.size(), at_);
  }

  void comment(std::size_t end, std::size_t closing) {
    const std::size_t begin = at_;
    if (end == std::string_view::npos) {
      clean_.openComment = spanOf(begin, begin + 2);
      end = text_.size();
      closing = 0;
    }
    std::string words(text_.substr(begin, end + closing - begin));
    std::erase(words, '\r');
    if (closing == 0)
      while (words.ends_with(' ') || words.ends_with('\t')) words.pop_back();
    clean_.comments.push_back({clean_.text.size(), std::move(words), ownLine_});
    if (closing != 0) clean_.text.push_back(' ');
    at_ = end + closing;
    clean_.moves.emplace_back(clean_.text.size(), at_);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool ownLine_ = true;
  Clean clean_;
};

}  // namespace

std::size_t Clean::originOf(std::size_t at) const {
  auto after = std::upper_bound(moves.begin(), moves.end(), std::pair{at, static_cast<std::size_t>(-1)});
  if (after == moves.begin()) return at;
  --after;
  return at - after->first + after->second;
}

Clean cleaned(std::string_view text) { return Cleaner(text).run(); }

}  // namespace axil::simeco::preprocess
