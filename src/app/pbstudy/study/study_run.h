/// How a study runs: cases dealt out over the ranks, their results brought together.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/common/options.h"
#include "app/common/provenance.h"
#include "core/error.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// One line of stderr that is written over: root's own cases, which stand for the others'.
class CaseProgress {
 public:
  /// Draws on root only, as `common` wants it. `total` = cases of this rank.
  CaseProgress(const CommonOptions& common, bool is_root, std::size_t total);
  ~CaseProgress();
  CaseProgress(const CaseProgress&) = delete;
  CaseProgress& operator=(const CaseProgress&) = delete;

  /// A case of `scene` is done.
  void next(const std::string& scene);

 private:
  bool wanted_;
  bool drawn_ = false;
  std::size_t done_ = 0, total_;
};

/// Collective. Runs the cases whose `owner` [num_cases] is this rank, one at a time and in their order, with
/// run(index); all ranks get all results in the order of the cases. Result is plain data with an `index`.
/// What `run` throws on one rank, all throw.
template <class Result, class Run>
std::vector<Result> run_dealt_out(const mpi::Communicator& comm, const std::vector<int>& owner, Run&& run) {
  const auto own = mpi::agree_on_errors(comm, [&] {
    std::vector<Result> results;
    for (std::size_t i = 0; i < owner.size(); ++i) {
      if (owner[i] != comm.rank()) continue;
      results.push_back(run(i));
      results.back().index = static_cast<int>(i);
    }
    return results;
  });
  const std::vector<Result> all = comm.allgatherv(std::span<const Result>(own));
  core::require_invariant(all.size() == owner.size(), "every case has one result");
  std::vector<Result> ordered(owner.size());
  for (const Result& result : all) ordered[static_cast<std::size_t>(result.index)] = result;
  return ordered;
}

/// Attributes of the root of a study's file.
std::map<std::string, std::string> study_attributes(const std::string& study, const Provenance& provenance);

}  // namespace pbmpi::app
