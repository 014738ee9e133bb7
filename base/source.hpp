#pragma once
/// \file
/// Places in a text, and what is wrong there. A Diagnostic is for the author of a text (a grammar, a description): all of
/// them are collected and shown at once. Lines and columns count from 1; columns count characters (code points), not bytes.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axil {

/// Bytes [begin, end) of a text.
struct SourceSpan {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  friend bool operator==(const SourceSpan&, const SourceSpan&) = default;
};

struct SourcePlace {
  int line = 1;
  int column = 1;
  friend bool operator==(const SourcePlace&, const SourcePlace&) = default;
};

/// Where byte `offset` of `text` stands.
[[nodiscard]] SourcePlace placeOf(std::string_view text, std::uint32_t offset);

enum class Severity { Error, Warning };

struct Diagnostic {
  Severity severity = Severity::Error;
  SourceSpan span;
  std::string message;
  std::string hint = {};  ///< what to do about it; may be empty
  friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

[[nodiscard]] bool hasErrors(const std::vector<Diagnostic>& diagnostics);

/// `FILE:LINE:COL: error: message (hint)`: one line.
[[nodiscard]] std::string formatDiagnostic(const Diagnostic& diagnostic, std::string_view text, std::string_view fileName);
/// The same, followed by the source line and a caret line under the span; of a long line only what is near the span.
[[nodiscard]] std::string formatWithCaret(const Diagnostic& diagnostic, std::string_view text, std::string_view fileName);

}  // namespace axil
