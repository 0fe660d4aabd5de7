/// Brings all states, counts and times to root at the end of a frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.h"
#include "model/islands.h"
#include "mpi/comm/message.h"
#include "mpi/comm/processor_time.h"
#include "mpi/spaces/step/crossing_search.h"
#include "mpi/spaces/step/rank_islands.h"
#include "mpi/spaces/step/step_context.h"

namespace pbmpi::mpi {

/// Root's measurements of the last step of a frame, over all ranks.
struct FrameFindings {
  stepping::Observables seen;    ///< joined over all ranks; excludes what root measures over all bodies
  std::vector<int> island;       ///< [num_units] lowest unit of its island
  std::vector<double> weight;    ///< [num_units] rows of joints and contacts, and bodies
  std::vector<char> near;        ///< [num_units] is a body of its island in the field? empty without a field
  std::vector<double> energy_j;  ///< [num_bodies]
  stepping::StepContacts contacts;  ///< of all ranks, if they are recorded
  std::vector<core::PhaseTimes>
      times;  ///< [num_ranks] of this frame so far, as if each rank had a core of its own
  std::int64_t bodies_shipped = 0;  ///< in this frame, from any rank to another, summed over its steps
};

/// Each rank measures its own bodies and sends root one message: the rows of its bodies, the memory of its
/// units, its boxes, counts, energies, times and islands. Root then has the whole state and the findings of
/// the frame.
///
/// SpaceStep calls send() on every rank at the end of the last step of a frame, even where all bodies sleep
/// or are on one rank.
class FrameReport {
 public:
  /// All borrowed.
  FrameReport(StepContext& shared, RankIslands& islands, CrossingSearch& crossing)
      : shared_(&shared), islands_(&islands), crossing_(&crossing) {}

  /// To be called before the first step of a frame.
  void start_frame() { processor_before_s_ = processor_time_s(); }
  /// Collective. `work`: what this rank solved in the last step; `bodies_shipped`: by this rank in this
  /// frame.
  void send(const StepWork& work, std::int64_t bodies_shipped, core::PhaseTimes& times);

  const FrameFindings& findings() const { return findings_; }  ///< findings of the last frame, on root

 private:
  /// One rank's part of the findings.
  struct Account {
    stepping::Observables seen;
    std::span<const double> energy_j;  ///< [bodies of the rank]
    core::PhaseTimes times;
    std::int64_t bodies_shipped = 0;
    std::span<const std::int32_t> island_of_unit;  ///< [units of the rank] as in LocalIslands
    std::span<const std::int32_t> unit_weight;     ///< [units of the rank]
    std::span<const char> unit_near;               ///< [units of the rank] with a field of interest
  };
  std::vector<double> own_energies() const;
  double own_joint_gap() const;
  void take_contacts(const stepping::StepContacts& part);
  void post(const Account& own);
  void receive(const Account& own, core::LapTimer& timer);
  void take_rows(int rank, MessageReader& message);
  Account read_account(MessageReader& message) const;
  void clear();
  void add(int rank, const Account& account, model::DisjointSets& islands);
  void join_islands(model::DisjointSets& islands);

  StepContext* shared_;
  RankIslands* islands_;
  CrossingSearch* crossing_;
  FrameFindings findings_;
  stepping::StepContacts own_contacts_;
  double processor_before_s_ = 0;  ///< processor_time_s() when the frame began
};

}  // namespace pbmpi::mpi
