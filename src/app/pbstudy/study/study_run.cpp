#include "app/pbstudy/study/study_run.h"

#include <unistd.h>

#include <iostream>

#include "app/common/version.h"

namespace pbmpi::app {
namespace {

bool wants_progress(const CommonOptions& common, bool is_root) {
  if (!is_root || common.quiet || common.progress == ProgressMode::never) return false;
  return common.progress == ProgressMode::always || isatty(STDERR_FILENO) != 0;
}

}  // namespace

CaseProgress::CaseProgress(const CommonOptions& common, bool is_root, std::size_t total)
    : wanted_(wants_progress(common, is_root)), total_(total) {}

CaseProgress::~CaseProgress() {
  if (drawn_) std::cerr << std::endl;
}

void CaseProgress::next(const std::string& scene) {
  ++done_;
  if (!wanted_) return;
  std::cerr << "\rpbstudy: case " << done_ << " of " << total_ << " on this rank (" << scene << ")   "
            << std::flush;
  drawn_ = true;
}

std::map<std::string, std::string> study_attributes(const std::string& study, const Provenance& provenance) {
  return {{"study", study},
          {"pbmpi_version", program_version},
          {"git_revision", git_revision},
          {"created", provenance.created},
          {"command_line", provenance.command_line}};
}

}  // namespace pbmpi::app
