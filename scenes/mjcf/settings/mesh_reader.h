/// MJCF's `<mesh>` in `<asset>`.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/meshes/model_meshes.h"
#include "scenes/mjcf/settings/defaults.h"
#include "scenes/xml/include.h"

namespace pbmpi::scenes::mjcf {

/// The files of meshes that a model's own assets name, as they are called in `texts`, which also have what it
/// includes. Attached models have theirs.
std::vector<std::string> mesh_files(const std::string& file, const xml::Texts& texts);

/// The meshes of one model, each read when a geom first asks for it.
class Meshes {
 public:
  /// `root`: `<mujoco>` with what it includes; `file`: its name. All is borrowed but the file's name.
  Meshes(const xml::Element& root, const std::string& file, const xml::Texts& texts, const Defaults& defaults,
         xml::Notes& notes);

  /// The mesh that the attribute 'mesh' of a geom names.
  const ModelMesh& of(xml::Attributes& geom);

 private:
  const ModelMesh& read(const std::string& name, const xml::Element& element);

  std::string file_;
  const xml::Texts& texts_;
  const Defaults& defaults_;
  xml::Notes& notes_;
  std::string folder_;
  bool strips_path_ = false;
  std::map<std::string, const xml::Element*> elements_;  ///< by name
  std::map<std::string, ModelMesh> read_;
};

}  // namespace pbmpi::scenes::mjcf
