/// Threads that share tasks.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pbmpi::core {

/// The caller's thread and others that wait for work. The others block all signals, so that the main thread
/// handles them. One caller at a time.
class ThreadPool {
 public:
  /// task(index, thread): `thread` counts from 0, the caller's, to num_threads() - 1.
  using Task = std::function<void(int index, int thread)>;

  /// `num_threads` >= 1 includes the caller's: with 1 there is no other. Throws core::RunError if the system
  /// gives no more threads.
  explicit ThreadPool(int num_threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int num_threads() const { return static_cast<int>(others_.size()) + 1; }

  /// Runs the tasks 0 to count - 1, each on whichever thread is free first, and returns when all are done. If
  /// tasks threw, rethrows the exception of the task with the lowest index.
  void run(int count, const Task& task);

 private:
  void wait_for_work(int thread);
  void take_tasks(int thread);
  void stop();

  std::mutex mutex_;
  std::condition_variable begins_, ends_;
  const Task* task_ = nullptr;  ///< of the current round
  int count_ = 0;               ///< number of its tasks
  std::atomic<int> next_ = 0;   ///< next task to take
  std::int64_t round_ = 0;
  int num_busy_ = 0;  ///< how many of the other threads are busy
  bool stops_ = false;
  std::exception_ptr error_;
  int error_index_ = 0;
  std::vector<std::jthread> others_;
};

/// The processors on which this thread may run: 1 where a launcher has bound the process to a core.
int num_usable_processors();

}  // namespace pbmpi::core
