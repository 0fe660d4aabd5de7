#include "scenes/format/pair_reader.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::scenes {
namespace {

bool is_copy_of(const std::string& name, const std::string& of) {
  if (!name.starts_with(of + ".")) return false;
  return std::all_of(name.begin() + static_cast<std::ptrdiff_t>(of.size()) + 1, name.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// The actor of that name, or all its copies.
std::vector<int> find_actors(const model::Model& model, const std::string& name, const std::string& where) {
  std::vector<int> found;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.actors.size(); ++i) {
    const std::string& actor = model.actors[i].name;
    if (actor == name || is_copy_of(actor, name)) found.push_back(static_cast<int>(i));
    names.push_back(actor);
  }
  if (found.empty())
    throw core::InputError(where + ": pair: unknown actor " + core::in_quotes(name) +
                           core::suggestion(name, names));
  return found;
}

}  // namespace

PairPlan::PairPlan(TableReader& table) : where_(table.where("actors")) {
  const std::vector<std::string> actors = table.texts("actors");
  if (actors.size() != 2) table.fail("actors", "'actors' must name two actors");
  actors_ = {actors[0], actors[1]};
  material_.mu = table.number("mu", Sign::non_negative);
  material_.restitution = table.number("restitution", Sign::non_negative, 0.0);
  if (material_.restitution > 1)
    table.fail("restitution", "'restitution' must lie in [0, 1] (above 1, each bounce gains energy)");
  table.finish();
}

void PairPlan::put_into(model::Model& model) const {
  const auto actors_of = [](const model::PairMaterial& one) { return std::pair(one.actor_a, one.actor_b); };
  for (const int a : find_actors(model, actors_[0], where_)) {
    for (const int b : find_actors(model, actors_[1], where_)) {
      const model::PairMaterial pair = {std::min(a, b), std::max(a, b), material_};
      std::vector<model::PairMaterial>& all = model.pair_materials;
      const auto at = std::ranges::lower_bound(all, actors_of(pair), {}, actors_of);
      if (at != all.end() && actors_of(*at) == actors_of(pair)) {
        *at = pair;
      } else {
        all.insert(at, pair);
      }
    }
  }
}

}  // namespace pbmpi::scenes
