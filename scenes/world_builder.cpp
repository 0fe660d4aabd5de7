// Builds the model of one world from a scene's plan.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "effects/effect_choices.h"
#include "model/validate.h"
#include "scenes/parts/at_rest.h"
#include "scenes/parts/overlap.h"
#include "scenes/scene_plan.h"

namespace pbmpi::scenes {
namespace {

/// "12 cm", "0.3 mm".
std::string length_text(double metres) {
  std::ostringstream text;
  text.precision(2);
  metres >= 0.01 ? text << std::lround(metres * 100) << " cm" : text << 1000 * metres << " mm";
  return text.str();
}

class WorldBuilder {
 public:
  WorldBuilder(const ScenePlan& plan, int world, std::uint64_t seed)
      : plan_(plan), world_(world), seed_(seed), model_(plan.empty) {}

  std::shared_ptr<const model::Model> build() {
    if (plan_.in_one_space) model_.spaces.resize(1);
    for (std::size_t entry = 0; entry < plan_.actors.size(); ++entry) place_copies(entry);
    for (const PairPlan& pair : plan_.pairs) pair.put_into(model_);
    for (const JointPlan& joint : plan_.joints) joint(model_);
    for (const EventPlan& event : plan_.events) event(model_);
    std::ranges::stable_sort(model_.events, {}, &model::Event::step);
    if (plan_.interest) plan_.interest->put_into(model_);
    if (plan_.hard_case) plan_.hard_case->require_bodies(model_);
    if (plan_.at_rest) bring_to_rest(model_);
    leave_out_effects();
    validate();
    refuse_overlap();
    return std::make_shared<const model::Model>(std::move(model_));
  }

 private:
  void place_copies(std::size_t entry) {
    const ActorEntry& actor = plan_.actors[entry];
    const int copies = actor.copies.in(world_);
    for (int copy = 0; copy < copies; ++copy) {
      // Each actor has keys for a million copies (the most that a file may ask for).
      const std::uint64_t key = (static_cast<std::uint64_t>(entry) << 20) + static_cast<std::uint64_t>(copy);
      const Offset offset = draw(actor.variation, seed_, world_, key);
      Placement place;
      place.name = actor.copies.are_numbered() ? actor.name + "." + std::to_string(copy + 1) : actor.name;
      place.pose.position = actor.position + actor.copies.offset(copy) + offset.position;
      place.pose.orientation = rotation(radians(actor.heading_deg + offset.heading_deg), Vec3::UnitZ());
      place.velocity = actor.velocity + offset.velocity;
      place.space = plan_.in_one_space ? 0 : actor.space;
      place.copy = copy;
      try {
        actor.plan(place, model_);
      } catch (const std::length_error& error) {
        throw core::InputError(actor.where + ": actor " + core::in_quotes(actor.name) + ": " + error.what());
      }
      actor.parts.put_into(model_, place.name);
      entry_of_actor_.resize(model_.actors.size(), &actor);
    }
  }

  void leave_out_effects() {
    model_.effects = plan_.defaults.effects;
    try {
      effects::leave_out_effects(model_);
    } catch (const core::InputError& error) {
      throw core::InputError(plan_.file + ": " + error.what());
    }
  }

  /// Checks what the readers cannot see.
  void validate() const {
    try {
      model::validate(model_, "world " + std::to_string(world_));
    } catch (const model::ActorError& error) {
      throw core::InputError(entry_of_actor_[error.actor()]->where + ": " + error.what());
    } catch (const core::InputError& error) {
      throw core::InputError(plan_.file + ": " + error.what());
    }
  }

  void refuse_overlap() const {
    const auto overlap = find_overlap(model_, plan_.most_overlap_m);
    if (!overlap) return;
    const ActorEntry &a = *entry_of_actor_[overlap->actor_a], &b = *entry_of_actor_[overlap->actor_b];
    // The error is reported at the actor that the scene's own file mentions, if the other comes from a base.
    const std::string& where = b.is_own || !a.is_own ? b.where : a.where;
    throw core::InputError(where + ": actor " + core::in_quotes(model_.actors[overlap->actor_b].name) +
                           ": in world " + std::to_string(world_) + " it overlaps " +
                           core::in_quotes(model_.actors[overlap->actor_a].name) + " by " +
                           length_text(overlap->depth_m) +
                           " at the start (it would be thrown out in one step); move one of them, or allow "
                           "it with 'overlap'");
  }

  const ScenePlan& plan_;
  int world_;
  std::uint64_t seed_;
  GrowingModel model_;
  std::vector<const ActorEntry*> entry_of_actor_;  // [num_actors]
};

}  // namespace

std::shared_ptr<const model::Model> build_world(const ScenePlan& plan, int world, std::uint64_t seed) {
  return WorldBuilder(plan, world, seed).build();
}

}  // namespace pbmpi::scenes
