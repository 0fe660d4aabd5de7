#include "scenes/format/case_reader.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::scenes {
namespace {

stability::Limits read_limits(TableReader& table, const char* key) {
  const auto [right, broken] = table.pair(key);
  if (right < 0) table.fail(key, "a bound counts from 0 up; give [right, broken], both at least 0");
  if (right > broken) table.fail(key, "what is right lies beyond what is broken; swap the two");
  return {right, broken};
}

}  // namespace

CaseReader::CaseReader(TableReader& table) {
  table.set_what("case");
  case_.group = table.text("group");
  case_.row = table.integer("row", 1);
  case_.source = table.text("source");
  case_.oracle = table.text("oracle");
  case_.seconds = table.number("seconds", Sign::positive, case_.seconds);
  case_.settle_s = table.number("settle", Sign::non_negative, case_.settle_s);
  if (table.has("watch")) case_.watch = table.texts("watch");
  watch_where_ = table.where("watch");
  read_region(table);
  read_bounds(table);
  for (TableReader& expect : table.tables("expect")) read_expectation(expect);
  table.finish();
}

void CaseReader::read_region(TableReader& table) {
  auto region = table.table("region");
  if (!region) return;
  if (region->has("low")) case_.region.low = region->vector_or_infinity("low");
  if (region->has("high")) case_.region.high = region->vector_or_infinity("high");
  region->finish();
  if ((case_.region.low.array() >= case_.region.high.array()).any())
    table.fail("region", "nothing lies in the region; give 'low' below 'high' on each axis");
}

void CaseReader::read_bounds(TableReader& table) {
  auto bounds = table.table("bounds");
  if (!bounds) return;
  for (std::size_t i = 0; i < stability::num_metrics; ++i) {
    const std::string name(stability::metric_table[i].name);
    if (!bounds->has(name)) continue;
    case_.bounds.push_back({static_cast<stability::Metric>(i), read_limits(*bounds, name.c_str())});
  }
  bounds->finish();
}

void CaseReader::read_expectation(TableReader& table) {
  table.set_what("case, expect");
  stability::Expectation expectation;
  expectation.body = table.text("body");
  expectation.quantity =
      static_cast<stability::Quantity>(table.choice("quantity", stability::quantity_names));
  expectation.at_s = table.number("at", Sign::non_negative, case_.seconds);
  if (expectation.at_s > case_.seconds) table.fail("at", "the case has ended by then; raise its 'seconds'");
  expectation.value = table.number("value", Sign::any);
  expectation.off_by = read_limits(table, "within");
  expect_where_.push_back(table.where("body") + ": case, expect");
  table.finish();
  case_.expectations.push_back(std::move(expectation));
}

void CaseReader::require_bodies(GrowingModel& model) const {
  for (std::size_t i = 0; i < expect_where_.size(); ++i)
    model.named_body(case_.expectations[i].body, expect_where_[i]);
  for (const std::string& beginning : case_.watch) {
    core::require_input(model.has_body_beginning_with(beginning),
                        watch_where_ + ": case: no body's name begins with " + core::in_quotes(beginning) +
                            "; give a beginning that one has");
  }
}

}  // namespace pbmpi::scenes
