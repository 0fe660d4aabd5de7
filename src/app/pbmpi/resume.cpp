#include "app/pbmpi/resume.h"

#include <ostream>
#include <vector>

#include "app/common/version.h"
#include "core/error.h"
#include "core/hash.h"
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

/// Equal bits are promised for one build only.
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

}  // namespace

io::Checkpoint load_checkpoint(const mpi::Communicator& comm, const std::string& path,
                               std::ostream& warnings) {
  io::Checkpoint checkpoint;
  mpi::agree_on_errors(comm, [&] {
    if (!comm.is_root()) return;
    checkpoint = io::read_checkpoint(path);
    check_build(checkpoint, path, warnings);
    require_undamaged(checkpoint, path);
  });
  for (std::string* text : {&checkpoint.scene, &checkpoint.scene_file, &checkpoint.scene_text,
                            &checkpoint.options, &checkpoint.output, &checkpoint.state_hash}) {
    comm.bcast_string(*text);
  }
  comm.bcast_value(checkpoint.frames);
  comm.bcast_value(checkpoint.steps);
  return checkpoint;
}

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

}  // namespace pbmpi::app
