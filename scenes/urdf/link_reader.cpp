#include "scenes/urdf/link_reader.h"

#include <algorithm>
#include <filesystem>

#include "core/text.h"
#include "model/names.h"
#include "scenes/links/rigid.h"
#include "scenes/meshes/model_meshes.h"
#include "scenes/urdf/elements.h"
#include "scenes/xml/attributes.h"

namespace pbmpi::scenes::urdf {
namespace {

using model::Shape;
using xml::Attributes;
using xml::Element;
using xml::LeaveOut;
using xml::Range;

/// An inertia that no body has, if the user leaves it out: its moments become their mean, as with MuJoCo's
/// balanceinertia. Else it is kept: many files give one to small parts, such as sensors, that are fixed to
/// others.
model::Mat3 checked_inertia(const model::Mat3& read, const Element& element, const LeaveOut& leave_out,
                            std::string& odd) {
  if (is_of_a_body(read)) return read;
  if (leave_out.names("inertia")) {
    leave_out.notes().add(element.where, "an inertia that no body has: its three moments become their mean");
    return read.trace() / 3 * model::Mat3::Identity();
  }
  odd = element.where +
        ": inertia: no body has a moment of inertia above the sum of the other two; change one, or let all "
        "three be their mean: " +
        LeaveOut::advice("inertia");
  return read;
}

MassProperties read_inertial(const Element& element, const LeaveOut& leave_out, std::string& odd) {
  pass_over_unknown(element, {"origin", "mass", "inertia"}, leave_out);
  Attributes mass(need_child(element, "mass"), leave_out);
  const Element& moments = need_child(element, "inertia");
  Attributes inertia(moments, leave_out);
  const Pose pose = read_origin(element, leave_out);
  const double ixx = inertia.number("ixx"), iyy = inertia.number("iyy"), izz = inertia.number("izz");
  const double ixy = inertia.number("ixy", Range::any, 0.0), ixz = inertia.number("ixz", Range::any, 0.0),
               iyz = inertia.number("iyz", Range::any, 0.0);
  MassProperties read{mass.number("value", Range::non_negative), Vec3::Zero(), model::Mat3::Zero()};
  read.inertia << ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz;
  mass.finish(leave_out.notes());
  inertia.finish(leave_out.notes());
  if (read.mass_kg > 0) read.inertia = checked_inertia(read.inertia, moments, leave_out, odd);
  return links::moved(read, pose);
}

/// The convex hull of `<mesh filename scale>`.
links::LinkGeom read_mesh(const Element& element, const Pose& origin, const MeshTexts& meshes,
                          const LeaveOut& leave_out) {
  Attributes mesh(element, leave_out);
  const std::string given = mesh.text("filename");
  const std::string what = "mesh " + core::in_quotes(given);
  if (!is_mesh_file(given))
    xml::refuse_element(element, what + " is no STL or OBJ; convert it to one of them");
  const std::string file = mesh_name(given, meshes.model);
  if (file.empty())
    mesh.fail("filename", what + " is not in the folder of " + core::in_quotes(meshes.model) +
                              " or below it; move it there, or name it as package://");
  if (!meshes.texts.contains(file)) xml::refuse_element(element, what + " was not found; give its path");
  MeshPlacing placing;
  placing.scale = mesh.vector("scale", core::Vec3(core::Vec3::Ones()));
  if (!(placing.scale.cwiseAbs().minCoeff() > 0)) mesh.fail("scale", "'scale' must not be 0");
  mesh.finish(leave_out.notes());
  const std::string& text = text_of_mesh(meshes.texts, file, mesh.where("filename"));
  const ModelMesh placed = place_mesh(read_mesh_text(text, file), placing, element.where + ": " + what);
  if (!placed.note.empty()) leave_out.notes().add(element.where, what + ": " + placed.note);
  const Solid solid = solid_of(placed.found, origin);
  links::LinkGeom geom;
  geom.where = element.where;
  geom.shape = solid.shape;
  geom.size = solid.size;
  geom.pose = solid.pose;
  geom.hull = solid.hull;
  return geom;
}

std::optional<links::LinkGeom> read_collision(const Element& element, const MeshTexts& meshes,
                                              const LeaveOut& leave_out) {
  pass_over_unknown(element, {"origin", "geometry", "material", "verbose", "contact_coefficients", "surface"},
                    leave_out);
  const Element& geometry = need_child(element, "geometry");
  std::vector<std::string> shapes{"mesh"};
  for (const model::ShapeTraits& traits : model::shape_traits) {
    if (traits.num_sizes > 0 && !traits.has_points) shapes.emplace_back(traits.name);
  }
  pass_over_unknown(geometry, shapes, leave_out);
  const auto is_shape = [&](const Element& child) {
    return std::ranges::find(shapes, child.name) != shapes.end();
  };
  if (std::ranges::count_if(geometry.children, is_shape) != 1)
    Attributes(geometry).fail("it must hold one shape");
  const Element& shape = *std::ranges::find_if(geometry.children, is_shape);
  if (shape.name == "mesh") {
    if (leave_out.drops(shape.name, shape.where)) return std::nullopt;
    return read_mesh(shape, read_origin(element, leave_out), meshes, leave_out);
  }
  links::LinkGeom geom;
  geom.where = shape.where;
  geom.pose = read_origin(element, leave_out);
  Attributes size(shape, leave_out);
  geom.shape = *model::enum_from_name<Shape>(shape.name, model::shape_names);
  const model::ShapeTraits& traits = model::traits_of(geom.shape);
  if (traits.radius == model::no_size) {
    const core::Vec3 sides = size.vector("size");
    if (!(sides.minCoeff() > 0)) size.fail("size", "'size' must be above 0");
    geom.size = {sides.x(), sides.y(), sides.z()};
  } else {
    geom.size[static_cast<std::size_t>(traits.radius)] = size.number("radius", Range::positive);
    if (traits.length[2] != model::no_size)
      geom.size[static_cast<std::size_t>(traits.length[2])] = size.number("length", Range::positive);
  }
  size.finish(leave_out.notes());
  return geom;
}

}  // namespace

std::string mesh_name(const std::string& filename, const std::string& model) {
  namespace fs = std::filesystem;
  if (filename.starts_with("package://")) return filename;
  const fs::path name = fs::path(filename).lexically_normal();
  const bool leaves = name.empty() || name.is_absolute() || *name.begin() == ".." ||
                      filename.find("://") != std::string::npos;
  return leaves ? "" : (fs::path(model).parent_path() / name).string();
}

links::Link read_link(const Element& element, const MeshTexts& meshes, const LeaveOut& leave_out) {
  Attributes attributes(element, leave_out);
  links::Link link;
  link.name = attributes.text("name");
  link.where = element.where;
  attributes.allow({"type"});
  attributes.finish(leave_out.notes());
  pass_over_unknown(element,
                    {"inertial", "visual", "collision", "contact", "self_collision_checking", "sensor"},
                    leave_out);
  if (const Element* inertial = child_of(element, "inertial")) {
    const MassProperties mass = read_inertial(*inertial, leave_out, link.odd_inertia);
    if (mass.mass_kg > 0) link.mass = mass;
  }
  for (const Element& child : element.children) {
    if (child.name != "collision") continue;
    if (auto geom = read_collision(child, meshes, leave_out)) link.geoms.push_back(std::move(*geom));
  }
  return link;
}

}  // namespace pbmpi::scenes::urdf
