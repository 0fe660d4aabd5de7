/// Applies the model's rules to contacts, and shows them.
#pragma once

#include <span>
#include <vector>

#include <mujoco/mujoco.h>

#include "model/contact.h"
#include "model/model.h"
#include "model/touch_rule.h"
#include "stepping/step_contacts.h"

namespace pbmpi::mujoco {

/// MuJoCo gives a pair the larger friction of its two geoms, and can exclude only whole bodies from
/// collision. Its contacts are therefore adjusted before rows are made of them.
class Touches {
 public:
  /// `model` is borrowed. `has_friction`: is the effect on?
  Touches(const model::Model& model, std::span<const std::int32_t> broken_in, bool has_friction,
          const mjModel& compiled);

  /// Drops the contacts of pairs that may not touch, and sets the friction of the others.
  void apply(mjData& data) const;
  /// Number of rows of all contacts.
  static int count_rows(const mjData& data);

  /// The contact in the model's form: the normal points into body a, which is real.
  model::Contact contact(const mjContact& found) const;
  /// Appends all contacts of the step that was solved, and their forces, in canonical order. `before`: the
  /// centres of the bodies before that step [m].
  void show(const mjModel& compiled, const mjData& data, std::span<const model::Vec3> before,
            stepping::StepContacts& shown) const;

 private:
  model::GeomPair pair_of(const mjContact& found) const;

  const model::Model* model_;
  model::TouchRule rule_;
  bool has_friction_;
  std::vector<int> geoms_;  ///< [MuJoCo's geoms] index of the model's geom
};

}  // namespace pbmpi::mujoco
