#include "scenes/parameter_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "core/error.h"
#include "helpers.h"

namespace pbmpi::scenes {
namespace {

std::string refusal(const std::string& file, const std::string& text) {
  try {
    const ParameterTable table(file, text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

const std::string csv =
    "car.speed,human1.position,world.at_rest,car.note\n"
    "12.5,\"[9, 0, 0]\",true,fast\n"
    ",,,\n"
    "3,,false,\"\"\"slow, or not\"\"\"\n";
const std::string toml =
    "[[world]]\ncar.speed = 12.5\nhuman1.position = [9, 0, 0]\nworld.at_rest = true\n\"car.note\" = "
    "\"fast\"\n"
    "[[world]]\n"
    "[[world]]\ncar = { speed = 3, note = \"slow, or not\" }\nworld.at_rest = false\n";

/// Brings a value into one form: a CSV cell is kept as it is, while toml++ writes arrays and texts in a form
/// of its own.
std::string in_one_form(std::string value) {
  for (const auto& [from, to] : {std::pair{"[ ", "["}, {" ]", "]"}, {"'", "\""}}) {
    for (std::size_t at; (at = value.find(from)) != std::string::npos;)
      value.replace(at, std::strlen(from), to);
  }
  return value;
}

TEST(ParameterTable, has_a_world_a_row_and_the_same_values_from_either_format) {
  const ParameterTable from_csv("p.csv", csv), from_toml("p.toml", toml);
  EXPECT_EQ(from_csv.keys(),
            (std::vector<std::string>{"car.speed", "human1.position", "world.at_rest", "car.note"}));
  ASSERT_EQ(from_csv.num_worlds(), 3);
  ASSERT_EQ(from_toml.num_worlds(), 3);
  EXPECT_TRUE(from_csv.of_world(1).empty());
  for (int world = 0; world < 3; ++world) {
    for (const Override& one : from_csv.of_world(world)) {
      const auto same = std::ranges::find(from_toml.of_world(world), one.key, &Override::key);
      ASSERT_NE(same, from_toml.of_world(world).end()) << one.key;
      EXPECT_EQ(in_one_form(one.value), in_one_form(same->value)) << one.key;
    }
    EXPECT_EQ(from_csv.of_world(world).size(), from_toml.of_world(world).size());
  }
  EXPECT_EQ(from_csv.values()[2], (std::vector<std::string>{"3", "", "false", "\"slow, or not\""}));
}

TEST(ParameterTable, keeps_every_bit_of_a_number) {
  const ParameterTable table("p.toml", "[[world]]\ncar.speed = 0.1234567890123456789\ncar.x = 1e-300\n");
  EXPECT_EQ(*number_in(table.of_world(0)[0].value), 0.1234567890123456789);
  EXPECT_EQ(*number_in(table.of_world(0)[1].value), 1e-300);
}

TEST(ParameterTable, tells_where_a_value_stands) {
  EXPECT_EQ(ParameterTable("p.csv", csv).of_world(2)[0].where, "p.csv:4:1: column 'car.speed'");
  EXPECT_EQ(ParameterTable("p.toml", toml).of_world(0)[0].where, "p.toml:2:13: 'car.speed'");
}

TEST(ParameterTable, makes_the_worlds_of_edited_scenes) {
  const auto scene = parse_scene(find_scene("CrashSk"));
  const ParameterTable table("p.csv", "car.speed,world.gravity\n12.5,\n,\"[0, 0, -1.62]\"\n");
  EXPECT_EQ(body(*scene->build(0, 1, table.of_world(0)), "car.chassis").velocity.x(), 12.5);
  EXPECT_EQ(scene->build(1, 1, table.of_world(1))->gravity.z(), -1.62);
}

TEST(ParameterTable, refuses_what_has_no_worlds_or_no_parameters) {
  EXPECT_EQ(refusal("p.csv", ""), "p.csv: the table has no worlds; give each of them a row");
  EXPECT_EQ(refusal("p.csv", "car.speed\n"), "p.csv: the table has no worlds; give each of them a row");
  EXPECT_EQ(refusal("p.toml", "[[world]]\n").find("p.toml: the table has no parameters"), 0u);
  EXPECT_EQ(refusal("p.toml", "[[worlds]]\n").find("p.toml:1:3: parameters: unknown key 'worlds'"), 0u)
      << refusal("p.toml", "[[worlds]]\n");
  EXPECT_EQ(refusal("p.csv", "a.b,a.b\n1,2\n").find("p.csv:1:5: a second column 'a.b'"), 0u);
  EXPECT_EQ(refusal("p.csv", "a.b,\n1,2\n").find("p.csv:1:5: a column has no name"), 0u);
  EXPECT_EQ(refusal("p.toml", "[[world]\n").find("p.toml:1:"), 0u);
}

TEST(ParameterTable, knows_numbers) {
  EXPECT_EQ(number_in("5"), 5.0);
  EXPECT_EQ(number_in("-1e3"), -1000.0);
  EXPECT_FALSE(number_in("true"));
  EXPECT_FALSE(number_in("\"5\""));
  EXPECT_FALSE(number_in("[5]"));
  EXPECT_FALSE(number_in(""));
}

}  // namespace
}  // namespace pbmpi::scenes
