#pragma once
/// \file
/// What a turtle reads: a string, a window at a time, so that a string which is made while it is read need not stand in memory.
/// Internal to the turtle.

#include "simeco/module_string.hpp"

#include <cstdint>
#include <span>

namespace axil::simeco::turtle {

struct TurtleWindow {
  std::span<const SymbolCode> codes;
  const double* parameters = nullptr;        ///< of all its modules
  const std::uint32_t* sources = nullptr;    ///< the number of each module; null: they are counted from 0
};

class TurtleInput {
 public:
  virtual ~TurtleInput() = default;
  /// The modules behind the first `read` of the last window, which had so many parameters, and more. False, and no window, when there are no more.
  virtual bool more(std::size_t read, std::size_t parametersRead, TurtleWindow& window) = 0;
};

/// A string that stands in memory.
class WholeString : public TurtleInput {
 public:
  WholeString(std::span<const SymbolCode> codes, const double* parameters, const std::uint32_t* sources = nullptr) : whole_{codes, parameters, sources} {}
  bool more(std::size_t, std::size_t, TurtleWindow& window) override {
    if (given_) return false;
    given_ = true;
    window = whole_;
    return true;
  }

 private:
  TurtleWindow whole_;
  bool given_ = false;
};

}  // namespace axil::simeco::turtle
