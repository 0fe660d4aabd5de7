#include "engines/shared_scene.h"

#include <utility>

#include "core/system/input_file.h"
#include "mpi/comm/agreement.h"

namespace pbmpi::engines {

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

scenes::ParameterTable share_parameters(const mpi::Communicator& comm, const std::string& path) {
  std::string text;
  mpi::agree_on_errors(comm, [&] {
    if (comm.is_root())
      text = core::read_input_file(path, "give the path of a table of parameters (CSV, or TOML)");
  });
  comm.bcast_string(text);
  return {path, std::move(text)};
}

}  // namespace pbmpi::engines
