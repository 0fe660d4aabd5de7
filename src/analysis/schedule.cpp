#include "analysis/schedule.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <vector>

#include "core/error.h"

namespace pbmpi::analysis {

double longest_first_makespan(std::span<const double> lengths, int cores) {
  core::require_invariant(cores >= 1, "a schedule needs a core");
  std::vector<double> jobs(lengths.begin(), lengths.end());
  std::sort(jobs.begin(), jobs.end(), std::greater<>());
  std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
  for (int core = 0; core < cores; ++core) free_at.push(0);
  double end = 0;
  for (const double job : jobs) {
    const double done = free_at.top() + job;
    free_at.pop();
    free_at.push(done);
    end = std::max(end, done);
  }
  return end;
}

int fewest_cores(std::span<const double> lengths, double tolerance) {
  double longest = 0, sum = 0;
  for (const double length : lengths) {
    longest = std::max(longest, length);
    sum += length;
  }
  if (longest <= 0) return 0;
  // No schedule is shorter than the mean load, so fewer cores need not be tried; the margin is for rounding.
  const double most = longest * (1 + tolerance);
  int cores = std::max(1, static_cast<int>(sum / most * (1 - 1e-9)));
  while (longest_first_makespan(lengths, cores) > most) ++cores;
  return cores;
}

}  // namespace pbmpi::analysis
