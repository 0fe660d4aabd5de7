#include "solver/collide/awake_geoms.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "ode/collide/narrow_phase.h"
#include "solver/pack/simd.h"
#include "solver/sor_run.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Contact;
using model::Model;

/// Boxes and balls in a heap above the ground, with a static ramp among them.
Model heap(int count) {
  Model model;
  const int ramp = support::add_actor(model, "ramp", model::ActorKind::ramp);
  const double side = 0.32 * std::cbrt(count);
  for (int i = 0; i < count; ++i) {
    const auto number = [&](std::uint64_t k) {
      return core::to_unit(core::mix_key(9, static_cast<std::uint64_t>(i), k));
    };
    const int actor = support::add_actor(model, "solid" + std::to_string(i));
    support::add_solid(model, actor, "body" + std::to_string(i),
                       i % 3 == 0 ? model::Shape::sphere : model::Shape::box, {0.2, 0.3, 0.4}, 1,
                       {side * number(0), side * number(1), side * number(2)});
    if (i == count / 2) {
      model::Geom geom = model.geoms.back();
      geom.body = model::no_body;
      geom.actor = ramp;
      geom.local.position = {side / 2, side / 2, side / 2};
      model.geoms.push_back(geom);
    }
  }
  support::add_ground(model);
  model.effects["sleeping"] = true;
  return model;
}

std::vector<Contact> collide(Pack& pack) {
  std::vector<Contact> contacts;
  pack.collide(std::span(&contacts, 1));
  return contacts;
}

// A tenth of the bodies, a single one, and none; worlds that are swept plainly, in groups, and sorted.
TEST(AwakeGeoms, limit_the_contacts_to_those_of_which_a_body_is_awake) {
  for (const int count : {40, 200, 1100}) {
    const Model model = heap(count);
    const auto fallback = ode::make_narrow_phase(model);
    for (const stepping::Simd simd : machine_simds()) {
      const std::vector<PackedWorld> worlds = {{&model, find_articulations(model), fallback.get()}};
      const auto pack = make_pack(worlds, simd, stepping::Precision::double_);
      const std::vector<Contact> all = collide(*pack);
      ASSERT_GT(all.size(), static_cast<std::size_t>(count)) << "a heap";
      for (const int stride : {10, count, 2 * count}) {
        std::vector<int> awake;
        for (int body = stride - 1; body < count; body += stride) awake.push_back(body);
        pack->set_awake(0, awake);
        const auto is_awake = [&](int body) { return std::binary_search(awake.begin(), awake.end(), body); };
        std::vector<Contact> expected = all;
        std::erase_if(expected, [&](const Contact& c) { return !is_awake(c.body_a) && !is_awake(c.body_b); });
        const std::vector<Contact> found = collide(*pack);
        ASSERT_EQ(found.size(), expected.size()) << count << " bodies, every " << stride;
        for (std::size_t i = 0; i < found.size(); ++i) {
          EXPECT_EQ(found[i].geoms, expected[i].geoms);
          EXPECT_EQ(found[i].position, expected[i].position);
        }
      }
    }
  }
}

}  // namespace
}  // namespace pbmpi::solver
