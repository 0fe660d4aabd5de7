// A mechanism from an MJCF or URDF file.
#include <map>
#include <memory>

#include "core/text.h"
#include "scenes/actors/actor.h"
#include "scenes/actors/model_file.h"
#include "scenes/links/assembly.h"

namespace pbmpi::scenes {
namespace {

ModelChoices read_choices(TableReader& actor) {
  ModelChoices choices;
  if (actor.has("leave_out")) {
    for (std::string& name : actor.texts("leave_out")) choices.leave_out.insert(std::move(name));
  }
  choices.keyframe = actor.text("keyframe", "");
  return choices;
}

/// Reads `joints = { knee = deg, rail = metres, shoulder = { axis = [x, y, z], angle = deg } }`: where joints
/// start, as the model counts them.
void read_starts(TableReader& actor, links::Mechanism& mechanism) {
  auto table = actor.table("joints");
  if (!table) return;
  std::map<std::string, links::LinkJoint*> joints;
  std::vector<std::string> names;
  for (links::Link& link : mechanism.links) {
    for (links::LinkJoint& joint : link.joints) {
      joints.emplace(joint.name, &joint);
      names.push_back(joint.name);
    }
  }
  for (const std::string& name : table->keys()) {
    const auto found = joints.find(name);
    if (found == joints.end())
      table->fail(name, "unknown joint " + core::in_quotes(name) + core::suggestion(name, names));
    links::LinkJoint* joint = found->second;
    switch (joint->motion) {
      case links::Motion::hinge:
        joint->start = radians(table->number(name, Sign::any)) - joint->reference;
        break;
      case links::Motion::slide:
        joint->start = table->number(name, Sign::any) - joint->reference;
        break;
      case links::Motion::ball:
        joint->start_turn = table->rotation(name);
        break;
      case links::Motion::free:
        table->fail(name, "a free body has no joint that could start elsewhere; give the actor's 'position'");
    }
  }
  table->finish();
}

}  // namespace

ActorPlan read_model(TableReader& actor, const SceneContext& context) {
  const std::string file = actor.text("file");
  if (context.files == nullptr || !context.files->contains(file))
    actor.fail("file", "there is no text of " + core::in_quotes(file) +
                           "; give the path of a file, or its text in [files]");
  xml::Notes notes;
  links::ModelFile read = read_model_file(*context.files, file, read_choices(actor), notes);
  read_starts(actor, read.mechanism);
  const auto assembly = std::make_shared<const links::Assembly>(read.mechanism, context.dt_s, notes);
  if (context.notes != nullptr) {
    for (std::string& line : notes.lines()) context.notes->push_back(std::move(line));
  }
  return [assembly](const Placement& place, model::Model& model) {
    assembly->put_into({place.name, place.pose, place.velocity, place.space}, model);
  };
}

}  // namespace pbmpi::scenes
