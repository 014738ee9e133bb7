#include "emit/structured.hpp"

#include "base/text.hpp"
#include "emit/exact.hpp"
#include "emit/statistical.hpp"

#include <cmath>

namespace axil::emit {

Result<simeco::Grammar> structuredGrammar(const quantify::Measurements& measurements, const EmitOptions& options, const StructureOptions& structure) {
  if (structure.orders && *structure.orders < 1) return fail(ErrorCode::BadInput, std::to_string(*structure.orders) + " branching orders are not possible; keep at least 1");
  if (!(structure.maximumError > 0 && structure.maximumError <= 0.5) || !(structure.detail > 0 && std::isfinite(structure.detail)))
    return fail(ErrorCode::BadInput, "an error of " + shortest(structure.maximumError) + " of the height or a detail of " + shortest(structure.detail) +
                                         " is not possible; give an error above 0 up to 0.5 and a detail above 0");
  if (structure.form == StructuredForm::Statistical) return statisticalGrammar(measurements, options, structure);
  if (!structure.also.empty()) return fail(ErrorCode::BadInput, "an exact form is of one plant; leave the further plants out, or ask for the statistical form");
  return exactGrammar(measurements, options, structure);
}

}  // namespace axil::emit
