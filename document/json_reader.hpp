#pragma once
/// \file
/// Private to document: reading a JSON object key by key, collecting every fault with the path of the value it is about,
/// and keeping the keys nobody asked for.

#include "document/project.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace axil::document {

/// Parses JSON text for a file of ours. Fails with the line and column of the first fault, or for nesting beyond 100 levels.
[[nodiscard]] Result<nlohmann::ordered_json> parseJson(std::string_view text);

/// One JSON object (or what stands in its place). A value that is missing or of the wrong type leaves a fault and gives a
/// neutral value, so that reading goes on and all faults of a file come together.
class ObjectReader {
 public:
  ObjectReader(const nlohmann::ordered_json& value, std::string path, std::vector<std::string>& faults);

  [[nodiscard]] bool has(const char* key);
  [[nodiscard]] double number(const char* key);
  [[nodiscard]] std::optional<double> numberIfAny(const char* key);
  [[nodiscard]] std::int64_t integer(const char* key, std::int64_t low, std::int64_t high);
  [[nodiscard]] std::string text(const char* key);
  [[nodiscard]] std::string textOr(const char* key, std::string otherwise);
  /// `count` finite numbers.
  [[nodiscard]] std::vector<double> numbers(const char* key, std::size_t count);
  [[nodiscard]] PhotoPoint point(const char* key);
  /// A 3 x 3 matrix given as three rows, row by row.
  [[nodiscard]] std::array<double, 9> rows(const char* key);
  /// The members of an array or object; an empty reader list where the key is missing or wrong.
  [[nodiscard]] std::vector<ObjectReader> objects(const char* key);
  [[nodiscard]] ObjectReader object(const char* key);
  [[nodiscard]] std::vector<std::int64_t> integers(const char* key, std::int64_t low, std::int64_t high);
  /// The names of this object's members, in the order of the file; each counts as asked for.
  [[nodiscard]] std::vector<std::string> allKeys();

  void fault(const std::string& key, const std::string& what);
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Members that no call above asked for.
  [[nodiscard]] Extras extras() const;

 private:
  const nlohmann::ordered_json* find(const char* key);
  const nlohmann::ordered_json* require(const char* key);
  std::string pathOf(const std::string& key) const;
  double finite(const nlohmann::ordered_json& value, const std::string& path);

  const nlohmann::ordered_json* value_;
  std::string path_;
  std::vector<std::string>* faults_;
  std::set<std::string> asked_;
};

}  // namespace axil::document
