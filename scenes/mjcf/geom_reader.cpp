#include "scenes/mjcf/geom_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "core/text.h"
#include "model/names.h"
#include "scenes/links/rigid.h"
#include "scenes/mjcf/settings/mesh_reader.h"

namespace pbmpi::scenes::mjcf {
namespace {

using model::Mat3;
using model::Shape;
using xml::Attributes;
using xml::Range;

constexpr double water = 1000;  // [kg/m^3] MuJoCo's default density

/// The middle, half the length, and the direction of `fromto`.
struct Segment {
  Pose pose;
  double half_length = 0;
};

std::optional<Segment> read_segment(Attributes& geom) {
  const std::vector<double> ends = geom.numbers("fromto", 6, 6);
  if (ends.empty()) return std::nullopt;
  const Vec3 from(ends[0], ends[1], ends[2]), to(ends[3], ends[4], ends[5]);
  const Vec3 along = from - to;  // MuJoCo's z axis points to the first end
  if (!(along.norm() > 0)) geom.fail("fromto", "the two ends of 'fromto' are one point; move one");
  return Segment{{(from + to) / 2, turn_of_z(along)}, along.norm() / 2};
}

/// `size` as in model::Geom; MJCF has half of each length.
std::array<double, 3> read_sizes(Attributes& geom, Shape shape, const std::optional<Segment>& segment) {
  if (shape == Shape::plane) {
    geom.allow({"size"});  // only affects how a plane is drawn, which has no end
    return {};
  }
  const model::ShapeTraits& traits = model::traits_of(shape);
  const std::size_t needed = segment ? 1 : static_cast<std::size_t>(traits.num_sizes);
  const std::vector<double> read = geom.numbers("size", 1, 3);
  if (read.size() < needed)
    geom.fail("size",
              "'size' needs " + std::to_string(needed) + " number" + (needed == 1 ? "" : "s") + " [m]");
  for (std::size_t i = 0; i < needed; ++i) {
    if (!(read[i] > 0)) geom.fail("size", "'size' must be above 0");
  }
  std::array<double, 3> size{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(traits.num_sizes); ++i) {
    const double given = segment ? read[0] : read[i];
    size[i] = static_cast<int>(i) == traits.radius ? given : 2 * given;
  }
  if (segment) size[static_cast<std::size_t>(traits.length[2])] = 2 * segment->half_length;
  return size;
}

/// Reads the friction. Only the first coefficient, for sliding along the surface, has an effect here.
double read_friction(Attributes& geom, xml::Notes& notes) {
  const std::vector<double> friction = geom.numbers("friction", 1, 3);
  const int condim = geom.integer("condim", 1, 3);
  if (condim > 3) notes.add(geom.where("condim"), "torsional and rolling friction (condim 4, 6) is left out");
  if (!friction.empty() && !(friction[0] >= 0)) geom.fail("friction", "'friction' must be at least 0");
  return condim == 1 ? 0 : friction.empty() ? 1 : friction[0];
}

void note_contact_numbers(Attributes& geom, xml::Notes& notes) {
  for (const char* name : {"solref", "solimp", "solmix", "margin", "gap", "priority"}) {
    if (geom.has(name))
      notes.add(geom.where(name), core::in_quotes(name) + " of geoms is left out: contacts are pbmpi's");
  }
}

MassProperties mass_of(Attributes& geom, const links::LinkGeom& read) {
  const Solid solid{read.shape, read.size, read.pose};
  const double density = geom.number("density", Range::non_negative, water);
  const double mass = geom.number("mass", Range::non_negative, density * volume(solid.shape, solid.size));
  return mass_properties({solid}, mass);
}

/// Does the mass of the geom count for its body's?
bool counts(Attributes& geom, const Compiler& compiler) {
  const int group = geom.integer("group", -1000000, 0);
  return group >= compiler.first_inertia_group && group <= compiler.last_inertia_group;
}

/// Three half axes.
MassProperties mass_of_ellipsoid(Attributes& geom, const Compiler& compiler) {
  const std::vector<double> half = geom.numbers("size", 3, 3);
  if (half.empty() || !(*std::ranges::min_element(half) > 0))
    geom.fail("'size' needs three half axes above 0 [m]");
  const Vec3 squares(half[0] * half[0], half[1] * half[1], half[2] * half[2]);
  const double size = 4 * std::numbers::pi / 3 * std::abs(half[0] * half[1] * half[2]);
  const double density = geom.number("density", Range::non_negative, water);
  const double mass = geom.number("mass", Range::non_negative, density * size);
  Mat3 inertia = Mat3::Zero();
  inertia.diagonal() = mass / 5 * (Vec3::Constant(squares.sum()) - squares);
  return links::moved({mass, Vec3::Zero(), inertia}, read_pose(geom, compiler));
}

/// In the body's frame. A geom has the place of its mesh's frame.
MassProperties mass_of_mesh(Attributes& geom, const ModelMesh& mesh, const Pose& pose) {
  const double density = geom.number("density", Range::non_negative, water);
  std::optional<double> mass;
  if (geom.has("mass")) mass = geom.number("mass", Range::non_negative);
  return links::moved(scenes::mass_of(mesh, mass, density), pose);
}

/// Null if it cannot be read: its mass may not be needed.
const ModelMesh* readable_mesh(Attributes& geom, Meshes& meshes) {
  try {
    return &meshes.of(geom);
  } catch (const core::InputError&) {
    return nullptr;
  }
}

/// A geom of a shape that cannot be collided, and that touches nothing, or that the scene leaves out.
ReadGeom read_drawing(Attributes& geom, const std::string& type, const Context& context) {
  const Compiler& compiler = context.compiler;
  const xml::LeaveOut& leave_out = context.leave_out;
  ReadGeom read;
  const bool has_mass = geom.number("mass", Range::non_negative, 1.0) > 0 &&
                        (geom.has("mass") || geom.number("density", Range::non_negative, water) > 0);
  const std::string what = "a geom of type " + core::in_quotes(type) + " is left out";
  if (leave_out.names(type) || !counts(geom, compiler) || !has_mass || type == "hfield") {
    leave_out.notes().add(geom.where(), what + (leave_out.names(type) ? ", and so is its mass" : ""));
    return read;
  }
  if (type == "ellipsoid" && !geom.has("fromto") && !geom.has("mesh"))
    read.mass = mass_of_ellipsoid(geom, compiler);
  else if (const ModelMesh* mesh = type == "mesh" ? readable_mesh(geom, *context.meshes) : nullptr)
    read.mass = mass_of_mesh(geom, *mesh, read_pose(geom, compiler));
  else
    read.unknown_mass = geom.where() + ": the mass of a geom of type " + core::in_quotes(type) +
                        " is not known; give its body an <inertial>, or " + xml::LeaveOut::advice(type);
  leave_out.notes().add(geom.where(), what + ": it touches nothing");
  return read;
}

/// A mesh or an ellipsoid that touches something does so as its hull, a height field as a mesh of triangles.
std::optional<Shape> shape_of(const std::string& type, bool touches) {
  if (type == "mesh") return touches ? std::optional(Shape::hull) : std::nullopt;
  if (type == "hfield") return touches ? std::optional(Shape::mesh) : std::nullopt;
  if (type == "ellipsoid") return touches ? std::optional(Shape::hull) : std::nullopt;
  if (type == model::name_of(Shape::hull)) return std::nullopt;
  return model::enum_from_name<Shape>(type, model::shape_names);
}

/// A surface without a mass.
ReadGeom read_field_geom(Attributes& attributes, links::LinkGeom geom, const Context& context) {
  const geometry::PlacedMesh& field = context.meshes->height_field_of(attributes);
  model::Geom shaped;
  geometry::put_mesh(field.mesh, shaped);
  geom.size = shaped.size;
  geom.hull = shaped.hull;
  geom.mesh = shaped.mesh;
  geom.pose.position = geom.pose.point_to_outer(field.centre);
  attributes.allow({"size", "fromto", "mass", "density"});
  attributes.finish();
  return {geom, std::nullopt, {}};
}

ReadGeom read_hull_geom(Attributes& attributes, const std::string& type, links::LinkGeom geom,
                        const Context& context) {
  ReadGeom read;
  MassProperties mass;
  geometry::FoundHull found;
  if (type == "ellipsoid") {
    if (attributes.has("mesh") || attributes.has("fromto"))
      attributes.fail_unless_left_out(attributes.has("mesh") ? "mesh" : "fromto",
                                      "an ellipsoid has three half axes here; give its 'size'", type);
    mass = mass_of_ellipsoid(attributes, context.compiler);
    const std::vector<double> half = attributes.numbers("size", 3, 3);
    found = hull_of_ellipsoid({half[0], half[1], half[2]}, attributes.where());
    context.leave_out.notes().add(attributes.where(),
                                  "an ellipsoid touches others as the hull of 128 of its points");
  } else {
    const ModelMesh& mesh = context.meshes->of(attributes);
    mass = mass_of_mesh(attributes, mesh, geom.pose);
    found = mesh.found;
  }
  if (counts(attributes, context.compiler) && mass.mass_kg > 0) read.mass = mass;
  const Solid solid = solid_of(found, geom.pose);
  geom.size = solid.size;
  geom.pose = solid.pose;
  geom.hull = solid.hull;
  read.geom = std::move(geom);
  if (type == "mesh") attributes.allow({"size", "fromto"});
  attributes.finish();
  return read;
}

}  // namespace

ReadGeom read_geom(Attributes attributes, const Context& context) {
  const Compiler& compiler = context.compiler;
  const xml::LeaveOut& leave_out = context.leave_out;
  attributes.allow({"name", "class", "rgba", "material", "user", "hfield", "mesh", "fitscale", "fluidcoef"});
  const std::string type = attributes.text("type", attributes.has("mesh") ? "mesh" : "sphere");
  const int contype = context.option.collides ? attributes.integer("contype", 0, 1) : 0;
  const int conaffinity = context.option.collides ? attributes.integer("conaffinity", 0, 1) : 0;
  attributes.allow({"contype", "conaffinity"});
  const bool touches = contype != 0 || conaffinity != 0;
  const auto shape = shape_of(type, touches && !leave_out.names(type));
  if (!shape) {
    const bool is_known = type == "mesh" || type == "ellipsoid" || type == "hfield" || type == "sdf";
    const bool is_drawing = is_known && !touches;
    if (!is_drawing && !leave_out.names(type))
      attributes.fail_unless_left_out(
          "type",
          "geoms of type " + core::in_quotes(type) +
              " cannot be collided here; take spheres, capsules, cylinders, boxes, planes or meshes",
          type);
    return read_drawing(attributes, type, context);
  }
  attributes.drop(leave_out);  // now that 'mesh' can only mean the type
  attributes.refuse({"shellinertia"}, "hollow geoms are not read; give the body an <inertial>");
  links::LinkGeom geom;
  geom.shape = *shape;
  geom.where = attributes.where();
  geom.contype = static_cast<unsigned>(contype);
  geom.conaffinity = static_cast<unsigned>(conaffinity);
  geom.mu = read_friction(attributes, leave_out.notes());
  note_contact_numbers(attributes, leave_out.notes());
  geom.pose = read_pose(attributes, compiler);
  if (*shape == Shape::hull) return read_hull_geom(attributes, type, std::move(geom), context);
  if (*shape == Shape::mesh) return read_field_geom(attributes, std::move(geom), context);
  const auto segment =
      *shape == Shape::sphere || *shape == Shape::plane ? std::nullopt : read_segment(attributes);
  if (segment) geom.pose = segment->pose;
  geom.size = read_sizes(attributes, *shape, segment);
  ReadGeom read{geom, std::nullopt, {}};
  const bool has_mass = counts(attributes, compiler);
  if (*shape == Shape::plane) {
    attributes.allow({"mass", "density"});
  } else {
    const MassProperties mass = mass_of(attributes, geom);
    if (has_mass && mass.mass_kg > 0) read.mass = mass;
  }
  attributes.finish();
  return read;
}

MassProperties read_inertial(const xml::Element& element, const Compiler& compiler,
                             const xml::LeaveOut& leave_out) {
  Attributes inertial(element, leave_out);
  const Pose pose = read_pose(inertial, compiler);
  if (!inertial.has("pos")) inertial.fail("it has no 'pos'; give the centre of mass");
  const double mass = inertial.number("mass", Range::non_negative);
  const std::vector<double> full = inertial.numbers("fullinertia", 6, 6);
  const std::vector<double> moments = inertial.numbers("diaginertia", 3, 3);
  inertial.allow({"class"});
  inertial.finish();
  if (full.empty() == moments.empty()) inertial.fail("give either 'diaginertia' or 'fullinertia'");
  Mat3 inertia = Mat3::Zero();
  if (full.empty()) {
    inertia.diagonal() << moments[0], moments[1], moments[2];
  } else {
    inertia << full[0], full[3], full[4], full[3], full[1], full[5], full[4], full[5], full[2];
  }
  if (!compiler.balances_inertia && !is_of_a_body(inertia))
    inertial.fail("no body has a moment of inertia above the sum of the other two; change one");
  return links::moved({mass, Vec3::Zero(), inertia}, pose);
}

MassProperties adjusted(const MassProperties& mass, const Compiler& compiler) {
  MassProperties result = mass;
  result.mass_kg = std::max(mass.mass_kg, compiler.least_mass);
  if (compiler.least_inertia <= 0 && !compiler.balances_inertia) return result;
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(mass.inertia);
  Vec3 moments = eigen.eigenvalues().cwiseMax(compiler.least_inertia);
  if (compiler.balances_inertia && 2 * moments.maxCoeff() > moments.sum())
    moments.setConstant(moments.mean());
  result.inertia = eigen.eigenvectors() * moments.asDiagonal() * eigen.eigenvectors().transpose();
  return result;
}

}  // namespace pbmpi::scenes::mjcf
