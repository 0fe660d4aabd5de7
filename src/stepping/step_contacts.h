/// The contacts and joints of a step.
#pragma once

#include <vector>

#include "model/step_memory.h"

namespace pbmpi::stepping {

/// Contacts and joints of a step, with the forces with which they ended its last substep. With the effect
/// "sleeping", those of awake bodies only.
struct StepContacts {
  std::vector<model::LoadedContact> contacts;  ///< in canonical order, speculative contacts included
  std::vector<model::JointForce> joints;       ///< [num_joints]; arbitrary for a broken joint

  void clear() {
    contacts.clear();
    joints.clear();
  }
};

}  // namespace pbmpi::stepping
