/// The words by which the steppers' enumerations appear in options and HDF5 files.
#pragma once

#include <array>
#include <string_view>

#include "model/names.h"
#include "stepping/stepper.h"

namespace pbmpi::stepping {

inline constexpr std::array<std::string_view, 5> stepper_kind_names = {"quick", "direct", "sor", "bullet",
                                                                       "mujoco"};
inline constexpr std::array<std::string_view, 2> precision_names = {"double", "single"};
inline constexpr std::array<std::string_view, 5> simd_names = {"auto", "sse2", "avx2", "avx512", "off"};
inline constexpr std::array<std::string_view, 3> law_names = {"soft", "ode", "coulomb"};
inline constexpr std::array<std::string_view, 2> row_order_names = {"shuffled", "fixed"};

constexpr std::string_view name_of(StepperKind kind) { return stepper_kind_names[static_cast<int>(kind)]; }
constexpr std::string_view name_of(Precision precision) {
  return precision_names[static_cast<int>(precision)];
}
constexpr std::string_view name_of(Simd simd) { return simd_names[static_cast<int>(simd)]; }
constexpr std::string_view name_of(Law law) { return law_names[static_cast<int>(law)]; }
constexpr std::string_view name_of(RowOrder order) { return row_order_names[static_cast<int>(order)]; }

}  // namespace pbmpi::stepping
