/// pbreport: serial post-processing of pbmpi's files.
#include <iostream>
#include <new>
#include <stdexcept>

#include "app/common/options.h"
#include "app/pbreport/commands.h"
#include "app/pbreport/isolated.h"
#include "core/error.h"
#include "core/system/leftovers.h"

namespace {

int report(int argc, char** argv) {
  using pbmpi::core::ExitCode;
  const auto fail = [](const std::exception& error, ExitCode code) {
    std::cerr << "pbreport: " << error.what() << std::endl;
    return static_cast<int>(code);
  };
  pbmpi::core::remove_leftovers_on_signals();
  try {
    return static_cast<int>(pbmpi::app::run_pbreport(pbmpi::app::arguments(argc, argv), std::cout));
  } catch (const pbmpi::core::InputError& error) {
    return fail(error, ExitCode::bad_input);
  } catch (const std::bad_alloc&) {
    return fail(std::runtime_error("there is not enough memory for what is to be read"), ExitCode::failed);
  } catch (const std::exception& error) {
    return fail(error, ExitCode::failed);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return pbmpi::app::run_isolated([&] { return report(argc, argv); });
}
