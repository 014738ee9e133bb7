#pragma once
/// \file
/// How long work tells how far it is and hears that it should stop. Both are arguments; nothing is global.

#include <atomic>
#include <functional>
#include <string_view>

namespace axil {

/// Set from any thread; long work looks at it often and returns ErrorCode::Cancelled.
class CancelToken {
 public:
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> cancelled_{false};
};

/// Called from the working thread: what is being done, and the share done from 0 to 1. May be empty.
using Progress = std::function<void(std::string_view what, double share)>;

/// What long work is given. Copies share the token, which the caller owns and must outlive the work; null is fine.
struct Watch {
  Progress progress = {};
  const CancelToken* cancel = nullptr;

  void report(std::string_view what, double share) const {
    if (progress) progress(what, share);
  }
  [[nodiscard]] bool cancelled() const { return cancel != nullptr && cancel->cancelled(); }
};

}  // namespace axil
