#pragma once
/// \file
/// Robust and combined estimates of plain numbers. Private to this room; layers.hpp says what they are for.

#include "quantify/layers.hpp"

#include <span>
#include <vector>

namespace axil::quantify {

/// Huber's M-estimate of the centre and the standard deviation around it. Zero spread gives the value itself.
struct Centre {
  double value = 0;
  double deviation = 0;
};
[[nodiscard]] Centre centreOf(std::span<const double> values);

[[nodiscard]] double medianOf(std::vector<double> values);
/// The value below which `share` of them lie, between neighbours in proportion. `values` must not be empty.
[[nodiscard]] double quantileOf(std::vector<double> values, double share);

/// The random-effects mean of several measured values with their variances. `between`: how much they differ beyond those, as a deviation.
struct Combined {
  double value = 0;
  double error = 0;
  double between = 0;
};
[[nodiscard]] Combined combined(std::span<const double> values, std::span<const double> variances);

/// How much groups differ beyond what their members do, as a deviation: the component of variance between them (one way, groups of unlike size); 0 where it is no more than chance.
[[nodiscard]] double betweenGroups(std::span<const std::vector<double>> groups);

/// An estimate of samples of several plants. A share counts as binomial.
enum class SampleKind { Plain, Share };
[[nodiscard]] Estimate estimateOf(std::span<const Sample> samples, SampleKind kind);

/// Draws sisters towards what their parent layer expects of each (`expected`), by empirical Bayes. A share is as unsure as its samples would be if the parent were right: none of
/// three is no certainty; and of more than a hundred samples it is drawn the less the more there are.
void pool(std::vector<Estimate*>& sisters, std::span<const double> expected, SampleKind kind);

/// The trend of samples that stand on axes: entries of `axisOf` are alike where samples share an axis.
[[nodiscard]] Trend trendOf(std::span<const Sample> samples, std::span<const std::size_t> axisOf, bool logarithmic);

}  // namespace axil::quantify
