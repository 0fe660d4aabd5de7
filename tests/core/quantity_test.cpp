#include "core/quantity.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace pbmpi::core {
namespace {

std::string refusal(const char* text, const Measure& measure) {
  try {
    read_quantity(text, "--option", measure);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Quantity, has_a_unit) {
  EXPECT_DOUBLE_EQ(read_quantity("3.33ms", "", frame_time), 3.33e-3);  // one rounding of the product
  EXPECT_DOUBLE_EQ(read_quantity("500us", "", frame_time), 5e-4);
  EXPECT_EQ(read_quantity("2s", "", frame_time), 2);
  EXPECT_EQ(read_quantity("30min", "", run_time), 1800);
  EXPECT_EQ(read_quantity("1h", "", run_time), 3600);
  EXPECT_DOUBLE_EQ(read_quantity("1cm", "", tolerance), 0.01);
}

TEST(Quantity, without_a_unit_is_in_si_where_that_is_plausible) {
  EXPECT_EQ(read_quantity("0.01", "", step_time), 0.01);
  EXPECT_EQ(read_quantity("3600", "", run_time), 3600);
  EXPECT_EQ(read_quantity("1e-4", "", tolerance), 1e-4);
  EXPECT_EQ(refusal("3.33", frame_time),
            "--option 3.33: is that 3.33s? Write its unit, e.g. 3.33ms or 3.33s");
  EXPECT_EQ(refusal("0.01", tolerance), "--option 0.01: is that 0.01m? Write its unit, e.g. 0.1mm or 0.01m");
  EXPECT_EQ(refusal("1e-9", step_time), "--option 1e-9: is that 1e-9s? Write its unit, e.g. 10ms or 1e-9s");
  EXPECT_NE(refusal("0.0001", length_with_unit).find("is that 0.0001m?"), std::string::npos);
}

TEST(Quantity, that_is_none_is_refused_with_the_units_that_there_are) {
  for (const char* text : {"", "ms", "-1ms", "0ms", "0", "3.33 ms", "3mss", "nanms", "infms", "inf", "1km"}) {
    EXPECT_NE(refusal(text, frame_time)
                  .find("a finite number above 0 with a unit (us, ms, s, min, h), e.g. 3.33ms"),
              std::string::npos)
        << text;
  }
}

TEST(Quantity, may_be_nothing_where_that_makes_sense) {
  EXPECT_EQ(read_quantity("0", "", tolerance), 0);
  EXPECT_EQ(read_quantity("0mm", "", tolerance), 0);
  EXPECT_NE(refusal("-1", tolerance).find("above 0, or 0, with a unit (mm, cm, m)"), std::string::npos);
}

TEST(Quantity, as_text_is_read_back_bit_for_bit) {
  for (const double value : {0.01, 1e-9, 1.0 / 3, 7.0}) {
    EXPECT_EQ(read_quantity(quantity_text(value, step_time), "", step_time), value);
    EXPECT_EQ(read_quantity(quantity_text(value, tolerance), "", tolerance), value);
  }
  EXPECT_EQ(quantity_text(0.01, step_time), "0.01");
  EXPECT_EQ(quantity_text(0.01, tolerance), "0.01m");
  EXPECT_EQ(quantity_text(0, tolerance), "0");
}

TEST(Quantity, bounds_what_a_solver_can_carry) {
  EXPECT_EQ(bound_against(-1e30, false), "");
  EXPECT_EQ(bound_against(0, false), "");
  EXPECT_EQ(bound_against(1e-30, true), "");
  EXPECT_TRUE(bound_against(-1e31, false).starts_with("from -1e30 to 1e30"));
  EXPECT_TRUE(bound_against(1e-31, true).starts_with("at least 1e-30"));
}

}  // namespace
}  // namespace pbmpi::core
