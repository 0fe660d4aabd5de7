#include "app/common/load_scene.h"

#include <algorithm>

#include "mpi/comm/agreement.h"

namespace pbmpi::app {

scenes::SceneSource share_scene(const mpi::Communicator& comm, const std::string& name_or_path) {
  scenes::SceneSource source;
  mpi::agree_on_errors(comm, [&] {
    if (comm.is_root()) source = scenes::find_scene(name_or_path);
  });
  comm.bcast_string(source.name);
  comm.bcast_string(source.file);
  comm.bcast_string(source.text);
  return source;
}

std::string scene_text_parameter(std::string scene_name) {
  std::ranges::replace(scene_name, '/', '.');
  return "scene_text_" + scene_name;
}

std::unique_ptr<scenes::Scene> load_scene(const mpi::Communicator& comm, const std::string& name_or_path,
                                          std::optional<double> dt_s,
                                          std::optional<scenes::SpacesForm> spaces,
                                          const model::EffectChoices& effects) {
  return scenes::parse_scene(share_scene(comm, name_or_path), dt_s, spaces, effects);
}

}  // namespace pbmpi::app
