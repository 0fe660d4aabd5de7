/// The one list of observables: from it follow the columns of a run's file, how they are read back, and how
/// worlds and ranks are joined. A new observable takes a member of Observables, a line here, and the code
/// that measures it.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <variant>

#include "stepping/observables.h"

namespace pbmpi::stepping {

/// How the numbers of several ranks (of one world) or of several worlds become one. A vector is joined
/// component by component. The join of no numbers is 0.
enum class Join { sum, max };

/// What an observable shows in a world in which all bodies sleep.
enum class Asleep { as_before, zero };

/// A column in a group of the file: a number (or a vector) for each world and frame.
template <class Owner>
struct ObservableColumn {
  using Member = std::variant<int Owner::*, double Owner::*, std::array<double, 3> Owner::*>;
  std::string_view name;
  std::string_view unit;  ///< empty for a count
  Member member;
  Join join;
  Asleep asleep;

  constexpr bool is_vector() const { return std::holds_alternative<std::array<double, 3> Owner::*>(member); }
};
using WorldColumn = ObservableColumn<Observables>;
using ResidualColumn = ObservableColumn<Residuals>;

/// Group /observables/world of the file. The members, and io/SCHEMA.md, say what each means.
inline constexpr auto world_observables = std::to_array<WorldColumn>({
    {"contacts", "", &Observables::contacts, Join::sum, Asleep::zero},
    {"rows", "", &Observables::rows, Join::sum, Asleep::zero},
    {"islands", "", &Observables::islands, Join::sum, Asleep::as_before},
    {"max_island_rows", "", &Observables::max_island_rows, Join::max, Asleep::zero},
    {"fast_bodies", "", &Observables::fast_bodies, Join::sum, Asleep::zero},
    {"row_visits", "", &Observables::row_visits, Join::sum, Asleep::zero},
    {"energy", "J", &Observables::energy_j, Join::sum, Asleep::as_before},
    {"max_penetration", "m", &Observables::max_penetration_m, Join::max, Asleep::zero},
    {"joint_gap", "m", &Observables::joint_gap_m, Join::max, Asleep::as_before},
    {"nonfinite", "", &Observables::nonfinite, Join::sum, Asleep::as_before},
    {"linear_momentum", "kg m s-1", &Observables::linear_momentum, Join::sum, Asleep::as_before},
    {"angular_momentum", "kg m2 s-1", &Observables::angular_momentum, Join::sum, Asleep::as_before},
});

/// Group /observables/interest, with the effect "field_of_interest".
inline constexpr auto interest_observables = std::to_array<WorldColumn>({
    {"bodies_inside", "", &Observables::bodies_inside, Join::sum, Asleep::zero},
});

/// Group /observables/residual, on request.
inline constexpr auto residual_observables = std::to_array<ResidualColumn>({
    {"joint_speed", "m s-1", &Residuals::joint_speed, Join::max, Asleep::as_before},
    {"joint_turn", "rad s-1", &Residuals::joint_turn, Join::max, Asleep::as_before},
    {"complementarity", "J", &Residuals::complementarity_j, Join::max, Asleep::as_before},
    {"natural_speed", "m s-1", &Residuals::natural_speed, Join::max, Asleep::as_before},
    {"natural_turn", "rad s-1", &Residuals::natural_turn, Join::max, Asleep::as_before},
});

/// Index of a member in world_observables, for callers that want a single observable; does not compile for a
/// member that is no column.
consteval std::size_t column_of(WorldColumn::Member member) {
  std::size_t column = 0;
  while (world_observables.at(column).member != member) ++column;
  return column;
}

/// Calls visit(member pointer) with the member's own type.
template <class Column, class Visit>
void with_member(const Column& column, Visit&& visit) {
  std::visit(visit, column.member);
}

/// The number in a column. It must not be a vector.
double number_of(const Observables& seen, const WorldColumn& column);

/// The name of the first column, of those of the residuals too, with a NaN or an infinity; empty if all
/// numbers are finite.
std::string_view first_not_finite(const Observables& seen);

/// Joins numbers of worlds or ranks.
double join(Join rule, std::span<const double> numbers);

/// Joins another rank's observables of the world into `all`. Residuals stay as they are.
void join(Observables& all, const Observables& part);

/// Sets the observables of a world in which all bodies have slept since the last measurement.
void observe_sleep(Observables& seen);

}  // namespace pbmpi::stepping
