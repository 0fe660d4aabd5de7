#include "contact_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "effects/effects.h"
#include "geometry/box.h"
#include "geometry/geometry.h"
#include "ode/collide/narrow_phase.h"
#include "solver/pack/simd.h"
#include "solver/pack/step_settings.h"
#include "solver/worlds/sor_stepper.h"

namespace pbmpi::testing_support {
namespace {

bool equal_bits(const mpi::WireContact& a, const mpi::WireContact& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

ContactOracle::ContactOracle(const mpi::Communicator& comm, std::shared_ptr<const model::Model> model,
                             const stepping::StepperSettings& settings)
    : comm_(&comm),
      model_(std::move(model)),
      dt_s_(settings.dt_s),
      margin_m_(solver::contact_margin_m(settings, *model_)),
      rule_(*model_) {
  if (effects::StepPlan(*model_).has(effects::EffectId::fast_bodies)) fast_bodies_.emplace(*model_);
  whole_ = solver::make_sor_stepper(settings, ode::make_narrow_phase);
  whole_->add(0, model_, model::initial_state(*model_), 0);
  narrow_phase_ = ode::make_narrow_phase(*model_);
  solver::PackedWorld world{model_.get(), solver::find_articulations(*model_), narrow_phase_.get()};
  world.contact_margin_m = margin_m_;
  pack_ = solver::make_pack({&world, 1}, settings.simd, settings.precision);
}

/// Collides every pair that may touch, except solids whose boxes do not overlap, for which colliders find
/// nothing.
std::vector<model::Contact> ContactOracle::brute_force(std::int64_t step) {
  const model::State& before = whole_->state(0);
  rule_ = model::TouchRule(*model_, before.broken_in);
  if (fast_bodies_) fast_bodies_->set_broken(before.broken_in);
  pack_->load(0, before);
  for (const model::Event& event : model_->events) {
    if (event.step == step && event.kind == model::EventKind::launch) pack_->launch(0, event);
  }
  std::vector<model::BodyPose> poses(model_->bodies.size());
  pack_->poses(0, poses);
  const auto& geoms = model_->geoms;
  std::vector<geometry::Box> boxes(geoms.size());
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    if (geoms[i].shape != model::Shape::plane)
      boxes[i] =
          geometry::geom_box(geoms[i], geoms[i].body < 0 ? geometry::static_pose() : poses[geoms[i].body])
              .grown(margin_m_);
  }
  std::vector<model::GeomPair> pairs;
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    for (std::size_t j = i + 1; j < geoms.size(); ++j) {
      const bool plane = geoms[i].shape == model::Shape::plane || geoms[j].shape == model::Shape::plane;
      if ((plane || boxes[i].overlaps(boxes[j])) && rule_.may_touch(static_cast<int>(i), static_cast<int>(j)))
        pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
    }
  }
  std::vector<model::Contact> contacts;
  pack_->collide_pairs(0, pairs, contacts);
  if (fast_bodies_) {
    model::State state = whole_->state(0);
    pack_->store(0, state);
    if (fast_bodies_->look(state, dt_s_)) {
      const std::size_t num_touching = contacts.size();
      fast_bodies_->add(
          state, [](int, int) { return true; }, contacts);
      contacts_ahead_checked_ += std::ssize(contacts) - static_cast<std::ptrdiff_t>(num_touching);
    }
  }
  return contacts;
}

void ContactOracle::check(std::int64_t step, std::span<const model::Contact> contacts) {
  std::vector<mpi::WireContact> mine;
  for (const model::Contact& contact : contacts) mine.push_back(mpi::to_wire(contact));
  std::vector<mpi::WireContact> found = comm_->allgatherv(std::span<const mpi::WireContact>(mine));
  if (!comm_->is_root()) return;
  std::stable_sort(found.begin(), found.end(), [](const mpi::WireContact& a, const mpi::WireContact& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  const std::vector<model::Contact> expected = brute_force(step);
  contacts_checked_ += std::ssize(expected);
  ASSERT_EQ(found.size(), expected.size()) << "step " << step;
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_TRUE(equal_bits(found[i], mpi::to_wire(expected[i])))
        << "step " << step << ": geoms " << expected[i].geoms.first << " and " << expected[i].geoms.second;
  }
  core::PhaseTimes times;
  whole_->advance(1, times);
}

}  // namespace pbmpi::testing_support
