#include "app/pbmpi/describe.h"

#include <malloc.h>

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

#include "app/common/step_arguments.h"
#include "app/pbmpi/options/run_options.h"
#include "app/pbmpi/run_parameters.h"
#include "effects/effect_choices.h"
#include "effects/run_plan.h"
#include "engines/optional_engines.h"
#include "engines/stepper_factory.h"
#include "io/run/run_file.h"
#include "model/names.h"
#include "mpi/balance/partition.h"
#include "mpi/spaces/plan/initial_owners.h"
#include "mpi/spaces/plan/rank_groups.h"
#include "mpi/spaces/plan/space_ownership.h"
#include "stepping/frame.h"
#include "stepping/names.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::app {
namespace {

/// Counts over all worlds.
struct Census {
  stepping::WorldTable table;
  std::size_t geoms = 0, joints = 0, events = 0, spaces = 0;
  std::map<std::string, int> actor_kinds;
  effects::RunPlan plan;
};

/// Says so where the stepper skips the pass.
std::string idle_note(const effects::RunPass& pass, stepping::StepperKind stepper) {
  if (pass.effect->name != "field_of_interest" || traits_of(stepper).has_field) return "";
  return "; idle, since " + std::string(name_of(stepper)) +
         (traits_of(stepper).iterates ? " solves all islands alike" : " solves without iterations");
}

Census take_census(const Work& work) {
  Census census;
  for (int world = 0; world < work.spec.num_worlds; ++world) {
    const auto model = build_world(work, world);
    census.table.body_offset.push_back(census.table.num_bodies() + model->num_bodies());
    census.geoms += model->geoms.size();
    census.joints += model->joints.size();
    census.events += model->events.size();
    census.spaces = std::max(census.spaces, model->spaces.size());
    for (const model::Actor& actor : model->actors) ++census.actor_kinds[std::string(name_of(actor.kind))];
    census.plan.add(*model);
  }
  return census;
}

std::string in_units(double bytes) {
  static constexpr const char* units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  int unit = 0;
  while (bytes >= 1024 && unit < 4) {
    bytes /= 1024;
    ++unit;
  }
  std::ostringstream text;
  text << std::fixed << std::setprecision(unit == 0 ? 0 : 1) << bytes << ' ' << units[unit];
  return text.str();
}

/// Heap bytes of the first world in its stepper, including the model, which is built anew for this.
std::size_t measure_world_bytes(const Work& work) {
  const auto stepper = engines::make_stepper(work.spec.stepper);
  const std::size_t before = mallinfo2().uordblks;
  auto model = build_anew(work, 0);
  const model::State state = model::initial_state(*model);
  stepper->add(work.spec.first_world(), std::move(model), state, 0);
  return mallinfo2().uordblks - before;
}

/// "0..49" or "7".
std::string range_text(int first, int last) {
  return first == last ? std::to_string(first) : std::to_string(first) + ".." + std::to_string(last);
}

/// `first_world`: its number in the ensemble.
void print_distribution(std::ostream& out, const Census& census, int first_world, int num_ranks,
                        double world_bytes) {
  const std::vector<int> placement = mpi::equal_placement(census.table.num_worlds(), num_ranks);
  for (int rank = 0; rank < num_ranks; ++rank) {
    const auto first = std::find(placement.begin(), placement.end(), rank);
    const auto count = std::count(placement.begin(), placement.end(), rank);
    if (count == 0) {
      out << "  rank " << rank << ": idle (more ranks than worlds)\n";
      continue;
    }
    const auto begin = static_cast<int>(first - placement.begin());
    const int last = begin + static_cast<int>(count) - 1;
    const auto bodies = census.table.body_offset[static_cast<std::size_t>(last) + 1] -
                        census.table.body_offset[static_cast<std::size_t>(begin)];
    out << "  rank " << rank << ": worlds " << range_text(first_world + begin, first_world + last) << " ("
        << count << " worlds, " << bodies << " bodies, about "
        << in_units(world_bytes * static_cast<double>(count)) << ")\n";
  }
}

/// A world's spaces over `num_ranks` ranks from `first_rank` on.
void print_spaces(std::ostream& out, const model::Model& model, int first_rank, int num_ranks) {
  const model::SpaceMap map = model::make_space_map(model);
  const mpi::SpaceOwnership ownership(map, mpi::initial_owners(model, map, num_ranks), num_ranks);
  for (int rank = 0; rank < num_ranks; ++rank) {
    const auto at = static_cast<std::size_t>(rank);
    out << "  rank " << first_rank + rank << ": ";
    if (ownership.bodies[at].empty()) {
      out << "idle (more ranks than spaces)\n";
      continue;
    }
    out << "spaces";
    for (const int space : ownership.spaces[at]) out << ' ' << model.spaces[static_cast<std::size_t>(space)];
    out << " (" << ownership.bodies[at].size() << " bodies)" << (rank == 0 ? ", and what crosses spaces" : "")
        << '\n';
  }
}

/// The worlds of each group, and the spaces of its ranks; spaces as in the first world.
void print_groups(std::ostream& out, const Work& work, int num_ranks) {
  const mpi::RankGroups& groups = work.spec.groups;
  const int first_world = work.spec.first_world();
  int rank = 0;
  for (int group = 0; group < groups.num_groups(); ++group) {
    const int ranks = groups.ranks[static_cast<std::size_t>(group)];
    const int worlds = groups.worlds[static_cast<std::size_t>(group)];
    const int first = first_world + groups.first_world(group);
    if (work.spec.num_worlds > 1) {
      out << "  group " << group << ": worlds " << range_text(first, first + worlds - 1) << " (" << worlds
          << " worlds), one after the other, each over ranks " << range_text(rank, rank + ranks - 1) << '\n';
    }
    print_spaces(out, *work.first_world, rank, ranks);
    rank += ranks;
  }
  for (; rank < num_ranks; ++rank)
    out << "  rank " << rank << ": idle (more ranks than groups have use for)\n";
}

/// Which worlds of an ensemble the run has, and what they change in the scene.
std::string ensemble_lines(const Work& work) {
  std::string text;
  if (work.spec.range)
    text += "ensemble: worlds " + range_text(work.spec.range->first, work.spec.range->end - 1) + " of " +
            std::to_string(work.spec.replicas) + "\n";
  if (work.parameters) {
    text += "parameters: " + work.parameters->file() + ", a world a row:";
    for (const std::string& key : work.parameters->keys()) text += " " + key;
    text += "\n";
  }
  return text;
}

/// The scene, the stepper, and the options that are not as by default, as a command line gives them.
std::string options_line(const Work& work) {
  const RunSpec& spec = work.spec;
  RunSpec usual;
  std::string text = "options:";
  for (const RunOption& option : run_options()) {
    take_default(option, work.scene->defaults(), usual);
    const auto value = text_of(option, spec);
    if (!value || value == text_of(option, usual)) continue;
    text += " --" + std::string(option.name) + (value->empty() ? "" : " " + *value);
  }
  for (const stepping::StepOption& option : stepping::step_options()) {
    const bool is_usual = option.name != "stepper" && is_default(option, spec.stepper);
    if (fits(option, spec.stepper.kind) && !is_usual)
      text += " --" + std::string(option.name) + " " + given_text(option, spec.stepper);
  }
  if (spec.estimate) text += " --feec='" + estimate_text(*spec.estimate) + "'";
  return text + "\n";
}

void print_plan(std::ostream& out, const effects::RunPlan& plan, stepping::StepperKind stepper) {
  out << "step plan:\n";
  for (const effects::RunPass& pass : plan.passes()) {
    out << "  " << std::left << std::setw(18) << pass.effect->name << std::setw(10)
        << core::phase_names[static_cast<std::size_t>(pass.effect->phase)] << pass.effect->meaning << ": "
        << pass.reason << idle_note(pass, stepper) << '\n';
  }
}

}  // namespace

std::string describe(const Work& work, int num_ranks) {
  const scenes::Scene& scene = *work.scene;
  const RunSpec& spec = work.spec;
  const Census census = take_census(work);
  const auto world_bytes = static_cast<double>(measure_world_bytes(work));
  std::ostringstream out;
  out << "scene: " << scene.name() << " - " << scene.title() << '\n'
      << "worlds: " << census.table.num_worlds() << ", bodies: " << census.table.num_bodies()
      << ", geoms: " << census.geoms << ", joints: " << census.joints << ", events: " << census.events
      << ", spaces: " << census.spaces << '\n'
      << "actors:";
  for (const auto& [kind, count] : census.actor_kinds) out << ' ' << count << ' ' << kind;
  out << '\n' << ensemble_lines(work);
  out << "frames: " << spec.warmup << " warm-up + " << spec.frames << " measured, " << spec.steps_per_frame
      << " steps of " << spec.stepper.dt_s << " s\n"
      << "stepper: " << setting_text(spec.stepper) << ", seed " << spec.stepper.seed << '\n'
      << options_line(work);
  if (spec.estimate) {
    const stepping::StepperSettings& stepper = *spec.estimate;
    out << "estimate: " << name_of(stepper.kind) << ", " << stepper.iterations << " iteration"
        << (stepper.iterations == 1 ? "" : "s") << ", " << name_of(stepper.precision) << " precision\n";
  }
  for (const std::string& note : scene.notes()) out << "note: " << note << '\n';
  if (!spec.effects.empty()) out << "effects chosen: " << effects::to_text(spec.effects) << '\n';
  print_plan(out, census.plan, spec.stepper.kind);
  for (const std::string& line : engines::inexpressible(spec.stepper.kind, *work.first_world))
    out << name_of(spec.stepper.kind) << ": " << line << '\n';
  const bool spaces = spec.decomposition == Decomposition::spaces;
  out << "decomposition: " << (spaces ? "spaces" : "worlds") << " over " << num_ranks
      << (num_ranks == 1 ? " rank" : " ranks");
  if (spec.stepper.threads > 1) out << " of " << spec.stepper.threads << " threads";
  if (spaces && spec.num_worlds > 1) out << ", " << in_words(spec.groups);
  out << '\n';
  if (spaces) {
    print_groups(out, work, num_ranks);
  } else {
    print_distribution(out, census, spec.first_world(), num_ranks, world_bytes);
  }
  out << "memory: about " << in_units(world_bytes) << " a world (measured on world 0)\n";
  if (spec.output) {
    const std::int64_t bytes =
        io::estimate_file_bytes({.num_bodies = census.table.num_bodies(),
                                 .num_worlds = spec.num_worlds,
                                 .num_ranks = num_ranks,
                                 .num_frames = spec.frames_to_do(),
                                 .record_every = spec.record_every,
                                 .optional = optional_columns(work, census.plan),
                                 .num_geoms = static_cast<std::int64_t>(census.geoms),
                                 .num_joints = static_cast<std::int64_t>(census.joints)});
    out << "output: " << *spec.output << ", about " << in_units(static_cast<double>(bytes)) << '\n';
  } else {
    out << "output: none\n";
  }
  return out.str();
}

}  // namespace pbmpi::app
