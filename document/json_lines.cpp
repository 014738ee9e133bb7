#include "document/json_lines.hpp"

#include <nlohmann/json.hpp>

namespace axil::document {

using Json = nlohmann::ordered_json;

namespace {

std::string listLines(const Json& list) {
  std::string text = "[\n";
  for (std::size_t i = 0; i < list.size(); ++i) text += "    " + list[i].dump() + (i + 1 < list.size() ? ",\n" : "\n");
  return text + "  ]";
}

// A list of plain numbers or texts stays on its line.
bool isLong(const Json& value) { return value.is_array() && !value.empty() && value.front().is_structured(); }

}  // namespace

std::string jsonLines(const Json& object) {
  std::string text = "{\n";
  std::size_t left = object.size();
  for (const auto& [key, value] : object.items()) {
    text += "  " + Json(key).dump() + ": " + (isLong(value) ? listLines(value) : value.dump());
    text += --left > 0 ? ",\n" : "\n";
  }
  return text + "}\n";
}

}  // namespace axil::document
