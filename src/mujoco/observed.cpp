#include "mujoco/observed.h"

#include <algorithm>
#include <vector>

#include "model/islands.h"

namespace pbmpi::mujoco {
namespace {

/// A body that a row acts on; no_body if the row acts on the world alone.
int body_of_row(const Coordinates& at, const Touches& touches, const mjModel& compiled, const mjData& data,
                int row) {
  const int id = data.efc_id[row];
  switch (data.efc_type[row]) {
    case mjCNSTR_EQUALITY: {
      const int object = compiled.eq_obj1id[id];
      return at.body_of(compiled.eq_type[id] == mjEQ_JOINT ? compiled.jnt_bodyid[object] : object);
    }
    case mjCNSTR_FRICTION_DOF:
      return at.body_of(compiled.dof_bodyid[id]);
    case mjCNSTR_LIMIT_JOINT:
      return at.body_of(compiled.jnt_bodyid[id]);
    default:
      return touches.contact(data.contact[id]).body_a;
  }
}

}  // namespace

void count(const model::Model& model, const model::State& state, const Coordinates& at,
           const Touches& touches, const mjModel& compiled, const mjData& data, stepping::Observables& seen) {
  model::DisjointSets sets = model::jointed_bodies(model, state.broken_in);
  seen.max_penetration_m = 0;
  for (int i = 0; i < data.ncon; ++i) {
    const model::Contact contact = touches.contact(data.contact[i]);
    seen.max_penetration_m = std::max(seen.max_penetration_m, contact.depth);
    if (contact.body_b != model::no_body) sets.unite(contact.body_a, contact.body_b);
  }
  std::vector<int> rows(model.bodies.size(), 0);
  for (int row = 0; row < data.nefc; ++row) {
    const int body = body_of_row(at, touches, compiled, data, row);
    if (body != model::no_body) ++rows[sets.find(body)];
  }
  seen.contacts = data.ncon;
  seen.rows = data.nefc;
  seen.row_visits = static_cast<double>(data.nefc) * data.solver_iter;
  seen.max_island_rows = rows.empty() ? 0 : *std::ranges::max_element(rows);
  seen.islands = 0;
  for (int body = 0; body < model.num_bodies(); ++body) seen.islands += sets.find(body) == body ? 1 : 0;
}

}  // namespace pbmpi::mujoco
