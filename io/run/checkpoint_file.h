/// The file from which a run continues (`filetype = "pbmpi-checkpoint"`, io/SCHEMA.md). One rank writes and
/// reads it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/file/output_lock.h"
#include "model/state.h"

namespace pbmpi::io {

struct Checkpoint {
  std::string pbmpi_version, git_revision, build;  ///< of the program that wrote it
  std::string created;                             ///< ISO 8601, UTC
  std::string scene;                               ///< its name
  std::string scene_file;                          ///< name of the scene's text in error messages
  std::string scene_text;                          ///< TOML
  std::string parameters_file;                     ///< name of parameters_text in error messages
  std::string parameters_text;  ///< table of the parameters in which worlds differ from the scene, or empty
  std::string options;          ///< as resolved, one "name = value" a line
  std::string output;           ///< file of the run that wrote it, or empty
  std::int64_t frames = 0;      ///< done, warm-up included
  std::int64_t steps = 0;       ///< done
  std::string state_hash;
  std::vector<model::State> worlds;  ///< [num_worlds] bit for bit
};

/// Replaces the file of `lock` in one go (io/file/write_file.h); returns the bytes written. Throws
/// core::RunError.
std::int64_t write_checkpoint(const OutputLock& lock, const Checkpoint& checkpoint);

/// Throws core::InputError if the file is missing, not HDF5, of another file type or a newer layout, or
/// damaged.
Checkpoint read_checkpoint(const std::string& path);

/// The right to write checkpoints of about `bytes` to `path`. Throws core::InputError if they cannot be
/// written, or another process writes there.
OutputLock lock_checkpoint(const std::string& path, std::int64_t bytes);

}  // namespace pbmpi::io
