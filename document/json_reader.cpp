#include "document/json_reader.hpp"

#include "base/source.hpp"
#include "base/text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace axil::document {

using Json = nlohmann::ordered_json;

namespace {

constexpr int kMaximumDepth = 100;
const Json kNothing = Json::object();

// Levels of brackets outside strings; counted before parsing, so that hostile nesting never reaches recursive code.
int nestingDepth(std::string_view text) {
  int depth = 0, deepest = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      else if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

// The library's own message without its code "[...] " and its position "parse error at ...: ", which we give as line and column.
std::string reasonOf(const std::string& message) {
  const std::size_t code = message.find("] ");
  std::string reason = code == std::string::npos ? message : message.substr(code + 2);
  if (const std::size_t colon = reason.find(": "); reason.starts_with("parse error at") && colon != std::string::npos) reason.erase(0, colon + 2);
  if (reason.size() > 160) reason = reason.substr(0, 157) + "...";
  return reason;
}

const char* typeOf(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list";
  if (value.is_string()) return "a text";
  if (value.is_boolean()) return "true or false";
  return value.is_null() ? "null" : "a number";
}

}  // namespace

Result<Json> parseJson(std::string_view text) {
  if (nestingDepth(text) > kMaximumDepth)
    return fail(ErrorCode::LimitReached, "the JSON is nested more than " + std::to_string(kMaximumDepth) + " levels deep");
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto offset = static_cast<std::uint32_t>(error.byte > 0 ? error.byte - 1 : 0);
    const SourcePlace place = placeOf(text, offset);
    return fail(ErrorCode::BadInput, "broken JSON at line " + std::to_string(place.line) + ", column " + std::to_string(place.column) + ": " +
                                         reasonOf(error.what()));
  } catch (const Json::exception& error) {
    return fail(ErrorCode::BadInput, std::string("broken JSON: ") + reasonOf(error.what()));
  }
}

ObjectReader::ObjectReader(const Json& value, std::string path, std::vector<std::string>& faults)
    : value_(&value), path_(std::move(path)), faults_(&faults) {
  if (value.is_object()) return;
  faults_->push_back((path_.empty() ? "the file" : path_) + " must be an object { }, not " + typeOf(value));
  value_ = &kNothing;
}

std::string ObjectReader::pathOf(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

void ObjectReader::fault(const std::string& key, const std::string& what) { faults_->push_back(pathOf(key) + " " + what); }

const Json* ObjectReader::find(const char* key) {
  asked_.insert(key);
  const auto at = value_->find(key);
  return at == value_->end() ? nullptr : &*at;
}

const Json* ObjectReader::require(const char* key) {
  const Json* value = find(key);
  // A stand-in that was never an object has been reported already.
  if (value == nullptr && value_ != &kNothing) fault(key, "is missing");
  return value;
}

bool ObjectReader::has(const char* key) { return find(key) != nullptr; }

double ObjectReader::finite(const Json& value, const std::string& path) {
  if (!value.is_number()) {
    faults_->push_back(path + " must be a number, not " + typeOf(value));
    return 0;
  }
  const double number = value.get<double>();
  if (!std::isfinite(number)) faults_->push_back(path + " must be finite");
  return std::isfinite(number) ? number : 0;
}

double ObjectReader::number(const char* key) {
  const Json* value = require(key);
  return value ? finite(*value, pathOf(key)) : 0;
}

std::optional<double> ObjectReader::numberIfAny(const char* key) {
  const Json* value = find(key);
  if (value == nullptr || value->is_null()) return std::nullopt;
  return finite(*value, pathOf(key));
}

std::int64_t ObjectReader::integer(const char* key, std::int64_t low, std::int64_t high) {
  const Json* value = require(key);
  if (value == nullptr) return low;
  const double number = finite(*value, pathOf(key));
  if (number == std::floor(number) && number >= static_cast<double>(low) && number <= static_cast<double>(high)) return static_cast<std::int64_t>(number);
  if (value->is_number()) fault(key, "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return low;
}

std::string ObjectReader::text(const char* key) {
  const Json* value = require(key);
  if (value == nullptr) return {};
  if (value->is_string()) return value->get<std::string>();
  fault(key, std::string("must be a text, not ") + typeOf(*value));
  return {};
}

std::string ObjectReader::textOr(const char* key, std::string otherwise) { return has(key) ? text(key) : otherwise; }

std::vector<double> ObjectReader::numbers(const char* key, std::size_t count) {
  std::vector<double> result(count, 0.0);
  const Json* value = require(key);
  if (value == nullptr) return result;
  if (!value->is_array() || value->size() != count) {
    fault(key, "must be a list of " + std::to_string(count) + " numbers");
    return result;
  }
  for (std::size_t i = 0; i < count; ++i) result[i] = finite((*value)[i], pathOf(key) + "[" + std::to_string(i) + "]");
  return result;
}

PhotoPoint ObjectReader::point(const char* key) {
  const std::vector<double> xy = numbers(key, 2);
  return {{xy[0], xy[1]}};
}

std::array<double, 9> ObjectReader::rows(const char* key) {
  std::array<double, 9> result{};
  const Json* value = require(key);
  if (value == nullptr) return result;
  const bool shaped = value->is_array() && value->size() == 3 &&
                      std::all_of(value->begin(), value->end(), [](const Json& row) { return row.is_array() && row.size() == 3; });
  if (!shaped) {
    fault(key, "must be three rows of three numbers");
    return result;
  }
  for (std::size_t i = 0; i < 9; ++i)
    result[i] = finite((*value)[i / 3][i % 3], pathOf(key) + "[" + std::to_string(i / 3) + "][" + std::to_string(i % 3) + "]");
  return result;
}

std::vector<ObjectReader> ObjectReader::objects(const char* key) {
  std::vector<ObjectReader> readers;
  const Json* value = find(key);
  if (value == nullptr) return readers;
  if (!value->is_array()) {
    fault(key, std::string("must be a list [ ], not ") + typeOf(*value));
    return readers;
  }
  for (std::size_t i = 0; i < value->size(); ++i) readers.emplace_back((*value)[i], pathOf(key) + "[" + std::to_string(i) + "]", *faults_);
  return readers;
}

ObjectReader ObjectReader::object(const char* key) {
  const Json* value = require(key);
  return ObjectReader(value ? *value : kNothing, pathOf(key), *faults_);
}

std::vector<std::int64_t> ObjectReader::integers(const char* key, std::int64_t low, std::int64_t high) {
  std::vector<std::int64_t> result;
  const Json* value = require(key);
  if (value == nullptr) return result;
  if (!value->is_array()) {
    fault(key, std::string("must be a list of whole numbers, not ") + typeOf(*value));
    return result;
  }
  for (std::size_t i = 0; i < value->size(); ++i) {
    const std::string path = pathOf(key) + "[" + std::to_string(i) + "]";
    const double number = finite((*value)[i], path);
    if (number != std::floor(number) || number < static_cast<double>(low) || number > static_cast<double>(high))
      faults_->push_back(path + " must be a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    else
      result.push_back(static_cast<std::int64_t>(number));
  }
  return result;
}

std::vector<std::string> ObjectReader::allKeys() {
  std::vector<std::string> keys;
  for (const auto& member : value_->items()) {
    keys.push_back(member.key());
    asked_.insert(member.key());
  }
  return keys;
}

Extras ObjectReader::extras() const {
  Extras extras;
  for (const auto& member : value_->items())
    if (!asked_.contains(member.key())) extras[member.key()] = member.value().dump();
  return extras;
}

}  // namespace axil::document
