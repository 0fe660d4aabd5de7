// Takes a step of one world apart. ODE does not time islands, so the step is repeated from its own start with
// all bodies disabled except those of one island.
#include <algorithm>
#include <functional>

#include "core/clock.h"
#include "ode/objects/bodies.h"
#include "ode/world.h"

namespace pbmpi::ode {
namespace {

/// The least time of a few repeats: the cost of the work without disturbances of the machine.
constexpr int num_repeats = 3;

double least_time(const std::function<void()>& prepare, const std::function<void()>& work) {
  double least_s = model::infinity;
  for (int repeat = 0; repeat < num_repeats; ++repeat) {
    prepare();
    const double start_s = core::now_s();
    work();
    least_s = std::min(least_s, core::now_s() - start_s);
  }
  return least_s;
}

/// The pairs of each collision space, and at the end those between two spaces. A static geom belongs to all
/// spaces.
std::vector<std::vector<GeomPair>> cut_by_space(const model::Model& model,
                                                const std::vector<GeomPair>& pairs) {
  std::vector<std::vector<GeomPair>> cut(model.spaces.size() + 1);
  for (const GeomPair& pair : pairs) {
    const model::Geom& a = model.geoms[pair.first];
    const model::Geom& b = model.geoms[pair.second];
    const bool is_static = a.body == model::no_body || b.body == model::no_body;
    const int space = a.body == model::no_body ? b.space : a.space;
    cut[is_static || a.space == b.space ? space : cut.size() - 1].push_back(pair);
  }
  return cut;
}

std::vector<double> shares_of_geoms(const model::Model& model) {
  std::vector<double> shares(model.spaces.size(), 0);
  for (const model::Geom& geom : model.geoms) ++shares[geom.space];
  for (double& share : shares) share /= static_cast<double>(model.geoms.size());  // exactly 1 for one space
  return shares;
}

}  // namespace

std::optional<stepping::StepProfile> World::profile_last_step() {
  model::State after = before_last_;
  copy_out(bodies_, after);
  after.broken_in = broken_in();
  set_broken(before_last_.broken_in);
  --step_;
  stepping::StepProfile profile;
  restore(before_last_);
  if (broad_phase_) profile_collision(profile);
  count();
  profile_islands(profile);
  contacts_.clear();
  ++step_;
  restore(after);
  set_broken(after.broken_in);
  return profile;
}

/// Leaves the contacts of the whole step in place.
void World::profile_collision(stepping::StepProfile& profile) {
  const double broad_s =
      least_time([&] { restore(before_last_); }, [&] { static_cast<void>(broad_phase_->find_pairs()); });
  const std::vector<GeomPair>& pairs = broad_phase_->find_pairs();
  const std::vector<std::vector<GeomPair>> cut = cut_by_space(*model_, pairs);
  const std::vector<double> shares = shares_of_geoms(*model_);
  profile.collide_s = broad_s;
  double longest_s = 0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const double narrow_s =
        cut[i].empty() ? 0
                       : least_time([&] { contacts_.clear(); },
                                    [&] { contacts_.make(world_.get(), cut[i], broad_phase_->geoms()); });
    profile.collide_s += narrow_s;
    if (i < shares.size()) {
      longest_s = std::max(longest_s, broad_s * shares[i] + narrow_s);
    } else {
      profile.collide_spaces_s = longest_s + narrow_s;
    }
  }
  contacts_.clear();
  contacts_.make(world_.get(), pairs, broad_phase_->geoms());
  static_cast<void>(rules_.after_collision(*this));  // nothing sleeps in a world that is profiled
  for (const stepping::Touch& touch : contacts_.touches()) {
    if (touch.cross_space) profile.cross_contacts += touch.num_contacts;
  }
}

/// A step without bodies gives the overhead that every island's step includes.
void World::profile_islands(stepping::StepProfile& profile) {
  profile.islands = row_counter_.islands(contacts_.touches());
  for (const dBodyID body : bodies_) dBodyDisable(body);
  const double empty_s = time_solve({}, settings_.iterations, before_last_);
  std::vector<std::vector<int>> members(bodies_.size());
  for (int body = 0; body < model_->num_bodies(); ++body) {
    members[row_counter_.island_of(body)].push_back(body);
  }
  for (stepping::IslandCost& island : profile.islands) {
    std::vector<dBodyID> bodies;
    model::State state;
    for (const int body : members[island.first_body]) {
      bodies.push_back(bodies_[body]);
      state.position.push_back(before_last_.position[body]);
      state.orientation.push_back(before_last_.orientation[body]);
      state.velocity.push_back(before_last_.velocity[body]);
      state.angular_velocity.push_back(before_last_.angular_velocity[body]);
    }
    const int iterations = focus_ ? focus_->iterations_of(island.first_body) : settings_.iterations;
    island.solve_s = std::max(0.0, time_solve(bodies, iterations, state) - empty_s);
  }
  for (const dBodyID body : bodies_) dBodyEnable(body);
}

/// Seconds of a step in which only the `enabled` bodies take part. `before`: their state, which is restored
/// after the step.
double World::time_solve(const std::vector<dBodyID>& enabled, int iterations, const model::State& before) {
  for (const dBodyID body : enabled) dBodyEnable(body);
  const double least_s = least_time(
      [&] {
        if (!enabled.empty()) ode::restore(enabled, before);
      },
      [&] { solve_enabled(iterations); });
  if (!enabled.empty()) ode::restore(enabled, before);
  for (const dBodyID body : enabled) dBodyDisable(body);
  return least_s;
}

}  // namespace pbmpi::ode
