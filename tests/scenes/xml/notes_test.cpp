#include "scenes/xml/notes.h"

#include <gtest/gtest.h>

namespace pbmpi::scenes::xml {
namespace {

TEST(Notes, tell_what_is_equal_once) {
  Notes notes;
  notes.add("f:1:1", "left out");
  notes.add("f:2:1", "changed");
  notes.add("f:3:1", "left out");
  notes.add("f:4:1", "left out");
  EXPECT_EQ(notes.lines(), (std::vector<std::string>{"f:1:1: left out (and 2 more)", "f:2:1: changed"}));
}

}  // namespace
}  // namespace pbmpi::scenes::xml
