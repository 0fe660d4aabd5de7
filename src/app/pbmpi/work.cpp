#include "app/pbmpi/work.h"

#include <filesystem>
#include <iostream>
#include <utility>

#include "app/common/load_scene.h"
#include "app/common/version.h"
#include "app/pbmpi/options/saved_options.h"
#include "app/pbmpi/resume.h"
#include "core/error.h"

namespace pbmpi::app {

Work new_work(const mpi::Communicator& comm, const Options& options) {
  Work work;
  work.source = share_scene(comm, options.scene);
  work.scene = scenes::parse_scene(work.source, options.dt_s(), options.spaces, options.effects);
  work.spec = resolve(options, *work.scene);
  return work;
}

Work resumed_work(const mpi::Communicator& comm, const std::vector<std::string>& args, Options& options) {
  const std::string path = *options.resume;
  io::Checkpoint checkpoint = load_checkpoint(comm, path, std::cerr);
  Work work;
  work.source = scene_of(comm, checkpoint, path, options.scene);
  options = parse_options(args, checkpoint.options);
  require_same_stepper(path, checkpoint.options, options.step.settings.kind);
  work.scene = scenes::parse_scene(work.source, options.dt_s(), options.spaces, options.effects);
  work.spec = resolve(options, *work.scene, {path, checkpoint.frames, checkpoint.output});
  require_same_physics(path, checkpoint.options, saved_options(work.spec, options.decomposition));
  core::require_input(checkpoint.steps == checkpoint.frames * work.spec.steps_per_frame,
                      path + ": its numbers of frames and steps do not fit; the file is damaged");
  work.states = std::move(checkpoint.worlds);
  return work;
}

io::Checkpoint checkpoint_without_states(const Work& work, Decomposition asked) {
  io::Checkpoint checkpoint;
  checkpoint.pbmpi_version = program_version;
  checkpoint.git_revision = git_revision;
  checkpoint.build = build_description;
  checkpoint.scene = work.source.name;
  checkpoint.scene_file = work.source.file;
  checkpoint.scene_text = work.source.text;
  checkpoint.options = saved_options(work.spec, asked);
  if (work.spec.output) checkpoint.output = std::filesystem::absolute(*work.spec.output).string();
  return checkpoint;
}

}  // namespace pbmpi::app
