#pragma once
/// \file
/// The first stage of the preprocessor: comments, joined lines and carriage returns go, every byte keeps its place. Internal.

#include "simeco/lsystem_preprocess.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axil::simeco::preprocess {

/// A text without comments, joined lines and carriage returns, and where its bytes came from.
struct Clean {
  std::string text;
  std::vector<std::pair<std::size_t, std::size_t>> moves;  ///< from byte `first` on, byte b came from b - first + second
  std::vector<PlacedComment> comments;
  std::optional<SourceSpan> openComment;

  /// Where byte `at` of `text` was written.
  [[nodiscard]] std::size_t originOf(std::size_t at) const;
};

[[nodiscard]] Clean cleaned(std::string_view text);

}  // namespace axil::simeco::preprocess
