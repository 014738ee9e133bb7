#include "base/large_array.hpp"

#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace axil {
namespace {

constexpr std::size_t largePage = std::size_t{1} << 21;
/// Below this the rounding up costs more than it saves.
constexpr std::size_t worthwhile = 2 * largePage;

std::size_t roundedUp(std::size_t bytes) { return (bytes + largePage - 1) / largePage * largePage; }

}  // namespace

void wishLargePages(void* block, std::size_t bytes) noexcept {
#if defined(__linux__)
  const auto first = static_cast<std::size_t>(reinterpret_cast<std::uintptr_t>(block));
  const std::size_t begin = roundedUp(first), end = (first + bytes) / largePage * largePage;
  if (end > begin) (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#else
  (void)block;
  (void)bytes;
#endif
}

void freeLargeBlock(void* block) noexcept { std::free(block); }

void* largeBlock(std::size_t bytes) {
  void* const block = bytes < worthwhile ? std::malloc(bytes) : std::aligned_alloc(largePage, roundedUp(bytes));
  if (block == nullptr) throw std::bad_alloc();
  if (bytes >= worthwhile) wishLargePages(block, roundedUp(bytes));
  return block;
}

}  // namespace axil
