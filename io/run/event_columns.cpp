#include "io/run/event_columns.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "io/hdf5/read_columns.h"

namespace pbmpi::io {
namespace {

namespace event_kind = stepping::event_kind;

constexpr const char* events_group = "/events";
constexpr TableShape events_shape = {EventColumns::max_rows, 0, EventColumns::max_rows};

/// The columns in the order in which EventColumns::add() puts values.
const std::vector<ColumnSpec>& columns() {
  static const std::vector<ColumnSpec> specs = {{"frame", H5T_NATIVE_INT64}, {"kind", 0, 1, "", 24},
                                                {"detail", 0, 1, "", 160},   {"step", H5T_NATIVE_INT64},
                                                {"world", H5T_NATIVE_INT32}, {"joint", H5T_NATIVE_INT32},
                                                {"name", 0, 1, "", 96},      {"value", H5T_NATIVE_DOUBLE}};
  return specs;
}

void read_subjects(hid_t file, std::int64_t count, std::vector<stepping::RunEvent>& events) {
  const auto step = read_integers(file, "/events/step", count);
  const auto world = read_integers(file, "/events/world", count);
  const auto joint = read_integers(file, "/events/joint", count);
  const auto name = read_texts(file, "/events/name", count);
  const auto value = read_doubles(file, "/events/value", count, 1);
  for (std::size_t i = 0; i < events.size(); ++i) {
    events[i].step = step[i];
    events[i].world = static_cast<std::int32_t>(world[i]);
    events[i].joint = static_cast<std::int32_t>(joint[i]);
    events[i].name = name[i];
    events[i].value = value[i];
  }
}

}  // namespace

bool EventColumns::is_of_the_run(const std::string& kind) {
  constexpr std::array kinds = {event_kind::rebalance, event_kind::signal, event_kind::time_limit,
                                event_kind::checkpoint};
  return std::ranges::find(kinds, kind) != kinds.end();
}

std::string EventColumns::count_name(const std::string& kind) { return "num_" + kind; }

std::vector<std::string> EventColumns::datasets() { return GrowingTable::datasets(events_group, columns()); }

std::size_t EventColumns::bytes() { return max_rows * GrowingTable::row_bytes(columns(), 1); }

void EventColumns::create(hid_t file) { GrowingTable::create(file, events_group, columns(), events_shape); }

EventColumns::EventColumns(hid_t file, const FileRanks& ranks)
    : is_root_(ranks.is_root()), rows_(file, ranks, events_group, columns(), events_shape) {}

void EventColumns::add(const stepping::RunEvent& event) {
  const auto count = told_.find(count_name(event.kind));
  core::require_invariant(count != told_.end(), "an event of a kind that the file does not count");
  ++count->second;
  if (event.kind == event_kind::rebalance) told_[worlds_moved] += static_cast<std::int64_t>(event.value);
  if (!take_row(event.kind)) {
    ++told_[num_dropped];
    return;
  }
  rows_.begin_row(is_root_ ? std::vector<Range>{{0, 1}} : std::vector<Range>{});
  rows_.put(0, 0, event.frame);
  rows_.put_text(1, event.kind);
  rows_.put_text(2, event.detail);
  rows_.put(3, 0, event.step);
  rows_.put(4, 0, event.world);
  rows_.put(5, 0, event.joint);
  rows_.put_text(6, event.name);
  rows_.put(7, 0, event.value);
}

bool EventColumns::take_row(const std::string& kind) {
  const bool of_the_run = is_of_the_run(kind);
  int& rows = of_the_run ? rows_of_the_run_ : rows_of_worlds_;
  if (rows == (of_the_run ? max_rows_of_the_run : max_rows - max_rows_of_the_run)) return false;
  ++rows;
  return true;
}

EventCounts EventColumns::counts() const {
  EventCounts counts = told_;
  counts[num_rows] = static_cast<std::int64_t>(rows_.num_rows());
  return counts;
}

EventCounts EventColumns::no_counts() {
  EventCounts counts = {{num_rows, 0}, {num_dropped, 0}, {worlds_moved, 0}};
  for (const char* kind : event_kind::all) counts[count_name(kind)] = 0;
  return counts;
}

void read_events(hid_t file, RunData& run) {
  const std::int64_t count = integer_attribute(file, "/events", EventColumns::num_rows);
  const auto frame = read_integers(file, "/events/frame", count);
  const auto kind = read_texts(file, "/events/kind", count);
  const auto detail = read_texts(file, "/events/detail", count);
  for (std::size_t i = 0; i < frame.size(); ++i) run.events.push_back({frame[i], kind[i], detail[i]});
  if (has_object(file, "/events/step")) {
    read_subjects(file, count, run.events);
    run.worlds_moved = integer_attribute(file, "/events", EventColumns::worlds_moved);
    const auto attributes = attributes_as_text(file, "/events");  // older layouts count fewer kinds
    for (const char* one : event_kind::all) {
      if (attributes.contains(EventColumns::count_name(one)))
        run.num_events[one] = integer_attribute(file, "/events", EventColumns::count_name(one));
    }
  } else {
    for (const stepping::RunEvent& event : run.events) ++run.num_events[event.kind];
  }
}

}  // namespace pbmpi::io
