/// A scene: the recipe from which worlds are built, read from a TOML file, or from a model in MJCF or URDF.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/model.h"
#include "scenes/overrides.h"
#include "stability/cases/hard_case.h"

namespace pbmpi::scenes {

/// What a scene file proposes for a run; the command line overrides each value.
struct RunDefaults {
  int replicas = 1;
  int warmup = 3;
  int frames = 5;
  int steps_per_frame = 3;
  double dt_s = 0.01;
  int iterations = 20;
  model::EffectChoices effects;  ///< merged one effect at a time
};

/// Immutable once loaded. A world depends on (scene, world id, seed, overrides) only, so each rank builds
/// just its own worlds.
class Scene {
 public:
  virtual ~Scene() = default;
  virtual const std::string& name() const = 0;   ///< e.g. "100CrSk"; names the output file
  virtual const std::string& title() const = 0;  ///< one line for --list-scenes
  virtual const std::string& text() const = 0;   ///< the scene file's TOML or XML
  virtual const RunDefaults& defaults() const = 0;
  /// Parts of model files that are interpreted differently or left out: "file:line:column: ...".
  virtual const std::vector<std::string>& notes() const = 0;
  /// The file's [case], if it has one.
  virtual const std::optional<stability::HardCase>& hard_case() const = 0;
  /// The validated model of world `world`, as if the scene's file contained `overrides`. Throws
  /// core::InputError with file:line:column, or with the place of the override.
  virtual std::shared_ptr<const model::Model> build(int world, std::uint64_t seed,
                                                    const Overrides& overrides = {}) const = 0;
  /// Are all worlds without overrides the same for any seed, so that they may share a model?
  virtual bool is_uniform() const { return false; }
};

struct SceneInfo {
  std::string name;
  std::string title;
};

/// The group of a scene that comes with pbmpi.
enum class SceneGroup {
  paper,    ///< the nine scenes of PhysicsBench, in the order of the paper's Table 1
  effects,  ///< scenes for the effects that none of the nine needs; in alphabetical order
  exact,    ///< motions known in closed form, "exact/NAME", in alphabetical order
  hard,     ///< hard cases, "hard/GROUP/NAME", in alphabetical order
};

std::vector<SceneInfo> list_scenes(SceneGroup group);

/// The text of scene `name_or_path`: a path if it ends in ".toml", ".xml", ".mjcf" or ".urdf", else a scene
/// that comes with pbmpi (these texts are embedded in the program, so it needs no data folder). If the scene
/// names model files, their texts follow as [files]. Throws core::InputError for an unknown name (with the
/// nearest names) or an unreadable file.
struct SceneSource {
  std::string name;  ///< scene name; for a file, its stem
  std::string file;  ///< its name in error messages
  std::string text;
};
SceneSource find_scene(const std::string& name_or_path);

/// The scenes on which this one is based: its `base`, the base's own base, and so on; none without a base.
/// Throws core::InputError as parse_scene() does.
std::vector<SceneSource> bases_of(const SceneSource& source);

/// Parses a scene: TOML, or, if the text begins with '<', a model that becomes the scene's only actor. Throws
/// core::InputError ("file:line:column: ...") for malformed files, unknown keys and impossible values. Rank 0
/// finds and reads the text, and every rank parses the same text. `dt_s` replaces the file's own time step:
/// programmes given in seconds (steering) are converted to steps with it. `effects` take precedence over
/// those of the file's `[effects]`.
std::unique_ptr<Scene> parse_scene(const SceneSource& source, std::optional<double> dt_s = std::nullopt,
                                   const model::EffectChoices& effects = {});

}  // namespace pbmpi::scenes
