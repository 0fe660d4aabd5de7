#include "stepping/observable_table.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace pbmpi::stepping {
namespace {

template <class Number>
void join_into(Join rule, Number& all, const Number& part) {
  all = rule == Join::sum ? all + part : std::max(all, part);
}

void join_into(Join rule, std::array<double, 3>& all, const std::array<double, 3>& part) {
  for (std::size_t axis = 0; axis < all.size(); ++axis) join_into(rule, all[axis], part[axis]);
}

bool is_finite(double number) { return std::isfinite(number); }
bool is_finite(const std::array<double, 3>& vector) {
  return std::ranges::all_of(vector, [](double number) { return std::isfinite(number); });
}

/// Calls visit(column) for every column whose numbers stand in Observables itself.
template <class Visit>
void for_each_column(Visit visit) {
  for (const WorldColumn& column : world_observables) visit(column);
  for (const WorldColumn& column : interest_observables) visit(column);
}

}  // namespace

double number_of(const Observables& seen, const WorldColumn& column) {
  core::require_invariant(!column.is_vector(), "number_of: the column holds vectors");
  if (const auto* count = std::get_if<int Observables::*>(&column.member)) return seen.**count;
  return seen.*std::get<double Observables::*>(column.member);
}

std::string_view first_not_finite(const Observables& seen) {
  std::string_view found;
  const auto look = [&found](const auto& column, const auto& owner) {
    with_member(column, [&](auto member) {
      if (found.empty() && !is_finite(owner.*member)) found = column.name;
    });
  };
  for_each_column([&](const WorldColumn& column) { look(column, seen); });
  for (const ResidualColumn& column : residual_observables) look(column, seen.residuals);
  return found;
}

double join(Join rule, std::span<const double> numbers) {
  double all = 0;
  for (const double number : numbers) join_into(rule, all, number);
  return all;
}

void join(Observables& all, const Observables& part) {
  for_each_column([&](const WorldColumn& column) {
    with_member(column, [&](auto member) { join_into(column.join, all.*member, part.*member); });
  });
}

void observe_sleep(Observables& seen) {
  for_each_column([&](const WorldColumn& column) {
    if (column.asleep == Asleep::zero) with_member(column, [&](auto member) { seen.*member = {}; });
  });
}

}  // namespace pbmpi::stepping
