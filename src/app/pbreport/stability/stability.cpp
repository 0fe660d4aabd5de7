#include "app/pbreport/stability/stability.h"

#include "app/pbreport/stability/stability_page.h"
#include "app/pbreport/stability/stability_text.h"
#include "app/pbreport/study/study_report.h"

namespace pbmpi::app {
namespace {

const StudyReport stability_report{
    "stability", "which settings hold the hard cases",
    "a map of cases and settings; a click on a field shows its curves and its replay",
    "print the map as a table instead"};

}  // namespace

core::ExitCode run_stability_report(const std::vector<std::string>& args, std::ostream& out) {
  return run_study_report(stability_report, args, out,
                          [](const io::TableFile& file, const ReportOfStudyOptions& options) {
                            const StabilityMap map = stability_map(file, options.scenes);
                            return StudyViews{[map, options, &file](const std::string& path) {
                                                write_stability_page(path, file, map, options.file);
                                              },
                                              [map] { return stability_to_json(map); },
                                              [map] { return stability_to_markdown(map); },
                                              [map] { return stability_to_text(map); }};
                          });
}

}  // namespace pbmpi::app
