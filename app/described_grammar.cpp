#include "app/described_grammar.hpp"

#include "base/files.hpp"
#include "keywords/keywords.hpp"

#include <filesystem>
#include <iostream>

namespace axil::app {

namespace {

constexpr std::uintmax_t kMaximumTextBytes = keywords::descriptionLimitBytes;

Result<std::string> textIn(const std::string& file) {
  if (file != "-") return readFile(file, kMaximumTextBytes);
  std::string text;
  for (char c; text.size() <= kMaximumTextBytes && std::cin.get(c);) text.push_back(c);
  return text;
}

}  // namespace

bool isDescription(const std::string& file) { return file.ends_with(".txt"); }

Result<emit::DescribedPlant> describedPlantIn(const std::string& file) {
  const auto bytes = textIn(file);
  if (!bytes) return bytes.failure();
  const auto named = [&](const Error& error) { return fail(Error{error.code, (file == "-" ? "standard input" : file) + ": " + error.message, error.details}); };
  const auto text = keywords::decodeDescription(*bytes);
  if (!text) return named(text.error());
  const auto traits = keywords::readTraits(text->utf8);
  if (!traits) return named(traits.error());
  const std::string stem = std::filesystem::path(file).stem().string();
  auto plant = emit::describedPlant(*traits, {.name = file == "-" || stem.empty() ? "plant" : stem});
  if (!plant) return named(plant.error());
  return plant;
}

}  // namespace axil::app
