#include "effects/fast_bodies.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "effects/approach.h"
#include "geometry/geometry.h"
#include "geometry/ray_cast.h"

namespace pbmpi::effects {
namespace {

/// Of the geom's body.
model::BodyPose body_pose_of(const model::State& state, const model::Geom& geom) {
  if (geom.body == model::no_body) return geometry::static_pose();
  return geometry::body_pose({state.position[geom.body], state.orientation[geom.body]});
}

model::BodyPose pose_of(const model::State& state, const model::Geom& geom) {
  return geometry::geom_pose(geom, body_pose_of(state, geom));
}

/// `geom_at`: the geom's pose; the other arguments are the body's.
core::Vec3 velocity_of_centre(const model::BodyPose& geom_at, const core::Vec3& body_position,
                              const core::Vec3& velocity, const core::Vec3& angular_velocity) {
  return velocity + angular_velocity.cross(core::Vec3(geom_at.position) - body_position);
}

/// A path of the geom's centre, extended by how far the geom reaches ahead of it.
core::Vec3 with_front(const model::Geom& geom, const model::BodyPose& geom_at, const core::Vec3& way) {
  const double length = way.norm();
  if (length == 0) return way;
  return way + geometry::half_extent(geom, geom_at.rotation, way / length) / length * way;
}

constexpr int no_family = -1;

/// A family is the geoms of an actor that does not collide with itself, or else of a body. Most geoms near a
/// limb are of its own family.
int family_of(const model::Model& model, const model::Geom& geom) {
  const auto actor = static_cast<std::size_t>(geom.actor);
  return model.actors[actor].self_collision ? static_cast<int>(model.actors.size()) + geom.body : geom.actor;
}

bool by_geoms(const model::Contact& a, const model::Contact& b) { return a.geoms < b.geoms; }

/// Keeps of each pair of bodies the farthest approach.
void keep_farthest(std::vector<model::Contact>& approaches) {
  const auto bodies = [](const model::Contact& contact) { return std::pair(contact.body_a, contact.body_b); };
  std::sort(approaches.begin(), approaches.end(), [&](const model::Contact& a, const model::Contact& b) {
    return std::tuple(bodies(a), -a.approach, a.geoms) < std::tuple(bodies(b), -b.approach, b.geoms);
  });
  const auto end =
      std::unique(approaches.begin(), approaches.end(),
                  [&](const model::Contact& a, const model::Contact& b) { return bodies(a) == bodies(b); });
  approaches.erase(end, approaches.end());
}

void keep_once(std::vector<int>& bodies) {
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
}

}  // namespace

std::vector<SlowBound> slow_bounds(const model::Model& model, double most_approach_m) {
  // A geom's centre may move half by the body's displacement and half by its rotation; 0.49 instead of 0.5
  // leaves room for rounding.
  constexpr double share = 0.49;
  std::vector<SlowBound> bounds(model.bodies.size(), {model::infinity, model::infinity});
  for (const model::Geom& geom : model.geoms) {
    if (geom.body == model::no_body) continue;
    SlowBound& bound = bounds[static_cast<std::size_t>(geom.body)];
    const double way = share * std::min(geometry::least_half_extent(geom), most_approach_m);
    const double arm = geom.local.position.norm();
    bound.way_m = std::min(bound.way_m, way);
    if (arm > 0) bound.turn_rad = std::min(bound.turn_rad, way / arm);
  }
  return bounds;
}

FastBodies::FastBodies(const model::Model& model, double most_approach_m)
    : model_(&model),
      rule_(model),
      seams_(geometry::Seams::find(model)),
      geoms_of_body_(model.bodies.size()),
      most_approach_m_(most_approach_m),
      moving_of_geom_(model.geoms.size(), -1),
      met_poses_(model.geoms.size()) {
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    const model::Geom& geom = model.geoms[i];
    const double radius = geometry::bounding_radius(geom), arm = geom.local.position.norm();
    Ball& ball = balls_.emplace_back(Ball{.body = geom.body});
    if (geom.body == model::no_body) {
      ball.family = no_family;
      ball.centre = geom.local.position;
      ball.radius = radius;
      static_geoms_.push_back(static_cast<int>(i));
    } else {
      ball.family = family_of(model, geom);
      ball.radius = radius + arm;
      ball.least_half = geometry::least_half_extent(geom);
      ball.arm = arm;
      geoms_of_body_[geom.body].push_back(static_cast<int>(i));
    }
    chosen_.push_back(static_cast<int>(i));
  }
  for (const model::Body& body : model.bodies) ease_of_turning_.push_back(3 / body.inertia.trace());
}

void FastBodies::choose(std::span<const int> bodies) {
  chosen_ = static_geoms_;
  for (const int body : bodies)
    chosen_.insert(chosen_.end(), geoms_of_body_[body].begin(), geoms_of_body_[body].end());
}

/// The first test saves the two square roots a geom: the displacement and the rotation each account for less
/// than half of what makes a geom fast. A non-finite speed counts as slow.
bool FastBodies::is_slow(const Ball& ball, const core::Vec3& velocity, const core::Vec3& spin, double dt_s,
                         double most_m) {
  const double half_s = 0.499 * most_m / dt_s;
  const bool clearly =
      velocity.squaredNorm() < half_s * half_s && spin.squaredNorm() * ball.arm * ball.arm < half_s * half_s;
  if (clearly) return true;
  const double most = velocity.norm() + (ball.arm > 0 ? spin.norm() * ball.arm : 0);
  return !(most * dt_s > most_m);
}

bool FastBodies::look(const model::State& state, double dt_s, int pieces) {
  for (const Moving& moving : moving_) moving_of_geom_[moving.geom] = -1;
  moving_.clear();
  bodies_.clear();
  for (const int index : chosen_) {
    const Ball& ball = balls_[index];
    if (ball.body == model::no_body) continue;
    const core::Vec3& velocity = state.velocity[ball.body];
    const core::Vec3& spin = state.angular_velocity[ball.body];
    const double most_slow = std::min(ball.least_half / pieces, most_approach_m_);
    if (is_slow(ball, velocity, spin, dt_s, most_slow)) continue;
    const model::Geom& geom = model_->geoms[index];
    const model::BodyPose at = pose_of(state, geom);
    const core::Vec3 way = dt_s * velocity_of_centre(at, state.position[ball.body], velocity, spin);
    const double length = way.norm();
    if (!std::isfinite(length) || !(length > most_slow)) continue;
    const double half = geometry::half_extent(geom, at.rotation, way / length);
    const bool is_fast = length * pieces > half, may_approach = length > most_approach_m_;
    if (!is_fast && !may_approach) continue;
    const core::Vec3 reach = way + half / length * way;
    moving_.push_back({index, ball.family, ball.radius, at, way, reach, is_fast, may_approach});
    if (is_fast) bodies_.push_back(ball.body);
  }
  // Of two that meet, the lower one finds the contact.
  std::ranges::sort(moving_, {}, &Moving::geom);
  for (std::size_t i = 0; i < moving_.size(); ++i) moving_of_geom_[moving_[i].geom] = static_cast<int>(i);
  keep_once(bodies_);
  return !moving_.empty();
}

std::vector<FastBodies::Reach> FastBodies::reaches(const model::State& state) const {
  std::vector<Reach> reaches;
  for (const Moving& moving : moving_) {
    const int body = model_->geoms[moving.geom].body;
    // Its own search, and the ball in which a path of another one finds it.
    geometry::Box box = geometry::swept_box(core::Vec3(moving.pose.position), moving.radius, moving.way);
    box.include(geometry::swept_box(state.position[body], moving.radius, moving.way));
    reaches.push_back({body, moving.may_approach ? box.grown(most_approach_m_) : box});
  }
  return reaches;
}

bool FastBodies::is_near(const model::State& state, const core::Vec3& middle, double half_way,
                         const Ball& ball) {
  const core::Vec3& centre = ball.body == model::no_body ? ball.centre : state.position[ball.body];
  const double reach = half_way + ball.radius;
  return (centre - middle).squaredNorm() <= reach * reach;
}

const model::BodyPose& FastBodies::met_pose(const model::State& state, int geom) {
  std::optional<model::BodyPose>& pose = met_poses_[static_cast<std::size_t>(geom)];
  if (!pose) {
    pose = pose_of(state, model_->geoms[static_cast<std::size_t>(geom)]);
    if (model_->geoms[static_cast<std::size_t>(geom)].body != model::no_body) met_.push_back(geom);
  }
  return *pose;
}

/// Call it first, since the state may differ from the last call's.
void FastBodies::forget_met() {
  for (const int geom : met_) met_poses_[static_cast<std::size_t>(geom)].reset();
  met_.clear();
}

bool FastBodies::is_covered(const model::State& state, int geom, const core::Vec3& point,
                            const core::Vec3& normal) const {
  return seams_ && seams_->covers(geom, body_pose_of(state, model_->geoms[static_cast<std::size_t>(geom)]),
                                  point, normal);
}

/// The contact acts somewhere between the point where the path meets the surface and the point below the fast
/// geom's centre: the lever arm of an oblique hit would turn a body instead of stopping it, so the arm is
/// divided by how easily the two bodies turn, with less for the one that turns more easily. Between the two
/// surfaces it lies half way; where they overlap, which no depth says, nearer to that of this body.
void FastBodies::meet(const model::State& state, const Moving& fast, const core::Vec3& way, int other) {
  const core::Vec3 centre(fast.pose.position);
  const model::Geom& geom = model_->geoms[fast.geom];
  const auto entry = geometry::enter(model_->geoms[other], met_pose(state, other), centre, way);
  if (!entry || !rule_.may_touch(fast.geom, other)) return;
  const core::Vec3 hit = centre + entry->share * way;
  if (is_covered(state, other, hit, entry->normal)) return;
  const double height = entry->normal.dot(centre - hit);
  const int other_body = model_->geoms[other].body;
  model::Contact contact;
  const bool fast_is_a = put_geoms(fast.geom, other, contact);
  const double own_ease = ease_of_turning_[geom.body];
  const double other_ease = other_body == model::no_body ? 0 : ease_of_turning_[other_body];
  contact.normal = fast_is_a ? entry->normal : core::Vec3(-entry->normal);
  const double own_share = own_ease / (own_ease + other_ease);
  const double overlap = geometry::half_extent(geom, fast.pose.rotation, -entry->normal) - height;
  const double to_between = overlap < 0 ? 0.5 * overlap : own_share * overlap;
  contact.depth = std::min(0.0, overlap);
  contact.position =
      own_share * (centre - height * entry->normal) + (1 - own_share) * hit - to_between * entry->normal;
  const model::Material material =
      model::pair_material(*model_, contact.geoms, geom.material, model_->geoms[other].material);
  contact.mu = material.mu;
  contact.restitution = material.restitution;
  found_.push_back(contact);
}

bool FastBodies::put_geoms(int geom, int other, model::Contact& contact) const {
  const int body = model_->geoms[geom].body, other_body = model_->geoms[other].body;
  contact.geoms = {std::min(geom, other), std::max(geom, other)};
  const bool is_a = other_body == model::no_body || geom == contact.geoms.first;
  contact.body_a = is_a ? body : other_body;
  contact.body_b = is_a ? other_body : body;
  return is_a;
}

void FastBodies::approach(const model::State& state, const Moving& from, int other) {
  const Moving* too = moving(other);
  const bool other_moves = too != nullptr && too->may_approach;
  const model::Geom &geom = model_->geoms[from.geom], &met = model_->geoms[other];
  const bool is_static = met.body == model::no_body;
  const core::Vec3 way = other_moves ? core::Vec3(from.way - too->way) : from.way;
  const double room = other_moves || is_static ? 0 : most_approach_m_;
  const double by =
      is_static ? approach_to_static(geom, from.pose, way, met, met_pose(state, other)) : way.norm();
  if (!(by > most_approach_m_) || !rule_.may_touch(from.geom, other)) return;
  if (!may_meet(geom, from.pose, way, met, met_pose(state, other), room)) return;
  model::Contact contact;
  put_geoms(from.geom, other, contact);
  contact.approach = by;
  contact.depth = -model::infinity;
  contact.position = core::Vec3(from.pose.position);
  contact.normal = core::Vec3::UnitZ();
  approaches_.push_back(contact);
}

template <class Accepts>
void FastBodies::look_from(const model::State& state, const Moving& from, const BallSet& set,
                           const Accepts& accepts) {
  if (from.is_fast) find_meetings(state, from, set, accepts);
  if (from.may_approach) find_approaches(state, from, set, accepts);
}

template <class Accepts>
void FastBodies::find_approaches(const model::State& state, const Moving& from, const BallSet& set,
                                 const Accepts& accepts) {
  const geometry::Box near = geometry::swept_box(core::Vec3(from.pose.position), from.radius, from.way);
  set.swept.for_each_near(near.grown(most_approach_m_), from.family, [&](int index) {
    const int other = set.geoms[index];
    if (accepts(other)) approach(state, from, other);
  });
}

/// Meets the geoms near the path for which accepts(geom) is true.
template <class Accepts>
void FastBodies::find_meetings(const model::State& state, const Moving& fast, const BallSet& set,
                               const Accepts& accepts) {
  const core::Vec3 centre(fast.pose.position);
  const model::Geom& geom = model_->geoms[fast.geom];
  const core::Vec3 middle = centre + 0.5 * fast.reach;
  const double half = 0.5 * fast.reach.norm();
  const auto meet_if_near = [&](int index) {
    const int other = set.geoms[index];
    if (!accepts(other)) return;
    const Ball& ball = balls_[other];
    if (const Moving* too = moving(other); too != nullptr && too->is_fast) {
      const core::Vec3 way = with_front(geom, fast.pose, fast.way - too->way);
      if (is_near(state, centre + 0.5 * way, 0.5 * way.norm(), ball)) meet(state, fast, way, other);
    } else if (is_near(state, middle, half, ball)) {
      meet(state, fast, fast.reach, other);
    }
  };
  // The front is within the geom's ball; the path of another fast geom is in its swept ball.
  set.swept.for_each_near(geometry::swept_box(centre, fast.radius, fast.way), fast.family, meet_if_near);
}

/// Empties the sets but keeps their memory.
void FastBodies::clear_sets(std::size_t count) {
  forget_met();
  sets_.resize(count);
  for (BallSet& set : sets_) {
    set.swept.clear();
    set.geoms.clear();
  }
}

void FastBodies::put_ball(const model::State& state, int geom, BallSet& set) const {
  const Ball& ball = balls_[geom];
  const core::Vec3& centre = ball.body == model::no_body ? ball.centre : state.position[ball.body];
  const Moving* moves = moving(geom);
  set.swept.add(centre, ball.radius, moves != nullptr ? moves->way : core::Vec3(core::Vec3::Zero()),
                ball.family);
  set.geoms.push_back(geom);
}

void FastBodies::add(const model::State& state, const Filter& filter, std::vector<model::Contact>& contacts) {
  if (moving_.empty()) return;
  clear_sets(1);
  for (const int geom : chosen_) put_ball(state, geom, sets_.front());
  sets_.front().swept.finish();
  for (const Moving& moving : moving_)
    look_from(state, moving, sets_.front(), [&](int other) { return filter(moving.geom, other); });
  join_found(contacts);
}

void FastBodies::add_across(const model::State& state, std::span<const int> group_of_body,
                            std::vector<model::Contact>& contacts) {
  if (moving_.empty()) return;
  const auto group_of = [&](const Moving& moving) { return group_of_body[model_->geoms[moving.geom].body]; };
  const int first = group_of(moving_.front());
  const bool all_in_first = std::all_of(moving_.begin(), moving_.end(),
                                        [&](const Moving& moving) { return group_of(moving) == first; });
  clear_sets(static_cast<std::size_t>(*std::max_element(group_of_body.begin(), group_of_body.end()) + 1));
  for (const int geom : chosen_) {
    if (balls_[geom].body == model::no_body) continue;
    const int group = group_of_body[balls_[geom].body];
    if (!all_in_first || group != first) put_ball(state, geom, sets_[group]);
  }
  for (BallSet& set : sets_) set.swept.finish();
  for (const Moving& moving : moving_) {
    for (int group = 0; group < static_cast<int>(sets_.size()); ++group) {
      if (group != group_of(moving)) look_from(state, moving, sets_[group], [](int) { return true; });
    }
  }
  join_found(contacts);
}

/// Keeps canonical order, with the speculative contacts of a pair after its touching ones, and its approach
/// last.
void FastBodies::join_found(std::vector<model::Contact>& contacts) {
  std::stable_sort(found_.begin(), found_.end(), by_geoms);
  const auto end =
      std::unique(found_.begin(), found_.end(),
                  [](const model::Contact& a, const model::Contact& b) { return a.geoms == b.geoms; });
  found_.erase(end, found_.end());
  keep_farthest(approaches_);
  found_.insert(found_.end(), approaches_.begin(), approaches_.end());
  std::stable_sort(found_.begin(), found_.end(), by_geoms);
  approaches_.clear();
  const auto num_touching = std::ssize(contacts);
  contacts.insert(contacts.end(), found_.begin(), found_.end());
  std::inplace_merge(contacts.begin(), contacts.begin() + num_touching, contacts.end(), by_geoms);
  found_.clear();
}

}  // namespace pbmpi::effects
