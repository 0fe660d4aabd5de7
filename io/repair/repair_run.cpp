#include "io/repair/repair_run.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <vector>

#include "core/error.h"
#include "core/system/descriptor.h"
#include "io/file/output_lock.h"
#include "io/hdf5/chunk_ranges.h"
#include "io/hdf5/read_columns.h"
#include "io/hdf5/written_file.h"
#include "io/run/contact_rows.h"
#include "io/run/event_columns.h"
#include "io/run/frame_table.h"

namespace pbmpi::io {
namespace {

struct Cut {
  std::string dataset;
  hsize_t rows;
};

/// The datasets that are longer than what is committed, with the rows that stay.
std::vector<Cut> cuts_of(hid_t file, std::int64_t frames) {
  std::vector<Cut> cuts;
  const auto add = [&](const std::string& path, std::int64_t rows) {
    if (has_object(file, path) && dims_of(file, path).at(0) > static_cast<hsize_t>(rows))
      cuts.push_back({path, static_cast<hsize_t>(rows)});
  };
  const std::int64_t recorded = frames / integer_attribute(file, "/", "record_every");
  for (const FrameTable& table : all_frame_tables()) {
    if (!has_object(file, table.group)) continue;
    for (const std::string& path : GrowingTable::datasets(table.group, table.columns))
      add(path, table.rows == Rows::recorded ? recorded : frames);
  }
  if (const std::vector<ContactSpan> spans = read_contact_spans(file, frames);
      has_object(file, "/contacts")) {
    for (const std::string& path :
         GrowingTable::datasets(ContactRows::frame_group, ContactRows::frame_columns()))
      add(path, frames);
    add(ContactRows::points, spans.empty() ? 0 : spans.back().first + spans.back().count);
  }
  const std::int64_t num_events = integer_attribute(file, "/events", "num_events");
  for (const std::string& path : EventColumns::datasets()) add(path, num_events);
  return cuts;
}

std::int64_t bytes_on_disk(const core::Descriptor& file) {
  struct stat status {};
  constexpr std::int64_t block_bytes = 512;
  return fstat(file.get(), &status) == 0 ? block_bytes * status.st_blocks : 0;
}

/// Bytes of the file that no committed row needs.
struct Unused {
  std::vector<core::ByteRange> all;
  std::vector<core::ByteRange> in_kept_chunks;  ///< the part of `all` in chunks that also hold committed rows
};

Unused unused_bytes(hid_t file, const std::vector<Cut>& cuts) {
  Unused unused;
  for (const Cut& cut : cuts) {
    const auto dataset =
        owned<Dataset>(H5Dopen2(file, cut.dataset.c_str(), H5P_DEFAULT), "H5Dopen(" + cut.dataset + ")");
    const auto all = bytes_of_rows(dataset.id(), cut.rows, dims_of(file, cut.dataset).at(0));
    unused.all.insert(unused.all.end(), all.begin(), all.end());
    const auto kept = bytes_of_rows(dataset.id(), cut.rows, end_of_chunk(dataset.id(), cut.rows));
    unused.in_kept_chunks.insert(unused.in_kept_chunks.end(), kept.begin(), kept.end());
  }
  return unused;
}

void shorten(hid_t file, const std::vector<Cut>& cuts) {
  for (const Cut& cut : cuts) {
    std::vector<hsize_t> dims = dims_of(file, cut.dataset);
    dims[0] = cut.rows;
    const auto dataset = owned<Dataset>(H5Dopen2(file, cut.dataset.c_str(), H5P_DEFAULT), "H5Dopen");
    check(H5Dset_extent(dataset.id(), dims.data()), "H5Dset_extent(" + cut.dataset + ")");
  }
}

Repair repair(const std::string& path) {
  const core::Descriptor disk(path, O_RDWR);
  core::require_input(disk.is_open(),
                      path + ": it cannot be repaired: " + core::reason_of(errno) + "; make it writable");
  const std::int64_t before = bytes_on_disk(disk);
  Repair done;
  Unused unused;
  WrittenFile file;
  try {
    file = WrittenFile::open(path);
    done.frames = integer_attribute(file.id(), "/", "frames_committed");
    const std::vector<Cut> cuts = cuts_of(file.id(), done.frames);
    if (cuts.empty()) return done;
    unused = unused_bytes(file.id(), cuts);
    // Holes first: they change nothing that a reader sees, so a kill here leaves the file as it was.
    core::punch_holes(disk.get(), unused.all);
    shorten(file.id(), cuts);
  } catch (const core::RunError& error) {
    throw core::InputError(path + ": it cannot be repaired: " + error.what());
  }
  try {
    file.close();
  } catch (const core::RunError& error) {
    throw core::RunError("cannot write " + path + ": " + error.what());
  }
  core::punch_holes(disk.get(), unused.in_kept_chunks);  // HDF5 has written these chunks whole
  fsync(disk.get());
  done.bytes_freed = before - bytes_on_disk(disk);
  return done;
}

/// Removes what dead lock holders left behind that belongs to the run, such as its checkpoints' lock: taking
/// a lock cleans up, and giving it back removes its file.
void remove_dead_locks(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path run(path), folder = run.parent_path();
  const std::string begin = "." + run.stem().string() + ".", end = ".lock";
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin) || !name.ends_with(end)) continue;
    try {
      const OutputLock dead((folder / name.substr(1, name.size() - 1 - end.size())).string());
    } catch (const core::InputError&) {
      // Another run is still alive.
    }
  }
}

}  // namespace

Repair repair_run(const std::string& path) {
  prepare_hdf5();
  const OutputLock lock(path);
  remove_dead_locks(lock.path());
  open_run(lock.path());  // refuses a file that is not a run's
  return repair(lock.path());
}

}  // namespace pbmpi::io
