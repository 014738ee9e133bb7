// The classic L-system front end, the engine behind it and the turtle against any bytes: nothing may crash, every diagnostic must
// stand in the text, what parses must print as a text that says the same, and a derivation ends within its limits.
#include "simeco/lsystem_plant.hpp"
#include "simeco/lsystem_language.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace {

using namespace axil::simeco;

void checkDiagnostics(const std::vector<axil::Diagnostic>& diagnostics, std::string_view text) {
  for (const axil::Diagnostic& d : diagnostics)
    AXIL_ASSERT(d.span.begin <= d.span.end && d.span.end <= text.size(), "a diagnostic stands outside the text");
}

void checkPrinting(const Grammar& grammar) {
  const std::string once = print(grammar);
  const Parsed again = parseLSystem(once);
  AXIL_ASSERT(again.ok(), "a printed grammar has errors");
  AXIL_ASSERT(again.grammar == grammar, "a printed grammar reads back as another one");
  AXIL_ASSERT(print(again.grammar) == once, "printing is not stable");
}

/// By one turtle and by three.
void checkDrawing(const Grammar& grammar, LSystemPlantOptions options) {
  const auto one = plantOfLSystem(grammar, options);
  if (!one) return AXIL_ASSERT(!one.error().message.empty(), "a failure says why");
  options.derive.derive.threads = 3;
  options.modulesPerThread = 1;
  const auto three = plantOfLSystem(grammar, options);
  if (!three) return;  // the time was over
  AXIL_ASSERT(one->organs.size() == three->organs.size() && one->faces.size() == three->faces.size() && one->styles == three->styles, "more turtles draw something else");
  for (std::size_t i = 0; i < one->organs.size(); ++i)
    AXIL_ASSERT(one->organs[i].module == three->organs[i].module && one->organs[i].parent == three->organs[i].parent && one->organs[i].style == three->organs[i].style,
                "more turtles draw other organs");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  LSystemOptions options;
  options.macroTextLimit = 1 << 16;
  const Parsed parsed = parseLSystem(text, options);
  checkDiagnostics(parsed.diagnostics, text);
  if (!parsed.ok()) return 0;
  const auto found = checkLSystem(parsed.grammar);
  checkDiagnostics(found, text);
  checkPrinting(parsed.grammar);
  if (axil::hasErrors(found)) return 0;
  LSystemPlantOptions grown;
  grown.derive.derive.threads = 1;
  grown.derive.derive.limits = {.modules = 20'000, .bytes = 1 << 24, .steps = 50, .loopIterations = 10'000, .seconds = 1};
  checkDrawing(parsed.grammar, grown);
  return 0;
}
