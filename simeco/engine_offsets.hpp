#pragma once
/// \file
/// Offsets: where the parameters of any module of a string start, in a quarter of a byte a module: every sixteenth module's offset is
/// kept, the others are counted from there. Private to the engine.

#include "simeco/program.hpp"

#include <cstdint>
#include <span>

namespace axil::simeco {

class Offsets {
 public:
  /// Reads the whole string, which must stay as it is for as long as it is asked about (modules may become others with as many parameters).
  void read(const Program& program, std::span<const SymbolCode> codes) {
    program_ = &program;
    codes_ = codes;
    kept_.setSize(codes.size() / kEvery + 1);
    std::uint32_t offset = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      if (i % kEvery == 0) kept_[i / kEvery] = offset;
      offset += program.parameterCount[codes[i]];
    }
  }
  [[nodiscard]] std::uint32_t of(std::size_t module) const {
    const std::size_t from = module / kEvery;
    std::uint32_t offset = kept_[from];
    for (std::size_t i = from * kEvery; i < module; ++i) offset += program_->parameterCount[codes_[i]];
    return offset;
  }
  [[nodiscard]] std::size_t bytes() const { return kept_.bytes(); }

 private:
  static constexpr std::size_t kEvery = 16;
  const Program* program_ = nullptr;
  std::span<const SymbolCode> codes_;
  Buffer<std::uint32_t> kept_;
};

}  // namespace axil::simeco
