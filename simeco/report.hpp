#pragma once
/// \file
/// Report: collects what is wrong with a text, up to a stated number, and counts the rest. Internal to the front ends.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.hpp"

namespace axil::simeco {

/// More than these are counted, not kept: a binary file named .simeco must not fill the screen.
inline constexpr std::size_t kMostDiagnostics = 100;

class Report {
 public:
  void error(SourceSpan span, std::string message, std::string hint = {});
  void warning(SourceSpan span, std::string message, std::string hint = {});
  /// Everything, in text order; a last line says how many more there are.
  [[nodiscard]] std::vector<Diagnostic> take();

 private:
  void add(Diagnostic diagnostic);
  std::vector<Diagnostic> kept_;
  std::size_t errorsLeftOut_ = 0;
  std::size_t warningsLeftOut_ = 0;
  std::size_t warnings_ = 0;
};

/// Sorted by place, at most kMostDiagnostics and one line that counts the rest.
[[nodiscard]] std::vector<Diagnostic> limited(std::vector<Diagnostic> diagnostics);

/// The known word that `word` was most likely meant to be, or an empty view.
[[nodiscard]] std::string_view nearest(std::string_view word, std::span<const std::string_view> known);
/// "did you mean 'GrowRate'?", or nothing.
[[nodiscard]] std::string didYouMean(std::string_view word, std::span<const std::string_view> known);

}  // namespace axil::simeco
