/// Runs of the other programs of this build for "pbstudy prediction": pbmpi, alone or under pbvalue, and
/// pbreport.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/pbstudy/prediction/prediction_cases.h"
#include "core/system/child.h"

namespace pbmpi::app {

/// The folder for VALGRIND_LIB.
std::string tool_folder();
/// Was this program built?
bool has_program(const std::string& name);

/// A finished run of a program.
struct ChildRun {
  core::ChildEnd end;
  std::string errors;      ///< what it wrote to its standard error
  nlohmann::json summary;  ///< what it printed; null if that is not JSON

  /// Did the run take all its frames, or end at one with a number that is not finite?
  bool has_ended_well() const { return end.exit_code == 0 || (end.exit_code == 1 && nonfinite_frame() >= 0); }
  /// The frame of "... non-finite body in frame 3"; -1 if there is none.
  int nonfinite_frame() const;
};

/// A run that must end well: throws core::RunError otherwise. `what` names it.
void require_end(const ChildRun& run, const std::string& what);

/// Starts runs whose files lie in a folder that is removed with this object.
class ChildRuns {
 public:
  /// `time_limit_s`: for each run.
  explicit ChildRuns(double time_limit_s);
  ~ChildRuns();
  ChildRuns(const ChildRuns&) = delete;
  ChildRuns& operator=(const ChildRuns&) = delete;

  std::string file(const std::string& name) const { return folder_ + "/" + name; }

  /// Runs pbmpi over all frames of the scene; it writes NAME.h5. `before`: a command to put before it, or
  /// none; `more`: its last options; `steps_per_frame`: replaces the scene's.
  ChildRun simulate(const std::string& name, const PredictionCase& one, const StudyScene& scene,
                    std::vector<std::string> before, const std::vector<std::string>& more,
                    int steps_per_frame = 0);
  /// Runs "pbreport diff" on two files; a null summary if nothing can be compared.
  ChildRun difference(const std::string& file, const std::string& reference);

 private:
  ChildRun start(const std::string& name, core::Child& child);

  std::string folder_;
  double time_limit_s_;
};

}  // namespace pbmpi::app
