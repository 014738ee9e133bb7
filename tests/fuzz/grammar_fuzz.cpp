// The SimEco front end against any bytes: nothing may crash, every diagnostic must stand in the text, and what parses without
// an error must print as a text that says the same.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/text.hpp"
#include "simeco/language.hpp"

namespace {

void checkDiagnostics(const std::vector<axil::Diagnostic>& diagnostics, std::string_view text) {
  for (const axil::Diagnostic& d : diagnostics)
    AXIL_ASSERT(d.span.begin <= d.span.end && d.span.end <= text.size(), "a diagnostic stands outside the text");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace axil::simeco;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto decoded = axil::decodeText(bytes);
  if (!decoded) return 0;
  const std::string_view text = decoded->utf8;
  const Parsed parsed = parseSimeco(text);
  checkDiagnostics(parsed.diagnostics, text);
  checkDiagnostics(check(parsed.grammar), text);
  if (!parsed.ok()) return 0;
  const std::string once = print(parsed.grammar);
  const Parsed again = parseSimeco(once);
  AXIL_ASSERT(again.ok(), "a printed grammar has errors");
  AXIL_ASSERT(again.grammar == parsed.grammar, "a printed grammar reads back as another one");
  AXIL_ASSERT(print(again.grammar) == once, "printing is not stable");
  return 0;
}
