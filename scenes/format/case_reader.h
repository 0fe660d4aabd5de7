/// The scene's [case]: what makes it a hard case, and how a run of it is judged.
#pragma once

#include <string>
#include <vector>

#include "scenes/format/table_reader.h"
#include "scenes/parts/growing_model.h"
#include "stability/cases/hard_case.h"

namespace pbmpi::scenes {

class CaseReader {
 public:
  explicit CaseReader(TableReader& table);

  const stability::HardCase& hard_case() const { return case_; }
  /// Throws core::InputError at the name of a body that `model`, a world of the scene, does not have, or at a
  /// name prefix that no body's name begins with.
  void require_bodies(GrowingModel& model) const;

 private:
  void read_region(TableReader& table);
  void read_bounds(TableReader& table);
  void read_expectation(TableReader& table);

  stability::HardCase case_;
  std::string watch_where_;
  std::vector<std::string> expect_where_;  ///< [expectations] place of the body's name in the file
};

}  // namespace pbmpi::scenes
