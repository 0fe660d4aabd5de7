#include "app/pbstudy/study/study_runner.h"

#include <array>
#include <atomic>
#include <csignal>
#include <iostream>
#include <utility>

#include <fmt/core.h>

#include "app/common/engine_texts.h"
#include "app/common/version.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/system/awaited.h"
#include "core/system/signal_handler.h"
#include "engines/shared_scene.h"

namespace pbmpi::app {
namespace {

std::atomic<bool> stop_requested{false};  // a signal handler can reach nothing but globals
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void request_stop(int) { stop_requested = true; }

}  // namespace

StopRequest::StopRequest() {
  stop_requested = false;
  core::handle_signal(SIGUSR2, request_stop);
}

StopRequest::~StopRequest() { core::handle_signal(SIGUSR2, SIG_DFL); }

bool StopRequest::is_set() const { return stop_requested; }

using io::Parameter;

StudyRunner::StudyRunner(const mpi::Communicator& comm, std::string name, const StudyOptions& options)
    : comm_(comm), name_(std::move(name)), options_(options), start_s_(core::now_s()) {
  if (comm.is_root()) tell_of_slow_starts(options.common);
  const core::Awaited all_ranks("all ranks to read the scenes");
  for (const std::string& scene : options.scenes)
    scenes_.push_back(study_scene(engines::share_scene(comm, scene), options.overrides));
  require_distinct_names();
  if (comm.is_root() && !options.common.quiet) {
    for (const StudyScene& scene : scenes_)
      for (const std::string& note : scene.notes) std::cerr << "pbstudy: note: " << note << '\n';
  }
  const ProgressForm form = progress_form(options.common);
  if (comm.is_root() && form != ProgressForm::none) progress_.emplace(std::cerr, form);
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

void StudyRunner::open_output() {
  const core::Awaited all_ranks("all ranks to begin, and root to create " + options_.output);
  mpi::agree_on_errors(comm_, [&] {
    if (comm_.is_root()) writer_ = std::make_unique<io::TableWriter>(options_.output);
  });
  provenance_ = collect_provenance(comm_, options_.command_line);
  constexpr int num_threads = 1;
  if (comm_.is_root() && !options_.common.quiet)
    std::cerr << shared_processors_warning("pbstudy", provenance_, num_threads) << std::flush;
}

/// Hash of what decides the outcomes of the cases, except for the machine.
std::uint64_t StudyRunner::key_of(std::uint64_t layout) const {
  core::Hash64 hash;
  const auto add = [&](const std::string& text) {
    for (const char letter : text) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
    hash.add(text.size());
  };
  add(name_);
  add(program_version);
  add(git_revision);
  add(build_description);
  for (const std::string& arg : options_.deciding) add(arg);
  for (const StudyScene& scene : scenes_) add(scene.source.text);
  hash.add(layout);
  return hash.value();
}

void StudyRunner::open_journal(std::uint64_t layout, std::size_t num_cases) {
  const std::uint64_t key = key_of(31 * layout + num_cases);
  mpi::agree_on_errors(comm_, [&] {
    if (!comm_.is_root()) return;
    if (options_.resume)
      kept_ = read_case_journals(options_.output, key);
    else
      remove_case_journals(options_.output);
    for (const auto& [index, bytes] : kept_)
      core::require_input(
          index >= 0 && index < static_cast<std::int64_t>(num_cases),
          options_.output + ": its kept cases are not those of this study; leave --resume out");
  });
  is_kept_.assign(num_cases, 0);
  for (const auto& [index, bytes] : kept_) is_kept_[static_cast<std::size_t>(index)] = 1;
  comm_.bcast(std::span<char>(is_kept_));
  mpi::agree_on_errors(comm_,
                       [&] { journal_ = std::make_unique<CaseJournal>(options_.output, comm_.rank(), key); });
  if (comm_.is_root() && !kept_.empty() && !options_.common.quiet)
    std::cerr << "pbstudy: " << kept_.size() << " of " << num_cases << " cases are done already\n";
}

bool StudyRunner::is_to_stop() const {
  return stop_.is_set() || (options_.max_time_s && core::now_s() - start_s_ >= *options_.max_time_s);
}

void StudyRunner::require_all_done() const {
  std::array<std::int64_t, 1> done = {own_done_};
  comm_.allreduce(done, mpi::Reduce::sum);
  const std::int64_t left = num_to_do_ - done[0];
  if (left == 0) return;
  throw StudyStopped{
      fmt::format("stopped with {} of {} cases left; the others are kept beside {}: the same command with "
                  "--resume goes on",
                  left, is_kept_.size(), options_.output)};
}

void StudyRunner::case_done(int scene) {
  ++own_done_;
  done_->next();
  show_progress(this->scene(scene).source.name);
}

void StudyRunner::show_progress(const std::string& what) {
  if (!progress_) return;
  const std::int64_t done = done_->value();
  progress_->show(done == num_to_do_, [&] {
    const double elapsed_s = core::now_s() - start_s_;
    std::string text =
        fmt::format("pbstudy: {}; {} of {} cases done, {:.0f} s", what, done, num_to_do_, elapsed_s);
    if (done > 0)
      text += fmt::format(", about {:.0f} s left",
                          elapsed_s / static_cast<double>(done) * static_cast<double>(num_to_do_ - done));
    return text;
  });
}

std::vector<std::size_t> StudyRunner::cases_to_do(const std::vector<int>& scene,
                                                  const std::vector<double>& cost) const {
  std::vector<std::size_t> order;
  order.reserve(cost.size());
  for (std::size_t i = 0; i < cost.size(); ++i) {
    if (is_kept_[i] == 0) order.push_back(i);
  }
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return scene[a] != scene[b] ? scene[a] < scene[b] : cost[a] > cost[b];
  });
  return order;
}

io::TableFile study_file(const std::string& study, const Provenance& provenance, std::uint64_t seed,
                         int repeats) {
  io::TableFile file;
  file.attributes = {{"study", study},
                     {"pbmpi_version", program_version},
                     {"git_revision", git_revision},
                     {"created", provenance.created},
                     {"command_line", provenance.command_line}};
  file.parameters = {Parameter::of("seed", static_cast<std::int64_t>(seed)),
                     Parameter::of("repeats", std::int64_t{repeats}),
                     Parameter::of("ranks", static_cast<std::int64_t>(provenance.hosts.size())),
                     Parameter::of("build", build_description)};
  return file;
}

io::TableFile StudyRunner::file_with(StudyContent content) const {
  io::TableFile file = study_file(name_, provenance_, options_.seed, options_.repeats);
  file.parameters.push_back(Parameter::of("floor_seeds", std::int64_t{options_.floor_seeds}));
  for (const auto& [name, version] : engine_versions())
    file.parameters.push_back(Parameter::of(name, version));
  for (const StudyScene& scene : scenes_)
    file.parameters.push_back(Parameter::of(scene_text_parameter(scene.source.name), scene.source.text));
  for (Parameter& parameter : content.parameters) file.parameters.push_back(std::move(parameter));
  file.tables = std::move(content.tables);
  file.tables["cases"] = std::move(content.cases);
  return file;
}

void StudyRunner::print_end(const StudyContent& content) const {
  std::cout << num_cases_ << " cases of " << scenes_.size() << (scenes_.size() == 1 ? " scene" : " scenes")
            << " in " << options_.output << "\n"
            << "next: pbreport " << options_.output << content.next << "\n"
            << std::flush;
}

void StudyRunner::write(const std::function<StudyContent()>& content) {
  mpi::agree_on_errors(comm_, [&] {
    if (!comm_.is_root()) return;
    const StudyContent given = content();
    writer_->write(io::study_filetype, file_with(given));
    remove_case_journals(options_.output);
    if (!options_.common.quiet) print_end(given);
  });
}

}  // namespace pbmpi::app
