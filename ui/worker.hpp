#pragma once
/// \file
/// Worker: long work on a thread of its own, always on the latest question. What waits is replaced by what is asked later, so an answer
/// is at most one piece of work behind; whoever takes an answer looks whether it still fits. The window never waits for it.

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace axil::ui {

template <class Question, class Answer>
class Worker {
 public:
  using Work = std::function<Answer(const Question&)>;

  /// `makeWork` runs on the thread and what it makes ends there, so it may own what belongs to one thread (a drawing context).
  /// `answered` is called from the thread after each answer, to wake the window.
  Worker(std::function<Work()> makeWork, std::function<void()> answered)
      : answered_(std::move(answered)), thread_([this, makeWork = std::move(makeWork)] { run(makeWork()); }) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }

  void ask(Question question) {
    {
      const std::lock_guard lock(mutex_);
      question_ = std::move(question);
    }
    wake_.notify_all();
  }
  [[nodiscard]] std::optional<Answer> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_, std::nullopt);
  }
  /// Something is asked and not yet taken.
  [[nodiscard]] bool busy() const {
    const std::lock_guard lock(mutex_);
    return working_ || question_ || answer_;
  }
  /// Something is worked on or waits for it.
  [[nodiscard]] bool working() const {
    const std::lock_guard lock(mutex_);
    return working_ || question_;
  }

 private:
  void run(const Work& work) {
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [this] { return ending_ || question_; });
      if (ending_) return;
      const Question question = std::move(*std::exchange(question_, std::nullopt));
      working_ = true;
      lock.unlock();
      Answer answer = work(question);
      lock.lock();
      working_ = false;
      answer_ = std::move(answer);
      if (answered_) answered_();
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Question> question_;
  std::optional<Answer> answer_;
  bool working_ = false;
  bool ending_ = false;
  std::function<void()> answered_;
  std::thread thread_;  // last: it starts at once
};

}  // namespace axil::ui
