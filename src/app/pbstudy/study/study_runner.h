/// Runs a study of any kind of cases: scenes, cases that ranks take one by one, results, the file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/common/progress_line.h"
#include "app/common/provenance.h"
#include "app/pbstudy/study/case_journal.h"
#include "app/pbstudy/study/case_outcome.h"
#include "app/pbstudy/study/study_options.h"
#include "app/pbstudy/study/study_scene.h"
#include "core/error.h"
#include "io/table/table_file.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"
#include "mpi/comm/shared_counter.h"

namespace pbmpi::app {

/// While an object of this class lives, USR2 is noted: a job script sends it to mpirun when the time is up,
/// and mpirun passes it to all ranks. At most one object at a time. INT and TERM end the process at once; the
/// outcomes so far are in the journal.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool is_set() const;
};

/// What a study adds to the common content of all studies' files,
struct StudyContent {
  std::vector<io::Parameter> parameters;
  std::vector<io::TableColumn> cases;                          ///< one row per case
  std::map<std::string, std::vector<io::TableColumn>> tables;  ///< other tables, by name
  std::string next;                                            ///< options of pbreport for the next look
};

/// What the files of all studies say of their run: attributes, and as parameters seed, repeats, ranks, build.
io::TableFile study_file(const std::string& study, const Provenance& provenance, std::uint64_t seed,
                         int repeats);

/// Thrown on all ranks when a study was stopped before all its cases were done: it is incomplete, and can go
/// on.
struct StudyStopped {
  std::string message;
};

/// All calls are collective, in this order: open_output(), run(), write().
class StudyRunner {
 public:
  /// Reads the scenes. `name`: the study's, e.g. "accuracy". `comm` and `options` are borrowed. Throws
  /// core::InputError on every rank.
  StudyRunner(const mpi::Communicator& comm, std::string name, const StudyOptions& options);

  const std::vector<StudyScene>& scenes() const { return scenes_; }
  const StudyScene& scene(int index) const { return scenes_[static_cast<std::size_t>(index)]; }

  /// Makes sure before the work begins that the file can be written.
  void open_output();

  /// Runs cases, one at a time, with run_case(index), which gives a CaseOutcome, or a Result; all ranks get
  /// the outcomes of all cases, in their order. A case has a `scene`. A rank that is done with a case takes
  /// the next: scene by scene, and the dearest by cost_of(case), in any unit, first. Outcomes are kept in a
  /// journal beside the output until write(); with --resume, cases already in it are not run again. If
  /// `run_case` throws on one rank, all ranks throw; StudyStopped if a rank was asked to stop, or the time is
  /// up.
  template <class Result, class... Rows, class Case, class CostOf, class RunCase>
  CaseOutcomes<Result, Rows...> run(const std::vector<Case>& cases, CostOf&& cost_of, RunCase&& run_case);

  /// On root, where progress is shown: what its case does just now, e.g. "CrashSk: nature, frame 3 of 8".
  void show_progress(const std::string& what);

  /// Root writes the result of `content` (called on root), and prints the file's path.
  void write(const std::function<StudyContent()>& content);

 private:
  void require_distinct_names() const;
  io::TableFile file_with(StudyContent content) const;
  void print_end(const StudyContent& content) const;
  void case_done(int scene);
  /// Collective. Reads the journals' outcomes on root, and on all ranks which cases they are.
  void open_journal(std::uint64_t layout, std::size_t num_cases);
  std::uint64_t key_of(std::uint64_t layout) const;
  bool is_to_stop() const;
  /// Collective. Throws StudyStopped if cases were left out.
  void require_all_done() const;
  /// The cases that are not kept, in the order in which ranks take them. `scene`, `cost`: [num_cases].
  std::vector<std::size_t> cases_to_do(const std::vector<int>& scene, const std::vector<double>& cost) const;

  const mpi::Communicator& comm_;
  std::string name_;
  const StudyOptions& options_;
  std::vector<StudyScene> scenes_;
  Provenance provenance_;
  StopRequest stop_;
  double start_s_;
  std::unique_ptr<io::TableWriter> writer_;  ///< on root
  std::unique_ptr<CaseJournal> journal_;
  std::map<std::int64_t, std::vector<std::byte>> kept_;  ///< on root: outcomes of an earlier run
  std::vector<char> is_kept_;                            ///< [num_cases]
  std::optional<ProgressLine> progress_;                 ///< on root
  std::unique_ptr<mpi::SharedCounter> done_;             ///< cases of all ranks
  std::size_t num_cases_ = 0;
  std::int64_t num_to_do_ = 0, own_done_ = 0;
};

template <class Result, class... Rows, class Case, class CostOf, class RunCase>
CaseOutcomes<Result, Rows...> StudyRunner::run(const std::vector<Case>& cases, CostOf&& cost_of,
                                               RunCase&& run_case) {
  std::vector<double> cost(cases.size());
  std::ranges::transform(cases, cost.begin(), cost_of);
  std::vector<int> scene(cases.size());
  std::ranges::transform(cases, scene.begin(), &Case::scene);
  std::uint64_t layout = sizeof(Result);
  ((layout = 31 * layout + sizeof(Rows)), ...);
  open_journal(layout, cases.size());
  num_cases_ = cases.size();
  const std::vector<std::size_t> to_do = cases_to_do(scene, cost);
  num_to_do_ = std::ssize(to_do);
  mpi::SharedCounter taken(comm_);
  done_ = std::make_unique<mpi::SharedCounter>(comm_);
  CaseOutcomes<Result, Rows...> own = mpi::agree_on_errors(comm_, [&] {
    CaseOutcomes<Result, Rows...> outcomes;
    for (const auto& [index, bytes] : kept_) outcomes.append(outcome_of<Result, Rows...>(bytes));
    try {
      while (!is_to_stop()) {
        const std::int64_t next = taken.next();
        if (next >= num_to_do_) break;
        const std::size_t i = to_do[static_cast<std::size_t>(next)];
        CaseOutcome<Result, Rows...> outcome{run_case(i)};
        outcome.set_index(static_cast<int>(i));
        journal_->add(static_cast<std::int64_t>(i), bytes_of(outcome));
        outcomes.append(outcome);
        case_done(cases[i].scene);
      }
    } catch (...) {
      taken.skip(num_to_do_);  // the other ranks end with the case that they are at
      throw;
    }
    return outcomes;
  });
  show_progress(name_);
  progress_.reset();
  require_all_done();
  CaseOutcomes<Result, Rows...> all;
  all.results = comm_.allgatherv(std::span<const Result>(own.results));
  core::require_invariant(all.results.size() == cases.size(), "every case has one result");
  std::ranges::sort(all.results, {}, &Result::index);
  [[maybe_unused]] const auto gather_rows = [&]<class Row>(std::vector<Row>& rows,
                                                           const std::vector<Row>& mine) {
    rows = comm_.allgatherv(std::span<const Row>(mine));
    std::ranges::stable_sort(rows, {}, &Row::case_index);
  };
  (gather_rows(std::get<std::vector<Rows>>(all.rows), own.template rows_of<Rows>()), ...);
  return all;
}

}  // namespace pbmpi::app
