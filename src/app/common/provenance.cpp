#include "app/common/provenance.h"

#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "core/utc.h"
#include "mpi/comm/session.h"

namespace pbmpi::app {
namespace {

/// SLURM_* and OMPI_* of this process, one a line.
std::string job_environment() {
  std::vector<std::string> lines;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string line = *entry;
    if (line.starts_with("SLURM_") || line.starts_with("OMPI_")) lines.push_back(line);
  }
  std::sort(lines.begin(), lines.end());
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

Provenance collect_provenance(const mpi::Communicator& comm, const std::string& command_line) {
  Provenance provenance;
  provenance.command_line = command_line;
  provenance.created = core::utc_now();
  std::string environment = job_environment();
  provenance.processors = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  comm.bcast_string(provenance.created);
  comm.bcast_value(provenance.processors);
  comm.bcast_string(environment);
  provenance.environment = lines_of(environment);
  provenance.hosts = mpi::host_names(comm);
  return provenance;
}

std::string shared_processors_warning(const std::string& program, const Provenance& provenance,
                                      int num_threads) {
  std::ostringstream text;
  for (const std::string& host : distinct(provenance.hosts)) {
    const auto num_ranks = std::ranges::count(provenance.hosts, host);
    if (num_ranks == 1 || num_ranks * num_threads <= provenance.processors) continue;
    text << program << ": warning: " << num_ranks << " ranks";
    if (num_threads > 1) text << " of " << num_threads << " threads";
    text << " take turns on the " << provenance.processors
         << (provenance.processors == 1 ? " processor" : " processors") << " of " << host
         << ", which spoils times; start fewer\n";
  }
  return text.str();
}

std::vector<std::string> distinct(const std::vector<std::string>& values) {
  std::vector<std::string> result;
  for (const std::string& value : values) {
    if (std::find(result.begin(), result.end(), value) == result.end()) result.push_back(value);
  }
  return result;
}

}  // namespace pbmpi::app
