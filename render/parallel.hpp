#pragma once
/// \file
/// Private to render: the same small work for many things, on as many threads as there are. Each thing is done alone, so
/// what comes out does not depend on how many threads there were.

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace axil::render {

/// So many threads work on `count` things.
inline std::size_t threadsFor(std::size_t count) { return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, std::clamp<std::size_t>(count, 1, 8)); }

/// `work(k)` for every k below `count`; `work` writes only to what belongs to k.
template <class Work>
void inParallel(std::size_t count, const Work& work) {
  const std::size_t threads = threadsFor(count);
  const auto share = [&](std::size_t first) {
    for (std::size_t k = first; k < count; k += threads) work(k);
  };
  std::vector<std::jthread> others;
  others.reserve(threads - 1);
  for (std::size_t t = 1; t < threads; ++t) others.emplace_back(share, t);
  share(0);
}

/// Things are made in pieces of so many, each piece by itself; what comes out is the same for any number of threads.
inline std::size_t piecesFor(std::size_t count, std::size_t atOnce) { return (count + atOnce - 1) / atOnce; }

/// The least k below `count` that `is` holds for, else `count`.
template <class Is>
std::size_t firstOf(std::size_t count, const Is& is) {
  constexpr std::size_t atOnce = 8192;
  std::vector<std::size_t> firsts(piecesFor(count, atOnce), count);
  inParallel(firsts.size(), [&](std::size_t piece) {
    for (std::size_t k = piece * atOnce; k < std::min((piece + 1) * atOnce, count); ++k)
      if (is(k)) {
        firsts[piece] = k;
        return;
      }
  });
  return firsts.empty() ? count : *std::min_element(firsts.begin(), firsts.end());
}

}  // namespace axil::render
