// The engine and growth against grammars of both languages: whichever way the engine takes, with whatever number of threads, the string is
// the same; a derivation and a plant end within their limits; the plant at a time does not depend on what was asked before.
#include "simeco/engine.hpp"
#include "simeco/growth.hpp"
#include "simeco/language.hpp"
#include "simeco/lsystem_language.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace {

using namespace axil::simeco;

constexpr Limits kLimits{.modules = 5'000, .bytes = 1 << 24, .steps = 30, .settlingSteps = 30, .loopIterations = 2'000, .seconds = 2};

struct Way {
  bool general = false;
  int threads = 1;
};

/// The string after at most eight steps; nothing when a limit or a failure came first.
std::optional<ModuleString> derivedBy(const Grammar& grammar, std::size_t plant, Way way) {
  auto program = compile(grammar, plant);
  if (!program) return std::nullopt;
  EngineOptions options;
  options.limits = kLimits;
  options.threads = way.threads;
  options.generalWay = way.general;
  options.modulesPerThread = 3;
  options.modulesForCalm = 4;
  auto engine = Engine::create(*program, options);
  if (!engine || !(*engine)->start()) return std::nullopt;
  std::vector<std::size_t> modulesPerStep;
  if (!(*engine)->run(8, modulesPerStep)) return std::nullopt;
  (void)(*engine)->imageOf((*engine)->string());
  return (*engine)->takeString();
}

bool sameBits(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool sameString(const ModuleString& a, const ModuleString& b) {
  return std::equal(a.codes().begin(), a.codes().end(), b.codes().begin(), b.codes().end()) &&
         std::equal(a.parameters().begin(), a.parameters().end(), b.parameters().begin(), b.parameters().end(), sameBits);
}

void compareWays(const Grammar& grammar) {
  for (std::size_t plant = 0; plant < grammar.plants.size() && plant < 3; ++plant) {
    const auto general = derivedBy(grammar, plant, {.general = true});
    for (const int threads : {1, 3}) {
      const auto quick = derivedBy(grammar, plant, {.threads = threads});
      if (general && quick) AXIL_ASSERT(sameString(*general, *quick), "the ways of the engine derive different strings");
    }
  }
}

void growTwice(const Grammar& grammar) {
  GrowOptions options;
  options.limits = kLimits;
  options.upToTime = 6;
  const auto growth = prepareGrowth(grammar, options);
  if (!growth) {
    AXIL_ASSERT(!growth.error().message.empty(), "a failure says why");
    return;
  }
  const auto late = plantAt(*growth, 4.5);
  const auto early = plantAt(*growth, 1.25);
  const auto again = plantAt(*growth, 4.5);
  AXIL_ASSERT(late.has_value() == again.has_value(), "a time asked twice fails once");
  if (!late || !early) return;
  AXIL_ASSERT(late->organs.size() == again->organs.size(), "a time asked twice gives other organs");
  AXIL_ASSERT(*late == *again, "a time asked twice gives another plant");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto decoded = axil::decodeText(std::string_view(reinterpret_cast<const char*>(data), size));
  if (!decoded) return 0;
  const std::string_view text = decoded->utf8;
  const bool classic = text.find("EcoSystem") == std::string_view::npos;
  LSystemOptions small;
  small.macroTextLimit = 1 << 16;
  const Parsed parsed = classic ? parseLSystem(text, small) : parseSimeco(text);
  if (!parsed.ok() || axil::hasErrors(classic ? checkLSystem(parsed.grammar) : check(parsed.grammar))) return 0;
  compareWays(parsed.grammar);
  if (!classic) growTwice(parsed.grammar);
  return 0;
}
