#include "io/run/run_file.h"

#include <array>
#include <optional>

#include "core/clock.h"
#include "core/error.h"
#include "io/file/output_target.h"
#include "io/hdf5/chunk_ranges.h"
#include "io/hdf5/commit_record.h"
#include "io/hdf5/file_checksum.h"
#include "io/hdf5/file_ranks.h"
#include "io/hdf5/file_types.h"
#include "io/run/frame_columns.h"
#include "io/run/skeleton.h"
#include "io/setup/world_result_rows.h"
#include "io/table/table_file.h"

namespace pbmpi::io {
namespace {

/// Collective.
RunShape shape_of(const FileRanks& ranks, const RunSetup& setup) {
  std::array<std::int64_t, 2> counts{};
  for (const stepping::LocalWorld& world : setup.worlds) {
    counts[0] += static_cast<std::int64_t>(world.model->geoms.size());
    counts[1] += static_cast<std::int64_t>(world.model->joints.size());
  }
  ranks.sum(counts);
  return {.num_bodies = setup.table.num_bodies(),
          .num_worlds = setup.table.num_worlds(),
          .num_ranks = ranks.size(),
          .num_frames = setup.num_frames,
          .record_every = setup.record_every,
          .optional = setup.optional,
          .first_frame = setup.first_frame,
          .num_geoms = counts[0],
          .num_joints = counts[1],
          .substep_s = setup.substep_s};
}

}  // namespace

class RunFile::Impl {
 public:
  Impl(const FileGroup& group, RunSetup setup);
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void add(const stepping::FrameRecord& frame);
  void add(const stepping::RunEvent& event);
  void secure() {
    core::require_invariant(open_, "the run's file was closed");
    flush();
    require_in_place();
  }
  void close(bool complete, const std::string& state_hash, std::span<const WorldResult> results);

 private:
  void make_skeleton();
  void flush();
  /// Throws core::RunError if somebody has removed or replaced the file, which can still be closed.
  void require_in_place();
  /// Root only, before the waiting rows are written.
  void reserve_ahead();
  /// Does `work` on every rank; an error on any rank closes the file on all and becomes the same RunError.
  template <class Work>
  void write_together(Work&& work);
  /// After an error on which all ranks agree: closes what is open, and drops errors of closing.
  void close_all();
  /// Root only, once the file is closed for data.
  void finish(bool complete, const std::string& state_hash, std::span<const WorldResult> results);

  RunSetup setup_;
  FileRanks ranks_;
  RunShape shape_;
  OutputTarget target_;  ///< root only
  WrittenFile file_;     ///< for values
  CommitRecord record_;  ///< root only
  SpaceAhead space_{target_};
  std::optional<FrameColumns> columns_;
  double last_flush_s_ = 0;
  bool open_ = false;
};

RunFile::Impl::Impl(const FileGroup& group, RunSetup setup) : setup_(std::move(setup)), ranks_(group) {
  prepare_hdf5();
  shape_ = shape_of(ranks_, setup_);
  ranks_.together<core::InputError>([this] {
    const std::int64_t bytes = estimate_file_bytes(shape_);
    if (!ranks_.is_root()) return;
    target_ = output_target(setup_.path, filetype, bytes);
  });
  try {
    make_skeleton();
    ranks_.together([this] {
      if (!ranks_.is_root()) return;
      record_ = CommitRecord(target_.temporary_path());
      store_fixed_checksum(record_.id());
    });
    ranks_.together<core::InputError>([this] {
      if (ranks_.is_root()) target_.publish(setup_.optional.contacts ? ContactRows::spare_bytes(shape_) : 0);
    });
  } catch (const core::RunError& error) {
    close_all();
    throw core::RunError("cannot create " + setup_.path + ": " + error.what());
  } catch (...) {
    close_all();
    throw;
  }
  setup_.worlds.clear();  // borrowed for the skeleton only
  open_ = true;
  last_flush_s_ = core::now_s();
}

void RunFile::Impl::make_skeleton() {
  const std::string path = ranks_.broadcast(target_.temporary_path());
  io::make_skeleton(ranks_, path, setup_, shape_);
  ranks_.together([&] { file_ = WrittenFile::open_values(path); });
  fill_skeleton(ranks_, file_.id(), setup_);
  ranks_.together([this] { columns_.emplace(file_.id(), ranks_, setup_, shape_); });
  ranks_.together([this] { file_.sync(); });
}

template <class Work>
void RunFile::Impl::write_together(Work&& work) {
  try {
    ranks_.together(std::forward<Work>(work));
  } catch (const core::RunError& error) {
    close_all();
    throw core::RunError("cannot write " + setup_.path + ": " + error.what() +
                         "; the frames committed before are readable");
  }
}

void RunFile::Impl::add(const stepping::FrameRecord& frame) {
  core::require_invariant(open_, "a frame after the run's file was closed");
  columns_->add(frame);
  const bool due = core::now_s() - last_flush_s_ >= setup_.flush_interval_s;
  // Root's clock decides for all; every rank knows whether the columns are full.
  if (!ranks_.broadcast(due) && !columns_->full()) return;
  flush();
  require_in_place();
}

void RunFile::Impl::require_in_place() {
  ranks_.together([this] {
    if (ranks_.is_root()) target_.require_in_place();
  });
}

void RunFile::Impl::add(const stepping::RunEvent& event) {
  core::require_invariant(open_, "an event after the run's file was closed");
  columns_->add(event);
}

void RunFile::Impl::flush() {
  if (!columns_->empty()) {
    columns_->settle();
    write_together([this] {
      if (!ranks_.is_root()) return;
      target_.require_whole();
      reserve_ahead();
    });
    write_together([this] {
      columns_->write();
      file_.require_written();
    });
    // The data of all ranks are in the file before the number that declares them valid. They may still be on
    // their way to the disk: a kill does not lose them, and waiting would cost some percent of the run.
    write_together([this] {
      if (ranks_.is_root()) record_.commit(columns_->frames_written(), columns_->event_counts());
    });
  }
  last_flush_s_ = core::now_s();
}

void RunFile::Impl::reserve_ahead() {
  constexpr std::size_t step_bytes = std::size_t{64} << 20;
  const hsize_t frames = columns_->frames_in(step_bytes);
  for (const ColumnRows& column : columns_->column_rows()) {
    const hsize_t ahead = frames / static_cast<hsize_t>(column.frames_per_row) + 1;
    space_.cover(record_.id(), column.path, column.rows, ahead);
  }
}

void RunFile::Impl::close(bool complete, const std::string& state_hash,
                          std::span<const WorldResult> results) {
  if (!open_) return;
  flush();
  open_ = false;
  write_together([this] {
    file_.sync();
    columns_->close();
    file_.close();
  });
  write_together([&] {
    if (ranks_.is_root()) finish(complete, state_hash, results);
  });
  require_in_place();
}

void RunFile::Impl::finish(bool complete, const std::string& state_hash,
                           std::span<const WorldResult> results) {
  if (!results.empty()) write_world_results(record_.id(), results);
  record_.finish(complete, state_hash, columns_->event_counts());
  store_end_checksum(record_.id());
  record_.close();
  WrittenFile file = WrittenFile::open(target_.open_path());
  const std::vector<core::ByteRange> unused = columns_->cut(file.id());
  file.close();
  target_.release(unused);
}

void RunFile::Impl::close_all() {
  open_ = false;
  if (columns_) columns_->close();
  file_ = {};
  record_ = {};
}

RunFile::RunFile(const FileGroup& group, RunSetup setup)
    : impl_(std::make_unique<Impl>(group, std::move(setup))) {}
RunFile::~RunFile() = default;
void RunFile::frame_done(const stepping::FrameRecord& frame) { impl_->add(frame); }
void RunFile::event(const stepping::RunEvent& event) { impl_->add(event); }
void RunFile::secure() { impl_->secure(); }
void RunFile::close(bool complete, const std::string& state_hash, std::span<const WorldResult> results) {
  impl_->close(complete, state_hash, results);
}

}  // namespace pbmpi::io
