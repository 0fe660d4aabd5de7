#include "scenes/scene.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "helpers.h"

namespace pbmpi::scenes {
namespace {

const std::string box = "[[actor]]\nname = \"b\"\ntype = \"box\"\nsize = [1, 1, 1]\n";

TEST(Scene, keeps_the_defaults_of_a_run_that_the_file_does_not_set) {
  const auto scene = parse("title = \"t\"\n[run]\nframes = 7\n" + box + "mass = 1\n");
  EXPECT_EQ(scene->defaults().frames, 7);
  EXPECT_EQ(scene->defaults().warmup, RunDefaults{}.warmup);
  EXPECT_EQ(scene->defaults().dt_s, RunDefaults{}.dt_s);
}

TEST(Scene, passes_the_worlds_numbers_on_to_the_model) {
  const auto model = build(
      "title = \"t\"\ngravity = [0, 0, -1.62]\nerp = 0.3\ncfm = 1e-6\nspaces = [\"near\", \"far\"]\n"
      "[contact]\nsoft_erp = 0.4\nsoft_cfm = 1e-5\nbounce_velocity = 0.5\nmax_per_pair = 2\n" +
      box + "mass = 3\nspace = \"far\"\nmaterial = { mu = 0.1, restitution = 0.2 }\n");
  EXPECT_EQ(model->gravity.z(), -1.62);
  EXPECT_EQ(model->erp, 0.3);
  EXPECT_EQ(model->cfm, 1e-6);
  EXPECT_EQ(model->contact_law.soft_erp, 0.4);
  EXPECT_EQ(model->contact_law.soft_cfm, 1e-5);
  EXPECT_EQ(model->contact_law.bounce_velocity, 0.5);
  EXPECT_EQ(model->contact_law.max_per_pair, 2);
  EXPECT_EQ(model->spaces, (std::vector<std::string>{"near", "far"}));
  EXPECT_EQ(model->geoms[0].space, 1);
  EXPECT_EQ(model->geoms[0].material.mu, 0.1);
  EXPECT_EQ(model->geoms[0].material.restitution, 0.2);
}

TEST(Scene, says_whether_its_spaces_meet) {
  EXPECT_TRUE(build("title = \"t\"\n" + box + "mass = 1\n")->spaces_meet);
  EXPECT_FALSE(build("title = \"t\"\ninter_space = \"none\"\n" + box + "mass = 1\n")->spaces_meet);
}

TEST(Scene, is_uniform_unless_an_actor_varies_from_world_to_world) {
  const std::string scene = "title = \"t\"\n" + box + "mass = 1\n";
  EXPECT_TRUE(parse(scene)->is_uniform());
  EXPECT_TRUE(parse(scene + "copies = 3\nspacing = [2, 0, 0]\n")->is_uniform());
  EXPECT_FALSE(parse(scene + "copies = [[0, 3], [5, 1]]\nspacing = [2, 0, 0]\n")->is_uniform());
  EXPECT_FALSE(parse(scene + "variation = { heading = 1 }\n")->is_uniform());
  EXPECT_FALSE(parse(scene + "variation = { velocity = [0, 0, 0.1] }\n")->is_uniform());
}

TEST(Scene, a_time_step_given_by_the_caller_replaces_the_files_own) {
  const SceneSource source{"t", "t.toml", "title = \"t\"\n[run]\ndt = 0.01\n" + box + "mass = 1\n"};
  EXPECT_EQ(parse_scene(source, 0.002)->defaults().dt_s, 0.002);
  EXPECT_THROW(parse_scene(source, -1.0), core::InputError);
}

// Each message begins with the place of the error, and says what is wrong there.
struct Mistake {
  const char* name;
  std::string text;
  std::string place;  // line:column
  std::string says;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class SceneMistake : public testing::TestWithParam<Mistake> {};

TEST_P(SceneMistake, is_told_with_file_line_and_column) {
  const std::string message = error_of(GetParam().text);
  EXPECT_EQ(message.find("test.toml:" + GetParam().place + ":"), 0u) << message;
  EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
}

const std::string title = "title = \"t\"\n";

INSTANTIATE_TEST_SUITE_P(
    Files, SceneMistake,
    testing::Values(
        Mistake{"malformed", "title = \"t\"\nframes = = 3\n", "2:10", "malformed TOML"},
        Mistake{"no_title", box + "mass = 1\n", "1:1", "the key 'title' is missing"},
        Mistake{"no_actor", title, "1:1", "no [[actor]]"},
        Mistake{"unknown_key", title + "gravitiy = [0, 0, 0]\n" + box + "mass = 1\n", "2:1",
                "unknown key 'gravitiy'; did you mean 'gravity'?"},
        Mistake{"unknown_run_key", title + "[run]\nframe = 3\n" + box + "mass = 1\n", "3:1",
                "unknown key 'frame'; did you mean 'frames'?"},
        Mistake{"wrong_type", title + "gravity = 9.81\n" + box + "mass = 1\n", "2:11", "must be an array"},
        Mistake{"two_numbers", title + "gravity = [0, 1]\n" + box + "mass = 1\n", "2:11", "three numbers"},
        Mistake{"text_in_vector", title + "gravity = [0, \"a\", 1]\n" + box + "mass = 1\n", "2:15",
                "must be a number"},
        Mistake{"zero_frames", title + "[run]\nframes = 0\n" + box + "mass = 1\n", "3:10",
                "'frames' is 0; it must be at least 1"},
        Mistake{"no_replicas", title + "[run]\nreplicas = 0\n" + box + "mass = 1\n", "3:12", "at least 1"},
        Mistake{"half_a_frame", title + "[run]\nframes = 1.5\n" + box + "mass = 1\n", "3:10",
                "must be a whole number"},
        Mistake{"huge", title + "[run]\nframes = 3000000000\n" + box + "mass = 1\n", "3:10", "below 2^31"},
        Mistake{"negative_dt", title + "[run]\ndt = -0.01\n" + box + "mass = 1\n", "3:6",
                "'dt' is -0.01; it must be above 0"},
        Mistake{"infinite_dt", title + "[run]\ndt = inf\n" + box + "mass = 1\n", "3:6", "must be finite"},
        Mistake{"erp_above_one", title + "erp = 1.5\n" + box + "mass = 1\n", "2:7", "must lie in [0, 1]"},
        Mistake{"one_bracket", title + "[actor]\nname = \"b\"\n", "2:1", "write [[actor]]"},
        Mistake{"nan_mass", title + box + "mass = nan\n", "6:8", "'mass' is nan; it must be finite"},
        Mistake{"zero_mass", title + box + "mass = 0\n", "6:8", "'mass' is 0; it must be above 0"},
        Mistake{"negative_mass", title + box + "mass = -2\n", "6:8", "actor 'b': 'mass' is -2"},
        Mistake{"no_mass", title + box, "2:1", "either 'mass' [kg] or 'density'"},
        Mistake{"mass_and_density", title + box + "mass = 1\ndensity = 600\n", "7:11", "either 'mass'"},
        Mistake{"text_mass", title + box + "mass = \"heavy\"\n", "6:8", "must be a number"},
        Mistake{"negative_size",
                title + "[[actor]]\nname = \"b\"\ntype = \"box\"\nsize = [1, -1, 1]\nmass = 1\n", "5:12",
                "must be above 0"},
        Mistake{"same_name", title + box + "mass = 1\n" + box + "mass = 1\n", "8:8",
                "a second actor of this name"},
        Mistake{"unknown_type", title + "[[actor]]\nname = \"b\"\ntype = \"humen\"\n", "4:8",
                "unknown type 'humen'; did you mean 'human'?"},
        Mistake{"unknown_space",
                title + "spaces = [\"left\", \"right\"]\n" + box + "mass = 1\nspace = \"rigth\"\n", "8:9",
                "unknown space 'rigth'; did you mean 'right'"},
        Mistake{"inter_space", title + "inter_space = \"some\"\n" + box + "mass = 1\n", "2:15",
                "'inter_space' must be \"any\" or \"none\""},
        Mistake{"same_space", title + "spaces = [\"a\", \"a\"]\n" + box + "mass = 1\n", "2:10",
                "names one space twice"},
        Mistake{"bouncy", title + box + "mass = 1\nmaterial = { restitution = 1.5 }\n", "7:28",
                "lie in [0, 1]"},
        Mistake{"bad_material_key", title + box + "mass = 1\nmaterial = { nu = 1.5 }\n", "7:14",
                "unknown key 'nu'; did you mean 'mu'?"},
        Mistake{"zero_copies", title + box + "mass = 1\ncopies = 0\nspacing = [1, 0, 0]\n", "7:10",
                "at least 1"},
        Mistake{"copies_without_spacing", title + box + "mass = 1\ncopies = 2\n", "2:1",
                "'spacing' is missing"},
        Mistake{"unknown_base", title + "base = \"CrashS\"\n", "2:8", "did you mean 'CrashSk'"},
        Mistake{"base_by_path", title + "base = \"other.toml\"\n", "2:8",
                "must name a scene that pbmpi brings"}),
    [](const auto& test) { return test.param.name; });

TEST(Scene, tells_the_actor_of_a_name_clash_that_only_the_built_world_shows) {
  const std::string message =
      error_of(title + box + "mass = 1\ncopies = 2\nspacing = [2, 0, 0]\n" +
               "[[actor]]\nname = \"b.2\"\ntype = \"sphere\"\nradius = 1\nmass = 1\n");
  EXPECT_EQ(message.find("test.toml:9:1: world 0: body 'b.2' exists twice"), 0u) << message;
}

}  // namespace
}  // namespace pbmpi::scenes
