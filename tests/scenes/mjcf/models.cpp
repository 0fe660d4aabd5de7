#include "models.h"

#include <algorithm>

#include "../helpers.h"
#include "core/error.h"

namespace pbmpi::scenes {

std::shared_ptr<const model::Model> model_of(const std::string& xml) {
  return parse_scene({"m", "m.xml", xml})->build(0, 1);
}

std::vector<std::string> notes_of(const std::string& xml) {
  return parse_scene({"m", "m.xml", xml})->notes();
}

std::string refusal_of(const std::string& xml) {
  try {
    model_of(xml);
    return "";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

std::string mujoco(const std::string& world, const std::string& before) {
  return "<mujoco><compiler angle='radian'/>" + before + "<worldbody>" + world + "</worldbody></mujoco>";
}

std::string boxed(const std::string& more, const std::string& attributes) {
  return "<body name='b' " + attributes + "><geom type='box' size='.1 .2 .3' mass='1'/>" + more + "</body>";
}

const model::Body& link(const model::Model& model, const std::string& name) {
  return body(model, "m." + name);
}

const model::Joint& joint_of(const model::Model& model, const std::string& name) {
  return joint(model, "m." + name);
}

bool says(const std::vector<std::string>& notes, const std::string& words) {
  return std::ranges::any_of(notes,
                             [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

}  // namespace pbmpi::scenes
