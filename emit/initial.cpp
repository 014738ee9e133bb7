#include "emit/initial.hpp"

#include "emit/assembly.hpp"
#include "emit/plan.hpp"

#include <utility>

namespace axil::emit {

Result<simeco::Grammar> initialGrammar(const quantify::Measurements& measurements, const EmitOptions& options) {
  const Result<Plan> plan = planOf(measurements, options);
  if (!plan) return plan.failure();
  return std::move(assembled(*plan, options).grammar);
}

}  // namespace axil::emit
