#include "model/state_parts.h"

namespace pbmpi::model {

std::vector<double> body_rows(const State& state, std::span<const int> bodies,
                              std::span<const BodyColumn> columns) {
  std::vector<double> rows(width_of(columns) * bodies.size());
  double* to = rows.data();
  for (const int body : bodies) {
    for (const BodyColumn& column : columns) to = std::ranges::copy(column.of(state, body), to).out;
  }
  return rows;
}

void put_body_rows(std::span<const double> rows, std::span<const int> bodies, State& state,
                   std::span<const BodyColumn> columns) {
  const double* from = rows.data();
  for (const int body : bodies) {
    for (const BodyColumn& column : columns) {
      std::copy_n(from, column.width(), column.of(state, body).begin());
      from += column.width();
    }
  }
}

}  // namespace pbmpi::model
