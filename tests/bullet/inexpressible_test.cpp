#include "bullet/bullet_stepper.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::bullet {
namespace {

bool says(const model::Model& model, const std::string& word) {
  return std::ranges::any_of(inexpressible(model),
                             [&](const std::string& line) { return line.starts_with(word); });
}

TEST(Inexpressible, names_what_the_model_has_and_nothing_else) {
  model::Model model = support::pendulum(1, 0.1);
  for (const char* word : {"suspension", "limits", "cfm", "max_per_pair", "field", "infinite"})
    EXPECT_FALSE(says(model, word)) << word;
  EXPECT_FALSE(says(model, "gyroscopic")) << "it is a ball";
  EXPECT_TRUE(says(support::free_box(), "gyroscopic"));
  model.joints[0].limits[0] = {-1, 1};
  model.cfm = 1e-3;
  model.contact_law.max_per_pair = 8;
  support::add_ground(model);
  model.geoms.back().material.mu = model::infinity;
  for (const char* word : {"limits", "cfm", "max_per_pair", "infinite"})
    EXPECT_TRUE(says(model, word)) << word;
}

}  // namespace
}  // namespace pbmpi::bullet
