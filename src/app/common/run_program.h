/// Stands between main() and a program: errors become one message and an exit code.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "core/error.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// Runs `program` on all ranks, while an mpi::Session is alive. core::InputError and core::RunError are the
/// same on every rank (whoever throws one on a rank of its own has agreed on it before): root prints the
/// message, all return its exit code. Any other exception is a mistake in the program, on some rank: it is
/// printed and the whole run is aborted, so that nobody waits.
int run_program(const std::string& name,
                const std::function<core::ExitCode(const mpi::Communicator&)>& program);

/// Throws core::RunError if not everything printed to `out` has arrived. `what`: e.g. "the report".
void require_printed(std::ostream& out, const std::string& what);

}  // namespace pbmpi::app
