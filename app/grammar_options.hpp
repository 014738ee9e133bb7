#pragma once
/// \file
/// What the commands that take a grammar share: reading it, choosing a plant of it, and the options for both.

#include "base/result.hpp"
#include "base/turning.hpp"
#include "simeco/simeco.hpp"

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace axil::app {

/// The grammar in the file `path`; its warnings go to stderr. Fails with every error of the file.
[[nodiscard]] Result<simeco::Grammar> grammarIn(const std::string& path);

/// The plant of an ecosystem that is called `name`; without a name the first.
[[nodiscard]] Result<std::size_t> plantNamed(const simeco::Grammar& grammar, const std::string& name);

/// Of the random numbers of an ecosystem those of one plant, so that it is the same alone and among the others.
[[nodiscard]] std::uint64_t seedOf(std::uint64_t seed, std::size_t plant);

void addGrammar(CLI::App& sub, std::string& grammar);
void addSeed(CLI::App& sub, std::uint64_t& seed);
/// `otherwise` says which plants are meant without the option.
void addPlant(CLI::App& sub, std::string& plant, const char* otherwise);
void addLimits(CLI::App& sub, simeco::Limits& limits);

}  // namespace axil::app
