/// Where geoms touch that do not move against each other: what of their surfaces lies inside of their union,
/// and which contacts such a surface must not have.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/solid.h"
#include "model/contact.h"
#include "model/model.h"

namespace pbmpi::geometry {

/// Static geoms that touch are one solid, and so are the geoms of a body of which two are flush, as those of
/// a deck (others, as a car's cabin on its chassis, have no faces across which something could slide).
/// Something that slides across two flush geoms must not meet the edge between them: seen alone, each has an
/// edge and a side there that the union of both has not.
///
/// A contact stands if its normal is one of the union's: on an edge if each neighbour that reaches the point
/// allows the normal, too (the normals of a union at a point are those that all of its parts have there); on
/// a face if some part of the face under the other geom is not covered by neighbours. If no contact of a pair
/// stands, the pair gets those of the face that lets the other geom out by the shortest way, of the faces
/// that are not covered; none if there is no such face, or if the other geom does not reach it.
///
/// A hull or a mesh is never part of such a solid; a hull's contacts with one are corrected as those of
/// others.
///
/// Geoms count as touching, and faces as flush, up to 0.1 mm apart, or a thousandth of the thickness of the
/// thinner geom if that is less. A face that is partly covered is not met by what reaches over its border by
/// less than that.
class Seams {
 public:
  /// Null if no geoms form such a solid. `model` is borrowed.
  static std::unique_ptr<const Seams> find(const model::Model& model);

  /// Corrects the contacts of one pair of geoms: contacts[first ...]. `pose_of`: body -> its BodyPose.
  /// `least_depth`: the least depth of a contact [m].
  template <class PoseOf>
  void correct(std::size_t first, double least_depth, const PoseOf& pose_of,
               std::vector<model::Contact>& contacts) const {
    if (first == contacts.size()) return;
    const model::GeomPair pair = contacts[first].geoms;
    if (!touches(pair.first) && !touches(pair.second)) return;
    const auto pose = [&](int geom) {
      const int body = model_->geoms[static_cast<std::size_t>(geom)].body;
      return body == model::no_body ? static_pose() : pose_of(body);
    };
    correct({pair.first, pose(pair.first)}, {pair.second, pose(pair.second)}, first, least_depth, contacts);
    correct({pair.second, pose(pair.second)}, {pair.first, pose(pair.first)}, first, least_depth, contacts);
  }

  /// Is a geom's surface covered by a neighbour at this point [m], where `normal` is its normal (world
  /// frame)? `body`: pose of the geom's body, or static_pose().
  bool covers(int geom, const model::BodyPose& body, const core::Vec3& point, const core::Vec3& normal) const;

 private:
  /// A geom that others of its body may touch, in the body's frame.
  struct Part {
    Solid solid;
    double tolerance_m = 0;  ///< how far a neighbour may be away
    int cluster = -1;        ///< index into clusters_; -1: the only geom of a body, or a plane
    bool touches = false;
    unsigned coverable = 0;  ///< set of Faces in front of which a neighbour may reach
    bool may_be_covered(const Face& face) const { return (coverable >> index_of(solid, face) & 1u) != 0; }
  };
  /// The geoms of a body that has several, or all static ones but planes, with their boxes in the body's
  /// frame.
  struct Cluster {
    std::vector<int> geoms;
    std::vector<Box> boxes;
    BoxTree tree;
  };
  /// A geom of a pair, and the pose of its body.
  struct Side {
    int geom = 0;
    model::BodyPose body;
  };
  struct Frame;
  struct Touched;

  explicit Seams(const model::Model& model);
  bool touches(int geom) const { return parts_[static_cast<std::size_t>(geom)].touches; }
  int group_of(int geom) const { return model_->geoms[static_cast<std::size_t>(geom)].body; }
  void add_parts();
  void add_to_cluster(int cluster, int geom);
  void find_neighbours(int geom);
  void meet(int first, int second);
  void leave_out_uneven_bodies();
  static void add_coverable(Part& part, const Part& neighbour);

  void correct(const Side& own, const Side& other, std::size_t first, double least_depth,
               std::vector<model::Contact>& contacts) const;
  bool is_covered(int geom, const core::Vec3& point, const core::Vec3& normal) const;
  bool any_stands(const Touched& touched) const;
  bool is_allowed(int geom, const core::Vec3& point, const core::Vec3& normal) const;
  bool is_open(int geom, const Face& face, const Solid& other) const;
  bool is_on_open_face(int geom, const Face& face, const core::Vec3& point) const;
  void replace(const Touched& touched, double least_depth, const model::Contact& like,
               std::vector<model::Contact>& contacts) const;
  template <class Found>
  bool any_neighbour(int geom, const core::Vec3& point, const Found& found) const;

  const model::Model* model_;
  std::vector<Part> parts_;  ///< [geoms]
  std::vector<int> planes_;  ///< static
  std::vector<Cluster> clusters_;
  std::vector<char> is_even_;  ///< [bodies] are two geoms of the body flush?
};

}  // namespace pbmpi::geometry
