#include "app/pbmpi/work.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/common/version.h"
#include "app/pbmpi/options/options.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/system/mounts.h"
#include "core/system/paths.h"
#include "engines/shared_scene.h"
#include "mpi/comm/agreement.h"
#include "mpi/frame/frame_driver.h"

namespace pbmpi::app {
namespace {

void require_undamaged(const io::Checkpoint& checkpoint, const std::string& path) {
  std::vector<std::uint64_t> hashes;
  for (const model::State& state : checkpoint.worlds) hashes.push_back(model::hash(state));
  const std::string found = core::to_hex(mpi::combine_world_hashes(hashes));
  core::require_input(found == checkpoint.state_hash, path + ": its states have the hash " + found +
                                                          " and not " + checkpoint.state_hash +
                                                          "; the file is damaged");
}

/// Refuses another version and warns of another build: equal bits are promised for one build only.
void check_build(const io::Checkpoint& checkpoint, const std::string& path, std::ostream& warnings) {
  core::require_input(checkpoint.pbmpi_version == program_version,
                      path + ": written by pbmpi " + checkpoint.pbmpi_version + ", and this is " +
                          program_version + ", whose results may have other bits; resume with that one");
  const std::string saved = checkpoint.git_revision + "; " + checkpoint.build;
  const std::string here = std::string(git_revision) + "; " + build_description;
  if (saved != here) {
    warnings << "pbmpi: warning: " << path << " was written by another build (" << saved
             << ") than this one (" << here
             << "); the result may have other bits than a run that was never stopped" << std::endl;
  }
}

/// Collective. The checkpoint in `path`, with the states of its worlds on root only. Throws core::InputError
/// for a file that is not a checkpoint, is damaged, or comes from another version of pbmpi. Another build of
/// this version only gives a line on `warnings`.
io::Checkpoint load_checkpoint(const mpi::Communicator& comm, const std::string& path,
                               std::ostream& warnings) {
  io::Checkpoint checkpoint;
  mpi::agree_on_errors(comm, [&] {
    if (!comm.is_root()) return;
    checkpoint = io::read_checkpoint(path);
    check_build(checkpoint, path, warnings);
    require_undamaged(checkpoint, path);
  });
  for (std::string* text :
       {&checkpoint.scene, &checkpoint.scene_file, &checkpoint.scene_text, &checkpoint.parameters_file,
        &checkpoint.parameters_text, &checkpoint.options, &checkpoint.output, &checkpoint.state_hash}) {
    comm.bcast_string(*text);
  }
  comm.bcast_value(checkpoint.frames);
  comm.bcast_value(checkpoint.steps);
  return checkpoint;
}

/// Collective. The text of the checkpoint's scene. `asked`: the scene named on the command line, or nothing;
/// throws core::InputError if it is another one.
scenes::SceneSource scene_of(const mpi::Communicator& comm, const io::Checkpoint& checkpoint,
                             const std::string& path, const std::string& asked) {
  mpi::agree_on_errors(comm, [&] {
    if (!comm.is_root() || asked.empty()) return;
    const scenes::SceneSource named = scenes::find_scene(asked);
    core::require_input(named.name == checkpoint.scene && named.text == checkpoint.scene_text,
                        "--scene " + asked + ": the run in " + path + " has the scene " + checkpoint.scene +
                            (named.name == checkpoint.scene ? ", whose text was another" : "") +
                            "; leave the option out, or begin without --resume");
  });
  return {checkpoint.scene, checkpoint.scene_file, checkpoint.scene_text};
}

/// Collective. The checkpoint's table of parameters. `asked`: the table named on the command line; throws
/// core::InputError if it is another one.
std::optional<scenes::ParameterTable> parameters_of(const mpi::Communicator& comm,
                                                    const io::Checkpoint& checkpoint, const std::string& path,
                                                    const std::optional<std::string>& asked) {
  std::optional<scenes::ParameterTable> saved;
  if (!checkpoint.parameters_text.empty())
    saved.emplace(checkpoint.parameters_file, checkpoint.parameters_text);
  if (!asked) return saved;
  core::require_input(engines::share_parameters(comm, *asked).text() == checkpoint.parameters_text,
                      "--parameters " + *asked + ": the run in " + path + " has " +
                          (saved ? "other ones, of " + saved->file() : "none") +
                          "; leave the option out, or begin without --resume");
  return saved;
}

std::optional<int> num_rows(const Work& work) {
  return work.parameters ? std::optional(work.parameters->num_worlds()) : std::nullopt;
}

/// Throws core::InputError where the worlds of a rank cannot fit into the memory of its machine: building
/// them would take minutes before memory ran out. Only the models are counted.
void require_memory(const mpi::Communicator& comm, const Work& work) {
  const model::Model& model = *work.first_world;
  const double bytes_each = static_cast<double>(
      sizeof(model::Model) + model.bodies.size() * sizeof(model::Body) +
      model.geoms.size() * sizeof(model::Geom) + model.joints.size() * sizeof(model::Joint) +
      model.events.size() * sizeof(model::Event));
  const double of_a_rank = bytes_each * work.spec.num_worlds / comm.size();
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  constexpr double gib = 1024.0 * 1024 * 1024;
  core::require_input(
      of_a_rank <= memory,
      fmt::format(
          "--replicas {}: the worlds of a rank need more than {:.0f} GiB, and its machine has {:.0f}; ask "
          "for fewer, or use more nodes",
          work.spec.num_worlds, of_a_rank / gib, memory / gib));
}

/// --dt without --steps-per-frame changes the time that a frame stands for, and with it every result per
/// frame.
void note_length_of_frame(const mpi::Communicator& comm, const Options& options, const Work& work) {
  if (!options.dt_s() || options.given.contains("steps-per-frame") || options.common.quiet) return;
  const scenes::RunDefaults own = scenes::parse_scene(work.source)->defaults();
  const double before_s = own.dt_s * own.steps_per_frame, now_s = *options.dt_s() * work.spec.steps_per_frame;
  if (!comm.is_root() || std::abs(now_s - before_s) <= 1e-9 * before_s) return;
  std::cerr << fmt::format(
      "pbmpi: note: with --dt {:g} a frame of {} steps is {:g} s and not the scene's {:g} s of simulated "
      "time; --steps-per-frame {:.0f} comes nearest to it\n",
      *options.dt_s(), work.spec.steps_per_frame, now_s, before_s,
      std::max(1.0, std::round(before_s / *options.dt_s())));
}

/// Prints what was read differently from an imported model; a resumed run has printed it before.
void tell_notes(const mpi::Communicator& comm, const Options& options, const scenes::Scene& scene) {
  if (!comm.is_root() || options.common.quiet || options.action == Action::describe) return;
  for (const std::string& note : scene.notes()) std::cerr << "pbmpi: note: " << note << '\n';
}

}  // namespace

Work new_work(const mpi::Communicator& comm, const Options& options) {
  Work work;
  work.source = engines::share_scene(comm, *options.run.scene);
  work.scene = scenes::parse_scene(work.source, options.dt_s(), options.run.effects);
  if (options.run.parameters) work.parameters = engines::share_parameters(comm, *options.run.parameters);
  work.spec = resolve(options, *work.scene, {}, num_rows(work));
  work.first_world = build_anew(work, 0);
  require_memory(comm, work);
  note_length_of_frame(comm, options, work);
  tell_notes(comm, options, *work.scene);
  return work;
}

Work resumed_work(const mpi::Communicator& comm, const std::vector<std::string>& args, Options& options) {
  const std::string path = *options.run.resume;
  core::require_answers(std::array{core::NamedPath{"--resume", path, false}});
  io::Checkpoint checkpoint = load_checkpoint(comm, path, std::cerr);
  Work work;
  work.source = scene_of(comm, checkpoint, path, options.run.scene.value_or(""));
  options = parse_options(args, checkpoint.options);
  work.parameters = parameters_of(comm, checkpoint, path, options.run.parameters);
  require_same_stepper(path, checkpoint.options, options.step.settings.kind);
  work.scene = scenes::parse_scene(work.source, options.dt_s(), options.run.effects);
  work.spec = resolve(options, *work.scene, {path, checkpoint.frames, checkpoint.output}, num_rows(work));
  require_same_physics(path, checkpoint.options, saved_options(work.spec));
  core::require_input(checkpoint.steps == checkpoint.frames * work.spec.steps_per_frame,
                      path + ": its numbers of frames and steps do not fit; the file is damaged");
  work.first_world = build_anew(work, 0);
  work.states = std::move(checkpoint.worlds);
  return work;
}

std::shared_ptr<const model::Model> build_world(const Work& work, int world) {
  return world == 0 ? work.first_world : build_anew(work, world);
}

std::shared_ptr<const model::Model> build_anew(const Work& work, int world) {
  const int number = work.spec.first_world() + world;
  return work.scene->build(number, work.spec.seed,
                           work.parameters ? work.parameters->of_world(number) : scenes::Overrides());
}

io::Checkpoint checkpoint_without_states(const Work& work, Decomposition asked) {
  RunSpec spec = work.spec;
  spec.decomposition = asked;
  io::Checkpoint checkpoint;
  checkpoint.pbmpi_version = program_version;
  checkpoint.git_revision = git_revision;
  checkpoint.build = build_description;
  checkpoint.scene = work.source.name;
  checkpoint.scene_file = work.source.file;
  checkpoint.scene_text = work.source.text;
  if (work.parameters) {
    checkpoint.parameters_file = work.parameters->file();
    checkpoint.parameters_text = work.parameters->text();
  }
  checkpoint.options = saved_options(spec);
  if (work.spec.output) checkpoint.output = std::filesystem::absolute(*work.spec.output).string();
  return checkpoint;
}

}  // namespace pbmpi::app
