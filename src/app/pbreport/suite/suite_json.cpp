#include "app/pbreport/suite/suite_json.h"

#include <nlohmann/json.hpp>

namespace pbmpi::app {
namespace {

using nlohmann::ordered_json;

ordered_json relative(double ours, double papers) {
  if (papers == 0) return ours == 0 ? ordered_json(0) : ordered_json(nullptr);
  return (ours - papers) / papers;
}

ordered_json counts(double max, double min, double mean, double stddev) {
  return {{"max", max}, {"min", min}, {"mean", mean}, {"stddev", stddev}};
}

ordered_json rate(const Rate& rate) {
  return {{"harmonic_mean_hz", rate.harmonic_mean_hz}, {"satisfied_fraction", rate.satisfied_fraction}};
}

}  // namespace

ordered_json to_json(const IslandSummary& s) {
  ordered_json json;
  json["scene"] = s.scene;
  json["islands"] = counts(s.islands.max, s.islands.min, s.islands.mean, s.islands.stddev);
  json["spaces"] = s.spaces;
  json["cross_space_contacts_per_step"] =
      s.has_profile ? ordered_json(s.cross_contacts) : ordered_json(nullptr);
  json["paper"] = nullptr;
  json["relative_difference"] = nullptr;
  if (const PaperRow* paper = paper_row(s.scene)) {
    json["paper"] =
        counts(paper->islands_max, paper->islands_min, paper->islands_mean, paper->islands_stddev);
    json["paper"]["spaces"] = paper->spaces;
    json["paper"]["traffic"] = paper->traffic;
    json["relative_difference"] = {{"max", relative(s.islands.max, paper->islands_max)},
                                   {"min", relative(s.islands.min, paper->islands_min)},
                                   {"mean", relative(s.islands.mean, paper->islands_mean)},
                                   {"stddev", relative(s.islands.stddev, paper->islands_stddev)}};
  }
  return json;
}

ordered_json to_json(const CoreSummary& s) {
  ordered_json json;
  json["scene"] = s.scene;
  json["cores"] = s.cores;
  json["cores_mean"] = s.cores_mean;
  json["tolerance"] = cores_tolerance;
  const PaperRow* paper = paper_row(s.scene);
  json["paper_cores"] = paper != nullptr ? ordered_json(paper->cores) : ordered_json(nullptr);
  json["longest_island_share"] = s.longest_share;
  json["serial"] = rate(s.serial);
  json["islands_parallel"] = rate(s.islands_parallel);
  json["spaces_parallel"] = rate(s.spaces_parallel);
  json["collide_share"] = {{"serial", s.collide_share_serial},
                           {"islands_parallel", s.collide_share_parallel}};
  return json;
}

}  // namespace pbmpi::app
