#include "io/run/frame_columns.h"

#include <algorithm>

#include "io/hdf5/columns.h"

namespace pbmpi::io {
namespace {

// The add_... functions below put values in the order of these lists.

const std::vector<ColumnSpec>& body_columns() {
  static const std::vector<ColumnSpec> columns = {
      {"position/value", H5T_NATIVE_DOUBLE, 3, "m"},
      {"orientation/value", H5T_NATIVE_DOUBLE, 4, ""},
      {"velocity/value", H5T_NATIVE_DOUBLE, 3, "m s-1"},
      {"angular_velocity/value", H5T_NATIVE_DOUBLE, 3, "rad s-1"}};
  return columns;
}

const std::vector<ColumnSpec>& recorded_columns() {
  static const std::vector<ColumnSpec> columns = {{"step", H5T_NATIVE_INT64},
                                                  {"time", H5T_NATIVE_DOUBLE, 1, "s"}};
  return columns;
}

const std::vector<ColumnSpec>& world_columns() {
  static const std::vector<ColumnSpec> columns = {{"contacts", H5T_NATIVE_INT32},
                                                  {"rows", H5T_NATIVE_INT32},
                                                  {"islands", H5T_NATIVE_INT32},
                                                  {"max_island_rows", H5T_NATIVE_INT32},
                                                  {"energy", H5T_NATIVE_DOUBLE, 1, "J"},
                                                  {"max_penetration", H5T_NATIVE_DOUBLE, 1, "m"},
                                                  {"joint_gap", H5T_NATIVE_DOUBLE, 1, "m"},
                                                  {"nonfinite", H5T_NATIVE_INT32}};
  return columns;
}

const std::vector<ColumnSpec>& residual_columns() {
  static const std::vector<ColumnSpec> columns = {{"joint_speed", H5T_NATIVE_DOUBLE, 1, "m s-1"},
                                                  {"joint_turn", H5T_NATIVE_DOUBLE, 1, "rad s-1"},
                                                  {"complementarity", H5T_NATIVE_DOUBLE, 1, "J"},
                                                  {"natural_speed", H5T_NATIVE_DOUBLE, 1, "m s-1"},
                                                  {"natural_turn", H5T_NATIVE_DOUBLE, 1, "rad s-1"}};
  return columns;
}

const std::vector<ColumnSpec>& interest_columns() {
  static const std::vector<ColumnSpec> columns = {{"bodies_inside", H5T_NATIVE_INT32}};
  return columns;
}

const std::vector<ColumnSpec>& frame_columns() {
  static const std::vector<ColumnSpec> columns = {{"step", H5T_NATIVE_INT64},
                                                  {"time", H5T_NATIVE_DOUBLE, 1, "s"},
                                                  {"measured", H5T_NATIVE_UINT8},
                                                  {"wall", H5T_NATIVE_DOUBLE, 1, "s"},
                                                  {"deadline_met", H5T_NATIVE_UINT8}};
  return columns;
}

std::vector<ColumnSpec> phase_columns() {
  std::vector<ColumnSpec> columns;
  columns.reserve(core::phase_names.size() + 3);
  for (const std::string_view phase : core::phase_names) {
    columns.push_back({std::string(phase), H5T_NATIVE_DOUBLE, 1, "s"});
  }
  columns.push_back({"useful", H5T_NATIVE_DOUBLE, 1, "s"});
  columns.push_back({"messages", H5T_NATIVE_INT64});
  columns.push_back({"bytes", H5T_NATIVE_INT64, 1, "B"});
  return columns;
}

const std::vector<ColumnSpec>& island_columns() {
  static const std::vector<ColumnSpec> columns = {{"bodies", H5T_NATIVE_INT32},
                                                  {"contacts", H5T_NATIVE_INT32},
                                                  {"rows", H5T_NATIVE_INT32},
                                                  {"solve", H5T_NATIVE_DOUBLE, 1, "s"}};
  return columns;
}

const std::vector<ColumnSpec>& space_columns() {
  static const std::vector<ColumnSpec> columns = {{"cross_contacts", H5T_NATIVE_INT32},
                                                  {"collide", H5T_NATIVE_DOUBLE, 1, "s"},
                                                  {"collide_spaces", H5T_NATIVE_DOUBLE, 1, "s"}};
  return columns;
}

const std::vector<ColumnSpec>& event_columns() {
  static const std::vector<ColumnSpec> columns = {
      {"frame", H5T_NATIVE_INT64}, {"kind", 0, 1, "", 24}, {"detail", 0, 1, "", 160}};
  return columns;
}

const std::vector<ColumnSpec>& estimated_body_columns() {
  static const std::vector<ColumnSpec> columns = {{"position/value", H5T_NATIVE_DOUBLE, 3, "m"},
                                                  {"orientation/value", H5T_NATIVE_DOUBLE, 4, ""}};
  return columns;
}

const std::vector<ColumnSpec>& estimate_time_columns() {
  static const std::vector<ColumnSpec> columns = {{"delivered", H5T_NATIVE_DOUBLE, 1, "s"},
                                                  {"precise", H5T_NATIVE_DOUBLE, 1, "s"}};
  return columns;
}

const std::vector<ColumnSpec>& estimate_compute_columns() {
  static const std::vector<ColumnSpec> columns = {{"compute", H5T_NATIVE_DOUBLE, 1, "s"}};
  return columns;
}

/// Frames that wait at most: what all ranks together hold of them stays below 32 MiB, unless one is larger.
hsize_t frames_to_hold(const RunShape& shape) {
  constexpr std::size_t most_bytes = std::size_t{32} << 20;
  const FrameBytes bytes = frame_bytes(shape);
  const std::size_t each = bytes.every_frame + bytes.recorded / static_cast<std::size_t>(shape.record_every);
  return std::max<hsize_t>(most_bytes / each, 1);
}

TableShape table_shape(std::int64_t rows, std::int64_t items, hsize_t capacity) {
  return {static_cast<hsize_t>(rows), static_cast<hsize_t>(items), capacity};
}

hsize_t recorded_to_hold(const RunShape& shape) {
  return frames_to_hold(shape) / static_cast<hsize_t>(shape.record_every) + 1;
}

/// H5MD wants step and time beside each value; all four elements share one pair.
void link_step_and_time(hid_t file) {
  for (const char* element : {"orientation", "velocity", "angular_velocity"}) {
    for (const char* column : {"step", "time"}) {
      const std::string from = std::string("/particles/bodies/position/") + column;
      const std::string to = std::string("/particles/bodies/") + element + "/" + column;
      check(H5Lcreate_hard(file, from.c_str(), file, to.c_str(), H5P_DEFAULT, H5P_DEFAULT),
            "H5Lcreate_hard(" + to + ")");
    }
  }
}

/// What root alone writes into a one-dimensional table.
std::vector<Range> on_root(const FileRanks& ranks) {
  return ranks.is_root() ? std::vector<Range>{{0, 1}} : std::vector<Range>{};
}

}  // namespace

FrameBytes frame_bytes(const RunShape& shape) {
  const auto bodies = static_cast<hsize_t>(shape.num_bodies);
  const auto worlds = static_cast<hsize_t>(shape.num_worlds);
  const auto ranks = static_cast<hsize_t>(shape.num_ranks);
  FrameBytes bytes = {
      GrowingTable::row_bytes(world_columns(), worlds) + GrowingTable::row_bytes(frame_columns(), 1) +
          GrowingTable::row_bytes(phase_columns(), ranks),
      GrowingTable::row_bytes(body_columns(), bodies) + GrowingTable::row_bytes(recorded_columns(), 1)};
  if (shape.optional.estimate) {
    bytes.every_frame += GrowingTable::row_bytes(estimate_time_columns(), 1) +
                         GrowingTable::row_bytes(estimate_compute_columns(), ranks);
    bytes.recorded += GrowingTable::row_bytes(estimated_body_columns(), bodies);
  }
  if (shape.optional.residuals) bytes.every_frame += GrowingTable::row_bytes(residual_columns(), worlds);
  if (shape.optional.interest) bytes.every_frame += GrowingTable::row_bytes(interest_columns(), worlds);
  if (shape.optional.profile) {
    bytes.every_frame +=
        GrowingTable::row_bytes(island_columns(), bodies) + GrowingTable::row_bytes(space_columns(), worlds);
  }
  return bytes;
}

std::size_t event_bytes() { return max_events * GrowingTable::row_bytes(event_columns(), 1); }

FrameColumns::FrameColumns(hid_t file, const FileRanks& ranks, const stepping::WorldTable& table,
                           const RunShape& shape)
    : ranks_(ranks),
      table_(table),
      record_every_(shape.record_every),
      first_frame_(shape.first_frame),
      next_frame_(shape.first_frame),
      bodies_(file, ranks, "/particles/bodies", body_columns(),
              table_shape(shape.num_recorded(), shape.num_bodies, recorded_to_hold(shape))),
      recorded_(file, ranks, "/particles/bodies/position", recorded_columns(),
                table_shape(shape.num_recorded(), 0, recorded_to_hold(shape))),
      worlds_(file, ranks, "/observables/world", world_columns(),
              table_shape(shape.num_frames, shape.num_worlds, frames_to_hold(shape))),
      frames_(file, ranks, "/timings/frame", frame_columns(),
              table_shape(shape.num_frames, 0, frames_to_hold(shape))),
      phases_(file, ranks, "/timings/rank", phase_columns(),
              table_shape(shape.num_frames, shape.num_ranks, frames_to_hold(shape))),
      events_(file, ranks, "/events", event_columns(), table_shape(max_events, 0, max_events)) {
  link_step_and_time(file);
  if (shape.optional.residuals) {
    residuals_.emplace(file, ranks, "/observables/residual", residual_columns(),
                       table_shape(shape.num_frames, shape.num_worlds, frames_to_hold(shape)));
  }
  if (shape.optional.interest) {
    interest_.emplace(file, ranks, "/observables/interest", interest_columns(),
                      table_shape(shape.num_frames, shape.num_worlds, frames_to_hold(shape)));
  }
  if (shape.optional.profile) {
    islands_.emplace(file, ranks, "/timings/island", island_columns(),
                     table_shape(shape.num_frames, shape.num_bodies, frames_to_hold(shape)));
    spaces_.emplace(file, ranks, "/timings/space", space_columns(),
                    table_shape(shape.num_frames, shape.num_worlds, frames_to_hold(shape)));
  }
  if (!shape.optional.estimate) return;
  estimate_times_.emplace(file, ranks, "/estimate", estimate_time_columns(),
                          table_shape(shape.num_frames, 0, frames_to_hold(shape)));
  estimate_compute_.emplace(file, ranks, "/estimate", estimate_compute_columns(),
                            table_shape(shape.num_frames, shape.num_ranks, frames_to_hold(shape)));
  // The largest last: only space at the end of the file goes when a run is cut.
  estimated_bodies_.emplace(file, ranks, "/estimate", estimated_body_columns(),
                            table_shape(shape.num_recorded(), shape.num_bodies, recorded_to_hold(shape)));
}

void FrameColumns::add(const stepping::FrameRecord& frame) {
  core::require_invariant(frame.frame == next_frame_, "frames come in order");
  ++next_frame_;
  add_observables(frame);
  if (residuals_) add_residuals(frame);
  if (interest_) add_interest(frame);
  if (islands_) add_profiles(frame);
  add_times(frame);
  if (is_recorded(frame)) add_bodies(frame);
  if (estimate_times_) add_estimate(frame);
}

void FrameColumns::add_estimate(const stepping::FrameRecord& frame) {
  core::require_invariant(frame.estimate != nullptr, "a frame has the estimate that its file has room for");
  estimate_times_->begin_row(on_root(ranks_));
  estimate_times_->put(0, 0, frame.estimate->delivered_s);
  estimate_times_->put(1, 0, frame.wall_s);
  const auto rank = static_cast<hsize_t>(ranks_.rank());
  estimate_compute_->begin_row({{rank, 1}});
  estimate_compute_->put(0, rank, frame.estimate->compute_s);
  if (!is_recorded(frame)) return;
  std::vector<Range> ranges;
  for (const stepping::LocalWorld& world : frame.estimate->worlds) {
    append_range(ranges, static_cast<hsize_t>(table_.body_offset[world.id]), world.state->position.size());
  }
  estimated_bodies_->begin_row(ranges);
  for (const stepping::LocalWorld& world : frame.estimate->worlds) {
    const auto first = static_cast<hsize_t>(table_.body_offset[world.id]);
    estimated_bodies_->put(0, first, world.state->position.data(), world.state->position.size());
    estimated_bodies_->put(1, first, world.state->orientation.data(), world.state->orientation.size());
  }
}

void FrameColumns::add_bodies(const stepping::FrameRecord& frame) {
  std::vector<Range> ranges;
  for (const stepping::LocalWorld& world : frame.worlds) {
    append_range(ranges, static_cast<hsize_t>(table_.body_offset[world.id]), world.state->position.size());
  }
  bodies_.begin_row(ranges);
  for (const stepping::LocalWorld& world : frame.worlds) {
    const model::State& state = *world.state;
    const auto first = static_cast<hsize_t>(table_.body_offset[world.id]);
    bodies_.put(0, first, state.position.data(), state.position.size());
    bodies_.put(1, first, state.orientation.data(), state.orientation.size());
    bodies_.put(2, first, state.velocity.data(), state.velocity.size());
    bodies_.put(3, first, state.angular_velocity.data(), state.angular_velocity.size());
  }
  recorded_.begin_row(on_root(ranks_));
  recorded_.put(0, 0, frame.step);
  recorded_.put(1, 0, frame.time_s);
}

void FrameColumns::add_observables(const stepping::FrameRecord& frame) {
  std::vector<Range> ranges;
  for (const stepping::LocalWorld& world : frame.worlds)
    append_range(ranges, static_cast<hsize_t>(world.id), 1);
  worlds_.begin_row(ranges);
  for (const stepping::LocalWorld& world : frame.worlds) {
    const stepping::Observables& seen = *world.observables;
    const auto item = static_cast<hsize_t>(world.id);
    worlds_.put(0, item, seen.contacts);
    worlds_.put(1, item, seen.rows);
    worlds_.put(2, item, seen.islands);
    worlds_.put(3, item, seen.max_island_rows);
    worlds_.put(4, item, seen.energy_j);
    worlds_.put(5, item, seen.max_penetration_m);
    worlds_.put(6, item, seen.joint_gap_m);
    worlds_.put(7, item, seen.nonfinite);
  }
}

void FrameColumns::add_residuals(const stepping::FrameRecord& frame) {
  std::vector<Range> ranges;
  for (const stepping::LocalWorld& world : frame.worlds)
    append_range(ranges, static_cast<hsize_t>(world.id), 1);
  residuals_->begin_row(ranges);
  for (const stepping::LocalWorld& world : frame.worlds) {
    const stepping::Residuals& seen = world.observables->residuals;
    const auto item = static_cast<hsize_t>(world.id);
    residuals_->put(0, item, seen.joint_speed);
    residuals_->put(1, item, seen.joint_turn);
    residuals_->put(2, item, seen.complementarity_j);
    residuals_->put(3, item, seen.natural_speed);
    residuals_->put(4, item, seen.natural_turn);
  }
}

void FrameColumns::add_interest(const stepping::FrameRecord& frame) {
  std::vector<Range> ranges;
  for (const stepping::LocalWorld& world : frame.worlds)
    append_range(ranges, static_cast<hsize_t>(world.id), 1);
  interest_->begin_row(ranges);
  for (const stepping::LocalWorld& world : frame.worlds)
    interest_->put(0, static_cast<hsize_t>(world.id), world.observables->bodies_inside);
}

void FrameColumns::add_profiles(const stepping::FrameRecord& frame) {
  std::vector<Range> bodies, worlds;
  for (const stepping::LocalWorld& world : frame.worlds) {
    append_range(bodies, static_cast<hsize_t>(table_.body_offset[world.id]), world.state->position.size());
    append_range(worlds, static_cast<hsize_t>(world.id), 1);
  }
  islands_->begin_row(bodies);
  spaces_->begin_row(worlds);
  static const stepping::StepProfile nothing;  // of a world that has ended
  for (const stepping::LocalWorld& world : frame.worlds) {
    const stepping::StepProfile& profile = world.profile != nullptr ? *world.profile : nothing;
    const auto first = static_cast<hsize_t>(table_.body_offset[world.id]);
    std::vector<stepping::IslandCost> at_body(world.state->position.size());
    for (const stepping::IslandCost& island : profile.islands) at_body[island.first_body] = island;
    for (std::size_t i = 0; i < at_body.size(); ++i) {
      islands_->put(0, first + i, at_body[i].bodies);
      islands_->put(1, first + i, at_body[i].contacts);
      islands_->put(2, first + i, at_body[i].rows);
      islands_->put(3, first + i, at_body[i].solve_s);
    }
    const auto item = static_cast<hsize_t>(world.id);
    spaces_->put(0, item, profile.cross_contacts);
    spaces_->put(1, item, profile.collide_s);
    spaces_->put(2, item, profile.collide_spaces_s);
  }
}

void FrameColumns::add_times(const stepping::FrameRecord& frame) {
  frames_.begin_row(on_root(ranks_));
  frames_.put(0, 0, frame.step);
  frames_.put(1, 0, frame.time_s);
  frames_.put(2, 0, static_cast<std::uint8_t>(frame.measured));
  frames_.put(3, 0, frame.wall_s);
  frames_.put(4, 0, static_cast<std::uint8_t>(frame.deadline_met));

  const auto rank = static_cast<hsize_t>(ranks_.rank());
  phases_.begin_row({{rank, 1}});
  for (std::size_t phase = 0; phase < core::num_phases; ++phase) {
    phases_.put(phase, rank, frame.phases.seconds[phase]);
  }
  phases_.put(core::num_phases, rank, frame.phases.useful_s());
  phases_.put(core::num_phases + 1, rank, frame.traffic.messages);
  phases_.put(core::num_phases + 2, rank, frame.traffic.bytes);
}

void FrameColumns::add(const stepping::RunEvent& event) {
  if (events_.num_rows() + events_.num_waiting() == max_events) {
    ++events_dropped_;
    return;
  }
  events_.begin_row(on_root(ranks_));
  events_.put(0, 0, event.frame);
  events_.put_text(1, event.kind);
  events_.put_text(2, event.detail);
}

std::vector<GrowingTable*> FrameColumns::tables() {
  std::vector<GrowingTable*> all = {&bodies_, &recorded_, &worlds_, &frames_, &phases_, &events_};
  if (residuals_) all.push_back(&*residuals_);
  if (interest_) all.push_back(&*interest_);
  if (islands_) all.insert(all.end(), {&*islands_, &*spaces_});
  for (auto* table : {&estimated_bodies_, &estimate_times_, &estimate_compute_}) {
    if (*table) all.push_back(&**table);
  }
  return all;
}

std::string FrameColumns::write(const PropertyList& transfer) {
  std::string error;
  wrote_collectively_ = true;
  for (GrowingTable* table : tables()) {
    if (table->num_waiting() == 0) continue;
    const std::string failed = table->write(transfer);
    if (error.empty()) error = failed;
    wrote_collectively_ = wrote_collectively_ && table->wrote_collectively();
  }
  return error;
}

std::vector<ByteRange> FrameColumns::cut(hid_t file) {
  std::vector<ByteRange> unused;
  for (GrowingTable* table : tables()) table->cut(file, unused);
  return unused;
}

void FrameColumns::close() {
  for (GrowingTable* table : tables()) table->close();
}

}  // namespace pbmpi::io
