/// A world's model in MuJoCo's form, for one set of joints that hold.
#pragma once

#include <cstdint>
#include <vector>

#include "mujoco/constraints.h"
#include "mujoco/coordinates.h"
#include "mujoco/engine.h"
#include "mujoco/joint_loads.h"
#include "mujoco/mjcf.h"
#include "mujoco/touches.h"
#include "mujoco/tree/joint_links.h"
#include "mujoco/tree/joint_tree.h"

namespace pbmpi::mujoco {

struct Compiled {
  /// `model` is borrowed. `broken`: as State::broken_in; when other joints break, another tree is needed.
  Compiled(const model::Model& model, const std::vector<std::int32_t>& broken,
           const stepping::StepperSettings& settings, bool has_friction)
      : broken_in(broken),
        tree(make_joint_tree(model, broken_in)),
        links(make_links(model, tree)),
        constraints(make_constraints(model, tree, links)),
        engine(
            [&](int stack) {
              return mjcf_text({model, links, constraints, broken_in, settings}, stack);
            },
            stack_to_compile(model.num_bodies(), degrees_of_freedom(links))),
        at(links, engine.model()),
        touches(model, broken_in, has_friction, engine.model()),
        loads(model, links, at) {
    place_closures(constraints, engine.model());
  }
  Compiled(const Compiled&) = delete;
  Compiled& operator=(const Compiled&) = delete;

  /// Largest number of rows of constraints other than contacts.
  int rows_without_contacts() const {
    const mjModel& compiled = engine.model();
    constexpr int rows_of_weld = 6, rows_of_connect = 3, rows_of_axis = 2;  // a motor, and one of its limits
    int rows = 0;
    for (int i = 0; i < compiled.neq; ++i) {
      rows += compiled.eq_type[i] == mjEQ_WELD      ? rows_of_weld
              : compiled.eq_type[i] == mjEQ_CONNECT ? rows_of_connect
                                                    : 1;
    }
    for (int i = 0; i < compiled.njnt; ++i) rows += compiled.jnt_type[i] == mjJNT_FREE ? 0 : rows_of_axis;
    return rows;
  }

  std::vector<std::int32_t> broken_in;
  JointTree tree;
  std::vector<Link> links;
  Constraints constraints;
  Engine engine;
  Coordinates at;
  Touches touches;
  JointLoads loads;
};

}  // namespace pbmpi::mujoco
