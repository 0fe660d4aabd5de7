#include "io/join/join_rows.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "core/system/seal.h"
#include "io/hdf5/file_checksum.h"
#include "io/hdf5/read_columns.h"
#include "io/run/contact_rows.h"
#include "io/run/event_columns.h"

namespace pbmpi::io {
namespace {

constexpr std::size_t piece_bytes = std::size_t{4} << 20;

/// Columns that clocks have measured or decided, or that describe ranks, whose number differs between parts:
/// no two executions of a frame agree on them.
bool is_of_one_execution(const std::string& column) {
  constexpr std::array clocks = {"/timings/frame/wall",
                                 "/timings/frame/deadline_met",
                                 "/timings/island/solve",
                                 "/timings/space/collide",
                                 "/timings/space/collide_spaces",
                                 "/estimate/delivered",
                                 "/estimate/precise",
                                 "/estimate/compute"};
  return column.starts_with("/timings/rank/") || std::ranges::find(clocks, column) != clocks.end();
}

std::vector<std::byte> read_bytes(const RawRows& rows, JoinPlan::Rows range) {
  std::vector<std::byte> values(static_cast<std::size_t>(range.count) * rows.row_bytes);
  rows.read(static_cast<hsize_t>(range.first), static_cast<hsize_t>(range.count), values.data());
  return values;
}

JoinPlan::Rows rows_of(const JoinedTable& table, const JoinPlan& plan, const Stretch& frames,
                       std::int64_t begin) {
  if (table.rows == Rows::frames) return {frames.first - begin, frames.count};
  return plan.recorded_rows(frames.first, frames.count, begin);
}

/// Rows of `bytes_old` each, padded with zeros for ranks that a part did not have.
std::vector<std::byte> widened(const std::vector<std::byte>& values, std::size_t bytes_old,
                               std::size_t bytes_new) {
  if (bytes_old == bytes_new) return values;
  std::vector<std::byte> wide(values.size() / std::max<std::size_t>(bytes_old, 1) * bytes_new, std::byte{0});
  for (std::size_t from = 0, to = 0; from < values.size(); from += bytes_old, to += bytes_new)
    std::memcpy(&wide[to], &values[from], bytes_old);
  return wide;
}

void write_table(const std::vector<JoinPart>& parts, const JoinedTable& table, const JoinPlan& plan,
                 const Stretch& stretch, hid_t to) {
  const JoinPart& part = parts[stretch.part];
  const JoinPlan::Rows from = rows_of(table, plan, stretch, plan.parts()[stretch.part].first);
  const JoinPlan::Rows into = rows_of(table, plan, stretch, plan.first());
  std::vector<RawRows> sources, targets;
  std::size_t row_bytes = 1;
  for (const std::string& column : table.columns) {
    sources.push_back(raw_rows(part.file, column, from.first + from.count));
    targets.push_back(raw_rows(to, column));
    row_bytes += targets.back().row_bytes;
  }
  const auto piece = static_cast<std::int64_t>(std::max<std::size_t>(piece_bytes / row_bytes, 1));
  for (std::int64_t row = 0; row < from.count; row += piece) {
    const std::int64_t count = std::min(piece, from.count - row);
    std::vector<core::Checksum> sums(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const std::size_t bytes = targets[i].row_bytes;
      const auto values =
          widened(read_bytes(sources[i], {from.first + row, count}), sources[i].row_bytes, bytes);
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k].add(std::span(values).subspan(k * bytes, bytes));
      targets[i].write(static_cast<hsize_t>(into.first + row), static_cast<hsize_t>(count), values.data());
    }
    std::vector<std::uint64_t> checksums;
    checksums.reserve(sums.size());
    for (const core::Checksum& sum : sums) checksums.push_back(sum.value());
    raw_rows(to, table.checksums)
        .write(static_cast<hsize_t>(into.first + row), checksums.size(), checksums.data());
  }
}

/// Rows of /contacts/frame as columns.
struct ContactFrames {
  std::vector<std::int64_t> first, count, dropped;
  std::vector<std::uint64_t> checksum, row_checksum;

  void add(std::int64_t first_point, const ContactSpan& span, std::int64_t num_dropped) {
    first.push_back(first_point);
    count.push_back(span.count);
    dropped.push_back(num_dropped);
    checksum.push_back(span.checksum);
    core::Checksum sum;  // over the columns in their order
    for (const auto* column : {&first, &count, &dropped})
      sum.add(std::as_bytes(std::span(&column->back(), 1)));
    sum.add(std::as_bytes(std::span(&checksum.back(), 1)));
    row_checksum.push_back(sum.value());
  }
  void write(hid_t to, std::int64_t row) const {
    const std::string group = ContactRows::frame_group;
    const auto put = [&](const std::string& path, const auto& values) {
      raw_rows(to, path).write(static_cast<hsize_t>(row), values.size(), values.data());
    };
    put(group + "/first", first);
    put(group + "/count", count);
    put(group + "/dropped", dropped);
    put(group + "/checksum", checksum);
    put(row_checksum_path(group + "/first"), row_checksum);
  }
};

/// Writes the contacts of a stretch of frames after those of the frames before.
void write_contacts(const std::vector<JoinPart>& parts, const JoinPlan& plan, hid_t to) {
  std::int64_t next = 0;
  for (const Stretch& stretch : plan.stretches()) {
    const hid_t from = parts[stretch.part].file;
    const std::int64_t begin = stretch.first - plan.parts()[stretch.part].first;
    const std::vector<ContactSpan> spans = read_contact_spans(from, begin + stretch.count);
    const auto dropped =
        read_integers(from, std::string(ContactRows::frame_group) + "/dropped", begin + stretch.count);
    ContactFrames frames;
    std::int64_t num_points = 0;
    for (auto i = static_cast<std::size_t>(begin); i < spans.size(); ++i) {
      frames.add(next + num_points, spans[i], dropped[i]);
      num_points += spans[i].count;
    }
    frames.write(to, stretch.first - plan.first());
    const RawRows points = raw_rows(from, ContactRows::points), written = raw_rows(to, ContactRows::points);
    const auto piece = static_cast<std::int64_t>(piece_bytes / points.row_bytes);
    for (std::int64_t row = 0; row < num_points; row += piece) {
      const std::int64_t count = std::min(piece, num_points - row);
      const auto values = read_bytes(points, {spans[static_cast<std::size_t>(begin)].first + row, count});
      written.write(static_cast<hsize_t>(next + row), static_cast<hsize_t>(count), values.data());
    }
    next += num_points;
  }
}

std::int64_t num_contacts(const std::vector<JoinPart>& parts, const JoinPlan& plan) {
  std::int64_t all = 0;
  for (const Stretch& stretch : plan.stretches()) {
    const std::int64_t begin = stretch.first - plan.parts()[stretch.part].first;
    const auto counts = read_integers(
        parts[stretch.part].file, std::string(ContactRows::frame_group) + "/count", begin + stretch.count);
    for (auto count = counts.begin() + begin; count != counts.end(); ++count) all += *count;
  }
  return all;
}

[[noreturn]] void refuse_overlap(const JoinPart& a, const JoinPart& b, std::int64_t frame,
                                 const std::string& column) {
  throw core::InputError("frame " + std::to_string(frame) + " is in " + a.path + " and in " + b.path +
                         ", and " + column +
                         " is not the same in both; they are not of one run, or of other builds");
}

void require_equal(const JoinPart& a, JoinPlan::Rows rows_a, const JoinPart& b, JoinPlan::Rows rows_b,
                   const std::string& column, std::int64_t begin_a, std::int64_t frames_a_row) {
  const RawRows in_a = raw_rows(a.file, column), in_b = raw_rows(b.file, column);
  if (in_a.row_bytes != in_b.row_bytes)
    refuse_overlap(a, b, begin_a + (rows_a.first + 1) * frames_a_row - 1, column);
  for (std::int64_t i = 0; i < rows_a.count; ++i) {
    if (read_bytes(in_a, {rows_a.first + i, 1}) != read_bytes(in_b, {rows_b.first + i, 1}))
      refuse_overlap(a, b, begin_a + (rows_a.first + i + 1) * frames_a_row - 1, column);
  }
}

/// Do both parts record the motion of the same frames?
bool record_alike(const PartFrames& a, const PartFrames& b, std::int64_t record_every) {
  return (a.first - b.first) % record_every == 0;
}

}  // namespace

CommonTables common_tables(const std::vector<JoinPart>& parts) {
  CommonTables common;
  const auto add_to_some = [&](const std::string& name, const std::vector<std::string>& datasets) {
    common.of_some.push_back(name);
    for (const std::string& path : datasets) {
      if (has_object(parts.front().file, path)) common.left_out.insert(path);
    }
  };
  const auto parts_with = [&](const std::string& path) {
    return std::ranges::count_if(parts, [&](const JoinPart& part) { return has_object(part.file, path); });
  };
  for (const FrameTable& table : all_frame_tables()) {
    std::vector<std::string> datasets = GrowingTable::datasets(table.group, table.columns);
    const auto found = parts_with(datasets.front());
    if (found == 0) continue;
    if (found < std::ssize(parts)) {
      add_to_some(datasets.front(), datasets);
      continue;
    }
    JoinedTable joined{std::move(datasets), "", table.rows, table.items == Items::ranks};
    joined.checksums = joined.columns.back();
    joined.columns.pop_back();
    common.tables.push_back(std::move(joined));
  }
  const auto found = parts_with(ContactRows::points);
  common.has_contacts = found == std::ssize(parts);
  if (found > 0 && !common.has_contacts) {
    std::vector<std::string> datasets =
        GrowingTable::datasets(ContactRows::frame_group, ContactRows::frame_columns());
    datasets.emplace_back(ContactRows::points);
    datasets.emplace_back(ContactRows::frame_group);  // leaves the group above it empty
    add_to_some(ContactRows::points, datasets);
  }
  return common;
}

std::set<std::string> growing_datasets() {
  std::set<std::string> all = {ContactRows::points};
  const auto add = [&all](const std::vector<std::string>& paths) { all.insert(paths.begin(), paths.end()); };
  for (const FrameTable& table : all_frame_tables()) add(GrowingTable::datasets(table.group, table.columns));
  add(GrowingTable::datasets(ContactRows::frame_group, ContactRows::frame_columns()));
  add(EventColumns::datasets());
  return all;
}

std::map<std::string, GrownDataset> grown_datasets(const std::vector<JoinPart>& parts,
                                                   const CommonTables& common, const JoinPlan& plan,
                                                   std::int64_t num_events) {
  std::map<std::string, GrownDataset> grown;
  hsize_t num_ranks = 0;
  for (const JoinPart& part : parts) num_ranks = std::max(num_ranks, static_cast<hsize_t>(part.num_ranks));
  const auto frames = static_cast<hsize_t>(plan.num_frames());
  const hsize_t recorded = frames / static_cast<hsize_t>(plan.record_every());
  for (const JoinedTable& table : common.tables) {
    const hsize_t rows = table.rows == Rows::frames ? frames : recorded;
    for (const std::string& column : table.columns)
      grown[column] = {rows, table.has_ranks ? num_ranks : 0, 0};
    grown[table.checksums] = {rows, 0, 0};
  }
  if (common.has_contacts) {
    for (const std::string& path :
         GrowingTable::datasets(ContactRows::frame_group, ContactRows::frame_columns()))
      grown[path] = {frames, 0, 0};
    grown[ContactRows::points] = {static_cast<hsize_t>(num_contacts(parts, plan)), 0, 0};
  }
  for (const std::string& path : EventColumns::datasets())
    grown[path] = {static_cast<hsize_t>(num_events), 0, 0};
  return grown;
}

void require_equal_overlaps(const std::vector<JoinPart>& parts, const CommonTables& common,
                            const JoinPlan& plan) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const Stretch& overlap : plan.overlaps_of(i)) {
      const JoinPart &a = parts[i], &b = parts[overlap.part];
      const PartFrames &in_a = plan.parts()[i], &in_b = plan.parts()[overlap.part];
      for (const JoinedTable& table : common.tables) {
        const bool is_recorded = table.rows == Rows::recorded;
        if (is_recorded && !record_alike(in_a, in_b, plan.record_every())) continue;
        for (const std::string& column : table.columns) {
          if (is_of_one_execution(column)) continue;
          require_equal(a, rows_of(table, plan, overlap, in_a.first), b,
                        rows_of(table, plan, overlap, in_b.first), column, in_a.first,
                        is_recorded ? plan.record_every() : 1);
        }
      }
      if (!common.has_contacts) continue;
      for (const char* column : {"count", "dropped", "checksum"}) {
        require_equal(a, {overlap.first - in_a.first, overlap.count}, b,
                      {overlap.first - in_b.first, overlap.count},
                      std::string(ContactRows::frame_group) + "/" + column, in_a.first, 1);
      }
    }
  }
}

void write_joined_rows(const std::vector<JoinPart>& parts, const CommonTables& common, const JoinPlan& plan,
                       hid_t to) {
  for (const JoinedTable& table : common.tables) {
    for (const Stretch& stretch : plan.stretches()) write_table(parts, table, plan, stretch, to);
  }
  if (common.has_contacts) write_contacts(parts, plan, to);
}

}  // namespace pbmpi::io
