/// What the settings of "pbstudy accuracy" are compared with: nature, the limit of ever shorter steps, as far
/// as two independent ways agree on it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "app/pbstudy/study/case_stepper.h"

namespace pbmpi::app {

/// The ways to the limit. Both have rigid contacts and Coulomb's cone of friction in it; with a finite step
/// they have nothing in common but the scene: springs as stiff as the substep bears, with a memory of forces;
/// and rows with ERP and CFM, solved by many sweeps from nothing.
enum class Way { soft, ode };
inline constexpr std::array<std::string_view, 2> way_names = {"soft", "ode"};

/// How short the steps become.
struct NatureLimits {
  int most_steps = 1536;   ///< of a frame
  double error_m = 1e-4;   ///< steps are halved until that moves nine tenths of the bodies by less [m]
  int ode_sweeps = 100;    ///< in each step of Way::ode
  std::uint64_t seed = 1;  ///< of the order of the rows
};

/// The setting of a way with steps of dt.
stepping::StepperSettings settings_of(Way way, double dt_s, const NatureLimits& limits);

/// The setting under which the scene at rest shows what cannot stand: Way::soft with a sixteenth of the
/// scene's step.
stepping::StepperSettings resting_settings(const StudyScene& scene, const NatureLimits& limits);

/// The states [num_worlds] of all worlds.
using States = std::vector<model::State>;

/// A frame by one way: with the shortest steps that were tried, and with half as many.
struct WayEnds {
  int steps = 0;  ///< of the frame, in `finer`
  States coarser, finer;
};

/// A measured frame.
struct NatureFrame {
  std::array<WayEnds, way_names.size()> ways;
  double cpu_s = 0;  ///< processor time
  /// [num_worlds] How far nature is unknown, body by body and joint by joint. A body's uncertainty is the
  /// largest of the ways' distance and of what half as many steps change in either; a joint's is the ways'
  /// distance.
  std::vector<analysis::PoseErrors> uncertainty;

  const WayEnds& by(Way way) const { return ways[static_cast<std::size_t>(way)]; }
};

/// A run in the limit; states are those of Way::soft with its shortest steps.
struct Nature : Reference {
  std::vector<NatureFrame> frames;  ///< [measured frames]

  int first_frame() const { return static_cast<int>(states.size() - frames.size()) - 1; }  ///< measured
  /// [num_worlds] The end of measured frame `i`.
  const States& end(std::size_t i) const { return states[states.size() - frames.size() + i]; }
};

/// Hears of each run of a frame before it begins.
using NatureListener = std::function<void(int frame, int steps)>;
Nature find_nature(const StudyScene& scene, const NatureLimits& limits, const NatureListener& tell = {});

/// Lengths [m] for which a user may ask. A body is determined for one if nature is known to a tenth of it.
inline constexpr std::array<double, 3> asked_m = {1e-3, 1e-2, 1e-1};
inline constexpr double known_share = 0.1;
/// Errors count where nature is known to this length [m].
inline constexpr double judged_m = known_share * asked_m[1];

/// The distances [m] of all bodies of all worlds; infinite where one is not known.
std::vector<double> distances_m(const States& a, const States& b);

/// Leaves the errors of bodies that nature determines to judged_m, and of joints between such bodies; also
/// those that are not finite. `uncertainty` is that of the world.
void keep_judged(const model::Model& model, const analysis::PoseErrors& uncertainty,
                 analysis::PoseErrors& errors);

/// Counts, for each of asked_m, bodies that nature determines for it, and those of them that end within it.
struct WithinCounts {
  std::array<std::int64_t, asked_m.size()> determined{}, within{};
  std::int64_t bodies = 0;

  void count(const analysis::PoseErrors& uncertainty, const analysis::PoseErrors& errors);
  std::array<double, asked_m.size()> determined_shares() const;
  std::array<double, asked_m.size()> within_shares() const;  ///< NaN where nothing is determined
};

}  // namespace pbmpi::app
