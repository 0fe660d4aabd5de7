/// Runs one case of "pbstudy stability" on this rank.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/pbstudy/stability/stability_options.h"
#include "app/pbstudy/study/study_scene.h"
#include "stability/cases/case_watch.h"
#include "stability/cases/hard_case.h"

namespace pbmpi::app {

/// A hard case at one step length.
struct HardScene {
  std::shared_ptr<const model::Model> model;
  stability::HardCase hard_case;
  double dt_s = 0;

  std::int64_t num_steps() const;
};

/// Throws core::InputError for a scene without [case].
HardScene build_hard_scene(const StudyScene& scene, double dt_s, std::uint64_t seed);

/// A scene under a setting.
struct StabilityCase {
  int scene = 0;    ///< index into the study's scenes
  int setting = 0;  ///< index into its settings
  stepping::StepperSettings stepper;
  bool cut = false;
  std::int64_t num_steps = 0;
  int num_bodies = 0;
  std::string not_applicable;  ///< why the setting cannot run this case; empty: it can
};

/// All cases, scene by scene.
std::vector<StabilityCase> make_stability_cases(const std::vector<StudyScene>& scenes,
                                                const StabilityOptions& options);

/// Expected, in any unit.
double cost_of(const StabilityCase& one);

/// The most expectations of a case; more are refused.
inline constexpr std::size_t most_expectations = 24;

/// Measurements of a case. Sent between ranks as its bytes.
struct StabilityResult {
  int index = 0;  ///< index of the case
  std::array<double, stability::num_metrics> metrics{};
  std::array<double, most_expectations> expected_off{};
  double broken_at_s = 0;
  double simulated_s = 0;
  double step_time_s = 0;  ///< processor time per step, mean
  double row_visits = 0;   ///< per step, mean

  stability::CaseMeasurement measurement(const stability::HardCase& hard_case) const;
};

StabilityResult run_stability_case(const StabilityCase& one, const HardScene& hard);

}  // namespace pbmpi::app
