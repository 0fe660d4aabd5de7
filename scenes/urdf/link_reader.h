/// Reads URDF's `<link>` elements one by one.
#pragma once

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/include.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::urdf {

/// Where the meshes of a model are.
struct MeshTexts {
  const std::string& model;  ///< the name of its file
  const xml::Texts& texts;
};

/// The name in the texts of the mesh that a 'filename' means; empty for one outside of the model's folder.
std::string mesh_name(const std::string& filename, const std::string& model);

/// Reads mass and geoms; the caller adds the joints to other links.
links::Link read_link(const xml::Element& element, const MeshTexts& meshes, const xml::LeaveOut& leave_out);

}  // namespace pbmpi::scenes::urdf
