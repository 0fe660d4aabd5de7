#include "app/pbreport/calibrate/calibration.h"

#include <algorithm>

#include "app/pbreport/study/case_row.h"

namespace pbmpi::app {
namespace {

using analysis::TimedCase;
using analysis::TimedPart;

TimedPart part_named(const std::string& name) {
  const auto found = std::ranges::find(analysis::timed_part_names, name);
  core::require_input(found != analysis::timed_part_names.end(),
                      "a study of calibrate has a part '" + name +
                          "', which this pbreport does not know; use that "
                          "of the pbstudy which wrote it");
  return static_cast<TimedPart>(found - analysis::timed_part_names.begin());
}

double number_in(const io::TableFile& file, const std::string& name) {
  for (const io::Parameter& parameter : file.parameters) {
    if (parameter.name != name) continue;
    return parameter.type == io::Parameter::Type::integer ? static_cast<double>(parameter.integer)
                                                          : parameter.real;
  }
  throw core::InputError("a study of calibrate has no parameter '" + name + "'; measure it again");
}

/// Frames of several ranks are compared with a forecast, which is not made from them.
bool is_fitted(const TimedCase& one) { return one.part != TimedPart::frame || one.ranks == 1; }

}  // namespace

Calibration calibration_of(const io::TableFile& file) {
  Calibration calibration;
  const std::size_t num_cases = file.column<std::string>("cases", "part").size();
  for (std::size_t i = 0; i < num_cases; ++i) {
    const CaseRow row(file, i);
    const auto integer = [&](const char* name) { return file.column<std::int64_t>("cases", name)[i]; };
    calibration.cases.push_back({part_named(row.text("part")), integer("ranks"), integer("worlds"),
                                 integer("bodies"), integer("steps"), integer("bytes"), row.real("seconds")});
  }
  std::vector<TimedCase> fitted;
  std::ranges::copy_if(calibration.cases, std::back_inserter(fitted), is_fitted);
  calibration.costs = analysis::fit_costs(fitted);
  calibration.costs.base_bytes = number_in(file, "rank_bytes");
  calibration.costs.body_bytes = number_in(file, "body_bytes");
  return calibration;
}

std::vector<NamedCost> named_costs(const analysis::HarnessCosts& costs) {
  return {{"message_latency", "s", costs.link.latency_s},
          {"message_overhead", "s", costs.link.overhead_s},
          {"message_gap", "s", costs.link.gap_s},
          {"message_byte", "s", costs.link.byte_s},
          {"frame", "s", costs.frame_s},
          {"world_frame", "s", costs.world_frame_s},
          {"world_step", "s", costs.world_step_s},
          {"body_frame", "s", costs.body_frame_s},
          {"root_unpack_world", "s", costs.unpack_world_s},
          {"root_unpack_body", "s", costs.unpack_body_s},
          {"root_balance_world", "s", costs.balance_world_s},
          {"root_balance_rank", "s", costs.balance_rank_s},
          {"table_world", "s", costs.table_world_s},
          {"root_hash_world", "s", costs.hash_world_s},
          {"hash_body", "s", costs.hash_body_s},
          {"memory_rank", "B", costs.base_bytes},
          {"memory_body", "B", costs.body_bytes}};
}

}  // namespace pbmpi::app
