#include "app/pbreport/csv/item_choice.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::app {
namespace {

using io::ItemsOf;

std::vector<std::string> without_repeats(std::vector<std::string> names) {
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Removes from `chosen` the bodies whose name is not among `names`.
void choose(const std::vector<std::string>& names, const std::vector<std::string>& of_bodies,
            const std::string& option, std::vector<bool>& chosen) {
  if (names.empty()) return;
  chosen.resize(of_bodies.size(), true);
  for (const std::string& name : names) {
    core::require_input(std::ranges::find(of_bodies, name) != of_bodies.end(),
                        option + " " + name + ": the run has none of this name" +
                            core::suggestion(name, without_repeats(of_bodies)));
  }
  for (std::size_t i = 0; i < of_bodies.size(); ++i)
    chosen[i] = chosen[i] && std::ranges::find(names, of_bodies[i]) != names.end();
}

void require_items(const io::RunTable& table, const CsvOptions& options) {
  const bool has_bodies = table.items == ItemsOf::bodies || table.items == ItemsOf::contacts;
  core::require_input(has_bodies || (options.bodies.empty() && options.actors.empty()),
                      "--table " + table.name + ": its rows are not of bodies; leave out --body and --actor");
  const bool has_worlds = has_bodies || table.items == ItemsOf::worlds || table.items == ItemsOf::joints ||
                          table.rows == io::RowsOf::events;
  core::require_input(has_worlds || options.worlds.empty(),
                      "--table " + table.name + ": its rows are not of worlds; leave out --world");
  const FrameRange all;
  const bool chooses_frames = options.measured_only || options.frames.first != all.first ||
                              options.frames.last != all.last || options.frames.every != all.every;
  core::require_input(
      table.rows != io::RowsOf::run || !chooses_frames,
      "--table " + table.name + ": its rows are not of frames; leave out --frames and --measured");
}

}  // namespace

ItemChoice::ItemChoice(const io::RunTables& run, const io::RunTable& table, const CsvOptions& options)
    : items_(table.items), names_(&run.items()) {
  require_items(table, options);
  if (!options.worlds.empty()) world_.resize(static_cast<std::size_t>(names_->num_worlds));
  for (const int world : options.worlds) {
    core::require_input(world >= 0 && world < names_->num_worlds, "--world " + std::to_string(world) +
                                                                      ": the run has worlds 0 to " +
                                                                      std::to_string(names_->num_worlds - 1));
    world_[static_cast<std::size_t>(world)] = true;
  }
  choose(options.bodies, names_->body_name, "--body", body_);
  choose(options.actors, names_->actor, "--actor", body_);
}

bool ItemChoice::has_world(std::int64_t world) const {
  if (world_.empty()) return true;
  return world >= 0 && world < std::ssize(world_) && world_[static_cast<std::size_t>(world)];
}

bool ItemChoice::has_body(std::int64_t body) const {
  if (body_.empty()) return true;
  return body >= 0 && body < std::ssize(body_) && body_[static_cast<std::size_t>(body)];
}

bool ItemChoice::has_item(std::int64_t item) const {
  const auto i = static_cast<std::size_t>(item);
  switch (items_) {
    case ItemsOf::worlds:
      return has_world(item);
    case ItemsOf::bodies:
      return has_world(names_->body_world[i]) && has_body(item);
    case ItemsOf::joints:
      return has_world(names_->joint_world[i]);
    case ItemsOf::run:
    case ItemsOf::ranks:
    case ItemsOf::contacts:
      return true;
  }
  return true;
}

}  // namespace pbmpi::app
