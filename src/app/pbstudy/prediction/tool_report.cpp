#include "app/pbstudy/prediction/tool_report.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace pbmpi::app {
namespace {

using nlohmann::json;

PredictedFrame frame_from(const json& section, bool is_estimate) {
  PredictedFrame frame;
  frame.is_estimate = is_estimate ? 1 : 0;
  frame.instructions = section.at("instructions");
  frame.collision_instructions = section.at("collision_instructions");
  for (std::size_t i = 0; i < mix_classes.size(); ++i) frame.mix[i] = section.at("mix").at(mix_classes[i]);
  for (std::size_t i = 0; i < value_classes.size(); ++i) {
    const json& numbers = section.at("classes").at(value_classes[i]);
    frame.hits[i] = {numbers.at("executed"), numbers.at("repeated"), numbers.at("exact"),
                     numbers.at("fuzzy"),    numbers.at("wrong"),    numbers.at("error_sum"),
                     numbers.at("error_max")};
  }
  if (section.at("modelled").get<bool>()) {
    frame.micro_ops = section.at("micro_ops");
    frame.cycles = section.at("cycles").at("none");
    frame.predicted_cycles = section.at("cycles").at("predicted");
  }
  return frame;
}

void read_tool(const json& report, const PredictionCase& one, int case_index, PredictionOutcome& outcome) {
  std::array<int, 2> seen{};
  std::vector<VariantCycles> variants(one.has_variants ? model_variants().size() : 0);
  for (std::size_t i = 0; i < variants.size(); ++i)
    variants[i] = {case_index, static_cast<std::int32_t>(i), 0, 0};
  for (const json& section : report.at("sections")) {
    const bool is_estimate = section.at("section") == "estimate";
    PredictedFrame frame = frame_from(section, is_estimate);
    frame.case_index = case_index;
    frame.frame = seen[is_estimate ? 1 : 0]++;
    outcome.rows_of<PredictedFrame>().push_back(frame);
    for (std::size_t i = 0; i < variants.size() && frame.cycles >= 0; ++i) {
      const std::string suffix = i == 0 ? "" : std::to_string(i);
      variants[i].cycles += section.at("cycles").at("none" + suffix).get<std::int64_t>();
      variants[i].predicted_cycles += section.at("cycles").at("predicted" + suffix).get<std::int64_t>();
    }
  }
  outcome.result.num_frames = seen[0];
  outcome.rows_of<VariantCycles>() = variants;
}

}  // namespace

bool read_tool_report(const std::string& path, const PredictionCase& one, int case_index,
                      PredictionOutcome& outcome) {
  std::ifstream file(path);
  const json report = json::parse(file, nullptr, false);
  if (report.is_discarded()) return false;
  read_tool(report, one, case_index, outcome);
  return true;
}

}  // namespace pbmpi::app
