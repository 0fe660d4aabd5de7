#include "app/pbreport/run/page.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "app/common/options.h"
#include "app/common/python_program.h"
#include "core/system/descriptor.h"

namespace pbmpi::app {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// An open file without a name, which programs that this program starts inherit.
using UnnamedFile = std::unique_ptr<std::FILE, Close>;

UnnamedFile stored(const std::string& text) {
  UnnamedFile file(std::tmpfile());
  if (!file || std::fputs(text.c_str(), file.get()) < 0 || std::fflush(file.get()) != 0)
    throw core::RunError("no temporary file for the page can be written: " + core::reason_of(errno));
  return file;
}

}  // namespace

core::ExitCode write_page(const std::string& file, const std::string& page, const RunSummary& summary) {
  const UnnamedFile numbers = stored(to_json(summary));
  const std::string path_of_numbers = "/dev/fd/" + std::to_string(fileno(numbers.get()));
  setenv("PBREPORT_VERSION", version_line("pbreport").c_str(), 1);
  return run_report_for(page, {"report", file, page, path_of_numbers});
}

}  // namespace pbmpi::app
