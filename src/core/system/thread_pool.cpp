#include "core/system/thread_pool.h"

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace pbmpi::core {
namespace {

/// Blocks all signals in threads that are started while it lives.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

ThreadPool::ThreadPool(int num_threads) {
  require_invariant(num_threads >= 1, "a pool has the caller's thread at least");
  const SignalsBlocked blocked;
  // Before any thread runs: the threads would wait for ever if this failed.
  others_.reserve(static_cast<std::size_t>(num_threads) - 1);
  try {
    for (int thread = 1; thread < num_threads; ++thread)
      others_.emplace_back([this, thread] { wait_for_work(thread); });
  } catch (const std::system_error& error) {
    const std::string started = std::to_string(others_.size() + 1);
    stop();
    throw RunError("the system gives " + started + " of " + std::to_string(num_threads) +
                   " threads: " + error.what() + "; ask for fewer with --threads");
  }
}

ThreadPool::~ThreadPool() { stop(); }

void ThreadPool::stop() {
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
    begins_.notify_all();
  }
  others_.clear();  // joins them
}

void ThreadPool::run(int count, const Task& task) {
  {
    const std::lock_guard lock(mutex_);
    task_ = &task;
    count_ = count;
    next_ = 0;
    num_busy_ = static_cast<int>(others_.size());
    error_ = nullptr;
    ++round_;
    begins_.notify_all();
  }
  take_tasks(0);
  std::unique_lock lock(mutex_);
  ends_.wait(lock, [&] { return num_busy_ == 0; });
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void ThreadPool::wait_for_work(int thread) {
  std::int64_t done = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    begins_.wait(lock, [&] { return stops_ || round_ != done; });
    if (stops_) return;
    done = round_;
    lock.unlock();
    take_tasks(thread);
    lock.lock();
    if (--num_busy_ == 0) ends_.notify_one();
  }
}

void ThreadPool::take_tasks(int thread) {
  for (int index = next_++; index < count_; index = next_++) {
    try {
      (*task_)(index, thread);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_ || index < error_index_) {
        error_ = std::current_exception();
        error_index_ = index;
      }
    }
  }
}

int num_usable_processors() {
  const long configured = std::max(sysconf(_SC_NPROCESSORS_CONF), 1024L);  // the kernel wants room for all
  const std::unique_ptr<cpu_set_t, void (*)(cpu_set_t*)> set(CPU_ALLOC(static_cast<std::size_t>(configured)),
                                                             [](cpu_set_t* one) { CPU_FREE(one); });
  const std::size_t size = CPU_ALLOC_SIZE(static_cast<std::size_t>(configured));
  if (!set || sched_getaffinity(0, size, set.get()) != 0)
    return static_cast<int>(std::max(sysconf(_SC_NPROCESSORS_ONLN), 1L));
  return CPU_COUNT_S(size, set.get());
}

}  // namespace pbmpi::core
