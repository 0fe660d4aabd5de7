/// The XDMF sidecar with which ParaView opens the bodies of a run.
#pragma once

#include <string>

namespace pbmpi::io {

/// Writes an XDMF 3 file: one point per body and one grid per recorded frame, whose numbers stay in the HDF5
/// file `run_path`, named relative to the folder of `xdmf_path`. Only committed frames appear. It is written
/// by write_file(). Throws core::InputError if the run cannot be read or the file cannot be written.
void write_xdmf(const std::string& run_path, const std::string& xdmf_path);

/// write_xdmf() to a path that the user did not name: throws core::InputError also if an existing file there
/// is not an older sidecar of that run.
void write_sidecar(const std::string& run_path, const std::string& xdmf_path);

}  // namespace pbmpi::io
