#include "scenes/urdf/urdf.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "scenes/meshes/mesh_file.h"
#include "scenes/urdf/elements.h"
#include "scenes/urdf/joint_reader.h"
#include "scenes/urdf/link_reader.h"
#include "scenes/xml/attributes.h"

namespace pbmpi::scenes::urdf {
namespace {

/// Elements for other programs: colours, drives, simulators' own settings.
constexpr std::array<std::string_view, 8> of_others = {"material",           "transmission", "gazebo",
                                                       "ros2_control",       "sensor",       "group_state",
                                                       "disable_collisions", "mujoco"};

void add_meshes(const xml::Element& collision, const std::string& model, std::set<std::string>& files) {
  for (const xml::Element& geometry : collision.children) {
    for (const xml::Element& shape : geometry.children) {
      const xml::Attribute* given = shape.name == "mesh" ? shape.find("filename") : nullptr;
      if (given != nullptr && is_mesh_file(given->value)) files.insert(mesh_name(given->value, model));
    }
  }
}

class Reader {
 public:
  Reader(const xml::Element& root, const MeshTexts& meshes, const xml::LeaveOut& leave_out)
      : root_(root), meshes_(meshes), leave_out_(leave_out) {}

  links::ModelFile read() {
    xml::Attributes robot(root_, leave_out_);
    file_.mechanism.name = robot.text("name", "");
    file_.mechanism.self_collision = false;
    file_.mechanism.joins_massless = true;
    robot.allow({"version"});
    robot.finish(leave_out_.notes());
    for (const xml::Element& one : root_.children) read_one(one);
    core::require_input(!links_.empty(), root_.where + ": there is no <link>; give one");
    place(root_link(), links::no_link, 0);
    require_all_placed();
    return std::move(file_);
  }

 private:
  void read_one(const xml::Element& one) {
    if (one.name == "link") {
      links_.push_back(read_link(one, meshes_, leave_out_));
      const links::Link& link = links_.back();
      core::require_input(index_.emplace(link.name, links_.size() - 1).second,
                          link.where + ": a second link " + core::in_quotes(link.name) + "; rename one");
    } else if (one.name == "joint") {
      joints_.push_back(read_joint(one, leave_out_));
    } else if (std::ranges::find(of_others, one.name) != of_others.end()) {
      if (one.name == "gazebo")
        leave_out_.notes().add(one.where, "<gazebo> is left out, with what it says of friction and contacts");
    } else {
      pass_over(one, root_, {"link", "joint"}, leave_out_);
    }
  }

  std::size_t named(const std::string& name, const std::string& where) const {
    const auto found = index_.find(name);
    if (found != index_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [one, index] : index_) names.push_back(one);
    throw core::InputError(where + ": unknown link " + core::in_quotes(name) + core::suggestion(name, names));
  }

  /// The one link that is no joint's child.
  std::size_t root_link() {
    std::vector<const ReadJoint*> above(links_.size(), nullptr);
    children_.resize(links_.size());
    for (const ReadJoint& joint : joints_) {
      const std::size_t child = named(joint.child, joint.child_where);
      core::require_input(above[child] == nullptr, joint.child_where + ": the link " +
                                                       core::in_quotes(joint.child) +
                                                       " has two parents; a URDF is a tree");
      above[child] = &joint;
      children_[named(joint.parent, joint.parent_where)].push_back(&joint);
    }
    const auto root = std::ranges::find(above, nullptr);
    core::require_input(root != above.end(),
                        root_.where + ": the joints form a ring; a URDF is a tree with a root");
    const auto other = std::find(root + 1, above.end(), nullptr);
    if (other != above.end()) {
      const links::Link& second = links_[static_cast<std::size_t>(other - above.begin())];
      throw core::InputError(second.where + ": the link " + core::in_quotes(second.name) +
                             " is joined to none above it, and neither is " +
                             core::in_quotes(links_[static_cast<std::size_t>(root - above.begin())].name) +
                             "; a URDF has one root");
    }
    const auto index = static_cast<std::size_t>(root - above.begin());
    const bool stands = links_[index].name == "world" || !has_mass(index);
    if (!stands) {
      links::LinkJoint free;
      free.motion = links::Motion::free;
      free.name = links_[index].name + ".free";
      free.where = links_[index].where;
      links_[index].joints.push_back(free);
    }
    return index;
  }

  /// Does the link have a mass, or a link with mass that is fixed to it?
  bool has_mass(std::size_t root) const {
    for (std::vector<std::size_t> fixed{root}; !fixed.empty();) {
      const std::size_t link = fixed.back();
      fixed.pop_back();
      if (links_[link].mass) return true;
      for (const ReadJoint* joint : children_[link]) {
        if (joint->is_fixed) fixed.push_back(named(joint->child, joint->child_where));
      }
    }
    return false;
  }

  void place(std::size_t index, int parent, int depth) {
    const links::Link& link = links_[index];
    core::require_input(depth < xml::most_nesting, link.where + ": the tree is more than " +
                                                       std::to_string(xml::most_nesting) + " links deep");
    const auto own = static_cast<int>(file_.mechanism.links.size());
    file_.mechanism.links.push_back(link);
    file_.mechanism.links.back().parent = parent;
    for (const ReadJoint* joint : children_[index]) {
      const std::size_t below = named(joint->child, joint->child_where);
      links_[below].pose = joint->origin;
      if (!joint->is_fixed) links_[below].joints.push_back(joint->joint);
      place(below, own, depth + 1);
    }
  }

  /// A link that cannot be reached from the root is part of a ring.
  void require_all_placed() const {
    if (file_.mechanism.links.size() == links_.size()) return;
    throw core::InputError(root_.where + ": some joints form a ring; a URDF is a tree");
  }

  const xml::Element& root_;
  MeshTexts meshes_;
  const xml::LeaveOut& leave_out_;
  std::vector<links::Link> links_;
  std::map<std::string, std::size_t> index_;
  std::vector<ReadJoint> joints_;
  std::vector<std::vector<const ReadJoint*>> children_;
  links::ModelFile file_;
};

}  // namespace

links::ModelFile read(const xml::Element& root, const std::string& file, const xml::Texts& texts,
                      const xml::LeaveOut& leave_out) {
  return Reader(root, {file, texts}, leave_out).read();
}

std::vector<std::string> mesh_files(const std::string& file, const xml::Texts& texts) {
  std::set<std::string> files;
  for (const xml::Element& link : xml::parse(texts.at(file), file).children) {
    for (const xml::Element& collision : link.children) {
      if (link.name == "link" && collision.name == "collision") add_meshes(collision, file, files);
    }
  }
  files.erase("");
  return {files.begin(), files.end()};
}

}  // namespace pbmpi::scenes::urdf
