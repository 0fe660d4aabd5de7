#include "io/extract/run_tables.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/file_types.h"
#include "io/hdf5/read_columns.h"
#include "io/run/contact_rows.h"
#include "io/run/event_columns.h"
#include "io/run/frame_table.h"
#include "io/setup/world_result_rows.h"

namespace pbmpi::io {

struct RunTables::Impl {
  File file;
  std::vector<ContactSpan> contacts;  ///< [T]
};

namespace {

/// Names a table by the group, the items and the rows of its columns.
struct TableName {
  const char* name;
  const char* group;
  Items items;
  Rows rows;
  const char* meaning;
};

constexpr auto names = std::to_array<TableName>({
    {"bodies", "/particles/bodies", Items::bodies, Rows::recorded, "poses and velocities of bodies"},
    {"observables", "/observables/world", Items::worlds, Rows::frames, "what is measured of each world"},
    {"residuals", "/observables/residual", Items::worlds, Rows::frames,
     "residuals of each world's last step"},
    {"interest", "/observables/interest", Items::worlds, Rows::frames, "bodies in the field of interest"},
    {"joints", "/observables/joint", Items::joints, Rows::frames, "forces of joints, and when they broke"},
    {"timings", "/timings/frame", Items::run, Rows::frames, "how long frames took"},
    {"ranks", "/timings/rank", Items::ranks, Rows::frames, "seconds of ranks in their phases"},
    {"islands", "/timings/island", Items::bodies, Rows::frames, "islands, each at its lowest body"},
    {"spaces", "/timings/space", Items::worlds, Rows::frames, "collision detection by spaces"},
    {"estimates", "/estimate", Items::bodies, Rows::recorded, "poses as FEEC estimated them"},
    {"estimate_times", "/estimate", Items::run, Rows::frames, "when estimates were delivered"},
    {"estimate_ranks", "/estimate", Items::ranks, Rows::frames, "seconds of ranks for estimates"},
});

ItemsOf items_of(Items items) {
  switch (items) {
    case Items::run:
      return ItemsOf::run;
    case Items::ranks:
      return ItemsOf::ranks;
    case Items::worlds:
      return ItemsOf::worlds;
    case Items::bodies:
      return ItemsOf::bodies;
    case Items::joints:
      return ItemsOf::joints;
  }
  return ItemsOf::run;
}

/// "position" for /particles/bodies/position/value, "value" for /events/value.
std::string column_name(std::string path) {
  constexpr std::string_view value = "/value";
  if (path.ends_with(value) && std::ranges::count(path, '/') > 2) path.resize(path.size() - value.size());
  return path.substr(path.rfind('/') + 1);
}

std::string unit_of(hid_t file, const std::string& path) {
  const auto attributes = attributes_as_text(file, path);
  const auto unit = attributes.find("unit");
  return unit == attributes.end() ? "" : unit->second;
}

/// The text in each part of `bytes`, up to its NUL.
std::vector<std::string> texts_in(const std::vector<char>& bytes, std::size_t length) {
  std::vector<std::string> texts;
  for (std::size_t at = 0; at + length <= bytes.size(); at += length) {
    const std::string text(&bytes[at], length);
    texts.push_back(text.substr(0, text.find('\0')));
  }
  return texts;
}

/// Rows [first, first + count) of a dataset with `items` items a row.
TableColumn read_column(hid_t file, const std::string& path, std::int64_t first, std::int64_t count,
                        std::int64_t items) {
  RawRows rows = raw_rows(file, path, first + count);
  const std::size_t value_bytes = H5Tget_size(rows.type.id());
  const std::size_t values_a_row = rows.row_bytes / std::max<std::size_t>(value_bytes, 1);
  const auto num_items = static_cast<std::size_t>(items);
  if (num_items == 0 || values_a_row % num_items != 0)
    throw core::RunError(path + " does not have " + std::to_string(items) + " items a row");
  TableColumn column{column_name(path), unit_of(file, path), {}, values_a_row / num_items};
  const std::size_t num_values = values_a_row * static_cast<std::size_t>(count);
  const auto read = [&](auto& values) {
    rows.read(static_cast<hsize_t>(first), static_cast<hsize_t>(count), values.data());
  };
  switch (H5Tget_class(rows.type.id())) {
    case H5T_STRING: {
      std::vector<char> bytes(num_values * value_bytes);
      read(bytes);
      column.values = texts_in(bytes, value_bytes);
      break;
    }
    case H5T_INTEGER: {
      rows.type = number_type(H5T_NATIVE_INT64);
      std::vector<std::int64_t> values(num_values);
      read(values);
      column.values = std::move(values);
      break;
    }
    default: {
      rows.type = number_type(H5T_NATIVE_DOUBLE);
      std::vector<double> values(num_values);
      read(values);
      column.values = std::move(values);
    }
  }
  return column;
}

/// /contacts/point is one dataset; its columns are handed out one by one.
std::vector<TableColumn> read_contacts(hid_t file, std::int64_t first, std::int64_t count) {
  const TableColumn all = read_column(file, ContactRows::points, first, count, 1);
  const auto& values = std::get<std::vector<double>>(all.values);
  if (all.width != contact_columns.size())
    throw core::RunError(std::string(ContactRows::points) + " has other columns");
  constexpr std::size_t num_indices = 6;  // world, geoms, bodies, awake
  std::vector<TableColumn> columns;
  for (std::size_t i = 0; i < contact_columns.size(); ++i) {
    std::vector<double> numbers;
    for (std::size_t at = i; at < values.size(); at += contact_columns.size()) numbers.push_back(values[at]);
    columns.push_back({contact_columns[i], contact_units[i], {}, 1});
    if (i < num_indices) {
      columns.back().values = std::vector<std::int64_t>(numbers.begin(), numbers.end());
    } else {
      columns.back().values = std::move(numbers);
    }
  }
  return columns;
}

std::vector<FrameTime> read_frame_times(hid_t file, std::int64_t num_frames, std::int64_t first_frame) {
  const auto step = read_integers(file, "/timings/frame/step", num_frames);
  const auto time = read_doubles(file, "/timings/frame/time", num_frames, 1);
  const auto measured = read_integers(file, "/timings/frame/measured", num_frames);
  std::vector<FrameTime> frames;
  for (std::size_t i = 0; i < step.size(); ++i)
    frames.push_back({first_frame + static_cast<std::int64_t>(i), step[i], time[i], measured[i] != 0});
  return frames;
}

RunItems read_items(hid_t file) {
  RunItems items;
  const std::vector<hsize_t> table = dims_of(file, "/observables/world/contacts");
  if (table.size() != 2 || table[1] < 1 || !std::in_range<int>(table[1]))
    throw core::RunError("/observables/world/contacts has an impossible number of worlds");
  items.num_worlds = static_cast<int>(table[1]);
  items.world_id = read_world_ids(file, items.num_worlds);
  items.body_world = read_integers(file, "/particles/bodies/world");
  const auto count = static_cast<std::int64_t>(items.body_world.size());
  items.body_name = read_texts(file, "/particles/bodies/name", count);
  items.actor = read_texts(file, "/particles/bodies/actor", count);
  items.actor_kind = read_texts(file, "/particles/bodies/kind", count);
  if (has_object(file, "/joints/name")) {
    items.joint_world = read_integers(file, "/joints/world");
    items.joint_name = read_texts(file, "/joints/name", std::ssize(items.joint_world));
  }
  items.hosts = read_texts(file, "/ranks/host");
  return items;
}

}  // namespace

RunTables::RunTables(const std::string& path) : path_(path), impl_(std::make_unique<Impl>()) {
  impl_->file = open_run(path);
  const hid_t file = impl_->file.id();
  try {
    check_run(file);
    attributes_ = attributes_as_text(file, "/");
    parameters_ = scalars_as_text(file, "/parameters");
    const std::int64_t num_frames = integer_attribute(file, "/", "frames_committed");
    record_every_ = integer_attribute(file, "/", "record_every");
    num_events_ = integer_attribute(file, "/events", "num_events");
    const std::int64_t first =
        attributes_.contains("first_frame") ? integer_attribute(file, "/", "first_frame") : 0;
    frames_ = read_frame_times(file, num_frames, first);
    items_ = read_items(file);
    impl_->contacts = read_contact_spans(file, num_frames);
    find_tables();
  } catch (const core::RunError& error) {
    throw core::InputError(path + ": " + error.what() + "; the file is damaged or incomplete");
  }
}

RunTables::~RunTables() = default;
RunTables::RunTables(RunTables&&) noexcept = default;
RunTables& RunTables::operator=(RunTables&&) noexcept = default;

void RunTables::find_tables() {
  const hid_t file = impl_->file.id();
  for (const TableName& known : names) {
    const RowsOf rows = known.rows == Rows::recorded ? RowsOf::recorded : RowsOf::frames;
    RunTable table{known.name, known.meaning, items_of(known.items), rows, {}};
    for (const FrameTable& part : all_frame_tables()) {
      if (part.group != known.group || part.items != known.items || part.rows != known.rows) continue;
      for (const ColumnSpec& column : part.columns) {
        if (const std::string path = part.group + "/" + column.name; has_object(file, path))
          table.columns.push_back(path);
      }
    }
    if (!table.columns.empty()) tables_.push_back(std::move(table));
  }
  if (has_object(file, ContactRows::points))
    tables_.push_back({"contacts",
                       "contacts of each frame's last step",
                       ItemsOf::contacts,
                       RowsOf::frames,
                       {ContactRows::points}});
  find_tables_of_the_run();
  RunTable events{"events", "what happened beside the frames", ItemsOf::run, RowsOf::events, {}};
  for (const std::string& path : EventColumns::datasets()) {
    if (path.starts_with("/events/") && has_object(file, path)) events.columns.push_back(path);
  }
  tables_.push_back(std::move(events));
}

/// Finds the tables with a row per world and no frames.
void RunTables::find_tables_of_the_run() {
  const hid_t file = impl_->file.id();
  const auto add = [&](const char* name, const char* meaning, const std::string& group) {
    RunTable table{name, meaning, ItemsOf::worlds, RowsOf::run, {}};
    if (has_object(file, "/worlds/id")) table.columns.push_back("/worlds/id");
    for (const std::string& column : names_in(file, group)) table.columns.push_back(group + "/" + column);
    tables_.push_back(std::move(table));
  };
  const std::string parameters = "/world_parameters";
  if (has_object(file, parameters))
    add("world_parameters", "what worlds have otherwise than the scene", parameters);
  if (!read_world_results(file).empty()) add("world_results", "what has become of each world", world_results);
}

const RunTable* RunTables::find(const std::string& name) const {
  const auto found = std::ranges::find(tables_, name, &RunTable::name);
  return found == tables_.end() ? nullptr : &*found;
}

std::int64_t RunTables::num_rows(const RunTable& table) const {
  switch (table.rows) {
    case RowsOf::frames:
      return std::ssize(frames_);
    case RowsOf::recorded:
      return std::ssize(frames_) / record_every_;
    case RowsOf::events:
      return num_events_;
    case RowsOf::run:
      return 1;
  }
  return 0;
}

const FrameTime& RunTables::frame_of(const RunTable& table, std::int64_t row) const {
  const std::int64_t frame = table.rows == RowsOf::recorded ? (row + 1) * record_every_ - 1 : row;
  return frames_.at(static_cast<std::size_t>(frame));
}

std::int64_t RunTables::num_items(const RunTable& table, std::int64_t row) const {
  switch (table.items) {
    case ItemsOf::run:
      return 1;
    case ItemsOf::ranks:
      return std::ssize(items_.hosts);
    case ItemsOf::worlds:
      return items_.num_worlds;
    case ItemsOf::bodies:
      return std::ssize(items_.body_world);
    case ItemsOf::joints:
      return std::ssize(items_.joint_world);
    case ItemsOf::contacts:
      return impl_->contacts.at(static_cast<std::size_t>(row)).count;
  }
  return 0;
}

std::vector<TableColumn> RunTables::read(const RunTable& table, std::int64_t first,
                                         std::int64_t count) const {
  try {
    if (table.items == ItemsOf::contacts) {
      std::int64_t points = 0;
      for (std::int64_t row = first; row < first + count; ++row) points += num_items(table, row);
      const std::int64_t begin = count > 0 ? impl_->contacts.at(static_cast<std::size_t>(first)).first : 0;
      return read_contacts(impl_->file.id(), begin, points);
    }
    std::vector<TableColumn> columns;
    if (table.rows == RowsOf::run) {  // the items are its rows
      for (const std::string& path : table.columns)
        columns.push_back(read_column(impl_->file.id(), path, 0, count * num_items(table, 0), 1));
      return columns;
    }
    for (const std::string& path : table.columns)
      columns.push_back(read_column(impl_->file.id(), path, first, count, num_items(table, first)));
    return columns;
  } catch (const core::RunError& error) {
    throw core::InputError(path_ + ": " + error.what() + "; the file is damaged or incomplete");
  }
}

TableColumn RunTables::read_once(const std::string& path) const {
  try {
    const auto dims = dims_of(impl_->file.id(), path);
    return read_column(impl_->file.id(), path, 0, dims.empty() ? 0 : static_cast<std::int64_t>(dims[0]), 1);
  } catch (const core::RunError& error) {
    throw core::InputError(path_ + ": " + error.what() + "; the file is damaged or incomplete");
  }
}

}  // namespace pbmpi::io
