#include "io/join/join_events.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "core/error.h"
#include "core/system/seal.h"
#include "io/hdf5/file_checksum.h"
#include "io/hdf5/read_columns.h"
#include "io/run/event_columns.h"
#include "stepping/run_event.h"

namespace pbmpi::io {
namespace {

namespace event_kind = stepping::event_kind;

struct EventRow {
  std::int64_t frame = 0;
  std::string kind;
  double value = 0;
  std::vector<std::byte> bytes;  ///< bytes of the columns in order
};

struct PartEvents {
  std::vector<EventRow> rows;
  EventCounts counts;
};

std::vector<std::string> column_paths() {
  std::vector<std::string> paths = EventColumns::datasets();
  paths.pop_back();  // removes the path of the checksums
  return paths;
}

PartEvents read_part(hid_t file) {
  PartEvents events;
  for (const auto& [name, none] : EventColumns::no_counts())
    events.counts[name] = integer_attribute(file, "/events", name);
  const std::int64_t count = events.counts.at(EventColumns::num_rows);
  const auto frame = read_integers(file, "/events/frame", count);
  const auto kind = read_texts(file, "/events/kind", count);
  const auto value = read_doubles(file, "/events/value", count, 1);
  for (std::size_t i = 0; i < frame.size(); ++i) events.rows.push_back({frame[i], kind[i], value[i], {}});
  for (const std::string& path : column_paths()) {
    const RawRows rows = raw_rows(file, path, count);
    std::vector<std::byte> bytes(rows.row_bytes);
    for (std::size_t i = 0; i < events.rows.size(); ++i) {
      rows.read(i, 1, bytes.data());
      events.rows[i].bytes.insert(events.rows[i].bytes.end(), bytes.begin(), bytes.end());
    }
  }
  return events;
}

/// The events of worlds in these frames, in their order.
std::vector<const EventRow*> of_worlds(const PartEvents& events, const Stretch& frames) {
  std::vector<const EventRow*> found;
  for (const EventRow& row : events.rows) {
    if (row.frame >= frames.first && row.frame < frames.end() && !EventColumns::is_of_the_run(row.kind))
      found.push_back(&row);
  }
  return found;
}

/// Does the part have a row for each event of a world that happened before the end of these frames?
bool knows_all(const PartEvents& events, const Stretch& frames) {
  const auto last = std::find_if(events.rows.rbegin(), events.rows.rend(),
                                 [](const EventRow& row) { return !EventColumns::is_of_the_run(row.kind); });
  return events.counts.at(EventColumns::num_dropped) == 0 ||
         (last != events.rows.rend() && last->frame >= frames.end());
}

/// The events of worlds in frames that two parts share, from the part that has them all.
std::vector<const EventRow*> common_events(const JoinPart& a, const PartEvents& in_a, const JoinPart& b,
                                           const PartEvents& in_b, const Stretch& overlap) {
  const bool a_knows = knows_all(in_a, overlap), b_knows = knows_all(in_b, overlap);
  core::require_input(a_knows || b_knows,
                      a.path + " and " + b.path +
                          " have more events in the frames that both have than they have room "
                          "for: which these are is not known, and they cannot be joined");
  const auto of_a = of_worlds(in_a, overlap), of_b = of_worlds(in_b, overlap);
  const bool are_equal = std::ranges::equal(
      of_a, of_b, [](const EventRow* x, const EventRow* y) { return x->bytes == y->bytes; });
  core::require_input(!a_knows || !b_knows || are_equal,
                      a.path + " and " + b.path + " do not have the same events in frames " +
                          std::to_string(overlap.first) + " to " + std::to_string(overlap.end() - 1) +
                          ", which both have; they are not of one run, or of other builds");
  return a_knows ? of_a : of_b;
}

/// Counts one event less of its kind.
void take_off(const EventRow& row, EventCounts& counts) {
  --counts[EventColumns::count_name(row.kind)];
  if (row.kind == event_kind::rebalance)
    counts[EventColumns::worlds_moved] -= static_cast<std::int64_t>(row.value);
}

}  // namespace

JoinedEvents::JoinedEvents(const std::vector<JoinPart>& parts, const JoinPlan& plan)
    : counts_(EventColumns::no_counts()) {
  std::vector<PartEvents> events;
  events.reserve(parts.size());
  for (const JoinPart& part : parts) events.push_back(read_part(part.file));
  int rows_of_the_run = 0, rows_of_worlds = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EventCounts counts = events[i].counts;
    for (const Stretch& overlap : plan.overlaps_of(i)) {
      for (const EventRow* row :
           common_events(parts[i], events[i], parts[overlap.part], events[overlap.part], overlap))
        take_off(*row, counts);
    }
    for (const EventRow& row : events[i].rows) {
      const bool of_the_run = EventColumns::is_of_the_run(row.kind);
      if (plan.part_of(row.frame) != i) {
        // Events of worlds in frames that both parts have are taken off above.
        if (of_the_run || !plan.parts()[i].has(row.frame)) take_off(row, counts);
        continue;
      }
      int& taken = of_the_run ? rows_of_the_run : rows_of_worlds;
      const int room = of_the_run ? EventColumns::max_rows_of_the_run
                                  : EventColumns::max_rows - EventColumns::max_rows_of_the_run;
      if (taken == room) continue;
      ++taken;
      rows_.push_back(row.bytes);
    }
    for (const auto& [name, count] : counts) counts_[name] += count;
  }
  std::int64_t told = 0;
  for (const char* kind : event_kind::all) told += counts_[EventColumns::count_name(kind)];
  counts_[EventColumns::num_rows] = num_rows();
  counts_[EventColumns::num_dropped] = told - num_rows();
}

void JoinedEvents::write(hid_t to) const {
  std::size_t begin = 0;
  for (const std::string& path : column_paths()) {
    const RawRows column = raw_rows(to, path);
    const std::size_t bytes = column.row_bytes;
    std::vector<std::byte> values;
    for (const auto& row : rows_)
      values.insert(values.end(), row.begin() + static_cast<std::ptrdiff_t>(begin),
                    row.begin() + static_cast<std::ptrdiff_t>(begin + bytes));
    column.write(0, rows_.size(), values.data());
    begin += bytes;
  }
  std::vector<std::uint64_t> checksums;
  for (const auto& row : rows_) {
    core::Checksum sum;
    sum.add(row);
    checksums.push_back(sum.value());
  }
  raw_rows(to, EventColumns::datasets().back()).write(0, checksums.size(), checksums.data());
}

}  // namespace pbmpi::io
