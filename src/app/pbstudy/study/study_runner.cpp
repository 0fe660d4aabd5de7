#include "app/pbstudy/study/study_runner.h"

#include <iostream>
#include <utility>

#include "app/common/format.h"
#include "app/common/load_scene.h"
#include "app/common/version.h"
#include "core/error.h"
#include "core/system/awaited.h"

namespace pbmpi::app {

using io::Parameter;

StudyRunner::StudyRunner(const mpi::Communicator& comm, std::string name, const StudyOptions& options)
    : comm_(comm), name_(std::move(name)), options_(options) {
  for (const std::string& scene : options.scenes)
    scenes_.push_back(study_scene(share_scene(comm, scene), options.overrides));
  require_distinct_names();
  if (comm.is_root() && wants_progress(options.common)) progress_.emplace(std::cerr);
}

void StudyRunner::require_distinct_names() const {
  std::map<std::string, std::string> file_of;
  for (const StudyScene& scene : scenes_) {
    const auto [first, is_new] = file_of.emplace(scene_text_parameter(scene.source.name), scene.source.file);
    core::require_input(is_new, "--scene " + scene.source.file + ": the study has a scene " +
                                    scene.source.name + " already (" + first->second +
                                    "), and its rows are found by that name; rename a file, or name it once");
  }
}

void StudyRunner::open_output(const std::function<void()>& check) {
  const core::Awaited all_ranks("all ranks to begin, and root to create " + options_.output);
  mpi::agree_on_errors(comm_, [&] {
    if (!comm_.is_root()) return;
    if (check) check();
    writer_ = std::make_unique<io::TableWriter>(options_.output);
  });
  provenance_ = collect_provenance(comm_, options_.command_line);
}

void StudyRunner::case_done(int scene) {
  ++own_done_;
  if (!progress_) return;
  progress_->show(own_done_ == own_cases_, [&] {
    return format("pbstudy: case %zu of %zu on this rank (%s)", own_done_, own_cases_,
                  this->scene(scene).source.name.c_str());
  });
}

io::TableFile StudyRunner::file_with(StudyContent content) const {
  io::TableFile file;
  file.attributes = {{"study", name_},
                     {"pbmpi_version", program_version},
                     {"git_revision", git_revision},
                     {"created", provenance_.created},
                     {"command_line", provenance_.command_line}};
  file.parameters = std::move(content.parameters);
  file.parameters.push_back(Parameter::of("seed", static_cast<std::int64_t>(options_.seed)));
  file.parameters.push_back(Parameter::of("repeats", std::int64_t{options_.repeats}));
  file.parameters.push_back(Parameter::of("floor_seeds", std::int64_t{options_.floor_seeds}));
  file.parameters.push_back(Parameter::of("ranks", static_cast<std::int64_t>(provenance_.hosts.size())));
  file.parameters.push_back(Parameter::of("build", build_description));
  for (const StudyScene& scene : scenes_)
    file.parameters.push_back(Parameter::of(scene_text_parameter(scene.source.name), scene.source.text));
  file.tables = std::move(content.tables);
  file.tables["cases"] = std::move(content.cases);
  return file;
}

void StudyRunner::print_end(const StudyContent& content) const {
  std::cout << num_cases_ << " cases of " << scenes_.size() << (scenes_.size() == 1 ? " scene" : " scenes")
            << " in " << options_.output << "\n"
            << content.note << "next: pbreport " << options_.output << content.next << "\n"
            << std::flush;
}

void StudyRunner::write(const std::function<StudyContent()>& content) {
  mpi::agree_on_errors(comm_, [&] {
    if (!comm_.is_root()) return;
    const StudyContent given = content();
    writer_->write("pbmpi-study", file_with(given));
    if (!options_.common.quiet) print_end(given);
  });
}

}  // namespace pbmpi::app
