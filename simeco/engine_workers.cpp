#include "simeco/engine_workers.hpp"

#include <system_error>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace axil::simeco {

namespace {

// Long enough to bridge the gap between two steps, short enough not to take time from other programs.
constexpr int kLooks = 2000;

void breathe() {
#if defined(__x86_64__)
  _mm_pause();
#endif
}

template <class Changed>
bool looksFor(Changed changed) {
  for (int i = 0; i < kLooks; ++i) {
    if (changed()) return true;
    breathe();
  }
  return false;
}

}  // namespace

Workers::~Workers() {
  over_.store(true, std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::serve(int worker) {
  std::uint32_t seen = 0;
  for (;;) {
    const auto next = [&] { return round_.load(std::memory_order_acquire) != seen; };
    if (!looksFor(next)) round_.wait(seen, std::memory_order_acquire);
    if (!next()) continue;
    ++seen;
    if (over_.load(std::memory_order_relaxed)) return;
    (*work_)(worker);
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
  }
}

/// Threads count rounds from 0, so all of them start before the first round. Where the system gives fewer, the calling
/// thread does the rest of the work.
void Workers::startThreads() {
  if (started_) return;
  started_ = true;
  try {
    while (static_cast<int>(threads_.size()) + 1 < count_)
      threads_.emplace_back([this, worker = static_cast<int>(threads_.size()) + 1] { serve(worker); });
  } catch (const std::system_error&) {
  }
}

void Workers::each(const std::function<void(int)>& work) {
  if (count_ == 1) return work(0);
  startThreads();
  work_ = &work;
  busy_.store(static_cast<std::uint32_t>(threads_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  work(0);
  for (int worker = static_cast<int>(threads_.size()) + 1; worker < count_; ++worker) work(worker);
  const auto done = [&] { return busy_.load(std::memory_order_acquire) == 0; };
  while (!looksFor(done)) {
    const std::uint32_t left = busy_.load(std::memory_order_acquire);
    if (left != 0) busy_.wait(left, std::memory_order_acquire);
  }
}

}  // namespace axil::simeco
