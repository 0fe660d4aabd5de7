#include "app/pbstudy/accuracy/own_solution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/clock.h"
#include "core/random.h"
#include "engines/stepper_factory.h"

namespace pbmpi::app {

using model::State;

namespace {

/// The disturbance from which the noise floors of engines start: a few hundred times the rounding of a
/// position in a world of ten metres.
constexpr double disturbance = 1e-12;  // [m] and [m/s]

/// A frame is solved once four times as many iterations move no body farther.
constexpr double settled_m = 1e-5;

/// Does frame `frame` of the worlds `which` of a case, and writes their ends into `ends` [num_worlds].
void solve_frame(const AccuracyCase& one, const Worlds& worlds, int frame, const std::vector<int>& which,
                 const States& start, int iterations, States& ends) {
  const auto stepper = engines::make_stepper(own_settings(one.stepper, iterations), "own solution: ");
  const std::int64_t first_step = static_cast<std::int64_t>(frame) * one.steps_per_frame;
  for (const int world : which) {
    const auto place = static_cast<std::size_t>(world);
    stepper->add(world, worlds[place], start[place], first_step);
  }
  core::PhaseTimes times;
  stepper->advance(one.steps_per_frame, times);
  for (const int world : which) ends[static_cast<std::size_t>(world)] = stepper->state(world);
}

/// The largest displacement [m] of a body between two states; NaN if any is NaN.
double farthest_m(const State& a, const State& b) {
  double most = 0;
  for (std::size_t body = 0; body < a.position.size(); ++body) {
    const double way = (a.position[body] - b.position[body]).norm();
    if (!(way <= most)) most = way;
    if (std::isnan(most)) break;
  }
  return most;
}

}  // namespace

void disturb(double size, std::uint64_t key, State& state) {
  std::uint64_t drawn = 0;
  const auto move = [&](std::vector<model::Vec3>& vectors) {
    for (model::Vec3& vector : vectors) {
      for (double& coordinate : vector)
        coordinate += size * (2 * core::to_unit(core::mix_key(key, 0, ++drawn)) - 1);
    }
  };
  move(state.position);
  move(state.velocity);
}

OwnSolutions::OwnSolutions(const StudyScene& scene, const Nature& nature,
                           const std::vector<AccuracyCase>& cases, const AccuracyOptions& options)
    : scene_(scene), nature_(nature), cases_(cases), options_(options) {}

OwnSolutions::Solution OwnSolutions::solve(const AccuracyCase& one) const {
  Solution found;
  found.worlds = worlds_at_step(nature_, scene_, one.stepper.dt_s, one.stepper.seed);
  for (int frame = scene_.warmup; frame < scene_.total_frames(); ++frame) {
    const double start_s = core::thread_cpu_s();
    const States& start = nature_.states[static_cast<std::size_t>(frame)];
    std::vector<int> open(found.worlds.size());
    std::iota(open.begin(), open.end(), 0);
    std::vector<int> used(open.size(), options_.own_iterations);
    States ends(open.size());
    solve_frame(one, found.worlds, frame, open, start, options_.own_iterations, ends);
    States fewer = ends;
    for (std::int64_t wanted = 4 * std::int64_t{options_.own_iterations};
         traits_of(one.stepper.kind).iterates && wanted <= options_.own_most_iterations && !open.empty();
         wanted *= 4) {
      for (const int world : open) {
        fewer[static_cast<std::size_t>(world)] = ends[static_cast<std::size_t>(world)];
        used[static_cast<std::size_t>(world)] = static_cast<int>(wanted);
      }
      solve_frame(one, found.worlds, frame, open, start, static_cast<int>(wanted), ends);
      std::erase_if(open, [&](int world) {  // a world that is not finite will not settle either
        const auto place = static_cast<std::size_t>(world);
        return !(farthest_m(fewer[place], ends[place]) > settled_m);
      });
    }
    found.ends.push_back(std::move(ends));
    found.fewer.push_back(std::move(fewer));
    found.iterations.push_back(std::move(used));
    found.times_s.push_back(core::thread_cpu_s() - start_s);
  }
  return found;
}

/// Uses the iterations that the undisturbed solution took.
OwnSolutions::Solution OwnSolutions::solve_disturbed(const AccuracyCase& one, const Solution& own) const {
  Solution found;
  found.worlds = own.worlds;
  found.iterations = own.iterations;
  for (std::size_t i = 0; i < own.ends.size(); ++i) {
    const double start_s = core::thread_cpu_s();
    const auto frame = static_cast<std::size_t>(scene_.warmup) + i;
    States start = nature_.states[frame];
    std::map<int, std::vector<int>> worlds_by_iterations;
    for (std::size_t world = 0; world < start.size(); ++world) {
      disturb(disturbance, core::mix_key(one.stepper.seed, world, frame), start[world]);
      worlds_by_iterations[own.iterations[i][world]].push_back(static_cast<int>(world));
    }
    States ends(start.size());
    for (const auto& [iterations, worlds] : worlds_by_iterations)
      solve_frame(one, own.worlds, static_cast<int>(frame), worlds, start, iterations, ends);
    found.ends.push_back(std::move(ends));
    found.times_s.push_back(core::thread_cpu_s() - start_s);
  }
  found.fewer = own.ends;
  return found;
}

const OwnSolutions::Solution& OwnSolutions::solution(int index) {
  const auto known = solutions_.find(index);
  return known != solutions_.end() ? known->second
                                   : solutions_.emplace(index, solve(at(index))).first->second;
}

const FrameEnds* OwnSolutions::ends(int index) {
  return index == AccuracyCase::no_own ? nullptr : &solution(index).ends;
}

CaseResult OwnSolutions::judge(int index) {
  const AccuracyCase& one = at(index);
  const Solution& own = solution(one.own);
  const Solution disturbed = one.kind == CaseKind::own_floor ? solve_disturbed(one, own) : Solution{};
  const Solution& judged = one.kind == CaseKind::own_floor ? disturbed : own;
  CaseResult result = unobserved();
  DefectOf defect(nature_);
  analysis::PoseErrors own_errors;
  std::vector<std::vector<double>> times_s;
  double iterations = 0, num_solves = 0;
  for (std::size_t i = 0; i < judged.ends.size(); ++i) {
    defect.add(
        own.worlds,
        [&](int world) -> const State& { return judged.ends[i][static_cast<std::size_t>(world)]; }, i);
    own_errors.append(errors_between(own.worlds, judged.ends[i], judged.fewer[i]));
    times_s.push_back({judged.times_s[i]});
    for (const int count : judged.iterations[i]) iterations += (count - iterations) / ++num_solves;
  }
  defect.put_into(result);
  result.own_defect = analysis::summarize(own_errors);
  if (traits_of(one.stepper.kind).iterates) result.solve_iterations = iterations;
  summarize_times(times_s, result);
  return result;
}

}  // namespace pbmpi::app
