#include "io/run/contact_rows.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>

#include "core/system/seal.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/read_columns.h"

namespace pbmpi::io {
namespace {

constexpr std::size_t num_columns = contact_columns.size();
constexpr std::size_t bytes_a_row = num_columns * sizeof(double);

std::string column_names() {
  std::string names;
  for (const char* name : contact_columns) names += std::string(names.empty() ? "" : " ") + name;
  return names;
}

/// Small chunks for a short run leave little unused space at the end of the file.
hsize_t chunk_rows(hsize_t capacity) {
  constexpr hsize_t least = (hsize_t{64} << 10) / bytes_a_row, most = (hsize_t{4} << 20) / bytes_a_row;
  constexpr hsize_t num_chunks = 128;
  return std::min(std::clamp(capacity / num_chunks, least, most), capacity);
}

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  core::Checksum sum;
  sum.add(bytes);
  return sum.value();
}

}  // namespace

std::vector<ColumnSpec> ContactRows::frame_columns() {
  return {{"first", H5T_NATIVE_INT64},
          {"count", H5T_NATIVE_INT64},
          {"dropped", H5T_NATIVE_INT64},
          {"checksum", H5T_NATIVE_UINT64}};
}

hsize_t ContactRows::capacity(const RunShape& shape) {
  // A body in a dense heap has about ten contacts; a world of few bodies may lie on many geoms.
  const std::int64_t most_a_frame = 16 * shape.num_bodies + 16 * shape.num_worlds;
  return static_cast<hsize_t>(std::max<std::int64_t>(shape.num_frames * most_a_frame, 1));
}

std::int64_t ContactRows::expected_bytes(const RunShape& shape) {
  return shape.num_frames * shape.num_bodies * static_cast<std::int64_t>(bytes_a_row);
}

std::int64_t ContactRows::spare_bytes(const RunShape& shape) {
  const auto most = static_cast<std::int64_t>(capacity(shape) * bytes_a_row);
  return std::max<std::int64_t>(most - expected_bytes(shape), 0);
}

void ContactRows::create(hid_t file, const RunShape& shape) {
  GrowingTable::create(file, frame_group, frame_columns(), {static_cast<hsize_t>(shape.num_frames), 0});
  const hsize_t most = capacity(shape);
  const Dataset dataset =
      create_growing(file, points, number_type(H5T_NATIVE_DOUBLE), {most, num_columns}, "", chunk_rows(most));
  write_attribute(dataset.id(), "columns", column_names());
}

ContactRows::ContactRows(hid_t file, const FileRanks& ranks, const RunShape& shape,
                         std::vector<std::int64_t> geom_offset, hsize_t frames_held)
    : ranks_(ranks),
      geom_offset_(std::move(geom_offset)),
      capacity_(capacity(shape)),
      substep_s_(shape.substep_s),
      dataset_(owned<Dataset>(H5Dopen2(file, points, H5P_DEFAULT), "H5Dopen(contacts)")),
      frames_(file, ranks, frame_group, frame_columns(),
              {static_cast<hsize_t>(shape.num_frames), 0, frames_held}) {}

void ContactRows::add(const FrameSource& source) {
  Part& part = waiting_.emplace_back();
  part.num_rows.resize(geom_offset_.size() - 1, 0);
  for (const stepping::LocalWorld& world : source.frame.worlds) {
    const std::size_t before = part.rows.size();
    add_world(source, world, part);
    part.num_rows[static_cast<std::size_t>(world.id)] = static_cast<std::int64_t>(part.rows.size() - before);
  }
}

/// Adds the contacts of the step, merged by their geoms with the remembered contacts of sleeping bodies.
void ContactRows::add_world(const FrameSource& source, const stepping::LocalWorld& world, Part& part) const {
  static const stepping::StepContacts none;
  const stepping::StepContacts& shown = world.contacts != nullptr ? *world.contacts : none;
  const std::vector<model::ContactForce>& memory = world.state->memory.contacts;
  const auto geom0 = static_cast<double>(geom_offset_[static_cast<std::size_t>(world.id)]);
  const auto body0 = static_cast<double>(source.first_body(world));
  const auto put = [&](const model::ContactForce& force, const model::Contact* contact) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const model::Vec3 nowhere(unknown, unknown, unknown);
    const model::Vec3 position =
        contact != nullptr ? contact->position : model::Vec3(world.state->position[force.body_a] + force.arm);
    const model::Vec3 normal = contact != nullptr ? contact->normal : nowhere;
    const model::Vec3 impulse =
        contact != nullptr ? model::Vec3(substep_s_ * (force.normal * normal + force.friction)) : nowhere;
    Row row = {static_cast<double>(world.id),
               geom0 + force.geoms.first,
               geom0 + force.geoms.second,
               body0 + force.body_a,
               force.body_b == model::no_body ? -1 : body0 + force.body_b,
               contact != nullptr ? 1.0 : 0.0};
    double* to = &row[6];
    for (const model::Vec3& vector : {position, normal}) to = std::copy_n(vector.data(), 3, to);
    *to++ = contact != nullptr ? contact->depth : unknown;
    *to++ = contact != nullptr ? contact->mu : unknown;
    to = std::copy_n(force.arm.data(), 3, to);
    *to++ = force.normal;
    for (const model::Vec3& vector : {force.friction, impulse}) to = std::copy_n(vector.data(), 3, to);
    part.rows.push_back(row);
  };
  std::size_t old = 0;
  const auto put_sleeping_before = [&](const model::GeomPair* pair) {
    for (; old < memory.size() && (pair == nullptr || memory[old].geoms < *pair); ++old)
      put(memory[old], nullptr);
  };
  for (const auto& [contact, force] : shown.contacts) {
    put_sleeping_before(&force.geoms);
    put(force, &contact);
    while (old < memory.size() && memory[old].geoms == force.geoms) ++old;  // the contacts of the step
  }
  put_sleeping_before(nullptr);
}

std::vector<std::int64_t> ContactRows::count_rows() const {
  std::vector<std::int64_t> counts;
  for (const Part& part : waiting_) counts.insert(counts.end(), part.num_rows.begin(), part.num_rows.end());
  ranks_.sum(counts);
  return counts;
}

/// When sent, a row is preceded by the number of its frame. A world's rows of a frame come from one rank, in
/// order.
std::vector<ContactRows::Row> ContactRows::exchange(const std::vector<std::int64_t>& counts,
                                                    Range frames) const {
  using WireRow = std::array<double, num_columns + 1>;
  std::vector<std::vector<std::byte>> messages(static_cast<std::size_t>(ranks_.size()));
  for (int to = 0; to < ranks_.size(); ++to) {
    const Range share = share_of_rows(waiting_.size(), to, ranks_.size());
    for (hsize_t frame = share.first; frame < share.first + share.count; ++frame) {
      for (const Row& row : waiting_[frame].rows) {
        WireRow wire{static_cast<double>(frame)};
        std::ranges::copy(row, wire.begin() + 1);
        const auto bytes = std::as_bytes(std::span(wire));
        messages[to].insert(messages[to].end(), bytes.begin(), bytes.end());
      }
    }
  }
  const std::vector<std::byte> received =
      ranks_.size() == 1 ? std::move(messages[0]) : ranks_.exchange(messages);
  const std::size_t num_worlds = geom_offset_.size() - 1;
  std::vector<std::size_t> next;  // [frames][num_worlds] where a world's next row is put
  std::size_t num_rows = 0;
  for (std::size_t i = frames.first * num_worlds; i < (frames.first + frames.count) * num_worlds; ++i) {
    next.push_back(num_rows);
    num_rows += static_cast<std::size_t>(counts[i]);
  }
  std::vector<Row> rows(num_rows);
  for (std::size_t at = 0; at < received.size(); at += sizeof(WireRow)) {
    WireRow wire;
    std::memcpy(wire.data(), &received[at], sizeof wire);
    const auto frame = static_cast<std::size_t>(wire[0]), world = static_cast<std::size_t>(wire[1]);
    std::copy(wire.begin() + 1, wire.end(),
              rows[next[(frame - frames.first) * num_worlds + world]++].begin());
  }
  return rows;
}

void ContactRows::settle() {
  if (waiting_.empty()) return;
  const std::size_t num_worlds = geom_offset_.size() - 1;
  const std::vector<std::int64_t> counts = count_rows();
  const Range own = share_of_rows(waiting_.size(), ranks_.rank(), ranks_.size());
  const std::vector<Row> rows = exchange(counts, own);
  own_rows_.clear();
  std::size_t from = 0;
  for (hsize_t frame = 0; frame < waiting_.size(); ++frame) {
    std::int64_t count = 0;
    for (std::size_t world = 0; world < num_worlds; ++world) count += counts[frame * num_worlds + world];
    const bool fits = settled_ + static_cast<hsize_t>(count) <= capacity_;
    const bool is_own = frame >= own.first && frame < own.first + own.count;
    if (frame == own.first) first_own_ = settled_;
    frames_.begin_row(is_own ? std::vector<Range>{{0, 1}} : std::vector<Range>{});
    if (is_own) {
      const auto of_frame = std::span(rows).subspan(from, fits ? static_cast<std::size_t>(count) : 0);
      from += static_cast<std::size_t>(count);
      own_rows_.insert(own_rows_.end(), of_frame.begin(), of_frame.end());
      frames_.put(0, 0, static_cast<std::int64_t>(settled_));
      frames_.put(1, 0, fits ? count : 0);
      frames_.put(2, 0, fits ? std::int64_t{0} : count);
      frames_.put(3, 0, checksum_of(std::as_bytes(of_frame)));
    }
    if (fits) settled_ += static_cast<hsize_t>(count);
  }
  waiting_.clear();
  frames_.settle();
}

void ContactRows::write() {
  frames_.write();
  write_rows(dataset_, H5T_NATIVE_DOUBLE, {first_own_, own_rows_.size()}, own_rows_.data(), points);
  written_ = settled_;
  own_rows_.clear();
}

void ContactRows::close() {
  frames_.close();
  dataset_.close();
}

void ContactRows::cut(hid_t file, std::vector<core::ByteRange>& unused) const {
  frames_.cut(file, unused);
  cut_rows(file, points, written_, unused);
}

std::vector<ContactSpan> read_contact_spans(hid_t file, std::int64_t num_frames) {
  if (!has_object(file, "/contacts")) return {};
  const auto first = read_integers(file, std::string(ContactRows::frame_group) + "/first", num_frames);
  const auto count = read_integers(file, std::string(ContactRows::frame_group) + "/count", num_frames);
  const RawRows sums = raw_rows(file, std::string(ContactRows::frame_group) + "/checksum", num_frames);
  if (sums.row_bytes != sizeof(std::uint64_t)) throw core::RunError(sums.path + " is no column of checksums");
  std::vector<std::uint64_t> checksum(static_cast<std::size_t>(num_frames));
  sums.read(0, sums.num_rows, checksum.data());
  std::vector<ContactSpan> spans;
  std::int64_t next = 0;
  for (std::size_t frame = 0; frame < first.size(); ++frame) {
    if (first[frame] != next || count[frame] < 0)
      throw core::RunError(std::string(ContactRows::frame_group) + " does not say where the rows of frame " +
                           std::to_string(frame) + " are");
    next += count[frame];
    spans.push_back({first[frame], count[frame], checksum[frame]});
  }
  return spans;
}

void check_contacts(hid_t file, const std::vector<ContactSpan>& spans) {
  if (spans.empty()) return;
  const RawRows rows = raw_rows(file, ContactRows::points, spans.back().first + spans.back().count);
  std::vector<std::byte> values;
  for (const ContactSpan& span : spans) {
    values.resize(static_cast<std::size_t>(span.count) * rows.row_bytes);
    rows.read(static_cast<hsize_t>(span.first), static_cast<hsize_t>(span.count), values.data());
    if (checksum_of(values) != span.checksum)
      throw core::RunError("row " + std::to_string(span.first) + " of " + ContactRows::points +
                           ", or one of the " + std::to_string(span.count) +
                           " of its frame, changed since it was written");
  }
}

}  // namespace pbmpi::io
