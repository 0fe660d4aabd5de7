#include "solver/collide/geom_pairs.h"

#include "ode/collide/narrow_phase.h"
#include "solver/layout/articulation.h"
#include "solver/pack/pack.h"
#include "solver/pack/simd.h"

namespace pbmpi::solver {
namespace {

/// Two actors of one body each.
model::Model two_bodies() {
  model::Model model;
  for (int i = 0; i < 2; ++i) {
    model.actors.emplace_back().name = std::to_string(i);
    model::Body& body = model.bodies.emplace_back();
    body.name = std::to_string(i);
    body.actor = i;
  }
  return model;
}

}  // namespace

model::Quat Dice::rotation() {
  for (;;) {
    const double w = between(-1, 1), x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
    const double norm = std::sqrt(w * w + x * x + y * y + z * z);
    if (norm > 0.1 && norm < 1) return {w / norm, x / norm, y / norm, z / norm};
  }
}

model::Geom make_geom(model::Shape shape, int body, Dice& dice) {
  model::Geom geom;
  geom.shape = shape;
  geom.body = shape == model::Shape::plane ? model::no_body : body;
  geom.actor = body;
  geom.size = {dice.between(0.1, 0.6), dice.between(0.1, 0.9), dice.between(0.1, 0.9)};
  if (shape == model::Shape::plane) geom.local = {dice.in_cube(0.3), dice.rotation()};
  return geom;
}

model::Model make_model(const ShapePair& shapes, Dice& dice) {
  model::Model model = two_bodies();
  for (int i = 0; i < 2; ++i) model.geoms.push_back(make_geom(i == 0 ? shapes.a : shapes.b, i, dice));
  return model;
}

model::Geom geom_of(model::Shape shape, int body, const std::array<double, 3>& size) {
  model::Geom geom;
  geom.shape = shape;
  geom.body = body;
  geom.actor = body == model::no_body ? 1 : body;
  geom.size = size;
  return geom;
}

std::vector<model::Contact> contacts_of(const model::Geom& moving, const model::Pose& pose,
                                        const model::Geom& other, stepping::Precision precision) {
  model::Model model = two_bodies();
  model.geoms = {moving, other};
  model.bodies[0].pose = pose;
  const auto fallback = ode::make_narrow_phase(model);
  const PackedWorld world{&model, find_articulations(model), fallback.get()};
  const auto pack = make_pack({&world, 1}, stepping::Simd::automatic, precision);
  std::vector<model::Contact> contacts;
  pack->collide({&contacts, 1});
  return contacts;
}

}  // namespace pbmpi::solver
