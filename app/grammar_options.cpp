#include "app/grammar_options.hpp"

#include "app/cli_interop.hpp"
#include "base/rng.hpp"

#include <cstdio>

namespace axil::app {

namespace {

/// Warnings do not stop anything; they go to stderr, with the place they are about.
void warn(const simeco::GrammarFile& file) {
  for (const Diagnostic& d : file.parsed.diagnostics)
    if (d.severity == Severity::Warning) std::fprintf(stderr, "%s\n", formatWithCaret(d, file.text, file.path.string()).c_str());
}

}  // namespace

Result<simeco::Grammar> grammarIn(const std::string& path) {
  auto file = simeco::readGrammarFile(path);
  if (!file) return file.failure();
  if (file->parsed.ok()) {
    warn(*file);
    return std::move(file->parsed.grammar);
  }
  Error error{ErrorCode::BadGrammar, path + " has errors", {}};
  for (const Diagnostic& d : file->parsed.diagnostics) error.details.push_back(formatWithCaret(d, file->text, path));
  return fail(std::move(error));
}

Result<std::size_t> plantNamed(const simeco::Grammar& grammar, const std::string& name) {
  std::string names;
  for (std::size_t i = 0; i < grammar.plants.size(); ++i) {
    if (name.empty() || grammar.plants[i].name == name) return i;
    names += (names.empty() ? "\"" : ", \"") + grammar.plants[i].name + "\"";
  }
  if (names.empty()) return fail(ErrorCode::BadGrammar, "the grammar has no plant");
  return fail(ErrorCode::BadInput, "the grammar has no plant \"" + name + "\"; it has " + names);
}

std::uint64_t seedOf(std::uint64_t seed, std::size_t plant) { return plant == 0 ? seed : Rng(seed).split(plant).bits(); }

void addGrammar(CLI::App& sub, std::string& grammar) { sub.add_option("GRAMMAR", grammar, "A .simeco or .l file")->required(); }

void addSeed(CLI::App& sub, std::uint64_t& seed) {
  sub.add_option("--seed", seed, "Seed of every random choice; the same seed grows the same plant")->capture_default_str();
}

void addPlant(CLI::App& sub, std::string& plant, const char* otherwise) {
  sub.add_option("--plant", plant, std::string("Name of one plant of the ecosystem; by default ") + otherwise)->option_text("NAME");
}

void addLimits(CLI::App& sub, simeco::Limits& limits) {
  constexpr const char* kGroup = "Limits (what meets one stops with a message)";
  // Two limits: with a number of steps, and until nothing changes any more. Who gives one means both.
  const auto setSteps = [&limits](const std::int64_t& steps) { limits.steps = limits.settlingSteps = steps; };
  sub.add_option("--max-modules", limits.modules, "Modules in a string")->check(aboveZero())->capture_default_str()->group(kGroup);
  sub.add_option("--max-memory", limits.bytes, "Memory of the derivation, as 500MB or 2GB")->transform(CLI::AsSizeValue(false))->check(aboveZero())->option_text("SIZE [2GB]")->group(kGroup);
  sub.add_option_function<std::int64_t>("--max-steps", setSteps, "Derivation steps")->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 40))
      ->option_text("INT [100000; 10000 where nothing says how many]")->group(kGroup);
  sub.add_option("--max-loop-iterations", limits.loopIterations, "Rounds of all loops in one block of statements")->check(aboveZero())->capture_default_str()->group(kGroup);
  sub.add_option("--max-expression-depth", limits.expressionDepth, "Nested operations in an expression")->check(CLI::Range(1, 10'000))->capture_default_str()->group(kGroup);
  sub.add_option("--max-seconds", limits.seconds, "Wall time of the derivation")->check(aboveZero())->capture_default_str()->group(kGroup);
}

}  // namespace axil::app
