/// Outcomes of a study's cases: plain data, which ranks exchange, and which a journal keeps, as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// The outcome of one case: a result, and rows of other tables. The case's index is the member `index` of a
/// result, and `case_index` of a row.
template <class Result, class... Rows>
struct CaseOutcome {
  static_assert((std::is_trivially_copyable_v<Result> && ... && std::is_trivially_copyable_v<Rows>));
  Result result = {};
  std::tuple<std::vector<Rows>...> rows = {};

  /// Of the case, in the result and in all rows.
  void set_index(int index) {
    result.index = index;
    [[maybe_unused]] const auto set_all = [&](auto& its_rows) {
      for (auto& row : its_rows) row.case_index = index;
    };
    (set_all(std::get<std::vector<Rows>>(rows)), ...);
  }

  template <class Row>
  std::vector<Row>& rows_of() {
    return std::get<std::vector<Row>>(rows);
  }
};

/// The outcomes of all cases, in their order.
template <class Result, class... Rows>
struct CaseOutcomes {
  std::vector<Result> results;
  std::tuple<std::vector<Rows>...> rows;

  template <class Row>
  const std::vector<Row>& rows_of() const {
    return std::get<std::vector<Row>>(rows);
  }

  void append(const CaseOutcome<Result, Rows...>& outcome) {
    results.push_back(outcome.result);
    [[maybe_unused]] const auto append_rows = [](auto& all, const auto& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    (append_rows(std::get<std::vector<Rows>>(rows), std::get<std::vector<Rows>>(outcome.rows)), ...);
  }
};

/// The bytes of the result, then for each table the number of its rows and the rows.
template <class Result, class... Rows>
std::vector<std::byte> bytes_of(const CaseOutcome<Result, Rows...>& outcome) {
  std::vector<std::byte> bytes;
  const auto put = [&](const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
  };
  [[maybe_unused]] const auto put_rows = [&]<class Row>(const std::vector<Row>& rows) {
    const std::uint64_t count = rows.size();
    put(&count, sizeof count);
    put(rows.data(), count * sizeof(Row));
  };
  put(&outcome.result, sizeof outcome.result);
  (put_rows(std::get<std::vector<Rows>>(outcome.rows)), ...);
  return bytes;
}

/// Throws core::RunError for bytes that bytes_of() did not give.
template <class Result, class... Rows>
CaseOutcome<Result, Rows...> outcome_of(std::span<const std::byte> bytes) {
  const auto take = [&](void* data, std::size_t size) {
    if (bytes.size() < size) throw core::RunError("the outcome of a case is cut off");
    if (size > 0) std::memcpy(data, bytes.data(), size);
    bytes = bytes.subspan(size);
  };
  [[maybe_unused]] const auto take_rows = [&]<class Row>(std::vector<Row>& rows) {
    std::uint64_t count = 0;
    take(&count, sizeof count);
    if (count > bytes.size() / sizeof(Row)) throw core::RunError("the outcome of a case is cut off");
    rows.resize(count);
    take(rows.data(), count * sizeof(Row));
  };
  CaseOutcome<Result, Rows...> outcome;
  take(&outcome.result, sizeof outcome.result);
  (take_rows(std::get<std::vector<Rows>>(outcome.rows)), ...);
  if (!bytes.empty()) throw core::RunError("the outcome of a case has bytes too many");
  return outcome;
}

}  // namespace pbmpi::app
