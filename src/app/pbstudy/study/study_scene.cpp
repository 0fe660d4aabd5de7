#include "app/pbstudy/study/study_scene.h"

namespace pbmpi::app {

StudyScene study_scene(const scenes::SceneSource& source, const SceneOverrides& overrides) {
  const auto scene = scenes::parse_scene(source);
  const scenes::RunDefaults& defaults = scene->defaults();
  StudyScene study;
  study.source = source;
  study.num_worlds = overrides.replicas.value_or(defaults.replicas);
  study.warmup = overrides.warmup.value_or(defaults.warmup);
  study.frames = overrides.frames.value_or(defaults.frames);
  study.dt_s = defaults.dt_s;
  study.frame_s = defaults.steps_per_frame * defaults.dt_s;
  study.iterations = defaults.iterations;
  study.effects = defaults.effects;
  study.notes = scene->notes();
  return study;
}

std::vector<std::string> study_scene_names(const std::vector<std::string>& given) {
  if (!given.empty() && given != std::vector<std::string>{"all"}) return given;
  std::vector<std::string> names;
  for (const scenes::SceneInfo& scene : scenes::list_scenes(scenes::SceneGroup::paper))
    names.push_back(scene.name);
  return names;
}

}  // namespace pbmpi::app
