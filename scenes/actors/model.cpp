// A mechanism from an MJCF or URDF file.
#include <memory>

#include "core/text.h"
#include "scenes/actors/actor.h"
#include "scenes/actors/model_file.h"
#include "scenes/links/assembly.h"

namespace pbmpi::scenes {

ActorPlan read_model(TableReader& actor, const SceneContext& context) {
  const std::string file = actor.text("file");
  std::set<std::string> leave_out;
  if (actor.has("leave_out")) {
    for (std::string& name : actor.texts("leave_out")) leave_out.insert(std::move(name));
  }
  const auto found = context.files == nullptr ? decltype(context.files->end()){} : context.files->find(file);
  if (context.files == nullptr || found == context.files->end())
    actor.fail("file", "there is no text of " + core::in_quotes(file) +
                           "; give the path of a file, or its text in [files]");
  xml::Notes notes;
  const links::ModelFile read = read_model_file(found->second, file, leave_out, notes);
  const auto assembly = std::make_shared<const links::Assembly>(read.mechanism, context.dt_s, notes);
  if (context.notes != nullptr) {
    for (std::string& line : notes.lines()) context.notes->push_back(std::move(line));
  }
  return [assembly](const Placement& place, model::Model& model) {
    assembly->put_into({place.name, place.pose, place.velocity, place.space}, model);
  };
}

}  // namespace pbmpi::scenes
