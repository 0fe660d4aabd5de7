/// What all parts of a divided world's step share.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "effects/field_of_interest.h"
#include "effects/space_sleepers.h"
#include "model/contact.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"
#include "mpi/comm/message.h"
#include "mpi/comm/pending_messages.h"
#include "mpi/spaces/plan/space_ownership.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// Tags of the messages of a step, one for each kind of message.
enum StepTag : int {
  border_tag = 1,  ///< CrossingSearch: to root, at the end of a step
  more_tag,        ///< CrossingSearch: to root, what it asks for in a step
  verdict_tag,     ///< CrossingSearch: from root
  report_tag,      ///< IslandDispatch: to root
  orders_tag,      ///< IslandDispatch: from root
  ship_tag,        ///< IslandShipping: to the rank that solves
  back_tag,        ///< IslandShipping: to the rank that owns
  frame_tag,       ///< FrameReport: to root
  center_tag,      ///< FieldCenter: from the owner of the followed body to all
};

/// Owned by SpaceStep, borrowed by its parts.
struct StepContext {
  const Communicator* comm = nullptr;          ///< borrowed, as are the next four
  stepping::SpaceStepper* stepper = nullptr;   ///< the engine, which holds this rank's copy of the world
  ErrorHold* errors = nullptr;                 ///< holds what the engine throws until the ranks agree on it
  effects::SpaceSleepers* sleepers = nullptr;  ///< null without the effect "sleeping"
  effects::FieldOfInterest* field = nullptr;   ///< null without the effect "field_of_interest"
  std::unique_ptr<Mail> mail;                  ///< none for a single rank, which sends nothing
  std::optional<SpaceOwnership> ownership;     ///< set by SpaceStep::own()
  bool crosses = false;       ///< Can bodies of two ranks touch? Otherwise steps exchange no islands.
  bool joints_break = false;  ///< the effect "breakable_joints"
  bool remembers = false;     ///< a step hands on forces to the next
  bool records = false;       ///< the frame's last step is recorded with its contacts and forces

  bool is_root() const { return comm->is_root(); }
  const std::vector<int>& own_spaces() const { return ownership->spaces[comm->rank()]; }
  const std::vector<int>& own_units() const { return ownership->units[comm->rank()]; }
  const std::vector<int>& own_bodies() const { return ownership->bodies[comm->rank()]; }

  /// Writes what is sent of units in addition to the states of their bodies: their broken joints, and the
  /// forces that a step hands on.
  void put_units(std::span<const int> units, MessageWriter& message) const {
    if (joints_break) message.put(stepper->broken_rows(units));
    if (remembers) message.put(stepper->memory_rows(units));
  }
  /// Reads what put_units() wrote.
  void take_units(std::span<const int> units, MessageReader& message) const {
    if (joints_break) stepper->put_broken(units, message.get<std::int32_t>());
    if (remembers) stepper->put_memory(units, message.get<double>());
  }

  /// Calls `function` unless an error is held already; holds what it throws. The messages of the step are
  /// exchanged regardless, so that no rank waits for another in vain.
  template <class Function>
  void guard(Function&& function) {
    if (!errors->failed()) errors->guard(std::forward<Function>(function));
  }
};

/// Contacts and units that this rank solves in a step: its own, until islands are shipped.
struct StepWork {
  std::vector<model::Contact> contacts;  ///< in canonical order
  std::vector<int> units;                ///< ascending
};

}  // namespace pbmpi::mpi
