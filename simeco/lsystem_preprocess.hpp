#pragma once
/// \file
/// The C-like preprocessor of `.l` files: comments and line joins go, `#define #undef #include #if #ifdef #ifndef #elif #else
/// #endif` are obeyed, macros are replaced token by token, and every byte of the result still knows where it was written.
/// A line that starts with a tab is joined to the line before.

#include "simeco/lsystem_language.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axil::simeco {

/// A comment as it stood, and the byte of the processed text that it stood before.
struct PlacedComment {
  std::size_t at = 0;
  std::string text;
  bool ownLine = true;  ///< nothing but blanks stands before it on its line
};

/// The text after preprocessing, with the way back to the text as written.
class Preprocessed {
 public:
  std::string text;
  std::vector<PlacedComment> comments;
  std::vector<Diagnostic> diagnostics;
  bool cutShort = false;   ///< a comment or an #if that is never closed may have taken what stood behind

  /// A diagnostic about bytes [begin, end) of `text`, placed in the file as written.
  [[nodiscard]] Diagnostic diagnostic(Severity severity, std::size_t begin, std::size_t end, std::string message, std::string hint) const;
  /// Where bytes [begin, end) of `text` were written.
  [[nodiscard]] SourceSpan originOf(std::size_t begin, std::size_t end) const;

 private:
  friend class Preprocessor;
  struct Piece {
    std::size_t at = 0;      ///< first byte in `text`
    SourceSpan origin;       ///< in its file; of a verbatim piece only `begin` counts
    bool verbatim = true;    ///< false: all of it was made at `origin` by a macro
    std::int32_t file = 0;
  };
  struct File {
    std::string name;        ///< empty: the text itself
    std::string text;        ///< only of included files, for line numbers
    SourceSpan includedAt;   ///< the `#include` of the outermost file
  };
  [[nodiscard]] const Piece& pieceAt(std::size_t offset) const;
  /// What a macro made of its use, for messages.
  [[nodiscard]] std::string madeBy(const Piece& piece) const;
  std::vector<Piece> pieces_;
  std::vector<File> files_;
};

[[nodiscard]] Preprocessed preprocessLSystem(std::string_view text, const LSystemOptions& options);

}  // namespace axil::simeco
