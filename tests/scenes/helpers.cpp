#include "helpers.h"

#include <stdexcept>

#include "core/error.h"
#include "core/hash.h"
#include "model/state.h"

namespace pbmpi::scenes {
namespace {

template <class Item>
const Item& by_name(const std::vector<Item>& items, const std::string& name) {
  for (const Item& item : items) {
    if (item.name == name) return item;
  }
  throw std::runtime_error("the model has no '" + name + "'");
}

}  // namespace

std::unique_ptr<Scene> parse(const std::string& text) { return parse_scene({"test", "test.toml", text}); }

std::shared_ptr<const model::Model> build(const std::string& text) { return parse(text)->build(0, 1); }

std::string error_of(const std::string& text) {
  try {
    parse(text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

std::string error_after_ground(const std::string& lines) {
  return error_of("title = \"t\"\n[[actor]]\nname = \"ground\"\ntype = \"ground\"\n" + lines);
}

const model::Body& body(const model::Model& model, const std::string& name) {
  return by_name(model.bodies, name);
}

const model::Joint& joint(const model::Model& model, const std::string& name) {
  return by_name(model.joints, name);
}

std::uint64_t fingerprint(const model::Model& model) {
  core::Hash64 hash;
  hash.add(model::hash(model::initial_state(model)));
  for (const model::Body& b : model.bodies) {
    hash.add(&b.mass_kg, 1);
    hash.add(b.inertia.data(), 9);
  }
  for (const model::Geom& g : model.geoms) {
    hash.add(g.size.data(), 3);
    hash.add(g.local.position.data(), 3);
  }
  for (const model::Joint& j : model.joints) {
    hash.add(j.anchor_a.data(), 3);
    hash.add(j.anchor_b.data(), 3);
    hash.add(j.axis1_a.data(), 3);
    hash.add(j.axis2_b.data(), 3);
  }
  for (const model::Event& e : model.events) hash.add(&e.angle, 1);
  return hash.value();
}

std::string scene_with(const std::string& type, const std::string& more_keys) {
  return "title = \"t\"\n[[actor]]\nname = \"ground\"\ntype = \"ground\"\n[[actor]]\nname = \"a\"\ntype = "
         "\"" +
         type + "\"\n" + more_keys;
}

}  // namespace pbmpi::scenes
