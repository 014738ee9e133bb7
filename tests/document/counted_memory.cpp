#include "counted_memory.hpp"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {
std::atomic<std::size_t> held{0};

void* plain(std::size_t size) { return std::malloc(size == 0 ? 1 : size); }
void* aligned(std::size_t size, std::align_val_t align) {
  const auto step = static_cast<std::size_t>(align);
  return std::aligned_alloc(step, (size + step - 1) / step * step);
}
void* counted(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  held += malloc_usable_size(block) + sizeof(std::size_t);  // the allocator's own word before each block
  return block;
}
void release(void* block) {
  if (block == nullptr) return;
  held -= malloc_usable_size(block) + sizeof(std::size_t);
  std::free(block);
}
}  // namespace

void* operator new(std::size_t size) { return counted(plain(size)); }
void* operator new[](std::size_t size) { return counted(plain(size)); }
void* operator new(std::size_t size, std::align_val_t align) { return counted(aligned(size, align)); }
void* operator new[](std::size_t size, std::align_val_t align) { return counted(aligned(size, align)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* block = plain(size);
  return block == nullptr ? nullptr : counted(block);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  void* block = plain(size);
  return block == nullptr ? nullptr : counted(block);
}
void operator delete(void* block) noexcept { release(block); }
void operator delete[](void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { release(block); }
void operator delete[](void* block, const std::nothrow_t&) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { release(block); }

namespace axil::test {
std::size_t bytesHeld() { return held; }
}  // namespace axil::test
