/// The kinds of HDF5 files that pbmpi's programs write: the root's attribute `filetype`, and what goes with
/// it.
#pragma once

#include <cstdint>

namespace pbmpi::io {

/// Version of the file's layout (io/SCHEMA.md): the first number changes when old readers would be misled.
inline constexpr std::int64_t layout_major = 1;
inline constexpr std::int64_t layout_minor = 5;
inline constexpr const char* filetype = "pbmpi-run";

inline constexpr const char* checkpoint_filetype = "pbmpi-checkpoint";

}  // namespace pbmpi::io
