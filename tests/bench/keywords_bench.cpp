// How fast a description is read: bytes a second, on running text and on one endless line. The aim is 1 MB/s and more.
#include "keywords/keywords.hpp"

#include <benchmark/benchmark.h>

#include <string>

namespace axil::keywords {
namespace {

std::string repeated(std::string_view piece, std::size_t bytes) {
  std::string text;
  while (text.size() < bytes) text += piece;
  return text;
}

void readMany(benchmark::State& state, std::string_view piece) {
  const std::string text = repeated(piece, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(readTraits(text));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

void keywordsEnglish(benchmark::State& state) {
  readMany(state,
           "Shrub 1-3 m tall. Leaves opposite, simple; petiole 1-2 cm long; blade ovate to ovate-lanceolate, (2-)3-8(-10) x 2-5 cm, base rounded or "
           "cordate, apex acute, margin serrate, glabrous above. Flowers white, in racemes 5-10 cm long; petals 5; stamens 10.\n\n");
}
void keywordsChinese(benchmark::State& state) {
  readMany(state, "灌木，高1-3公尺。葉對生，卵形或卵狀披針形，長3-8公分，寬2-5公分，基部心形，先端銳尖，鋸齒緣。花白色，花瓣5枚，雄蕊10枚。\n\n");
}
void keywordsEndlessLine(benchmark::State& state) { readMany(state, "葉對生卵形"); }

BENCHMARK(keywordsEnglish)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(keywordsChinese)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(keywordsEndlessLine)->Arg(1'000'000)->Arg(10'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace axil::keywords
