/// The kinds of HDF5 files that pbmpi's programs write: the root's attribute `filetype`, and related
/// constants.
#pragma once

#include <cstdint>

namespace pbmpi::io {

/// Version of the file's layout (io/SCHEMA.md): the first number changes when old readers would be misled.
inline constexpr std::int64_t layout_major = 1;
inline constexpr std::int64_t layout_minor = 8;
inline constexpr const char* filetype = "pbmpi-run";

/// Group of a run's file that is written last: one row per world.
inline constexpr const char* world_results = "/world_results";

inline constexpr const char* checkpoint_filetype = "pbmpi-checkpoint";

}  // namespace pbmpi::io
