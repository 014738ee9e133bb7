#pragma once
/// \file
/// Workers: a few threads that wait for small pieces of work. A derivation has thousands of steps of some ten microseconds, so
/// the threads stay and look for work for a moment before they sleep. Private to the engine.

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace axil::simeco {

class Workers {
 public:
  explicit Workers(int count) : count_(count < 1 ? 1 : count) {}
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int count() const { return count_; }
  /// Calls work(0) ... work(count - 1) at the same time, work(0) on the calling thread; returns when all are done.
  void each(const std::function<void(int)>& work);

 private:
  void startThreads();
  void serve(int worker);

  int count_;
  std::vector<std::thread> threads_;  ///< made when there is work for the first time
  bool started_ = false;
  const std::function<void(int)>* work_ = nullptr;
  std::atomic<std::uint32_t> round_{0};
  std::atomic<std::uint32_t> busy_{0};
  std::atomic<bool> over_{false};
};

}  // namespace axil::simeco
