#pragma once
/// \file
/// The predictive grammar as the thesis builds it: the initial grammar, and one stage more. Private to this room; predictive.hpp is its door.
///
/// Rules of the initial grammar with the same structure (as many branches and leaves, a main child or none) make one template;
/// the ranges of their numbers become the ranges of its random values. Every tip ends in a counter and a marker,
/// `S(1002) S(5003)`; `S(i) -> S(i+1, 1001 < i < 1006)` lets the counter run; once it has run out, `S(1006) > S(5003) -> A(1003)` turns
/// it into an apex that expands by its template. A tip takes the template of the rule that it came from itself.
///
/// A counter's start says how late its tip appears, so that all run out in the same step, after the last measured organ: until
/// then the plant is exactly the initial plant. It predicts one stage and ends. Source: L-Grammar Generator 2005, section 3.4.2.

#include "emit/initial.hpp"

namespace axil::emit {

[[nodiscard]] Result<simeco::Grammar> thesisGrammar(const quantify::Measurements& measurements, const EmitOptions& options);

}  // namespace axil::emit
