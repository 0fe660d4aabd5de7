#include "core/system/thread_pool.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <csignal>
#include <set>
#include <stdexcept>

namespace pbmpi::core {
namespace {

TEST(ThreadPool, does_each_task_once_for_any_number_of_threads) {
  for (const int num_threads : {1, 2, 3, 7}) {
    ThreadPool pool(num_threads);
    EXPECT_EQ(pool.num_threads(), num_threads);
    for (const int count : {0, 1, 2, 5, 100, 3}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      pool.run(count, [&](int index, int thread) {
        EXPECT_TRUE(thread >= 0 && thread < num_threads);
        ++done[static_cast<std::size_t>(index)];
      });
      for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
    }
  }
}

TEST(ThreadPool, works_in_all_its_threads_at_the_same_time) {
  constexpr int num_threads = 3;
  ThreadPool pool(num_threads);
  std::atomic<int> arrived = 0;
  std::array<std::thread::id, num_threads> ids;
  // Each task waits for the others: with fewer threads they would wait for ever.
  pool.run(num_threads, [&](int, int thread) {
    ids[static_cast<std::size_t>(thread)] = std::this_thread::get_id();
    ++arrived;
    while (arrived < num_threads) std::this_thread::yield();
  });
  EXPECT_EQ(std::set(ids.begin(), ids.end()).size(), 3u);
  EXPECT_EQ(ids[0], std::this_thread::get_id()) << "the caller's";
}

TEST(ThreadPool, throws_what_the_first_failing_task_threw_once_all_are_done) {
  for (const int num_threads : {1, 3}) {
    ThreadPool pool(num_threads);
    std::atomic<int> done = 0;
    try {
      pool.run(40, [&](int index, int) {
        ++done;
        if (index % 7 == 3) throw std::runtime_error("task " + std::to_string(index));
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "task 3");
    }
    EXPECT_EQ(done, 40);
    pool.run(5, [&](int, int) { ++done; });
    EXPECT_EQ(done, 45) << "the pool goes on";
  }
}

TEST(ThreadPool, leaves_signals_to_the_callers_thread) {
  sigset_t before;
  pthread_sigmask(SIG_SETMASK, nullptr, &before);
  ThreadPool pool(2);
  sigset_t after;
  pthread_sigmask(SIG_SETMASK, nullptr, &after);
  EXPECT_EQ(sigismember(&before, SIGTERM), sigismember(&after, SIGTERM));
  std::atomic<int> arrived = 0;
  std::array<int, 2> blocked{};
  pool.run(2, [&](int, int thread) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
    sigset_t mask;
    pthread_sigmask(SIG_SETMASK, nullptr, &mask);
    blocked[static_cast<std::size_t>(thread)] = sigismember(&mask, SIGTERM);
  });
  EXPECT_EQ(blocked[0], sigismember(&before, SIGTERM));
  EXPECT_EQ(blocked[1], 1);
}

TEST(UsableProcessors, are_those_that_the_thread_is_bound_to) {
  const int all = num_usable_processors();
  ASSERT_GE(all, 1);
  std::jthread bound([] {
    cpu_set_t set;
    ASSERT_EQ(sched_getaffinity(0, sizeof set, &set), 0);
    int first = 0;
    while (!CPU_ISSET(first, &set)) ++first;
    CPU_ZERO(&set);
    CPU_SET(first, &set);
    ASSERT_EQ(sched_setaffinity(0, sizeof set, &set), 0);
    EXPECT_EQ(num_usable_processors(), 1);
  });
  bound.join();
  EXPECT_EQ(num_usable_processors(), all);
}

}  // namespace
}  // namespace pbmpi::core
