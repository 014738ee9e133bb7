#pragma once
/// \file
/// The commands of `axil`, each a function from plain options to an exit status: 0 success, 1 the input is wrong or gives
/// no answer. Data goes to stdout, words to stderr. docs/files.md says what each prints.

#include "base/turning.hpp"
#include "document/chain.hpp"
#include "simeco/environment.hpp"
#include "simeco/derive.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace axil::app {

struct KeywordsCommand {
  std::string file;  ///< "-": stdin
  bool json = false;
};
int run(const KeywordsCommand& command);

struct SkeletonCommand {
  std::string project;
};
int run(const SkeletonCommand& command);

struct QuantifyCommand {
  std::string project;
  TurningRule turning = TurningRule::Exact;
};
int run(const QuantifyCommand& command);

struct EmitCommand {
  std::string project;
  document::GrammarKind kind = document::GrammarKind::Initial;
  emit::Dialect dialect = emit::Dialect::SimEco;
  TurningRule turning = TurningRule::Exact;
  int decimals = 6;
};
int run(const EmitCommand& command);

struct CheckCommand {
  std::string grammar;
};
int run(const CheckCommand& command);

struct DeriveCommand {
  std::string grammar;
  std::string plant;  ///< its name; empty: the first
  std::optional<std::int64_t> steps;
  std::uint64_t seed = 1;
  enum class Print { Text, Counts, Stats } print = Print::Text;
  bool singlePrecision = false;
  int threads = 0;
  simeco::Limits limits;
};
int run(const DeriveCommand& command);

struct GrowCommand {
  std::string grammar;
  std::string plant;  ///< its name; empty: all of them
  std::optional<double> time;
  std::optional<std::int64_t> steps;
  std::uint64_t seed = 1;
  std::optional<int> frames;
  std::string out;
  std::string view = "quarter";
  std::string unit = "m";  ///< of the grammar's lengths
  int width = 1200;
  int height = 1600;
  simeco::Environment environment;
  TurningRule turning = TurningRule::Exact;
  simeco::Limits limits;
};
int run(const GrowCommand& command);

struct BuildCommand {
  std::string project;
  std::string out;
  int frames = 6;
  bool video = false;
};
int run(const BuildCommand& command);

}  // namespace axil::app
