/// Runs the command that reports a study, for studies without options of their own.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbreport/study/report_options.h"
#include "core/error.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// The words in which such commands differ.
struct StudyReport {
  std::string name;   ///< of the study, the command and, with .h5, the file
  std::string shows;  ///< "pbreport NAME shows ..."
  std::string page;   ///< what --html writes
  std::string table;  ///< what --markdown prints
};

/// A study that has been read, in the forms that a user may request.
struct StudyViews {
  std::function<void(const std::string& path)> write_page;
  std::function<std::string()> json, markdown, text;
};

using ReadStudy = std::function<StudyViews(const io::TableFile& file, const ReportOfStudyOptions& options)>;

Manual manual_of(const StudyReport& report);
/// Throws core::InputError with one clear message.
ReportOfStudyOptions parse_options(const StudyReport& report, const std::vector<std::string>& args);
/// `read` is called with the file, which outlives the views. Throws core::InputError for a file that cannot
/// be read or written.
core::ExitCode run_study_report(const StudyReport& report, const std::vector<std::string>& args,
                                std::ostream& out, const ReadStudy& read);

}  // namespace pbmpi::app
