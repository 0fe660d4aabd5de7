/// Wall-clock time, and the seconds that a frame spends in each phase.
#pragma once

#include <time.h>

#include <array>
#include <chrono>
#include <string_view>

namespace pbmpi::core {

/// Seconds of a clock that never goes backwards; its zero has no meaning.
inline double now_s() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// Seconds of processor time that this thread has used, without other processes on the core.
inline double thread_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The timed parts of a frame. For one world cut into spaces, `cross_space` is root's section (collisions
/// across spaces, islands joined over the ranks), and `ship` the passing of islands from rank to rank and
/// back. `wait` is time spent waiting for another rank's part.
enum class Phase { collide, islands, rows, solve, integrate, cross_space, ship, gather, wait, output };
inline constexpr int num_phases = 10;
inline constexpr std::array<std::string_view, num_phases> phase_names = {
    "collide", "islands", "rows", "solve", "integrate", "cross_space", "ship", "gather", "wait", "output"};

/// Seconds per phase of one rank in one frame.
struct PhaseTimes {
  std::array<double, num_phases> seconds{};

  double& operator[](Phase phase) { return seconds[static_cast<int>(phase)]; }
  double operator[](Phase phase) const { return seconds[static_cast<int>(phase)]; }
  /// Time spent on the simulation itself: all but ship, gather, wait and output.
  double useful_s() const {
    double sum = 0;
    for (int phase = 0; phase <= static_cast<int>(Phase::cross_space); ++phase) sum += seconds[phase];
    return sum;
  }
};

/// Adds to a phase the seconds since the last lap: one clock read at each boundary between two phases.
class LapTimer {
 public:
  explicit LapTimer(PhaseTimes& times) : times_(&times), last_s_(now_s()) {}
  void lap(Phase phase) {
    const double now = now_s();
    (*times_)[phase] += now - last_s_;
    last_s_ = now;
  }

 private:
  PhaseTimes* times_;
  double last_s_;
};

}  // namespace pbmpi::core
