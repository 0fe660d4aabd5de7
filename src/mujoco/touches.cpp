#include "mujoco/touches.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "mujoco/mjcf.h"

namespace pbmpi::mujoco {
namespace {

using model::Vec3;

/// Represents an unbounded friction coefficient: the cone's equations are scaled by it.
constexpr double most_friction = 100;

/// MuJoCo divides by a pair's coefficient: with a smaller one surfaces slide as if there were no friction.
constexpr double least_friction = 1e-5;

Vec3 vec3(const mjtNum* v) { return Vec3(v); }

}  // namespace

Touches::Touches(const model::Model& model, std::span<const std::int32_t> broken_in, bool has_friction,
                 const mjModel& compiled)
    : model_(&model), rule_(model, broken_in), has_friction_(has_friction), geoms_(compiled.ngeom) {
  for (int geom = 0; geom < static_cast<int>(model.geoms.size()); ++geom)
    geoms_[mj_name2id(&compiled, mjOBJ_GEOM, geom_name(geom).c_str())] = geom;
}

model::GeomPair Touches::pair_of(const mjContact& found) const {
  const auto [first, second] = std::minmax(geoms_[found.geom1], geoms_[found.geom2]);
  return {first, second};
}

void Touches::apply(mjData& data) const {
  int kept = 0;
  for (int i = 0; i < data.ncon; ++i) {
    const model::GeomPair pair = pair_of(data.contact[i]);
    if (!rule_.may_touch(pair.first, pair.second)) continue;
    mjContact& contact = data.contact[kept];
    if (kept != i) contact = data.contact[i];
    ++kept;
    const double mu = model::pair_material(*model_, pair, model_->geoms[pair.first].material,
                                           model_->geoms[pair.second].material)
                          .mu;
    contact.dim = has_friction_ && mu >= least_friction ? 3 : 1;
    contact.friction[0] = contact.friction[1] = std::clamp(mu, least_friction, most_friction);
  }
  data.ncon = kept;
}

int Touches::count_rows(const mjData& data) {
  return std::accumulate(data.contact, data.contact + data.ncon, 0,
                         [](int sum, const mjContact& contact) { return sum + contact.dim; });
}

/// MuJoCo's normal points from its first geom to its second.
model::Contact Touches::contact(const mjContact& found) const {
  const model::Geom &first = model_->geoms[geoms_[found.geom1]], &second = model_->geoms[geoms_[found.geom2]];
  const model::GeomPair pair = pair_of(found);
  const bool a_is_second = model_->geoms[pair.first].body == model::no_body
                               ? pair.second == geoms_[found.geom2]
                               : pair.first == geoms_[found.geom2];
  const model::Material material = model::pair_material(*model_, pair, model_->geoms[pair.first].material,
                                                        model_->geoms[pair.second].material);
  model::Contact contact;
  contact.body_a = a_is_second ? second.body : first.body;
  contact.body_b = a_is_second ? first.body : second.body;
  contact.position = vec3(found.pos);
  contact.normal = a_is_second ? vec3(found.frame) : Vec3(-vec3(found.frame));
  contact.depth = -found.dist;
  contact.mu = found.dim == 1 ? 0 : material.mu;
  contact.geoms = pair;
  return contact;
}

/// mj_contactForce() returns the force on the second geom along the axes of the contact's frame, the first of
/// which is the normal.
void Touches::show(const mjModel& compiled, const mjData& data, std::span<const Vec3> before,
                   stepping::StepContacts& shown) const {
  std::vector<int> order(data.ncon);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int i) { return pair_of(data.contact[i]); });
  for (const int i : order) {
    const mjContact& found = data.contact[i];
    const model::Contact contact = this->contact(found);
    std::array<mjtNum, 6> along{};
    mj_contactForce(&compiled, &data, i, along.data());
    const double sign = contact.normal.dot(vec3(found.frame)) > 0 ? 1 : -1;
    auto force = model::ContactForce::at(contact, before[contact.body_a]);
    force.normal = along[0];
    force.friction = sign * (along[1] * vec3(found.frame + 3) + along[2] * vec3(found.frame + 6));
    shown.contacts.push_back({contact, force});
  }
}

}  // namespace pbmpi::mujoco
