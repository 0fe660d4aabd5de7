/// Writes the HDF5 file of a run (io/SCHEMA.md), in parallel.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "io/hdf5/file_ranks.h"
#include "io/setup/run_setup.h"
#include "io/setup/world_results.h"
#include "stepping/frame.h"

namespace pbmpi::io {

/// The file of one run. Every call is collective over the file's ranks. Throws core::InputError from the
/// constructor if the file cannot be created, core::RunError if a write fails (the same error on every rank,
/// so no rank waits for another).
///
/// A SIGKILL loses at most the frames since the last flush; a power failure may lose more, since only close()
/// waits for the disk.
///
/// The skeleton (all datasets at their full length, allocated, with all metadata) is created under a
/// temporary name, flushed, and renamed to `path`; from then on only raw data and the attribute
/// frames_committed change, so the file opens after a SIGKILL at any moment. Frames are held in memory and
/// written at the flush cadence, or when those of all ranks exceed 32 MiB.
///
/// The destructor does not communicate, since it may run on one rank alone: without close(), frames since the
/// last flush are lost.
class RunFile final : public stepping::FrameObserver {
 public:
  RunFile(const FileGroup& group, RunSetup setup);
  ~RunFile() override;
  RunFile(const RunFile&) = delete;
  RunFile& operator=(const RunFile&) = delete;

  void frame_done(const stepping::FrameRecord& frame) override;
  void event(const stepping::RunEvent& event) override;
  void secure() override;  ///< writes the held frames

  /// Writes the held frames, cuts the datasets to the frames committed, stores the final attributes and
  /// closes. `complete` = all planned frames were simulated. `state_hash` and `results` ([num_worlds], or
  /// none where they are not known) matter on root only.
  void close(bool complete, const std::string& state_hash, std::span<const WorldResult> results = {});

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Bytes of the file for these numbers, within 10 %, if it has about one contact per body; --describe prints
/// it.
std::int64_t estimate_file_bytes(const RunShape& shape);

}  // namespace pbmpi::io
