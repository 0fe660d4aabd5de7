#include "app/pbreport/ensemble/ensemble_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/statistics.h"
#include "stepping/observable_table.h"

namespace pbmpi::app {
namespace {

using io::RunTables;
using io::TableColumn;

constexpr std::int64_t frames_at_once = 64;

double number(const TableColumn& column, std::size_t index) {
  if (const auto* real = std::get_if<std::vector<double>>(&column.values)) return (*real)[index];
  return static_cast<double>(std::get<std::vector<std::int64_t>>(column.values)[index]);
}

const io::RunTable& table_of(const RunTables& run, const char* name) {
  const io::RunTable* table = run.find(name);
  core::require_input(table != nullptr, run.path() + ": it has no " + name + "; was it written by pbmpi?");
  return *table;
}

/// One component of an observable.
struct Quantity {
  std::string name, unit;
  stepping::Join join;
  std::size_t component, width;
};

std::vector<Quantity> quantities() {
  constexpr std::array axes = {"_x", "_y", "_z"};
  std::vector<Quantity> all;
  for (const stepping::WorldColumn& column : stepping::world_observables) {
    const std::size_t width = column.is_vector() ? axes.size() : 1;
    for (std::size_t k = 0; k < width; ++k)
      all.push_back({std::string(column.name) + (width > 1 ? axes[k] : ""), std::string(column.unit),
                     column.join, k, width});
  }
  return all;
}

/// Rows of some frames of one run.
struct Piece {
  std::vector<TableColumn> observables;
  TableColumn wall;
  int num_worlds = 0;

  /// [num_worlds] values of a frame; empty if the file (of an older layout) lacks the column.
  std::vector<double> worlds(const Quantity& quantity, std::size_t frame) const {
    const std::string name =
        quantity.width > 1 ? quantity.name.substr(0, quantity.name.size() - 2) : quantity.name;
    const auto column = std::ranges::find(observables, name, &TableColumn::name);
    std::vector<double> values;
    for (std::size_t world = 0; column != observables.end() && world < static_cast<std::size_t>(num_worlds);
         ++world)
      values.push_back(number(
          *column,
          (frame * static_cast<std::size_t>(num_worlds) + world) * quantity.width + quantity.component));
    return values;
  }
};

Piece read_piece(const RunTables& run, std::int64_t first, std::int64_t count) {
  io::RunTable wall = table_of(run, "timings");
  wall.columns = {"/timings/frame/wall"};
  return {run.read(table_of(run, "observables"), first, count), run.read(wall, first, count).front(),
          run.items().num_worlds};
}

void add_samples(const Piece& piece, const Quantity& quantity, std::size_t frame, SampleOf over,
                 std::vector<double>& samples) {
  const std::vector<double> worlds = piece.worlds(quantity, frame);
  if (worlds.empty()) return;
  if (over == SampleOf::worlds) {
    samples.insert(samples.end(), worlds.begin(), worlds.end());
  } else {
    samples.push_back(stepping::join(quantity.join, worlds));
  }
}

/// Sums over the measured frames of one run.
class WorldSums {
 public:
  WorldSums(std::size_t run, const io::RunItems& items) : worlds_(items.world_id.size()) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t w = 0; w < worlds_.size(); ++w) {
      worlds_[w].run = run;
      worlds_[w].world = items.world_id[w];
      worlds_[w].collide_s = worlds_[w].solve_s = unknown;
    }
  }

  void add(const Piece& piece, std::size_t frame) {
    ++num_frames_;
    for (const Quantity& quantity : quantities()) {
      const std::vector<double> values = piece.worlds(quantity, frame);
      for (std::size_t w = 0; w < values.size(); ++w) add(quantity.name, values[w], worlds_[w]);
    }
  }
  void add_times(const std::vector<double>& collide_s, const std::vector<double>& solve_s) {
    for (std::size_t w = 0; w < worlds_.size(); ++w) {
      if (num_timed_ == 0) worlds_[w].collide_s = worlds_[w].solve_s = 0;
      worlds_[w].collide_s += collide_s[w];
      worlds_[w].solve_s += solve_s[w];
    }
    ++num_timed_;
  }

  std::vector<WorldFacts> means() const {
    std::vector<WorldFacts> all = worlds_;
    for (WorldFacts& world : all) {
      for (double* sum : {&world.contacts_mean, &world.rows_mean, &world.islands_mean})
        *sum /= std::max(num_frames_, 1.0);
      for (double* sum : {&world.collide_s, &world.solve_s}) *sum /= std::max(num_timed_, 1.0);
    }
    return all;
  }

 private:
  void add(const std::string& name, double value, WorldFacts& world) const {
    if (name == "contacts") {
      world.contacts_mean += value;
      world.contacts_max = std::max(world.contacts_max, value);
    } else if (name == "rows") {
      world.rows_mean += value;
      world.rows_max = std::max(world.rows_max, value);
    } else if (name == "islands") {
      world.islands_mean += value;
    } else if (name == "energy") {
      if (num_frames_ == 1) world.energy_first_j = value;
      world.energy_last_j = value;
    } else if (name == "max_penetration") {
      world.penetration_max_m = std::max(world.penetration_max_m, value);
    } else if (name == "joint_gap") {
      world.joint_gap_max_m = std::max(world.joint_gap_max_m, value);
    }
  }

  std::vector<WorldFacts> worlds_;
  double num_frames_ = 0, num_timed_ = 0;
};

/// Adds the seconds of a step by world, over the measured frames: with --record-islands only.
void add_step_times(const RunTables& run, std::int64_t num_frames, WorldSums& sums) {
  const io::RunTable *islands = run.find("islands"), *spaces = run.find("spaces");
  if (islands == nullptr || spaces == nullptr) return;
  io::RunTable solve = *islands, collide = *spaces;
  solve.columns = {"/timings/island/solve"};
  collide.columns = {"/timings/space/collide"};
  const std::vector<std::int64_t>& world_of = run.items().body_world;
  for (std::int64_t frame = 0; frame < num_frames; ++frame) {
    if (!run.frames()[static_cast<std::size_t>(frame)].is_measured) continue;
    const auto of_bodies = std::get<std::vector<double>>(run.read(solve, frame, 1).front().values);
    std::vector<double> solve_s(static_cast<std::size_t>(run.items().num_worlds));
    for (std::size_t body = 0; body < of_bodies.size(); ++body)
      solve_s.at(static_cast<std::size_t>(world_of[body])) += of_bodies[body];
    sums.add_times(std::get<std::vector<double>>(run.read(collide, frame, 1).front().values), solve_s);
  }
}

}  // namespace

std::vector<QuantitySpread> spread_by_frame(const EnsembleRuns& ensemble,
                                            const std::vector<double>& quantiles) {
  const std::vector<Quantity> all = quantities();
  std::vector<QuantitySpread> found;
  found.reserve(all.size() + 1);
  for (const Quantity& quantity : all) found.push_back({quantity.name, quantity.unit, {}});
  if (ensemble.over() == SampleOf::runs) found.push_back({"wall", "s", {}});
  for (std::int64_t first = 0; first < ensemble.num_frames(); first += frames_at_once) {
    const std::int64_t count = std::min(frames_at_once, ensemble.num_frames() - first);
    std::vector<Piece> pieces;
    for (const RunTables& run : ensemble.runs()) pieces.push_back(read_piece(run, first, count));
    for (std::size_t frame = 0; frame < static_cast<std::size_t>(count); ++frame) {
      for (std::size_t q = 0; q < found.size(); ++q) {
        std::vector<double> samples;
        for (const Piece& piece : pieces) {
          if (q < all.size()) {
            add_samples(piece, all[q], frame, ensemble.over(), samples);
          } else {
            samples.push_back(number(piece.wall, frame));
          }
        }
        found[q].by_frame.push_back(spread_of(samples, quantiles));
      }
    }
  }
  return found;
}

std::vector<WorldFacts> facts_of_worlds(const EnsembleRuns& ensemble) {
  std::vector<WorldFacts> worlds;
  for (std::size_t i = 0; i < ensemble.runs().size(); ++i) {
    const RunTables& run = ensemble.runs()[i];
    WorldSums sums(i, run.items());
    for (std::int64_t first = 0; first < ensemble.num_frames(); first += frames_at_once) {
      const std::int64_t count = std::min(frames_at_once, ensemble.num_frames() - first);
      const Piece piece = read_piece(run, first, count);
      for (std::int64_t frame = 0; frame < count; ++frame) {
        if (run.frames()[static_cast<std::size_t>(first + frame)].is_measured)
          sums.add(piece, static_cast<std::size_t>(frame));
      }
    }
    add_step_times(run, ensemble.num_frames(), sums);
    const auto means = sums.means();
    worlds.insert(worlds.end(), means.begin(), means.end());
  }
  return worlds;
}

}  // namespace pbmpi::app
