#include "app/pbreport/run/run_models.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "analysis/invariants.h"
#include "core/error.h"
#include "core/text.h"
#include "scenes/parameter_table.h"

namespace pbmpi::app {
namespace {

std::string parameter(const io::RunData& run, const std::string& name, const std::string& path) {
  const auto found = run.parameters.find(name);
  core::require_input(found != run.parameters.end(),
                      path + ": /parameters has no '" + name + "'; was the file written by pbmpi?");
  return found->second;
}

bool same_start(const core::Pose& a, const core::Pose& b) {
  return a.position == b.position && a.orientation == b.orientation;
}

/// Why two runs do not have the same bodies; empty if they do.
std::string difference(const io::BodyTable& a, const io::BodyTable& b) {
  if (a.id.size() != b.id.size()) {
    return std::to_string(a.id.size()) + " bodies against " + std::to_string(b.id.size());
  }
  for (std::size_t i = 0; i < a.id.size(); ++i) {
    const std::string which =
        "body " + std::to_string(i) + " ('" + a.name[i] + "' of world " + std::to_string(a.world[i]) + ")";
    if (a.name[i] != b.name[i] || a.world[i] != b.world[i]) return which + " is '" + b.name[i] + "' there";
    if (a.mass_kg[i] != b.mass_kg[i]) return which + " has another mass there";
    if (!same_start(a.initial[i], b.initial[i])) return which + " starts elsewhere there";
  }
  return "";
}

}  // namespace

std::vector<std::shared_ptr<const model::Model>> build_worlds(const scenes::Scene& scene,
                                                              const io::RunData& run, std::uint64_t seed) {
  const std::string text = core::value_in(run.parameters, "parameters_text");
  std::optional<scenes::ParameterTable> parameters;
  if (!text.empty()) parameters.emplace(core::value_in(run.parameters, "parameters_file"), text);
  std::vector<std::shared_ptr<const model::Model>> worlds;
  for (const std::int64_t id : run.world_id) {
    const auto number = static_cast<int>(id);
    const bool has_row = parameters && number < parameters->num_worlds();
    worlds.push_back(scene.build(number, seed, has_row ? parameters->of_world(number) : scenes::Overrides()));
  }
  return worlds;
}

RunModels rebuild_models(const io::RunData& run, const std::string& path) {
  const std::string name = parameter(run, "scene", path);
  const double dt_s = std::strtod(parameter(run, "dt", path).c_str(), nullptr);
  const auto seed = std::strtoull(parameter(run, "seed", path).c_str(), nullptr, 10);
  const auto scene = scenes::parse_scene({name, name + ".toml", parameter(run, "scene_text", path)}, dt_s);
  RunModels models;
  std::size_t first = 0, first_joint = 0;
  models.worlds = build_worlds(*scene, run, seed);
  for (const auto& world : models.worlds) {
    models.first_body.push_back(first);
    models.first_joint.push_back(first_joint);
    first_joint += world->joints.size();
    for (const model::Body& body : world->bodies) {
      core::require_input(first < run.bodies.name.size() && run.bodies.name[first] == body.name,
                          path +
                              ": its scene text gives other bodies than it has recorded; use the pbmpi that "
                              "wrote it");
      ++first;
    }
  }
  return models;
}

analysis::PoseView RecordedPoses::world(const RunModels& models, std::size_t world) const {
  const auto count = static_cast<std::size_t>(models.worlds[world]->num_bodies());
  return {std::span(*position).subspan(models.first_body[world], count),
          std::span(*orientation).subspan(models.first_body[world], count),
          broken_in.empty()
              ? std::span<const std::int32_t>()
              : std::span(broken_in).subspan(models.first_joint[world], models.worlds[world]->joints.size())};
}

std::vector<std::int32_t> broken_at(const RunModels& models, const io::RunData& run, std::size_t row) {
  std::vector<std::int32_t> broken(models.first_joint.back() + models.worlds.back()->joints.size(),
                                   model::unbroken);
  const std::int64_t steps_done = run.recorded_step[row];
  const auto note = [&](std::size_t joint, std::int64_t step) {
    if (step >= 0 && step < steps_done && joint < broken.size())
      broken[joint] = static_cast<std::int32_t>(step);
  };
  if (run.broken_in.empty()) {  // before layout 1.5
    for (const stepping::RunEvent& event : run.events) {
      if (event.kind == stepping::event_kind::joint_broken && event.world >= 0 && event.joint >= 0)
        note(models.first_joint.at(static_cast<std::size_t>(event.world)) +
                 static_cast<std::size_t>(event.joint),
             event.step);
    }
  }
  for (std::size_t joint = 0; joint < run.broken_in.size(); ++joint) note(joint, run.broken_in[joint]);
  const bool any = std::ranges::any_of(broken, [](std::int32_t step) { return step != model::unbroken; });
  return any ? broken : std::vector<std::int32_t>();
}

std::vector<std::size_t> bodies_of_joints(const RunModels& models) {
  std::vector<std::size_t> bodies;
  for (std::size_t world = 0; world < models.worlds.size(); ++world) {
    for (const model::Joint& joint : models.worlds[world]->joints)
      bodies.push_back(models.first_body[world] + static_cast<std::size_t>(joint.body_a));
  }
  return bodies;
}

analysis::PoseErrors compare_recorded(const RunModels& models, const RecordedPoses& poses,
                                      const RecordedPoses& reference) {
  analysis::PoseErrors errors;
  for (std::size_t world = 0; world < models.worlds.size(); ++world) {
    analysis::PoseErrors of_world =
        analysis::compare(*models.worlds[world], poses.world(models, world), reference.world(models, world));
    for (std::size_t& joint : of_world.joints) joint += models.first_joint[world];
    errors.append(of_world);
  }
  return errors;
}

std::vector<double> recorded_stretch(const RunModels& models, const RecordedPoses& poses) {
  std::vector<double> all;
  for (std::size_t world = 0; world < models.worlds.size(); ++world) {
    const model::Model& model = *models.worlds[world];
    const auto stretch =
        analysis::segment_stretch(model, analysis::human_segments(model), poses.world(models, world));
    all.insert(all.end(), stretch.begin(), stretch.end());
  }
  return all;
}

std::vector<std::size_t> measured_rows(const io::RunData& run, std::size_t num_rows) {
  std::vector<std::size_t> rows;
  if (run.position.empty()) return rows;
  const std::size_t record_every = std::max<std::size_t>(run.frame_measured.size() / run.position.size(), 1);
  for (std::size_t row = 0; row < num_rows; ++row) {
    if (run.frame_measured[(row + 1) * record_every - 1]) rows.push_back(row);
  }
  return rows;
}

void require_comparable(const io::RunData& a, const std::string& path_a, const io::RunData& b,
                        const std::string& path_b) {
  const std::string reason = difference(a.bodies, b.bodies);
  core::require_input(reason.empty(), path_a + " and " + path_b + " do not describe the same bodies (" +
                                          reason + "); compare runs of one scene and one --seed");
  const std::size_t rows = std::min(a.recorded_time_s.size(), b.recorded_time_s.size());
  core::require_input(rows > 0, path_a + " and " + path_b + ": one of them has no recorded frame to compare");
  for (std::size_t row = 0; row < rows; ++row) {
    // Times are step x dt, so another dt rounds differently.
    if (std::abs(a.recorded_time_s[row] - b.recorded_time_s[row]) <= 1e-9) continue;
    throw core::InputError(
        path_a + " and " + path_b + ": row " + std::to_string(row) +
        " was recorded at another time; give both the same frame length and --record-every");
  }
}

}  // namespace pbmpi::app
