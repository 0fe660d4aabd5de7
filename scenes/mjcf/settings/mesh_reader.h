/// MJCF's `<mesh>` and `<hfield>` in `<asset>`.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "scenes/meshes/model_meshes.h"
#include "scenes/mjcf/settings/defaults.h"
#include "scenes/xml/include.h"

namespace pbmpi::scenes::mjcf {

/// The files of meshes that a model's own assets name, as they are called in `texts`, which also have what it
/// includes. Attached models have theirs.
std::vector<std::string> mesh_files(const std::string& file, const xml::Texts& texts);

/// The meshes and height fields of one model, each read when a geom first asks for it.
class Meshes {
 public:
  /// `root`: `<mujoco>` with what it includes; `file`: its name. All is borrowed but the file's name.
  Meshes(const xml::Element& root, const std::string& file, const xml::Texts& texts, const Defaults& defaults,
         xml::Notes& notes);

  /// The mesh that the attribute 'mesh' of a geom names.
  const ModelMesh& of(xml::Attributes& geom);
  /// The surface of the height field that the attribute 'hfield' of a geom names.
  const geometry::PlacedMesh& height_field_of(xml::Attributes& geom);

 private:
  using Elements = std::map<std::string, const xml::Element*>;

  static const xml::Element& find(xml::Attributes& geom, const char* kind, const Elements& elements);
  const ModelMesh& read(const std::string& name, const xml::Element& element);

  std::string file_;
  const xml::Texts& texts_;
  const Defaults& defaults_;
  xml::Notes& notes_;
  std::string folder_;
  bool strips_path_ = false;
  Elements elements_, field_elements_;  ///< by name
  std::map<std::string, ModelMesh> read_;
  std::map<std::string, geometry::PlacedMesh> fields_;
};

}  // namespace pbmpi::scenes::mjcf
