#include "ode/collide/narrow_phase.h"

#include <vector>

#include "geometry/geometry.h"
#include "ode/collide/contacts.h"
#include "ode/objects/engine.h"
#include "ode/objects/geoms.h"

namespace pbmpi::ode {
namespace {

/// Collides geoms that are in no space and on no body, and are placed where needed.
class NarrowPhase final : public model::NarrowPhase {
 public:
  explicit NarrowPhase(const model::Model& model)
      : model_(&model),
        placed_(model.geoms.size(), 0),
        found_(static_cast<std::size_t>(model.contact_law.max_per_pair)) {
    for (const model::Geom& geom : model.geoms) {
      geoms_.push_back(make_shape(geom, nullptr));
      if (geom.body == model::no_body && geom.shape != model::Shape::plane)
        place(geoms_.back(), geom, geometry::static_pose());
    }
  }
  ~NarrowPhase() override {
    for (dGeomID geom : geoms_) dGeomDestroy(geom);
  }
  NarrowPhase(const NarrowPhase&) = delete;
  NarrowPhase& operator=(const NarrowPhase&) = delete;

  void collide(std::span<const model::BodyPose> poses, std::span<const model::GeomPair> pairs,
               std::vector<model::Contact>& contacts) override {
    if (pairs.empty()) return;
    prepare_thread();  // may run on any thread of a pool
    ++time_;
    for (const model::GeomPair& pair : pairs) {
      bring(pair.first, poses);
      bring(pair.second, poses);
      const int count = dCollide(geoms_[pair.first], geoms_[pair.second], static_cast<int>(found_.size()),
                                 found_.data(), sizeof(dContactGeom));
      for (int i = 0; i < count; ++i) contacts.push_back(to_contact(*model_, pair, found_[i]));
    }
  }

 private:
  static void place(dGeomID id, const model::Geom& geom, const model::BodyPose& body) {
    const model::BodyPose pose = geometry::geom_pose(geom, body);
    const double* r = pose.rotation;
    const dMatrix3 rotation = {real(r[0]), real(r[1]), real(r[2]), 0,          real(r[3]), real(r[4]),
                               real(r[5]), 0,          real(r[6]), real(r[7]), real(r[8]), 0};
    dGeomSetPosition(id, pose.position[0], pose.position[1], pose.position[2]);
    dGeomSetRotation(id, rotation);
  }

  /// Places a geom of a body, once per call of collide().
  void bring(int index, std::span<const model::BodyPose> poses) {
    const model::Geom& geom = model_->geoms[index];
    if (geom.body == model::no_body || placed_[index] == time_) return;
    place(geoms_[index], geom, poses[geom.body]);
    placed_[index] = time_;
  }

  Engine engine_;
  const model::Model* model_;
  std::vector<dGeomID> geoms_;
  std::vector<long> placed_;  ///< [geoms] number of the call that placed it
  long time_ = 0;
  std::vector<dContactGeom> found_;  ///< [max_per_pair]
};

}  // namespace

std::unique_ptr<model::NarrowPhase> make_narrow_phase(const model::Model& model) {
  return std::make_unique<NarrowPhase>(model);
}

}  // namespace pbmpi::ode
