#include "mpi/spaces/plan/root_schedule.h"

#include <algorithm>

namespace pbmpi::mpi {

void RootSchedule::start_all(double now_s) {
  for (Rank& rank : ranks_) rank.began_s = now_s;
}

void RootSchedule::note_verdict(double now_s, double search_s) {
  verdict_s_ = now_s;
  search_s_ = search_s;
}

double RootSchedule::expected_s(const Rank& rank) const {
  return std::max(rank.began_s + rank.pace.collide_s, verdict_s_) + rank.pace.solve_s;
}

void RootSchedule::note_arrival(int index, double after_s, double by_s, const StepPace& pace) {
  Rank& rank = ranks_[static_cast<std::size_t>(index)];
  rank.began_s = std::clamp(expected_s(rank), std::min(after_s, by_s), by_s);
  rank.pace = pace;
}

double RootSchedule::expected_s() const {
  double last_s = 0;
  for (std::size_t rank = 1; rank < ranks_.size(); ++rank)
    last_s = std::max(last_s, expected_s(ranks_[rank]));
  return last_s;
}

bool RootSchedule::should_wait(double now_s) const {
  const double due_in_s = std::max(0.0, expected_s() - now_s);
  const bool overdue = now_s > expected_s() + own_.collide_s;  // this step is not like the last one
  if (overdue || due_in_s >= own_.collide_s) return false;
  double collide_s = 0, solve_s = 0;
  for (std::size_t rank = 1; rank < ranks_.size(); ++rank) {
    collide_s = std::max(collide_s, ranks_[rank].pace.collide_s);
    solve_s = std::max(solve_s, ranks_[rank].pace.solve_s);
  }
  // The seconds from now until the last rank has solved, for either choice.
  const double wait_s = due_in_s + std::max(std::max(collide_s, search_s_) + solve_s,
                                            search_s_ + own_.collide_s + own_.solve_s);
  const double collide_first_s = own_.collide_s + search_s_ + std::max(solve_s, own_.solve_s);
  return wait_s < collide_first_s;
}

}  // namespace pbmpi::mpi
