/// The part of a scene that all cases of a study share.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace pbmpi::app {

/// What all settings of a case share.
struct StudyScene {
  scenes::SceneSource source;
  int num_worlds = 1;
  int warmup = 3, frames = 5;      ///< frames
  double frame_s = 0.03;           ///< simulated length of a frame
  double dt_s = 0.01;              ///< the scene's step
  int iterations = 20;             ///< the scene's
  model::EffectChoices effects;    ///< the scene's
  std::vector<std::string> notes;  ///< from scenes::Scene

  const std::string& name() const { return source.name; }
  int total_frames() const { return warmup + frames; }
  int steps_per_frame() const {
    return static_cast<int>(std::round(frame_s / dt_s));
  }  ///< with the scene's step
};

/// A scene's model, as it is at the start.
struct SceneModel {
  std::string name;  ///< the scene's
  std::shared_ptr<const model::Model> model;
};

/// What the command line sets instead of the scene.
struct SceneOverrides {
  std::optional<int> replicas, frames, warmup;
};

StudyScene study_scene(const scenes::SceneSource& source, const SceneOverrides& overrides);

/// The names given with --scene; all scenes that pbmpi brings if none is given, or for the word "all".
std::vector<std::string> study_scene_names(const std::vector<std::string>& given);

}  // namespace pbmpi::app
