// Any bytes as a project file: parsing never crashes, and what parses prints and parses to the same value.
#include "document/project.hpp"

#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto project = axil::document::parseProject({reinterpret_cast<const char*>(data), size});
  if (!project) return 0;
  const std::string text = axil::document::projectText(*project);
  const auto again = axil::document::parseProject(text);
  AXIL_ASSERT(again.has_value(), "a printed project must parse");
  AXIL_ASSERT(axil::document::projectText(*again) == text, "printing must be stable");
  return 0;
}
