#include "solver/parts/fine_islands.h"

#include <algorithm>
#include <cmath>

#include "geometry/geometry.h"
#include "solver/pack/step_settings.h"

namespace pbmpi::solver {
namespace {

constexpr int most_pieces = 8;

/// A power of two: few groups of islands.
int pieces_for(double approach_m, double most_m) {
  int pieces = 2;
  while (pieces < most_pieces && approach_m > pieces * most_m) pieces *= 2;
  return pieces;
}

/// [m] How far up along an axis the lowest point of a box is.
double lowest(const geometry::Box& box, const core::Vec3& axis) {
  double height = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = axis[static_cast<Eigen::Index>(k)];
    height += along * (along > 0 ? box.min[k] : box.max[k]);
  }
  return height;
}

}  // namespace

FineIslands::FineIslands(const model::Model& model, const stepping::StepperSettings& settings)
    : model_(&model),
      most_approach_m_(most_approach_m(settings)),
      margin_m_(contact_margin_m(settings, model)),
      geoms_of_body_(model.bodies.size()),
      slow_(effects::slow_bounds(model)),
      rule_(model),
      pieces_(model.bodies.size(), 1),
      island_(model.bodies.size(), 0) {
  std::vector<geometry::Box> boxes;
  for (int index = 0; index < static_cast<int>(model.geoms.size()); ++index) {
    const model::Geom& geom = model.geoms[static_cast<std::size_t>(index)];
    if (geom.body != model::no_body) {
      geoms_of_body_[static_cast<std::size_t>(geom.body)].push_back(index);
    } else if (geom.shape == model::Shape::plane) {
      const model::BodyPose pose = geometry::geom_pose(geom, geometry::static_pose());
      const core::Vec3 normal(pose.rotation[2], pose.rotation[5], pose.rotation[8]);
      planes_.push_back({index, normal, normal.dot(core::Vec3(pose.position))});
    } else {
      static_geoms_.push_back(index);
      boxes.push_back(geometry::geom_box(geom, geometry::static_pose()));
    }
  }
  static_tree_.set(boxes);
  state_ = model::initial_state(model);
}

bool FineIslands::can_be(const stepping::StepperSettings& settings) {
  return most_approach_m(settings) < model::infinity;
}

bool FineIslands::find(std::span<const int> bodies, std::span<const model::Contact> contacts,
                       std::span<const std::int32_t> broken_in, StepIslands& islands) {
  if (std::ranges::none_of(contacts, &model::Contact::is_approach)) return false;
  if (!std::ranges::equal(broken_in, broken_in_)) {
    broken_in_.assign(broken_in.begin(), broken_in.end());
    rule_ = model::TouchRule(*model_, broken_in_);
    if (fast_) fast_->set_broken(broken_in_);
  }
  islands.connect(contacts, broken_in);
  for (const int body : bodies) {
    island_[static_cast<std::size_t>(body)] = islands.find(body);
    pieces_[static_cast<std::size_t>(body)] = 1;
  }
  for (const model::Contact& contact : contacts) {
    if (!contact.is_approach()) continue;
    int& pieces = pieces_[static_cast<std::size_t>(islands.find(contact.body_a))];
    pieces = std::max(pieces, pieces_for(contact.approach, most_approach_m_));
  }
  for (const int body : bodies)
    pieces_[static_cast<std::size_t>(body)] = pieces_[static_cast<std::size_t>(islands.find(body))];
  return true;
}

bool FineIslands::together(int body, int other) const {
  return other == model::no_body ||
         island_[static_cast<std::size_t>(body)] == island_[static_cast<std::size_t>(other)];
}

void FineIslands::add_pair(int geom, int other) {
  if (!rule_.may_touch(geom, other)) return;
  pairs_.push_back({std::min(geom, other), std::max(geom, other)});
}

void FineIslands::put_boxes(std::span<const int> bodies) {
  boxes_.clear();
  for (const int body : bodies) {
    const auto b = static_cast<std::size_t>(body);
    const model::BodyPose pose = geometry::body_pose({state_.position[b], state_.orientation[b]});
    for (const int geom : geoms_of_body_[b]) {
      const geometry::Box box = geometry::geom_box(model_->geoms[static_cast<std::size_t>(geom)], pose);
      boxes_.push_back({geom, box.grown(margin_m_)});
    }
  }
}

/// Sorts the boxes along the axis on which their corners are spread most, and tests neighbours on it.
void FineIslands::find_pairs() {
  std::size_t axis = 0;
  double widest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] =
        std::ranges::minmax(boxes_, {}, [&](const GeomBox& each) { return each.box.min[k]; });
    const double spread = high.box.min[k] - low.box.min[k];
    if (!(spread > widest)) continue;
    widest = spread;
    axis = k;
  }
  std::ranges::sort(boxes_, {}, [&](const GeomBox& each) { return each.box.min[axis]; });
  for (auto each = boxes_.begin(); each != boxes_.end(); ++each) {
    for (auto next = each + 1; next != boxes_.end() && next->box.min[axis] <= each->box.max[axis]; ++next) {
      if (next->box.overlaps(each->box)) add_pair(each->geom, next->geom);
    }
    static_tree_.for_each_near(
        each->box, [&](int index) { add_pair(each->geom, static_geoms_[static_cast<std::size_t>(index)]); });
    for (const Plane& plane : planes_) {
      if (lowest(each->box, plane.normal) <= plane.height) add_pair(each->geom, plane.geom);
    }
  }
}

void FineIslands::add_fast(std::span<const int> bodies, double piece_s,
                           std::vector<model::Contact>& contacts) {
  const int num_pieces = pieces(bodies.front());
  const auto may_be_fast = [&](int body) {
    const auto b = static_cast<std::size_t>(body);
    return !slow_[b].holds(state_.velocity[b], state_.angular_velocity[b], num_pieces * piece_s);
  };
  if (std::ranges::none_of(bodies, may_be_fast)) return;
  if (!fast_) {
    fast_.emplace(*model_);
    fast_->set_broken(broken_in_);
  }
  fast_->choose(bodies);
  if (!fast_->look(state_, piece_s, num_pieces)) return;
  const auto accepts = [&](int geom, int other) {
    return together(model_->geoms[static_cast<std::size_t>(geom)].body,
                    model_->geoms[static_cast<std::size_t>(other)].body);
  };
  fast_->add(state_, accepts, contacts);
}

void FineIslands::collide(Pack& pack, int world, std::span<const int> bodies, double piece_s,
                          std::vector<model::Contact>& contacts) {
  contacts.clear();
  pairs_.clear();
  pack.store(world, bodies, state_);
  for (auto first = bodies.begin(); first != bodies.end();) {
    const auto end = std::find_if(first, bodies.end(), [&](int body) { return !together(*first, body); });
    put_boxes({first, end});
    find_pairs();
    first = end;
  }
  std::ranges::sort(pairs_);
  pack.collide_pairs(world, pairs_, contacts);
  add_fast(bodies, piece_s, contacts);
}

}  // namespace pbmpi::solver
