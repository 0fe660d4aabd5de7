#include "app/pbreport/diff/diff.h"

#include <fmt/core.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "app/common/json_text.h"
#include "app/pbreport/diff/diff_file.h"
#include "app/pbreport/diff/diff_options.h"
#include "app/pbreport/diff/diff_page.h"
#include "app/pbreport/diff/run_comparison.h"
#include "core/text.h"
#include "io/file/write_file.h"

namespace pbmpi::app {
namespace {

using analysis::error_columns;
using analysis::ErrorTable;
using analysis::NamedSummary;
using Json = nlohmann::ordered_json;

bool has_same_hash(const io::RunData& a, const io::RunData& b) {
  return core::value_in(a.attributes, "state_hash") == core::value_in(b.attributes, "state_hash");
}

/// Smallest and largest of one number over the floor runs.
struct Range {
  double low, high;
};
Range floor_of(const RunComparison& c, const NamedSummary& column, double analysis::ErrorSummary::*number) {
  Range range{c.floor.front().*column.summary.*number, 0};
  for (const ErrorTable& table : c.floor) {
    range.low = std::min(range.low, table.*column.summary.*number);
    range.high = std::max(range.high, table.*column.summary.*number);
  }
  return range;
}

Json summary_json(const analysis::ErrorSummary& s) {
  return {{"count", s.count}, {"rms", s.rms},     {"p99", s.p99},
          {"max", s.max},     {"bands", s.bands}, {"broken", s.broken}};
}

Json table_json(const ErrorTable& table) {
  Json json;
  for (const NamedSummary& column : error_columns) {
    json[std::string(column.name) + "_" + column.unit] = summary_json(table.*column.summary);
  }
  return json;
}

Json invariants_json(const RunInvariants& kept) {
  return {{"max_penetration_m", kept.max_penetration_m},
          {"max_joint_gap_m", kept.max_joint_gap_m},
          {"energy_first_j", kept.energy_first_j},
          {"energy_last_j", kept.energy_last_j},
          {"stretch", {{"max", kept.max_stretch}, {"bands", kept.stretch}}}};
}

Json constraints_json(const ConstraintErrors& errors) {
  Json json;
  for (const NamedConstraint& column : constraint_columns) {
    if (const analysis::ErrorSummary* summary = column.summary(errors))
      json[std::string(column.name) + "_" + column.unit] = summary_json(*summary);
  }
  json["passages"] = errors.passages;
  return json;
}

Json breaks_json(const std::vector<BrokenJoint>& broken) {
  Json json = Json::array();
  for (const BrokenJoint& one : broken) json.push_back({{"joint", one.joint}, {"step", one.step}});
  return json;
}

std::string to_json(const DiffOptions& options, const RunComparison& c, bool same_hash) {
  Json json;
  json["run"] = options.run;
  json["reference"] = options.reference;
  json["same_state_hash"] = same_hash;
  json["frames"] = c.num_frames;
  json["position_bands"] = analysis::position_band_names;
  json["orientation_bands"] = analysis::orientation_band_names;
  json["drift"] = table_json(c.drift);
  json["drift_by_frame"] = Json::array();
  for (const ErrorTable& table : c.drift_by_frame) json["drift_by_frame"].push_back(table_json(table));
  if (c.defect) json["estimate_defect"] = table_json(*c.defect);
  if (c.estimate_drift) json["estimate_drift"] = table_json(*c.estimate_drift);
  json["drift_by_actor"] = Json::array();
  for (const ActorErrors& actor : c.drift_by_actor) {
    Json one = {{"world", actor.actor.world}, {"actor", actor.actor.name}, {"kind", actor.actor.kind}};
    one.update(table_json(actor.drift));
    json["drift_by_actor"].push_back(std::move(one));
  }
  json["noise_floor"] = Json::array();
  for (const ErrorTable& table : c.floor) json["noise_floor"].push_back(table_json(table));
  json["invariants"] = {{"run", invariants_json(c.run)}, {"reference", invariants_json(c.reference)}};
  json["constraints"] = {{"run", constraints_json(c.run_constraints->all)},
                         {"reference", constraints_json(c.reference_constraints->all)}};
  json["joints_broken"] = {{"in_both", c.breaks.in_both},
                           {"in_run_only", breaks_json(c.breaks.in_run_only)},
                           {"in_reference_only", breaks_json(c.breaks.in_reference_only)},
                           {"unknown_in_run", c.breaks.unknown_in_run},
                           {"unknown_in_reference", c.breaks.unknown_in_reference}};
  return json_text(json, 2) + "\n";
}

template <class Counts, class Names>
std::string bands_text(const Counts& counts, const Names& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(counts[i]) + " " + std::string(names[i]);
  }
  return text;
}

std::string summary_text(const std::string& what, const char* name, const char* unit,
                         const analysis::ErrorSummary& s) {
  const bool is_position = std::string_view(unit) == "m";
  const std::string bands = is_position ? bands_text(s.bands, analysis::position_band_names)
                                        : bands_text(s.bands, analysis::orientation_band_names);
  const std::string broken = s.broken > 0 ? ", " + std::to_string(s.broken) + " broken" : "";
  return fmt::format("{} {:17} rms {:>10.4g}  p99 {:>10.4g}  max {:>10.4g} {:3}  ({})\n", what, name, s.rms,
                     s.p99, s.max, unit, bands + broken);
}

std::string errors_text(const std::string& what, const ErrorTable& table) {
  std::string text;
  for (const NamedSummary& column : error_columns)
    text += summary_text(what, column.name, column.unit, table.*column.summary);
  return text;
}

std::string constraints_text(const std::string& whose, const ConstraintErrors& errors) {
  std::string text;
  for (const NamedConstraint& column : constraint_columns) {
    if (const analysis::ErrorSummary* summary = column.summary(errors))
      text += summary_text("constraints of the " + whose + ":", column.name, column.unit, *summary);
  }
  if (errors.passages > 0)
    text += fmt::format("constraints of the {}: {} bodies went through something\n", whose, errors.passages);
  return text;
}

std::string floor_text(const RunComparison& c) {
  std::string text;
  for (const NamedSummary& column : error_columns) {
    const Range rms = floor_of(c, column, &analysis::ErrorSummary::rms);
    const Range max = floor_of(c, column, &analysis::ErrorSummary::max);
    const double found = (c.drift.*column.summary).rms;
    text += fmt::format(
        "noise_floor: {:11} rms {:.4g} to {:.4g}, max {:.4g} to {:.4g} {} over {} seeds: the drift is {}\n",
        column.name, rms.low, rms.high, max.low, max.high, column.unit, c.floor.size(),
        found > rms.high ? "above it" : "inside it and proves nothing");
  }
  return text;
}

std::string invariants_text(const char* whose, const RunInvariants& kept) {
  static constexpr std::array<std::string_view, 4> names = {"< 3 %", "3-20 %", "> 20 %", "inf/NaN"};
  return fmt::format(
      "{}: penetration {:.2f} mm, joint gap {:.2f} mm, energy {:.1f} J to {:.1f} J, stretch of human "
      "segments max {:.2f} % ({})\n",
      whose, 1e3 * kept.max_penetration_m, 1e3 * kept.max_joint_gap_m, kept.energy_first_j,
      kept.energy_last_j, 100 * kept.max_stretch, bands_text(kept.stretch, names));
}

std::string breaks_text(const char* where, const std::vector<BrokenJoint>& broken) {
  std::string text;
  for (const BrokenJoint& one : broken) {
    text += fmt::format("joints_broken: in the {} only: {} in step {}\n", where, one.joint, one.step);
  }
  return text;
}

/// Empty if no joint broke.
std::string breaks_text(const BreakComparison& breaks) {
  const std::size_t apart = breaks.in_run_only.size() + breaks.in_reference_only.size();
  std::string text;
  if (breaks.unknown_in_run + breaks.unknown_in_reference > 0) {
    text = fmt::format(
        "joints_broken: {} more in the run and {} in the reference, of which the files do not say "
        "which they are\n",
        breaks.unknown_in_run, breaks.unknown_in_reference);
  }
  if (breaks.in_both == 0 && apart == 0) return text;
  return fmt::format("joints_broken: {} in both, {} in one of the two\n", breaks.in_both, apart) + text +
         breaks_text("run", breaks.in_run_only) + breaks_text("reference", breaks.in_reference_only);
}

std::string to_text(const DiffOptions& options, const RunComparison& c, bool same_hash) {
  std::string text = fmt::format("run: {}\nreference: {}\nframes: {} measured\nstate_hash: {}\n", options.run,
                                 options.reference, c.num_frames, same_hash ? "equal" : "different");
  text += errors_text("drift:", c.drift);
  if (c.defect) text += errors_text("estimate_defect:", *c.defect);
  if (c.estimate_drift) text += errors_text("estimate_drift:", *c.estimate_drift);
  if (c.floor.empty()) {
    text += "noise_floor: unknown; name runs that differ from the reference in --solver-seed with --floor\n";
  } else {
    text += floor_text(c);
  }
  text += invariants_text("run", c.run) + invariants_text("reference", c.reference);
  text += constraints_text("run", c.run_constraints->all) +
          constraints_text("reference", c.reference_constraints->all);
  return text + breaks_text(c.breaks);
}

/// A floor run that is the reference itself would show a floor of zero.
void require_other_seed(const io::RunData& floor, const std::string& path, const io::RunData& reference) {
  core::require_input(!has_same_hash(floor, reference),
                      path +
                          ": it is the reference bit for bit and shows no noise; record it with another "
                          "--solver-seed");
}

}  // namespace

core::ExitCode run_diff(const std::vector<std::string>& args, std::ostream& out) {
  const DiffOptions options = parse_diff_options(args);
  if (options.help) {
    out << help_of(diff_manual());
    return core::ExitCode::done;
  }
  std::optional<io::OutputLock> output;  // an unwritable path is reported before the work
  if (options.output) output = io::output_target(*options.output, diff_filetype, io::table_bytes).take_lock();
  const io::RunData run = io::read_run(options.run);
  const io::RunData reference = io::read_run(options.reference);
  require_comparable(run, options.run, reference, options.reference);
  std::vector<io::RunData> floor;
  for (const std::string& path : options.floor) {
    floor.push_back(io::read_run(path));
    require_comparable(floor.back(), path, reference, options.reference);
    require_other_seed(floor.back(), path, reference);
  }
  const RunModels models = rebuild_models(reference, options.reference);
  RunComparison comparison = compare_runs(models, run, reference, floor);
  comparison.run_constraints = constraint_errors(models, run, options.run, comparison.rows);
  comparison.reference_constraints = constraint_errors(models, reference, options.reference, comparison.rows);
  if (output) {
    const io::TableFile file = diff_file(comparison, options.run, options.reference);
    io::replace_file(*output, io::table_image(diff_filetype, io::study_version, file));
  }
  if (options.html)
    write_diff_page(*options.html, comparison, {options.run, run.attributes},
                    {options.reference, reference.attributes});
  const bool same_hash = has_same_hash(run, reference);
  out << (options.json ? to_json(options, comparison, same_hash) : to_text(options, comparison, same_hash))
      << std::flush;
  if (!out) throw core::RunError("the comparison cannot be written to standard output; is the disk full?");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
