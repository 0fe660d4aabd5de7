#include "app/pbreport/csv/table_text.h"

#include <algorithm>
#include <array>

#include "app/pbreport/csv/item_choice.h"
#include "core/number_text.h"
#include "io/table/csv_text.h"

namespace pbmpi::app {
namespace {

using core::number_text;
using io::ItemsOf;
using io::RowsOf;
using io::TableColumn;

/// Names of the labels that precede the columns on each line.
std::string label_names(const io::RunTable& table) {
  if (table.rows == RowsOf::events) return "";
  if (table.rows == RowsOf::run) return "world";
  std::string frame = "frame,step,time [s],measured";
  switch (table.items) {
    case ItemsOf::run:
      return frame;
    case ItemsOf::ranks:
      return frame + ",rank,host";
    case ItemsOf::worlds:
      return frame + ",world";
    case ItemsOf::bodies:
      return frame + ",body,world,name,actor,kind";
    case ItemsOf::joints:
      return frame + ",joint,world,name";
    case ItemsOf::contacts:
      return frame;
  }
  return frame;
}

std::string frame_label(const io::FrameTime& frame) {
  return number_text(frame.frame) + "," + number_text(frame.step) + "," + number_text(frame.time_s) + "," +
         (frame.is_measured ? "1" : "0");
}

std::string item_label(const io::RunItems& names, ItemsOf items, std::int64_t item) {
  const auto i = static_cast<std::size_t>(item);
  std::string number = "," + number_text(item);
  switch (items) {
    case ItemsOf::ranks:
      return number + "," + io::csv_text(names.hosts[i]);
    case ItemsOf::worlds:
      return number;
    case ItemsOf::bodies:
      return number + "," + number_text(names.body_world[i]) + "," + io::csv_text(names.body_name[i]) + "," +
             io::csv_text(names.actor[i]) + "," + io::csv_text(names.actor_kind[i]);
    case ItemsOf::joints:
      return number + "," + number_text(names.joint_world[i]) + "," + io::csv_text(names.joint_name[i]);
    case ItemsOf::run:
    case ItemsOf::contacts:
      return "";
  }
  return "";
}

/// "_x" ... for a vector, "_w" ... for a quaternion, "_1" ... for anything else; empty for a number.
std::string component(std::size_t width, std::size_t k) {
  constexpr std::array vector = {"_x", "_y", "_z"};
  constexpr std::array quaternion = {"_w", "_x", "_y", "_z"};
  if (width == 1) return "";
  if (width == vector.size()) return vector[k];
  if (width == quaternion.size()) return quaternion[k];
  return "_" + std::to_string(k + 1);
}

/// Columns that do not repeat the labels before them.
std::vector<TableColumn> shown(std::vector<TableColumn> columns, const io::RunTable& table) {
  if (table.name != "timings") return columns;
  std::erase_if(columns, [](const TableColumn& column) {
    return column.name == "step" || column.name == "time" || column.name == "measured";
  });
  return columns;
}

std::string header(const std::vector<TableColumn>& columns, const io::RunTable& table) {
  std::string line = label_names(table);
  for (const TableColumn& column : columns) {
    for (std::size_t k = 0; k < column.width; ++k) {
      line += (line.empty() ? "" : ",") + column.name + component(column.width, k);
      if (!column.unit.empty()) line += " [" + column.unit + "]";
    }
  }
  return line + "\n";
}

/// Appends the values of item `index` among all that `columns` hold.
void append_values(const std::vector<TableColumn>& columns, std::size_t index, std::string& line) {
  for (const TableColumn& column : columns) {
    for (std::size_t k = 0; k < column.width; ++k) {
      if (!line.empty() && line.back() != '\n') line += ',';
      line += io::csv_value(column, index * column.width + k);
    }
  }
  line += '\n';
}

const std::vector<std::int64_t>& integers(const std::vector<TableColumn>& columns, const char* name) {
  return std::get<std::vector<std::int64_t>>(std::ranges::find(columns, name, &TableColumn::name)->values);
}

/// The chosen lines of the rows [first, first + count).
class Lines {
 public:
  Lines(const io::RunTables& run, const io::RunTable& table, const CsvOptions& options)
      : run_(run), table_(table), options_(options), choice_(run, table, options) {}

  std::string operator()(std::int64_t first, std::int64_t count) const {
    const std::vector<TableColumn> columns = shown(run_.read(table_, first, count), table_);
    return table_.rows == RowsOf::events ? of_events(columns, count) : of_frames(columns, first, count);
  }
  bool has_frame(std::int64_t row) const {
    if (table_.rows == RowsOf::run) return true;
    const io::FrameTime& frame = run_.frame_of(table_, row);
    return options_.frames.has(frame.frame) && (frame.is_measured || !options_.measured_only);
  }

 private:
  std::string of_events(const std::vector<TableColumn>& columns, std::int64_t count) const {
    const auto& frame = integers(columns, "frame");
    const bool have_worlds = std::ranges::find(columns, "world", &TableColumn::name) != columns.end();
    std::string text;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const bool has_world = choice_.has_world(have_worlds ? integers(columns, "world")[i] : -1);
      if (!has_world || !options_.frames.has(frame[i]) || !is_chosen_by_warmup(frame[i])) continue;
      std::string line;
      append_values(columns, i, line);
      text += line;
    }
    return text;
  }

  bool is_chosen_by_warmup(std::int64_t frame) const {
    const auto& frames = run_.frames();
    const auto found = std::ranges::find(frames, frame, &io::FrameTime::frame);
    return !options_.measured_only || (found != frames.end() && found->is_measured);
  }

  std::string of_frames(const std::vector<TableColumn>& columns, std::int64_t first,
                        std::int64_t count) const {
    std::string text;
    std::size_t index = 0;
    for (std::int64_t row = first; row < first + count; ++row) {
      const std::int64_t items = run_.num_items(table_, row);
      const bool has_frames = table_.rows != RowsOf::run;
      const std::string label = has_frames ? frame_label(run_.frame_of(table_, row)) : "";
      for (std::int64_t item = 0; item < items; ++item, ++index) {
        if (!has_frame(row) || !has_item(columns, item, index)) continue;
        text += (label + item_label(run_.items(), table_.items, item)).substr(has_frames ? 0 : 1);
        append_values(columns, index, text);
      }
    }
    return text;
  }

  bool has_item(const std::vector<TableColumn>& columns, std::int64_t item, std::size_t index) const {
    if (table_.items != ItemsOf::contacts) return choice_.has_item(item);
    const bool touches = choice_.has_body(integers(columns, "body_a")[index]) ||
                         choice_.has_body(integers(columns, "body_b")[index]);
    return touches && choice_.has_world(integers(columns, "world")[index]);
  }

  const io::RunTables& run_;
  const io::RunTable& table_;
  const CsvOptions& options_;
  ItemChoice choice_;
};

}  // namespace

void put_table(const io::RunTables& run, const io::RunTable& table, const CsvOptions& options,
               const std::function<void(std::string_view)>& put) {
  const Lines lines(run, table, options);
  put(header(shown(run.read(table, 0, 0), table), table));
  const std::int64_t num_rows = run.num_rows(table);
  if (table.rows == RowsOf::events) {
    put(lines(0, num_rows));
    return;
  }
  constexpr std::int64_t items_at_once = 1 << 15;
  for (std::int64_t first = 0, next = 0; first < num_rows; first = next) {
    std::int64_t items = 0;
    if (!lines.has_frame(first)) {  // not even read
      next = first + 1;
      continue;
    }
    for (; next < num_rows && items < items_at_once && lines.has_frame(next); ++next)
      items += run.num_items(table, next);
    put(lines(first, next - first));
  }
}

}  // namespace pbmpi::app
