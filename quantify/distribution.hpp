#pragma once
/// \file
/// Distributions of measured numbers, as few numbers as the samples allow: a constant, normal, even, or else a table of measured quantiles; the
/// simplest that the samples do not contradict (Kolmogorov's distance with Lilliefors' 1 % bound; fewer than eight samples contradict nothing), of two that fit the nearer.
/// Source: Lilliefors 1967.

#include <cstddef>
#include <vector>

namespace axil::quantify {

struct Distribution {
  enum class Form { Constant, Normal, Even, Table } form = Form::Constant;
  double centre = 0;            ///< mean; of Even the middle
  double spread = 0;            ///< standard deviation; of Even half the width
  std::vector<double> values;   ///< of Table: equally likely, ascending
  std::size_t samples = 0;
};

/// Of numbers that can't be negative, where none of them is: then a normal distribution must keep clear of 0.
[[nodiscard]] Distribution distributionOf(std::vector<double> values);
/// Like it, of whole numbers: a number or a table.
[[nodiscard]] Distribution countsOf(std::vector<double> values);

struct Moments {
  double mean = 0;
  double deviation = 0;
};
[[nodiscard]] Moments momentsOf(const std::vector<double>& values);

}  // namespace axil::quantify
