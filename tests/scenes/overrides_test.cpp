#include "scenes/overrides.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/hash.h"
#include "helpers.h"

namespace pbmpi::scenes {
namespace {

/// fingerprint(), and the other things that these tests override.
std::uint64_t bits(const model::Model& model) {
  core::Hash64 hash;
  hash.add(fingerprint(model));
  hash.add(model.gravity.data(), 3);
  hash.add(&model.contact_law.soft_erp, 1);
  for (const model::Geom& geom : model.geoms) {
    hash.add(&geom.material.mu, 1);
    hash.add(&geom.material.restitution, 1);
  }
  return hash.value();
}

/// The message with which CrashSk refuses to build world 3 with this override, or "".
std::string refusal(const Override& one, const char* scene = "CrashSk") {
  try {
    parse_scene(find_scene(scene))->build(3, 1, {one});
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

struct Equivalent {
  const char* name;
  Overrides overrides;
  std::string file;  ///< text of the scene file over 100CrSk with the same change
};
void PrintTo(const Equivalent& equivalent, std::ostream* out) { *out << equivalent.name; }

class OverridesAsAFile : public testing::TestWithParam<Equivalent> {};

// The oracle is a scene file based on the scene: what is tested for bases holds for overrides.
TEST_P(OverridesAsAFile, make_the_world_that_a_file_over_the_scene_makes) {
  const auto scene = parse_scene(find_scene("100CrSk"));
  const auto file = parse("title = \"t\"\nbase = \"100CrSk\"\n" + GetParam().file);
  for (const int world : {0, 7}) {
    const auto with = scene->build(world, 5, GetParam().overrides);
    EXPECT_EQ(bits(*with), bits(*file->build(world, 5)));
    EXPECT_NE(bits(*with), bits(*scene->build(world, 5)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, OverridesAsAFile,
    testing::Values(
        Equivalent{"number", {{"car.speed", "12.5", ""}}, "[[actor]]\nname = \"car\"\nspeed = 12.5\n"},
        Equivalent{"array",
                   {{"human1.position", "[9, 0, 0]", ""}},
                   "[[actor]]\nname = \"human1\"\nposition = [9, 0, 0]\n"},
        Equivalent{"in_a_table",
                   {{"ground.material.mu", "0.25", ""}},
                   "[[actor]]\nname = \"ground\"\nmaterial = { mu = 0.25 }\n"},
        Equivalent{"table",
                   {{"ground.material", "{ mu = 0.25, restitution = 0.5 }", ""}},
                   "[[actor]]\nname = \"ground\"\nmaterial = { mu = 0.25, restitution = 0.5 }\n"},
        Equivalent{"world", {{"world.gravity", "[0, 0, -1.62]", ""}}, "gravity = [0, 0, -1.62]\n"},
        Equivalent{"flag", {{"world.at_rest", "true", ""}}, "at_rest = true\n"},
        Equivalent{
            "several",
            {{"car.speed", "12.5", ""}, {"human2.height", "1.6", ""}, {"world.contact.soft_erp", "0.3", ""}},
            "[contact]\nsoft_erp = 0.3\n[[actor]]\nname = \"car\"\nspeed = 12.5\n[[actor]]\nname = "
            "\"human2\"\nheight = 1.6\n"}),
    [](const auto& test) { return test.param.name; });

TEST(Overrides, the_later_one_of_a_key_counts) {
  const auto scene = parse_scene(find_scene("CrashSk"));
  EXPECT_EQ(bits(*scene->build(0, 1, {{"car.speed", "3", ""}, {"car.speed", "12", ""}})),
            bits(*scene->build(0, 1, {{"car.speed", "12", ""}})));
}

TEST(Overrides, change_no_other_world) {
  const auto scene = parse_scene(find_scene("CrashSk"));
  const std::uint64_t before = bits(*scene->build(2, 1));
  scene->build(1, 1, {{"car.speed", "3", ""}});
  EXPECT_EQ(bits(*scene->build(2, 1)), before);
}

TEST(Overrides, reach_joints_and_names_with_dots) {
  const std::string text =
      "title = \"t\"\n[[actor]]\nname = \"a\"\ntype = \"box\"\nsize = [1, 1, 1]\nmass = 1\n"
      "[[actor]]\nname = \"a.b\"\ntype = \"box\"\nsize = [1, 1, 1]\nmass = 1\nposition = [5, 0, 0]\n"
      "[[joint]]\nname = \"hinge\"\nkind = \"hinge\"\nbodies = [\"a\", \"a.b\"]\nanchor = [0, 0, 0]\naxis = "
      "[0, 0, 1]\n";
  const auto model = parse(text)->build(0, 1, {{"a.b.mass", "3", ""}, {"hinge.break_force", "70", ""}});
  EXPECT_EQ(body(*model, "a.b").mass_kg, 3);
  EXPECT_EQ(body(*model, "a").mass_kg, 1);
  EXPECT_EQ(joint(*model, "hinge").break_force, 70);
}

TEST(Overrides, may_choose_effects_of_a_world) {
  const auto scene = parse_scene(find_scene("CrashSk"));
  const auto model = scene->build(0, 1, {{"world.effects.gravity", "false", ""}});
  EXPECT_EQ(model->gravity.z(), 0);
  EXPECT_NE(scene->build(1, 1)->gravity.z(), 0);
}

struct Wrong {
  const char* name;
  Override one;
  std::string message;  ///< beginning of the message
};
void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }

class WrongOverride : public testing::TestWithParam<Wrong> {};

TEST_P(WrongOverride, is_refused_where_it_stands) {
  EXPECT_EQ(refusal(GetParam().one).substr(0, GetParam().message.size()), GetParam().message)
      << refusal(GetParam().one);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, WrongOverride,
    testing::Values(
        Wrong{"key",
              {"car.sped", "5", "p.csv:3:7: column 'car.sped'"},
              "p.csv:3:7: column 'car.sped': actor 'car': unknown key 'sped'; did you mean 'speed'"},
        Wrong{"actor",
              {"cra.speed", "5", "p.csv:3:7"},
              "p.csv:3:7: the scene has no actor or joint 'cra'; did you mean 'car'"},
        Wrong{"range",
              {"car.chassis_mass", "-5", "p.csv:3:7"},
              "p.csv:3:7: actor 'car': 'chassis_mass' is -5; it must be above 0"},
        Wrong{"type",
              {"car.speed", "\"fast\"", "p.csv:3:7"},
              "p.csv:3:7: actor 'car': 'speed' must be a number"},
        Wrong{"inner_key",
              {"ground.material.mue", "1", "p.csv:3:7"},
              "p.csv:3:7: actor 'ground', material: unknown key 'mue'"},
        Wrong{"no_value", {"car.speed", "", "p.csv:3:7"}, "p.csv:3:7: '' is no TOML value"},
        Wrong{"no_toml", {"car.speed", "1.2.3", "p.csv:3:7"}, "p.csv:3:7: '1.2.3' is no TOML value"},
        Wrong{"more_than_a_value",
              {"car.speed", "1\n[[actor]]\nname = \"x\"", "p.csv:3:7"},
              "p.csv:3:7: '1\n[[actor]]\nname = \"x\"' is more than one TOML value"},
        Wrong{"no_key", {"car", "5", ""}, "parameter 'car': there is no key behind 'car'"},
        Wrong{"empty_part", {"car..speed", "5", ""}, "parameter 'car..speed': a part of the key is missing"},
        Wrong{"empty", {"", "5", ""}, "parameter '': the scene has no actor or joint ''"},
        Wrong{"name", {"car.name", "\"x\"", ""}, "parameter 'car.name': a name is what"},
        Wrong{"of_the_run",
              {"world.run.dt", "0.1", ""},
              "parameter 'world.run.dt': 'run' is the same for all worlds"},
        Wrong{"array",
              {"world.actor.speed", "1", ""},
              "parameter 'world.actor.speed': write the name of the actor"},
        Wrong{"pair", {"world.pair.mu", "1", ""}, "parameter 'world.pair.mu': a [[pair]] has no name"},
        Wrong{"unknown_of_the_world",
              {"world.gravty", "[0, 0, 0]", "p.csv:3:7"},
              "p.csv:3:7: scene: unknown key 'gravty'; did you mean 'gravity'"}),
    [](const auto& test) { return test.param.name; });

TEST(Overrides, of_a_world_that_cannot_be_are_named_beside_the_scenes_place) {
  const std::string message =
      refusal({"human1.position", "[0, 0, 0]", "p.csv:3:7: column 'human1.position'"});
  EXPECT_EQ(message.find("CrashSk.toml:"), 0u) << message;
  EXPECT_NE(message.find("in world 3 it overlaps"), std::string::npos) << message;
  EXPECT_NE(message.find("(parameters of this world: p.csv:3:7: column 'human1.position')"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace pbmpi::scenes
