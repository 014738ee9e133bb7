#include "simeco/program_rules.hpp"

namespace axil::simeco {

namespace {

Failure refused(const std::vector<std::string>& errors) {
  const std::string more = errors.size() > 1 ? " (and " + std::to_string(errors.size() - 1) + " more)" : "";
  return fail(Error{ErrorCode::BadGrammar, "the grammar cannot be run: " + errors.front() + more, errors});
}

}  // namespace

std::vector<FunctionRow> functionsOf(Language language) {
  std::vector<FunctionRow> rows(std::begin(kBoth), std::end(kBoth));
  if (language == Language::SimEco)
    rows.insert(rows.end(), std::begin(kSimeco), std::end(kSimeco));
  else
    rows.insert(rows.end(), std::begin(kClassic), std::end(kClassic));
  return rows;
}

Result<std::shared_ptr<const Program>> compile(const Grammar& grammar, std::size_t plant, const CompileOptions& options) {
  if (plant >= grammar.plants.size())
    return fail(ErrorCode::NotFound, "the grammar has " + std::to_string(grammar.plants.size()) + " plants; there is no plant number " +
                                         std::to_string(plant + 1));
  Compiler compiler(grammar, options);
  compiler.plant(plant);
  if (!compiler.errors().empty()) return refused(compiler.errors());
  return compiler.take();
}

Result<CompiledExpression> compileExpression(const Grammar& grammar, ExprId id, const std::vector<std::string>& locals, const CompileOptions& options) {
  // Most of a measured plant's thousand attributes are plain numbers.
  if (const auto* number = std::get_if<Number>(&grammar.at(id).node)) return CompiledExpression{nullptr, {.value = number->value}};
  Compiler compiler(grammar, options);
  const Term term = compiler.single(id, locals);
  if (!compiler.errors().empty()) return refused(compiler.errors());
  if (term.kind == Term::Kind::Constant) return CompiledExpression{nullptr, term};
  return CompiledExpression{compiler.take(), term};
}

}  // namespace axil::simeco
