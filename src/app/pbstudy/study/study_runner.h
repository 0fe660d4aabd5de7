/// How a study runs, whatever its cases are: scenes, cases dealt out over the ranks, results, the file.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/common/progress_line.h"
#include "app/common/provenance.h"
#include "app/pbstudy/study/study_options.h"
#include "app/pbstudy/study/study_scene.h"
#include "core/error.h"
#include "io/table/table_file.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// What a study adds to what the files of all studies hold, and to what is printed at the end.
struct StudyContent {
  std::vector<io::Parameter> parameters;
  std::vector<io::TableColumn> cases;                          ///< a row a case
  std::map<std::string, std::vector<io::TableColumn>> tables;  ///< others, by name
  std::string note;                                            ///< lines for the end of the run
  std::string next;                                            ///< options of pbreport to go on with
};

/// All calls are collective, and made in this order: open_output(), run(), write().
class StudyRunner {
 public:
  /// Reads the scenes. `name`: of the study, e.g. "accuracy". `comm` and `options` are borrowed. Throws
  /// core::InputError on every rank.
  StudyRunner(const mpi::Communicator& comm, std::string name, const StudyOptions& options);

  const std::vector<StudyScene>& scenes() const { return scenes_; }
  const StudyScene& scene(int index) const { return scenes_[static_cast<std::size_t>(index)]; }

  /// Makes sure that the file can be written before the work begins, if `check` (on root) throws nothing.
  void open_output(const std::function<void()>& check = {});

  /// Runs the cases whose `owner` [num_cases] is this rank, one at a time and in their order, with
  /// run_case(index); all ranks get all results in the order of the cases. A case has a `scene`, a result is
  /// plain data with an `index`. What `run_case` throws on one rank, all throw.
  template <class Result, class Case, class RunCase>
  std::vector<Result> run(const std::vector<Case>& cases, const std::vector<int>& owner, RunCase&& run_case);

  /// Root writes what `content` (called on root) gives, and prints where it is.
  void write(const std::function<StudyContent()>& content);

 private:
  void require_distinct_names() const;
  io::TableFile file_with(StudyContent content) const;
  void print_end(const StudyContent& content) const;
  void case_done(int scene);

  const mpi::Communicator& comm_;
  std::string name_;
  const StudyOptions& options_;
  std::vector<StudyScene> scenes_;
  Provenance provenance_;
  std::unique_ptr<io::TableWriter> writer_;  ///< on root
  std::optional<ProgressLine> progress_;     ///< on root, of its own cases: they stand for the others'
  std::size_t num_cases_ = 0, own_cases_ = 0, own_done_ = 0;
};

template <class Result, class Case, class RunCase>
std::vector<Result> StudyRunner::run(const std::vector<Case>& cases, const std::vector<int>& owner,
                                     RunCase&& run_case) {
  num_cases_ = cases.size();
  own_cases_ = static_cast<std::size_t>(std::count(owner.begin(), owner.end(), comm_.rank()));
  const auto own = mpi::agree_on_errors(comm_, [&] {
    std::vector<Result> results;
    for (std::size_t i = 0; i < owner.size(); ++i) {
      if (owner[i] != comm_.rank()) continue;
      results.push_back(run_case(i));
      results.back().index = static_cast<int>(i);
      case_done(cases[i].scene);
    }
    return results;
  });
  progress_.reset();
  const std::vector<Result> all = comm_.allgatherv(std::span<const Result>(own));
  core::require_invariant(all.size() == owner.size(), "every case has one result");
  std::vector<Result> ordered(owner.size());
  for (const Result& result : all) ordered[static_cast<std::size_t>(result.index)] = result;
  return ordered;
}

}  // namespace pbmpi::app
