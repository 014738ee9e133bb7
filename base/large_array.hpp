#pragma once
/// \file
/// Memory for large arrays. Most of what a large array costs is the first touch of its pages: every 4 KiB is a fault, and the
/// system clears it. Large pages (2 MiB) make that five hundred times rarer; where the system has none, nothing else differs.
///
/// `LargeArray` is a std::vector in such memory whose new elements are not written first: `resize` only makes room, and who
/// resizes fills every element. `growRoom` is for vectors whose type is not ours to choose.

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace axil {

/// So many bytes, in large pages when they are worth it; throws std::bad_alloc. To be given back with std::free.
[[nodiscard]] void* largeBlock(std::size_t bytes);
void freeLargeBlock(void* block) noexcept;
/// Asks for large pages in the inner part of memory that is not yet touched. A wish only.
void wishLargePages(void* block, std::size_t bytes) noexcept;

template <class T>
struct LargePages {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>, "elements are left unwritten at first");
  using value_type = T;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  [[nodiscard]] T* allocate(std::size_t count) { return static_cast<T*>(largeBlock(count * sizeof(T))); }
  void deallocate(T* block, std::size_t) noexcept { freeLargeBlock(block); }
  void construct(T*) noexcept {}
  template <class... Arguments>
  void construct(T* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
  template <class U>
  friend bool operator==(const LargePages&, const LargePages<U>&) {
    return true;
  }
};

template <class T>
using LargeArray = std::vector<T, LargePages<T>>;

/// Room for `count` elements in `array`, in large pages when they are worth it.
template <class T>
void growRoom(std::vector<T>& array, std::size_t count) {
  if (count <= array.capacity()) return;
  array.reserve(count);
  wishLargePages(static_cast<void*>(array.data() + array.size()), (count - array.size()) * sizeof(T));
}

}  // namespace axil
