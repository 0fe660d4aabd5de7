/// Counts of instructions from a study of effects that counted them.
#pragma once

#include <string>
#include <vector>

#include "app/pbstudy/effects/effects_runner.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

class CountedStudy {
 public:
  /// Throws core::InputError if the file is no study of effects, has no counts, or has other cases than
  /// these.
  CountedStudy(std::string path, const std::vector<StudyScene>& scenes, const std::vector<EffectCase>& cases);

  /// The source of the counts, as core::name_of names it.
  std::string source() const;
  /// Puts the counts into `results` [num_cases]. Throws core::InputError if their states differ from the
  /// counted ones.
  void give_counts(std::vector<EffectResult>& results) const;

 private:
  std::string path_;
  io::TableFile file_;
};

}  // namespace pbmpi::app
