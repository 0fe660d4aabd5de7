/// What the file of "pbstudy accuracy" keeps of nature: /nature and /nature_bodies.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "app/pbstudy/accuracy/accuracy_cases.h"
#include "app/pbstudy/accuracy/nature.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// A measured frame: how far both ways went, and what is known.
struct NatureFrameRow {
  int case_index = 0;
  int frame = 0;
  std::array<int, 2> steps{};  ///< of the frame, by Way
  /// What half as many steps change of the positions [m], by Way; and how far apart the ways are.
  std::array<double, 2> halved_median_m{}, halved_p90_m{};
  double apart_median_m = 0, apart_p90_m = 0;
  std::array<double, asked_m.size()> determined{};  ///< shares of the bodies
};

/// A body at the end of a measured frame.
struct NatureBodyRow {
  int case_index = 0;
  int frame = 0, world = 0, body = 0;
  /// Positions [m], world frame: soft with half as many steps, soft, ode with half as many, ode.
  std::array<std::array<double, 3>, 4> ends{};
  double uncertainty_m = 0;
};

std::vector<NatureFrameRow> frame_rows(const Nature& nature);
std::vector<NatureBodyRow> body_rows(const Nature& nature);

/// The two tables by name.
std::map<std::string, std::vector<io::TableColumn>> nature_tables(const std::vector<StudyScene>& scenes,
                                                                  const std::vector<AccuracyCase>& cases,
                                                                  const std::vector<NatureFrameRow>& frames,
                                                                  const std::vector<NatureBodyRow>& bodies);

}  // namespace pbmpi::app
