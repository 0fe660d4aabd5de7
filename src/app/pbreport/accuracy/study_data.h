/// A study of accuracy read back, and the choice among its settings.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/error_table.h"
#include "app/pbreport/accuracy/study_options.h"
#include "io/table/table_file.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// A row of /cases.
struct StudyCase {
  std::string scene, kind;
  stepping::StepperSettings stepper;
  int steps_per_frame = 0, worlds = 1, warmup = 0, frames = 0;
  int estimate_iterations = 0;  ///< FEEC's, for a look or for each step of a short run; 0: the frame's end
  int estimate_after = 0;       ///< number of precise steps before the estimate
  bool is_look = false;         ///< into the solve of the frame's last step
  double time_s = 0;            ///< for the worst measured frame: what a budget must hold
  double median_time_s = 0;     ///< over the measured frames
  double row_visits = 0;
  double joint_gap_m = 0, penetration_m = 0, energy_change_j = 0;
  /// The scene at rest: number of bodies that fell, time when the first did, creep of the fastest [m/s],
  /// energy gained without a cause [J]. NaN if the study did not watch it.
  double rest_fallen = NAN, rest_fell_at_s = NAN, rest_creep_m_s = NAN, rest_energy_gain_j = NAN;
  /// For a case that is solved like the reference: the largest residual of a step [m], and the mean number of
  /// its iterations. NaN for others, and in older files.
  double solve_residual_m = NAN, solve_iterations = NAN;
  analysis::ErrorTable defect, drift;
  /// Against its own equations solved by its own stepper; an own solution against itself with a quarter of
  /// its iterations, and one from disturbed states against the undisturbed one. No entries: not measured.
  analysis::ErrorTable own_defect;
  int own = -1;  ///< the row of its own solution; -1: none

  /// Did every body and joint stay finite?
  bool finite() const;
  /// Does the setting make a structure fall that should stand, as far as the study knows?
  bool fells() const { return rest_fallen > 0; }
  /// The error by which settings are ranked [m].
  double error_m(ErrorMeasure measure) const;

  /// Was it compared with its own solution?
  bool has_own() const { return own_defect.body_position.count > 0; }
  /// The error against its own solution [m], by the same measure; NaN without one.
  double own_error_m(ErrorMeasure measure) const;
};

/// "sor single, 2 substeps x 3 iterations"; values that all settings share are left out.
std::string setting_text(const StudyCase& one);
/// The options of pbmpi that give this setting, e.g. {"stepper", "sor"}.
std::vector<std::pair<std::string, std::string>> setting_options(const StudyCase& one);

/// The cases of one scene.
struct SceneCases {
  std::string name;
  std::vector<StudyCase> settings;
  std::vector<StudyCase> estimates;  ///< for the scene's own setting; never chosen, since more work follows
  std::vector<StudyCase> floor;
  std::vector<StudyCase> own;        ///< own solutions of the steppers (since version 1.6)
  std::vector<StudyCase> own_floor;  ///< own solutions from disturbed states
  std::optional<StudyCase> reference, more_iterations, second_method,
      halved_dt;                                                ///< older files lack some
  std::optional<StudyCase> halved_iterations, halved_substeps;  ///< in older files

  /// The noise floor [m]: the largest error that another seed alone gave the reference.
  double floor_m(ErrorMeasure measure) const;
  /// The noise floor [m] of a stepper's own solution: the largest error that a disturbance of its start and
  /// another seed gave it. NaN if none was measured.
  double own_floor_m(stepping::StepperKind kind, ErrorMeasure measure) const;
  /// How far the reference may be off [m]: its largest distance from itself with other seeds and more
  /// iterations (in older files half as many), and from a second method. The effect of the step's length is
  /// excluded: all settings share it.
  double uncertainty_m(ErrorMeasure measure) const;
  double uncertainty(const std::function<double(const StudyCase&)>& error) const;
  /// Indices of the settings that no other beats in both time and error, by ascending time: the error falls
  /// from each to the next. Excludes settings that blew up.
  std::vector<std::size_t> pareto_front(ErrorMeasure measure) const;
  std::vector<std::size_t> pareto_front(const std::function<double(const StudyCase&)>& error) const;
  /// The front of the settings that let nothing fall at rest.
  std::vector<std::size_t> standing_front(ErrorMeasure measure) const;
  /// The setting with the least error within the time, or the least time within the error, among those that
  /// let nothing fall at rest.
  std::optional<std::size_t> best_within(double budget_s, ErrorMeasure measure) const;
  std::optional<std::size_t> cheapest_within(double tolerance_m, ErrorMeasure measure) const;
};

/// In the order of the file. Throws core::InputError for a scene that is not in it.
std::vector<SceneCases> study_scenes(const io::TableFile& file, const std::vector<std::string>& names);

}  // namespace pbmpi::app
