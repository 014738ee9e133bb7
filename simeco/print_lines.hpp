#pragma once
/// \file
/// The layers of the SimEco printer, first: lines, comments, quoted texts, blocks. Private to print.cpp.

#include "simeco/grammar.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco::printing {

inline constexpr std::string_view kIndent = "    ";

/// Block comments, and at most one line comment after them.
inline bool isComment(std::string_view text) {
  while (!text.empty()) {
    if (text.starts_with("//")) return text.find('\n') == std::string_view::npos;
    const std::size_t end = text.starts_with("/*") ? text.find("*/", 2) : std::string_view::npos;
    if (end == std::string_view::npos) return false;
    text.remove_prefix(end + 2);
    while (text.starts_with(' ')) text.remove_prefix(1);
  }
  return true;
}

class LinePrinter {
 public:
  explicit LinePrinter(const Grammar& grammar) : grammar_(grammar) {}

 protected:
  // ---- lines and comments ----

  void indent() {
    for (int i = 0; i < depth_; ++i) out_ += kIndent;
  }
  /// A comment as it can stand in a text: one that lacks its // gets it, line by line.
  void comment(std::string_view text) {
    if (isComment(text)) {
      out_ += text;
      return;
    }
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string_view line = text.substr(begin, end - begin);
      if (begin > 0) {
        out_ += '\n';
        indent();
      }
      if (!line.starts_with("//")) out_ += line.empty() ? "//" : "// ";
      out_ += line;
      begin = end + 1;
    }
  }
  void lines(const std::vector<std::string>& comments) {
    for (const std::string& line : comments) {
      if (!line.empty()) {
        indent();
        comment(line);
      }
      out_ += '\n';
    }
  }
  void endLine(const std::string& rest) {
    if (!rest.empty()) {
      out_ += ' ';
      comment(rest);
    }
    out_ += '\n';
  }
  void open(const Comments& comments) {
    out_ += " {";
    endLine(comments.opening);
    ++depth_;
  }
  void close(const Comments& comments) {
    lines(comments.inside);
    --depth_;
    indent();
    out_ += '}';
    endLine(comments.trailing);
  }
  // The thesis writes an empty block as {}.
  void closeEmpty(const Comments& comments) {
    out_ += " {}";
    endLine(comments.trailing);
  }
  static bool isBare(const Comments& comments) { return comments.opening.empty() && comments.inside.empty(); }

  void quoted(std::string_view words) {
    out_ += '"';
    for (const char c : words) {
      if (c == '"') out_ += '"';
      out_ += c == '\n' || c == '\r' ? ' ' : c;  // a text is one line; check names such a text
    }
    out_ += '"';
  }

  const Grammar& grammar_;
  std::string out_;
  int depth_ = 0;
};

}  // namespace axil::simeco::printing
