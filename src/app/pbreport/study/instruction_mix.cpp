#include "app/pbreport/study/instruction_mix.h"

#include <cmath>

#include "app/common/format.h"
#include "core/statistics.h"

namespace pbmpi::app {

InstructionMix mean_mix(const std::vector<InstructionMix>& scenes) {
  InstructionMix mean{};
  for (const InstructionMix& mix : scenes) {
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += mix[i] / static_cast<double>(scenes.size());
  }
  return mean;
}

PaperVerdict judge_mix(const std::vector<InstructionMix>& scenes) {
  PaperVerdict verdict{"3.3", "34 % floating point, 25 % integer, 6 % branches, 5 % stores, 30 % loads",
                       "each within five points", Finding::undecidable, "not measured"};
  if (scenes.empty()) return verdict;
  const InstructionMix mean = mean_mix(scenes);
  bool is_near = true;
  verdict.number.clear();
  for (std::size_t i = 0; i < mean.size(); ++i) {
    is_near = is_near && std::abs(mean[i] - paper_mix[i]) <= 0.05;
    verdict.number += format("%s%.0f %% %s", i == 0 ? "" : ", ", 100 * mean[i], mix_names[i]);
  }
  verdict.finding = finding_if(is_near);
  return verdict;
}

PaperVerdict judge_collision_share(const std::vector<double>& shares) {
  PaperVerdict verdict{"3.3", "collision detection is 7 % of the instructions, 2 to 20 % by scene",
                       "mean of 2 to 20 %", Finding::undecidable, "not measured"};
  if (shares.empty()) return verdict;
  const core::Summary summary = core::summarize(shares);
  verdict.finding = finding_if(summary.mean >= 0.02 && summary.mean <= 0.20);
  verdict.number =
      format("%.0f %%, %.0f to %.0f %%", 100 * summary.mean, 100 * summary.min, 100 * summary.max);
  return verdict;
}

}  // namespace pbmpi::app
