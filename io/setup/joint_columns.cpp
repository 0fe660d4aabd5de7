/// The joints between bodies, and the settings of their worlds: /joints, /worlds.
#include <algorithm>

#include "io/hdf5/columns.h"
#include "io/setup/static_columns.h"
#include "model/names.h"

namespace pbmpi::io {
namespace {

using stepping::LocalWorld;

/// One number per joint, or one for each of its two axes.
struct JointNumbers {
  const char* name;
  const char* unit;
  std::vector<hsize_t> item;
  void (*put)(const model::Joint& joint, std::vector<double>& values);
};

/// The units are those of a hinge; a slider has m for rad and N for N m.
std::vector<JointNumbers> joint_numbers() {
  using model::Joint;
  using Values = std::vector<double>;
  return {{"anchor_a", "m", {3}, [](const Joint& j, Values& v) { append(v, j.anchor_a); }},
          {"anchor_b", "m", {3}, [](const Joint& j, Values& v) { append(v, j.anchor_b); }},
          {"axis1_a", "", {3}, [](const Joint& j, Values& v) { append(v, j.axis1_a); }},
          {"axis2_b", "", {3}, [](const Joint& j, Values& v) { append(v, j.axis2_b); }},
          {"limit_low",
           "",
           {2},
           [](const Joint& j, Values& v) {
             for (const model::AxisLimit& limit : j.limits) v.push_back(limit.low);
           }},
          {"limit_high",
           "",
           {2},
           [](const Joint& j, Values& v) {
             for (const model::AxisLimit& limit : j.limits) v.push_back(limit.high);
           }},
          {"motor_velocity",
           "",
           {2},
           [](const Joint& j, Values& v) {
             for (const model::AxisMotor& motor : j.motors) v.push_back(motor.velocity);
           }},
          {"motor_max_force",
           "",
           {2},
           [](const Joint& j, Values& v) {
             for (const model::AxisMotor& motor : j.motors) v.push_back(motor.max_force);
           }},
          {"motor_hold_rate",
           "s-1",
           {2},
           [](const Joint& j, Values& v) {
             for (const model::AxisMotor& motor : j.motors) v.push_back(motor.hold_rate);
           }},
          {"armature",
           "",
           {2},
           [](const Joint& j, Values& v) { v.insert(v.end(), j.armature.begin(), j.armature.end()); }},
          {"stiffness", "N m-1", {}, [](const Joint& j, Values& v) { v.push_back(j.suspension.stiffness); }},
          {"damping", "N s m-1", {}, [](const Joint& j, Values& v) { v.push_back(j.suspension.damping); }},
          {"break_force", "N", {}, [](const Joint& j, Values& v) { v.push_back(j.break_force); }},
          {"break_torque", "N m", {}, [](const Joint& j, Values& v) { v.push_back(j.break_torque); }}};
}

/// One number per world.
struct WorldNumbers {
  const char* name;
  const char* unit;
  double (*of)(const model::Model& model);
};

constexpr std::array<WorldNumbers, 9> world_numbers = {
    {{"joint_erp", "", [](const model::Model& m) { return m.erp; }},
     {"joint_cfm", "s kg-1", [](const model::Model& m) { return m.cfm; }},
     {"contact_erp", "", [](const model::Model& m) { return m.contact_law.soft_erp; }},
     {"contact_cfm", "s kg-1", [](const model::Model& m) { return m.contact_law.soft_cfm; }},
     {"bounce_velocity", "m s-1", [](const model::Model& m) { return m.contact_law.bounce_velocity; }},
     {"contacts_per_pair", "",
      [](const model::Model& m) { return static_cast<double>(m.contact_law.max_per_pair); }},
     {"linear_damping", "s-1", [](const model::Model& m) { return m.linear_damping; }},
     {"angular_damping", "s-1", [](const model::Model& m) { return m.angular_damping; }},
     {"air_density", "kg m-3", [](const model::Model& m) { return m.air_density; }}}};

}  // namespace

void write_joints(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  const auto global = [&](const LocalWorld& local, int body) {
    return body == model::no_body ? -1 : setup.table.body_offset[local.id] + body;
  };
  std::vector<std::int32_t> world, local_joint;
  std::vector<std::string> name, kind;
  std::vector<std::int64_t> body_a, body_b;
  for (const LocalWorld& local : setup.worlds) {
    for (const model::Joint& joint : local.model->joints) {
      world.push_back(local.id);
      local_joint.push_back(static_cast<std::int32_t>(&joint - local.model->joints.data()));
      name.push_back(joint.name);
      kind.emplace_back(name_of(joint.kind));
      body_a.push_back(global(local, joint.body_a));
      body_b.push_back(global(local, joint.body_b));
    }
  }
  ColumnWriter columns(ranks, file, "/joints",
                       rows_in_world_order(ranks, setup, [](const auto& m) { return m.joints.size(); }));
  columns.numbers("world", world);
  columns.numbers("local_joint", local_joint);
  columns.texts("name", name);
  columns.texts("kind", kind, longest(model::joint_kind_names));
  columns.numbers("body_a", body_a);
  columns.numbers("body_b", body_b);
  for (const JointNumbers& column : joint_numbers()) {
    std::vector<double> values;
    for (const LocalWorld& local : setup.worlds) {
      for (const model::Joint& joint : local.model->joints) column.put(joint, values);
    }
    columns.numbers(column.name, values, column.unit, column.item);
  }
}

void write_connectivity(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  const auto holds_two = [](const model::Joint& joint) { return joint.body_b != model::no_body; };
  std::vector<std::int64_t> pairs;
  for (const LocalWorld& local : setup.worlds) {
    for (const model::Joint& joint : local.model->joints) {
      if (!holds_two(joint)) continue;
      const std::int64_t first = setup.table.body_offset[local.id];
      pairs.insert(pairs.end(), {first + joint.body_a, first + joint.body_b});
    }
  }
  const OwnRows own = rows_in_world_order(ranks, setup, [&](const model::Model& m) {
    return static_cast<std::size_t>(std::count_if(m.joints.begin(), m.joints.end(), holds_two));
  });
  ColumnWriter(ranks, file, "/connectivity", own).numbers("joints", pairs, {2});
  if (!file.is_new) return;
  ranks.together([&] {
    if (!ranks.is_root()) return;
    const auto dataset = owned<Dataset>(H5Dopen2(file.id, "/connectivity/joints", H5P_DEFAULT), "H5Dopen");
    write_reference(dataset.id(), "particles_group", file.id, "/particles/bodies");
  });
}

void write_worlds(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  ColumnWriter columns(ranks, file, "/worlds",
                       rows_in_world_order(ranks, setup, [](const auto&) { return std::size_t{1}; }));
  std::vector<std::int64_t> id;
  std::vector<double> gravity;
  for (const LocalWorld& local : setup.worlds) {
    id.push_back(setup.first_world + local.id);
    append(gravity, local.model->gravity);
  }
  columns.numbers("id", id);
  columns.numbers("gravity", gravity, "m s-2", {3});
  for (const WorldNumbers& column : world_numbers) {
    std::vector<double> values;
    for (const LocalWorld& local : setup.worlds) values.push_back(column.of(*local.model));
    columns.numbers(column.name, values, column.unit);
  }
}

}  // namespace pbmpi::io
