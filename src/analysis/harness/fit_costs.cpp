#include "analysis/harness/fit_costs.h"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

namespace pbmpi::analysis {
namespace {

using Terms = std::vector<double>;

/// A measured time, and how often each cost counts in it.
struct Equation {
  Terms terms;
  double seconds;
};

/// Least squares of relative errors; a cost that would be negative is 0, and the others are fitted again.
Terms fit(const std::vector<Equation>& equations, std::size_t num_costs) {
  Terms costs(num_costs, 0);
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < num_costs; ++i) used.push_back(i);
  while (!used.empty() && !equations.empty()) {
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(equations.size()),
                           static_cast<Eigen::Index>(used.size()));
    for (std::size_t row = 0; row < equations.size(); ++row) {
      for (std::size_t i = 0; i < used.size(); ++i)
        matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)) =
            equations[row].terms[used[i]] / equations[row].seconds;
    }
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(matrix.rows());
    const Eigen::VectorXd found = matrix.colPivHouseholderQr().solve(ones);
    Eigen::Index least = 0;
    if (found.minCoeff(&least) < 0) {
      used.erase(used.begin() + least);
      continue;
    }
    for (std::size_t i = 0; i < used.size(); ++i) costs[used[i]] = found[static_cast<Eigen::Index>(i)];
    break;
  }
  return costs;
}

/// How often each cost of a part counts in the time of a case.
Terms terms_of(const TimedCase& one) {
  const auto worlds = static_cast<double>(one.worlds), bodies = static_cast<double>(one.bodies);
  const auto ranks = static_cast<double>(one.ranks);
  switch (one.part) {
    case TimedPart::frame:
      return {1, worlds, worlds * static_cast<double>(one.steps), worlds * bodies};
    case TimedPart::unpack:
      return {worlds, worlds * bodies};
    case TimedPart::balance:
      return {worlds, ranks};
    case TimedPart::table:
    case TimedPart::hash:
      return {worlds};
    case TimedPart::bodies:
      return {worlds * bodies};
    case TimedPart::message:
      return {1, static_cast<double>(one.bytes)};
    case TimedPart::send:
    case TimedPart::receive:
    case TimedPart::move:
      return {1};
  }
  return {};
}

Terms costs_of(std::span<const TimedCase> cases, TimedPart part, std::size_t num_costs) {
  std::vector<Equation> equations;
  for (const TimedCase& one : cases) {
    if (one.part == part && one.seconds > 0) equations.push_back({terms_of(one), one.seconds});
  }
  return fit(equations, num_costs);
}

}  // namespace

HarnessCosts fit_costs(std::span<const TimedCase> cases) {
  HarnessCosts costs;
  const Terms frame = costs_of(cases, TimedPart::frame, 4);
  costs.frame_s = frame[0];
  costs.world_frame_s = frame[1];
  costs.world_step_s = frame[2];
  costs.body_frame_s = frame[3];
  const Terms unpack = costs_of(cases, TimedPart::unpack, 2);
  costs.unpack_world_s = unpack[0];
  costs.unpack_body_s = unpack[1];
  const Terms balance = costs_of(cases, TimedPart::balance, 2);
  costs.balance_world_s = balance[0];
  costs.balance_rank_s = balance[1];
  costs.table_world_s = costs_of(cases, TimedPart::table, 1)[0];
  costs.hash_world_s = costs_of(cases, TimedPart::hash, 1)[0];
  costs.hash_body_s = costs_of(cases, TimedPart::bodies, 1)[0];
  const Terms message = costs_of(cases, TimedPart::message, 2);
  costs.link.byte_s = message[1];
  costs.link.overhead_s = std::min(costs_of(cases, TimedPart::send, 1)[0], message[0] / 2);
  costs.link.latency_s = message[0] - 2 * costs.link.overhead_s;
  costs.link.gap_s = costs_of(cases, TimedPart::receive, 1)[0];
  return costs;
}

}  // namespace pbmpi::analysis
