#pragma once
/// \file
/// Where a part of the string begins and ends: who stands beside its first and last module, outside. Private to the plain way.

#include "simeco/engine_plan.hpp"

#include <span>

namespace axil::simeco {

/// Who stands to the left of a part's first module, found by walking from there, further with every bracket that closes.
class LeftFringe {
 public:
  LeftFringe(const Plans& plans, std::span<const SymbolCode> codes, std::size_t begin) : plans_(plans), codes_(codes), at_(begin) {}

  /// The nearest considered module of this level or of those that carry it.
  SymbolCode nearest() {
    std::size_t depth = 0;
    for (std::size_t i = at_; i-- > 0;) {
      const std::uint8_t role = plans_.hot[codes_[i]].role;
      if (role == Plans::Closes) ++depth;
      if (role == Plans::Opens && depth > 0) --depth;
      if (role == Plans::Considered && depth == 0) return codes_[i];
    }
    return nobody();
  }
  /// Leaves the branch: to before the bracket that opened it.
  void leave() {
    std::size_t depth = 0;
    while (at_ > 0) {
      const std::uint8_t role = plans_.hot[codes_[--at_]].role;
      if (role == Plans::Closes) ++depth;
      if (role == Plans::Opens && depth-- == 0) return;
    }
  }
  [[nodiscard]] SymbolCode nobody() const { return static_cast<SymbolCode>(plans_.codes); }

 private:
  const Plans& plans_;
  std::span<const SymbolCode> codes_;
  std::size_t at_;
};

/// Who stands to the right of a part's last module.
class RightFringe {
 public:
  RightFringe(const Plans& plans, std::span<const SymbolCode> codes, std::size_t end) : plans_(plans), codes_(codes), at_(end) {}

  SymbolCode nearest() const {
    std::size_t depth = 0;
    for (std::size_t i = at_; i < codes_.size(); ++i) {
      const std::uint8_t role = plans_.hot[codes_[i]].role;
      if (role == Plans::Opens) ++depth;
      if (role == Plans::Closes && depth-- == 0) break;
      if (role == Plans::Considered && depth == 0) return codes_[i];
    }
    return nobody();
  }
  void leave() {
    std::size_t depth = 0;
    while (at_ < codes_.size()) {
      const std::uint8_t role = plans_.hot[codes_[at_++]].role;
      if (role == Plans::Opens) ++depth;
      if (role == Plans::Closes && depth-- == 0) return;
    }
  }
  [[nodiscard]] SymbolCode nobody() const { return static_cast<SymbolCode>(plans_.codes); }

 private:
  const Plans& plans_;
  std::span<const SymbolCode> codes_;
  std::size_t at_;
};

}  // namespace axil::simeco
