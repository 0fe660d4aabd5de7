#include "io/run/checkpoint_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.h"
#include "io/file/write_file.h"
#include "io/hdf5/file_types.h"
#include "io/table/table_file.h"
#include "model/state_parts.h"

namespace pbmpi::io {
namespace {

[[noreturn]] inline void refuse(const std::string& table, const std::string& column) {
  throw core::RunError("/" + table + "/" + column + " does not fit the other columns");
}

/// The numbers of a part as a column stores them.
template <class Number>
using StoredNumber = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;

/// Adds a column for each part of the rows.
template <class Row>
void add_columns(std::vector<Row>& rows, std::vector<TableColumn>& columns) {
  for (const model::RowPart<Row>& part : model::parts_of<Row>) {
    std::visit(
        [&](auto first) {
          using Number = std::remove_pointer_t<decltype(first(rows.front()))>;
          std::vector<StoredNumber<Number>> values;
          values.reserve(part.width * rows.size());
          for (Row& row : rows) values.insert(values.end(), first(row), first(row) + part.width);
          columns.push_back({part.name, part.unit, std::move(values), part.width});
        },
        part.first);
  }
}

/// Inverse of add_columns(). A part of which the table has no column, as in files of an older layout, is as
/// its initialiser says. Throws core::RunError where columns differ in length, or a whole number is out of
/// range.
template <class Row>
std::vector<Row> rows_of(const TableFile& file, const std::string& table) {
  std::vector<Row> rows;
  for (const model::RowPart<Row>& part : model::parts_of<Row>) {
    const bool is_first = &part == model::parts_of<Row>.data();
    if (!is_first && !file.has_column(table, part.name)) continue;
    std::visit(
        [&](auto first) {
          using Number = std::remove_pointer_t<decltype(first(rows.front()))>;
          const auto& values = file.column<StoredNumber<Number>>(table, part.name);
          if (is_first) rows.resize(values.size() / part.width);
          if (values.size() != rows.size() * part.width) refuse(table, part.name);
          auto value = values.begin();
          for (Row& row : rows) {
            for (std::size_t i = 0; i < part.width; ++i, ++value) {
              if constexpr (std::is_integral_v<Number>) {
                if (!std::in_range<Number>(*value)) refuse(table, part.name);
              }
              first(row)[i] = static_cast<Number>(*value);
            }
          }
        },
        part.first);
  }
  return rows;
}

/// Version of the layout; the first number changes when old programs would be misled.
constexpr std::array<std::int64_t, 2> version = {1, 5};

using Doubles = std::vector<double>;
using Integers = std::vector<std::int64_t>;
using Worlds = std::vector<model::State>;

/// The table of the bodies, the one whose columns have a row a world, and the former's number of rows there.
constexpr const char *body_table = "bodies", *world_table = "worlds", *body_count = "bodies";

void put_bodies(const Worlds& worlds, TableFile& file) {
  Integers counts;
  counts.reserve(worlds.size());
  for (const model::State& state : worlds) counts.push_back(state.num_bodies());
  file.tables[world_table].push_back({body_count, "", std::move(counts)});
  for (const model::BodyColumn& column : model::body_columns) {
    Doubles values;
    for (const model::State& state : worlds) {
      const std::span<const double> numbers = column.of(state);
      values.insert(values.end(), numbers.begin(), numbers.end());
    }
    file.tables[body_table].push_back({column.name, column.unit, std::move(values), column.width()});
  }
}

template <class Row>
void put_list(const model::RowList<Row>& list, const Worlds& worlds, TableFile& file) {
  Integers counts;
  counts.reserve(worlds.size());
  std::vector<Row> rows;
  for (const model::State& state : worlds) {
    counts.push_back(std::ssize(list.of(state)));
    rows.insert(rows.end(), list.of(state).begin(), list.of(state).end());
  }
  file.tables[world_table].push_back({list.count, "", std::move(counts)});
  add_columns(rows, file.tables[list.table]);
}

/// The states of all worlds, one world's rows after the previous world's.
void put_states(const Worlds& worlds, TableFile& file) {
  put_bodies(worlds, file);
  model::for_each_list([&](const auto& list) { put_list(list, worlds, file); });
  std::vector<model::GuardMemory> guards;
  guards.reserve(worlds.size());
  for (const model::State& state : worlds) guards.push_back(state.guard);
  add_columns(guards, file.tables[world_table]);
}

TableFile tables_of(const Checkpoint& checkpoint) {
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
  put_states(checkpoint.worlds, file);
  return file;
}

/// Before layout 1.5 a row of /rest said only where a body has stayed, and for how long. An awake body of
/// such a file begins to rest anew.
void begin_to_rest(Worlds& worlds) {
  for (model::State& state : worlds) {
    for (int body = 0; body < std::ssize(state.rest); ++body) {
      if (!state.rest[body].asleep()) state.rest[body] = model::begin_rest(state, body);
    }
  }
}

/// [num_worlds] rows of each world in a table of `num_rows`: the column `name` of /worlds.
const Integers& counts_of(const TableFile& file, const std::string& name, std::size_t num_rows,
                          std::size_t num_worlds) {
  const Integers& counts = file.column<std::int64_t>(world_table, name);
  auto left = static_cast<std::int64_t>(num_rows);
  for (const std::int64_t count : counts) {
    if (count < 0 || count > left) refuse(world_table, name);
    left -= count;
  }
  if (left != 0 || counts.size() != num_worlds) refuse(world_table, name);
  return counts;
}

void read_motion(const TableFile& file, Worlds& worlds) {
  for (const model::BodyColumn& column : model::body_columns) {
    const Doubles& values = file.column<double>(body_table, column.name);
    const Integers& counts = counts_of(file, body_count, values.size() / column.width(), worlds.size());
    auto from = values.begin();
    for (std::size_t world = 0; world < worlds.size(); ++world) {
      worlds[world].resize(static_cast<int>(counts[world]));
      const std::span<double> numbers = column.of(worlds[world]);
      std::copy_n(from, numbers.size(), numbers.begin());
      from += std::ssize(numbers);
    }
  }
}

template <class Row>
void read_list(const model::RowList<Row>& list, const TableFile& file, Worlds& worlds) {
  if (!file.has_column(world_table, list.count)) return;  // forces: layout 1.1
  const std::vector<Row> rows = rows_of<Row>(file, list.table);
  const Integers& counts = counts_of(file, list.count, rows.size(), worlds.size());
  auto from = rows.begin();
  for (std::size_t world = 0; world < worlds.size(); ++world) {
    list.of(worlds[world]).assign(from, from + counts[world]);
    from += counts[world];
  }
}

Worlds worlds_of(const TableFile& file) {
  Worlds worlds(file.column<std::int64_t>(world_table, body_count).size());
  read_motion(file, worlds);
  model::for_each_list([&](const auto& list) { read_list(list, file, worlds); });
  const auto guards = rows_of<model::GuardMemory>(file, world_table);
  if (guards.size() != worlds.size()) refuse(world_table, body_count);
  for (std::size_t world = 0; world < worlds.size(); ++world) worlds[world].guard = guards[world];
  if (!file.has_column("rest", "velocity")) begin_to_rest(worlds);
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
