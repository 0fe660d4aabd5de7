#include "app/common/run_program.h"

#include <iostream>
#include <new>

#include "core/system/awaited.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/session.h"

namespace pbmpi::app {

int run_program(const std::string& name,
                const std::function<core::ExitCode(const mpi::Communicator&)>& program) {
  const mpi::Communicator world = mpi::Communicator::world();
  core::set_waiter(name + ": rank " + std::to_string(world.rank()));
  const auto report = [&](const std::exception& error, core::ExitCode code) {
    if (world.is_root()) std::cerr << name << ": " << error.what() << std::endl;
    return static_cast<int>(code);
  };
  try {
    const core::ExitCode code = program(world);
    // What counts of a stopped run is its checkpoint, not what it printed.
    if (world.is_root() && code == core::ExitCode::done) require_printed(std::cout, "the output");
    return static_cast<int>(code);
  } catch (const core::InputError& error) {
    return report(error, core::ExitCode::bad_input);
  } catch (const core::RunError& error) {
    return report(error, core::ExitCode::failed);
  } catch (const std::bad_alloc&) {
    std::cerr << name << ": rank " << world.rank() << ": " << mpi::out_of_memory << std::endl;
    // Other ranks may wait for this one.
    if (world.size() > 1) mpi::Session::abort(static_cast<int>(core::ExitCode::failed));
    return static_cast<int>(core::ExitCode::failed);
  } catch (const std::exception& error) {
    std::cerr << name << ": rank " << world.rank() << ": " << error.what() << std::endl;
    mpi::Session::abort(static_cast<int>(core::ExitCode::failed));
  }
}

void require_printed(std::ostream& out, const std::string& what) {
  out.flush();
  if (!out) throw core::RunError(what + " cannot be written to standard output; is the disk full?");
}

}  // namespace pbmpi::app
