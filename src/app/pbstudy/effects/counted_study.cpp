#include "app/pbstudy/effects/counted_study.h"

#include "app/pbstudy/effects/effects_table.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

/// The columns in which two studies must agree before one can take the other's counts.
const std::vector<std::string> setting_columns = {"scene",           "kind",       "effect", "stepper",
                                                  "precision",       "iterations", "dt",     "solver_seed",
                                                  "steps_per_frame", "worlds",     "warmup", "frames"};

/// Throws unless `columns` has a column `name` whose values equal the file's.
void require_equal(const io::TableFile& file, const std::vector<io::TableColumn>& columns,
                   const std::string& name, const std::string& refusal) {
  for (const io::TableColumn& mine : columns) {
    if (mine.name != name) continue;
    for (const io::TableColumn& theirs : file.tables.at("cases")) {
      if (theirs.name == name) core::require_input(mine.values == theirs.values, refusal);
    }
  }
}

}  // namespace

CountedStudy::CountedStudy(std::string path, const std::vector<StudyScene>& scenes,
                           const std::vector<EffectCase>& cases)
    : path_(std::move(path)), file_(io::read_table_file(path_, io::study_filetype)) {
  const auto study = file_.attributes.find("study");
  core::require_input(study != file_.attributes.end() && study->second == "effects",
                      path_ + ": no study of effects; --instructions-from wants a file of pbstudy effects");
  file_.column<double>("cases", "instructions_with");
  const auto columns = effect_columns(scenes, cases, std::vector<EffectResult>(cases.size()), false);
  for (const std::string& name : setting_columns) {
    require_equal(file_, columns, name,
                  path_ + ": its cases are not those of this study, they differ in " + name +
                      "; give both the same options");
  }
}

std::string CountedStudy::source() const {
  for (const io::Parameter& parameter : file_.parameters) {
    if (parameter.name == "instructions_by") return parameter.text;
  }
  return "none";
}

void CountedStudy::give_counts(std::vector<EffectResult>& results) const {
  const auto columns = effect_columns({}, {}, results, false);
  for (const char* name : {"hash_baseline", "hash_variant"}) {
    require_equal(file_, columns, name,
                  path_ +
                      ": its states are not those of this study, so that its counts are of something else; "
                      "count with the same build");
  }
  const auto& with = file_.column<double>("cases", "instructions_with");
  const auto& without = file_.column<double>("cases", "instructions_without");
  for (std::size_t i = 0; i < results.size(); ++i) {
    results[i].instructions_with = with[i];
    results[i].instructions_without = without[i];
  }
}

}  // namespace pbmpi::app
