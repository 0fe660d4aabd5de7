#include "io/run/checkpoint_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "io/file/write_file.h"
#include "io/hdf5/file_types.h"
#include "io/run/table_rows.h"
#include "io/table/table_file.h"

namespace pbmpi::io {
namespace {

/// Version of the layout; the first number changes when old programs would be misled.
constexpr std::array<std::int64_t, 2> version = {1, 5};

using core::Quat;
using core::Vec3;
using Doubles = std::vector<double>;
using Integers = std::vector<std::int64_t>;

/// Tables of State::memory, and the columns of /worlds that count the rows of each world.
constexpr const char *contact_forces = "contact_forces", *joint_forces = "joint_forces";
/// The table of State::rest, and the column of /worlds that counts its rows.
constexpr const char *rest_table = "rest", *num_resting = "resting";

void append(Doubles& column, const Vec3& vector) {
  column.insert(column.end(), vector.data(), vector.data() + 3);
}
void append(Doubles& column, const Quat& q) { column.insert(column.end(), {q.w, q.x, q.y, q.z}); }

/// The columns of all worlds, one world's rows after the previous world's.
struct Columns {
  Integers bodies, resting, joints;  ///< [W] rows of each world
  Doubles position, orientation, velocity, angular_velocity;
  Doubles rest_rows;  ///< as put_row() writes them
  Integers broken_in;
  Doubles energy_gain, largest_kinetic;  ///< [W], as frozen_in
  Integers frozen_in;
  Integers num_contact_forces, num_joint_forces;  ///< [W] rows of each world
  Doubles contact_force_rows, joint_force_rows;   ///< as put_row() writes them

  void add(const model::State& state) {
    bodies.push_back(std::ssize(state.position));
    resting.push_back(std::ssize(state.rest));
    joints.push_back(std::ssize(state.broken_in));
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      append(position, state.position[i]);
      append(orientation, state.orientation[i]);
      append(velocity, state.velocity[i]);
      append(angular_velocity, state.angular_velocity[i]);
    }
    model::append_rows(rest_rows, state.rest, model::numbers_of_rest);
    broken_in.insert(broken_in.end(), state.broken_in.begin(), state.broken_in.end());
    energy_gain.push_back(state.guard.energy_gain_j);
    largest_kinetic.push_back(state.guard.largest_kinetic_j);
    frozen_in.push_back(state.guard.frozen_in);
    num_contact_forces.push_back(std::ssize(state.memory.contacts));
    num_joint_forces.push_back(std::ssize(state.memory.joints));
    model::append_rows(contact_force_rows, state.memory.contacts, model::numbers_of_contact_force);
    model::append_rows(joint_force_rows, state.memory.joints, model::numbers_of_joint_force);
  }
};

TableFile tables_of(const Checkpoint& checkpoint) {
  Columns columns;
  for (const model::State& state : checkpoint.worlds) columns.add(state);
  TableFile file;
  file.attributes = {{"pbmpi_version", checkpoint.pbmpi_version},
                     {"git_revision", checkpoint.git_revision},
                     {"build", checkpoint.build},
                     {"created", checkpoint.created},
                     {"state_hash", checkpoint.state_hash},
                     {"scene", checkpoint.scene}};
  file.parameters = {Parameter::of("frames_done", checkpoint.frames),
                     Parameter::of("steps_done", checkpoint.steps),
                     Parameter::of("scene_file", checkpoint.scene_file),
                     Parameter::of("scene_text", checkpoint.scene_text),
                     Parameter::of("parameters_file", checkpoint.parameters_file),
                     Parameter::of("parameters_text", checkpoint.parameters_text),
                     Parameter::of("options", checkpoint.options),
                     Parameter::of("output", checkpoint.output)};
  file.tables["worlds"] = {{"bodies", "", std::move(columns.bodies)},
                           {num_resting, "", std::move(columns.resting)},
                           {"joints", "", std::move(columns.joints)},
                           {"energy_gain", "J", std::move(columns.energy_gain)},
                           {"largest_kinetic", "J", std::move(columns.largest_kinetic)},
                           {"frozen_in", "", std::move(columns.frozen_in)},
                           {contact_forces, "", std::move(columns.num_contact_forces)},
                           {joint_forces, "", std::move(columns.num_joint_forces)}};
  file.tables["bodies"] = {{"position", "m", std::move(columns.position), 3},
                           {"orientation", "", std::move(columns.orientation), 4},
                           {"velocity", "m s-1", std::move(columns.velocity), 3},
                           {"angular_velocity", "rad s-1", std::move(columns.angular_velocity), 3}};
  file.tables[rest_table] = columns_of(model::rest_parts, columns.rest_rows);
  file.tables["joints"] = {{"broken_in", "", std::move(columns.broken_in)}};
  file.tables[contact_forces] = columns_of(model::contact_force_parts, columns.contact_force_rows);
  file.tables[joint_forces] = columns_of(model::joint_force_parts, columns.joint_force_rows);
  return file;
}

void read_memory(const TableFile& file, std::vector<model::State>& worlds) {
  if (!file.has_column("worlds", contact_forces)) return;  // layout 1.1
  ItemReader<model::ContactForce> contacts(file, contact_forces, model::contact_force_parts, contact_forces,
                                           model::contact_force_parts.size());
  ItemReader<model::JointForce> joints(
      file, joint_forces, model::joint_force_parts, joint_forces,
      file.has_column(joint_forces, "angle") ? model::joint_force_parts.size() : 3);
  for (model::State& state : worlds) state.memory = {contacts.of_next_world(), joints.of_next_world()};
  contacts.require_end();
  joints.require_end();
}

/// Before layout 1.5 a row said only where a body has stayed, and for how long. An awake body of such a file
/// begins to rest anew.
void read_rest(const TableFile& file, std::vector<model::State>& worlds) {
  const bool is_whole = file.has_column(rest_table, "short_knots");
  ItemReader<model::Rest> rests(file, rest_table, model::rest_parts, num_resting,
                                is_whole ? model::rest_parts.size() : 3);
  for (model::State& state : worlds) {
    state.rest = rests.of_next_world();
    for (int body = 0; !is_whole && body < std::ssize(state.rest); ++body) {
      if (!state.rest[body].asleep()) state.rest[body] = model::begin_rest(state, body);
    }
  }
  rests.require_end();
}

std::vector<model::State> worlds_of(const TableFile& file) {
  RowReader<std::int64_t> bodies(file, "worlds", "bodies"), joints(file, "worlds", "joints"),
      broken_in(file, "joints", "broken_in"), frozen_in(file, "worlds", "frozen_in");
  RowReader<double> position(file, "bodies", "position", 3), orientation(file, "bodies", "orientation", 4),
      velocity(file, "bodies", "velocity", 3), angular_velocity(file, "bodies", "angular_velocity", 3),
      energy_gain(file, "worlds", "energy_gain"), largest_kinetic(file, "worlds", "largest_kinetic");
  std::vector<model::State> worlds(file.column<std::int64_t>("worlds", "bodies").size());
  for (model::State& state : worlds) {
    const int num_bodies = bodies.integer(), num_joints = joints.integer();
    for (int body = 0; body < num_bodies; ++body) {
      state.position.push_back(position.vector());
      state.orientation.push_back(orientation.quaternion());
      state.velocity.push_back(velocity.vector());
      state.angular_velocity.push_back(angular_velocity.vector());
    }
    for (int joint = 0; joint < num_joints; ++joint) state.broken_in.push_back(broken_in.integer());
    state.guard = {*energy_gain.next(), *largest_kinetic.next(), frozen_in.integer()};
  }
  for (const auto* column : {&position, &orientation, &velocity, &angular_velocity}) column->require_end();
  broken_in.require_end();
  read_rest(file, worlds);
  read_memory(file, worlds);
  return worlds;
}

const Parameter& parameter(const TableFile& file, const std::string& name) {
  const auto found = std::find_if(file.parameters.begin(), file.parameters.end(),
                                  [&](const Parameter& one) { return one.name == name; });
  if (found == file.parameters.end()) throw core::RunError("there is no /parameters/" + name);
  return *found;
}

/// The text of a parameter; empty for a checkpoint before layout 1.4, which does not have it.
std::string text_or_none(const TableFile& file, const std::string& name) {
  const auto found = std::ranges::find(file.parameters, name, &Parameter::name);
  return found == file.parameters.end() ? "" : found->text;
}

std::string attribute(const TableFile& file, const std::string& name) {
  const auto found = file.attributes.find(name);
  if (found == file.attributes.end()) throw core::RunError("there is no attribute " + name);
  return found->second;
}

std::int64_t count(const TableFile& file, const std::string& name) {
  const std::string& text = parameter(file, name).text;  // all parameters read from a file are text
  char* end = nullptr;
  const long long value = std::strtoll(text.c_str(), &end, 10);
  if (end == text.c_str() || *end != '\0' || value < 1)
    throw core::RunError("/parameters/" + name + " is not above 0");
  return value;
}

Checkpoint checkpoint_of(const TableFile& file) {
  Checkpoint checkpoint;
  checkpoint.pbmpi_version = attribute(file, "pbmpi_version");
  checkpoint.git_revision = attribute(file, "git_revision");
  checkpoint.build = attribute(file, "build");
  checkpoint.created = attribute(file, "created");
  checkpoint.state_hash = attribute(file, "state_hash");
  checkpoint.scene = attribute(file, "scene");
  checkpoint.frames = count(file, "frames_done");
  checkpoint.steps = count(file, "steps_done");
  checkpoint.scene_file = parameter(file, "scene_file").text;
  checkpoint.scene_text = parameter(file, "scene_text").text;
  checkpoint.parameters_file = text_or_none(file, "parameters_file");
  checkpoint.parameters_text = text_or_none(file, "parameters_text");
  checkpoint.options = parameter(file, "options").text;
  checkpoint.output = parameter(file, "output").text;
  checkpoint.worlds = worlds_of(file);
  return checkpoint;
}

}  // namespace

std::int64_t write_checkpoint(const OutputLock& lock, const Checkpoint& checkpoint) {
  const std::vector<std::byte> image = table_image(checkpoint_filetype, version, tables_of(checkpoint));
  replace_file(lock, image);
  return std::ssize(image);
}

Checkpoint read_checkpoint(const std::string& path) {
  const TableFile file = read_table_file(path, checkpoint_filetype, version[0]);
  try {
    return checkpoint_of(file);
  } catch (const std::runtime_error& error) {
    throw core::InputError(path + ": " + error.what() + "; the file is damaged");
  }
}

OutputLock lock_checkpoint(const std::string& path, std::int64_t bytes) {
  return output_target(path, checkpoint_filetype, std::max<std::int64_t>(bytes, 1)).take_lock();
}

}  // namespace pbmpi::io
