#include "scenes/parts/growing_model.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {
namespace {

int add_named_body(GrowingModel& model, const std::string& name) {
  model::Body body;
  body.name = name;
  return add_body(model, std::move(body));
}

TEST(GrowingModel, finds_bodies_by_name_as_they_are_added) {
  GrowingModel model{model::Model()};
  EXPECT_EQ(model.find_body("a"), std::nullopt);
  const int a = add_named_body(model, "a");
  EXPECT_EQ(model.find_body("a"), a);
  const int b = add_named_body(model, "b.wheel");
  EXPECT_EQ(model.find_body("b.wheel"), b);
  EXPECT_EQ(model.find_body("b"), std::nullopt);
  EXPECT_TRUE(model.has_body_beginning_with("b."));
  EXPECT_FALSE(model.has_body_beginning_with("c"));
}

TEST(GrowingModel, suggests_names_where_there_is_none) {
  GrowingModel model{model::Model()};
  add_named_body(model, "wheel");
  try {
    model.named_body("weel", "f.toml:1:1: joint");
    FAIL() << "nothing is thrown";
  } catch (const core::InputError& error) {
    EXPECT_STREQ(error.what(), "f.toml:1:1: joint: unknown body 'weel'; did you mean 'wheel'?");
  }
}

TEST(GrowingModel, knows_an_actors_copies_by_their_numbers) {
  GrowingModel model{model::Model()};
  for (const char* name : {"man", "man.1", "manor", "man.apart1", "man.12"})
    add_actor(model, name, model::ActorKind::prop);
  EXPECT_EQ(model.named_actors("man", "here"), (std::vector<int>{0, 1, 4}));
  EXPECT_THROW(model.named_actors("men", "here"), core::InputError);
}

TEST(GrowingModel, gives_a_bodys_first_geom) {
  GrowingModel model{model::Model()};
  const int body = add_named_body(model, "a");
  EXPECT_EQ(model.geom_of(body), nullptr);
  model.geoms.resize(3);
  model.geoms[1].body = model.geoms[2].body = body;
  EXPECT_EQ(model.geom_of(body), &model.geoms[1]);
}

}  // namespace
}  // namespace pbmpi::scenes
