/// The joints of a pack, with copies of one articulation shape in the lanes of consecutive batches.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/random.h"
#include "solver/joints/joint_builder.h"
#include "solver/joints/joint_memory.h"
#include "solver/joints/joint_solver.h"

namespace pbmpi::solver {

template <class T>
class JointBatches {
 public:
  using V = typename T::V;

  /// Appends a shape whose body i of batch k is slot first_slot + k num_bodies + i; returns its index.
  int add_shape(const ArticulationShape& shape, int first_slot, int num_batches, int static_slot);
  int num_shapes() const { return static_cast<int>(shapes_.size()); }
  /// The joints of a shape: [num_batches][shape.joints].
  std::vector<JointLane<V>>& joints(int shape) { return shapes_[static_cast<std::size_t>(shape)].joints; }
  const std::vector<JointLane<V>>& joints(int shape) const {
    return shapes_[static_cast<std::size_t>(shape)].joints;
  }

  /// As many articulations of one shape as there are lanes. Their bodies are the slots first_slot to
  /// end_slot - 1, and no other batch's joint is on any of them.
  struct Batch {
    std::size_t shape = 0, index = 0;
    int first_slot = 0, end_slot = 0;
    bool has_joints = false;
  };
  /// All batches, in the order of their slots.
  std::vector<Batch> all() const;
  /// Chooses the batches that the following calls work on, in the order of their slots; they must stay valid
  /// until the next call.
  void activate(std::span<const Batch> batches);
  /// Calls visit(batch) for each active batch, in the order of their slots.
  template <class Visit>
  void for_each_active_batch(Visit visit) const {
    for (const Batch& batch : active_) visit(batch);
  }

  /// A joint has broken in this lane: from now on it exerts nothing.
  void set_broken(int shape, int joint, int lane) {
    T::set(joints(shape)[static_cast<std::size_t>(joint)].holds, lane, 0);
  }
  /// Builds the rows of a step's first substep, with the forces that the joints remember, times `h`.
  /// `exact`: see JointBuilder::build().
  void start(const Batch& batch, const JointBuilder<T>& builder, const V& exact, const V& h,
             const BodyLanes<T>& bodies) {
    for_each_rows(batch, [&](auto& joint, auto& rows) {
      for (int axis = 0; axis < 2; ++axis) joint.controls[axis].angle = joint.memory.angle[axis];
      const JointForceLane<V> forces{joint.memory.force * h, joint.memory.torque * h};
      builder.build(joint, exact, forces, bodies, rows);
      recall_forces<T>(joint.memory, h, rows);
    });
  }
  /// Builds the rows anew after the bodies have moved, with the same forces.
  void rebuild(const Batch& batch, const JointBuilder<T>& builder, const V& exact,
               const BodyLanes<T>& bodies) {
    const V one = T::broadcast(1);
    for_each_rows(batch, [&](auto& joint, auto& rows) {
      JointForceLane<V> forces;
      set_forces<T>(rows, one, forces);
      builder.build(joint, exact, forces, bodies, rows);
      recall_forces<T>(forces, one, rows);
    });
  }
  /// Reduces the impulses to a share.
  void carry(const Batch& batch, const V& share) {
    for_each_rows(batch, [&](auto&, auto& rows) {
      JointForceLane<V> forces;
      set_forces<T>(rows, T::broadcast(1), forces);
      recall_forces<T>(forces, share, rows);
    });
  }
  /// Remembers the forces with which the rows ended, except where keeps(slot of a joint's first body) says
  /// so: null, or 1 in the lanes whose memory stays as it is.
  template <class Keeps>
  void remember(const Batch& batch, const V& per_h, const Keeps& keeps) {
    for_each_rows(
        batch, [&](auto& joint, auto& rows) { remember_forces<T>(rows, per_h, keeps(joint.slot_a), joint); });
  }
  /// Lets rotors begin a substep, before anything acts on the bodies.
  void start_rotors(const Batch& batch, const BodyLanes<T>& bodies) {
    for_each_rows(batch, [&](auto&, auto& rows) { JointSolver<T>::start_rotors(rows, bodies); });
  }
  /// See JointBuilder::look_ahead().
  void look_ahead(const Batch& batch, const JointBuilder<T>& builder, const BodyLanes<T>& bodies) {
    for_each_rows(batch, [&](auto& joint, auto& rows) { builder.look_ahead(joint, bodies, rows); });
  }
  /// At the start of a substep, applies what acts on the bodies before the sweeps: motors at their limits,
  /// and, if `carries`, the impulses with which the rows start.
  void push(const Batch& batch, bool carries, BodyLanes<T>& bodies) {
    for_each_rows(batch, [&](auto&, auto& rows) {
      JointSolver<T>::push_motors(rows, bodies);
      if (carries) JointSolver<T>::push_carried(rows, bodies);
    });
  }
  /// Fisher-Yates with keyed numbers: the order is the same in every batch of a shape, and hence in every
  /// world.
  void shuffle(std::uint64_t key);
  /// Sweeps the joints in the order of the model.
  void order_as_given();
  /// swept_lanes(shape, batch, joint, rows): 1 in the lanes to be swept, else 0. `as_given`: in the order of
  /// the model, whatever the present one is.
  template <class SweptLanes>
  void sweep(const JointSolver<T>& solver, const SweptLanes& swept_lanes, bool as_given,
             BodyLanes<T>& bodies);

  /// The order of the joints of a shape in this sweep.
  std::span<const std::size_t> order(std::size_t shape) const { return shapes_[shape].order; }
  /// Calls visit(rows) for a joint, given by its index into the shape's joints, [num_batches][shape.joints].
  template <class Visit>
  void change_rows(std::size_t shape, std::size_t joint, Visit visit) {
    const RowsAt at = shapes_[shape].rows[joint];
    with_kind(at.kind, [&](auto kind) { visit(rows_of<kind.value>()[static_cast<std::size_t>(at.index)]); });
  }

  /// Number of rows in a lane of a joint as last built, limits and motors included.
  int num_rows(int shape, int joint, int lane) const;
  /// Calls visit(rows) for a joint as last solved.
  template <class Visit>
  void visit_rows(int shape, int joint, Visit visit) const {
    const RowsAt at = shapes_[static_cast<std::size_t>(shape)].rows[static_cast<std::size_t>(joint)];
    with_kind(at.kind, [&](auto kind) { visit(rows_of<kind.value>()[static_cast<std::size_t>(at.index)]); });
  }

 private:
  using Kind = model::JointKind;
  /// Where the rows of a joint are, kept apart from its terms, which a sweep does not need.
  struct RowsAt {
    Kind kind = Kind::ball;
    int index = 0;
  };
  struct Shape {
    std::size_t num_joints = 0;  ///< of one articulation
    int first_slot = 0, num_bodies = 0;
    std::size_t num_batches = 0;
    std::vector<JointLane<V>> joints;  ///< [num_batches][num_joints]
    std::vector<RowsAt> rows;          ///< [num_batches][num_joints]
    std::vector<std::size_t> order;    ///< of the joints within a batch, in this sweep
  };
  template <Kind kind>
  using RowsOf = std::vector<JointRows<T, kind>>;

  template <Kind kind>
  RowsOf<kind>& rows_of() {
    return std::get<RowsOf<kind>>(rows_);
  }
  template <Kind kind>
  const RowsOf<kind>& rows_of() const {
    return std::get<RowsOf<kind>>(rows_);
  }
  /// Calls visit(std::integral_constant<Kind, kind>), searching from kind number `first` on.
  template <int first = 0, class Visit>
  static auto with_kind(Kind kind, Visit visit) {
    constexpr auto own = static_cast<Kind>(first);
    if constexpr (first + 1 < model::num_joint_kinds) {
      if (kind != own) return with_kind<first + 1>(kind, visit);
    }
    return visit(std::integral_constant<Kind, own>{});
  }
  template <std::size_t... kind>
  static std::tuple<RowsOf<static_cast<Kind>(kind)>...> rows_of_all(std::index_sequence<kind...>);

  /// Calls visit(joint, its rows) for each joint of a batch.
  template <class Visit>
  void for_each_rows(const Batch& batch, Visit visit);

  /// Calls visit(shape, its active batches) for each shape that has any.
  template <class Visit>
  void for_each_active_shape(Visit visit) const {
    for (std::size_t i = 0; i + 1 < first_of_shape_.size(); ++i) {
      const auto batches = active_.subspan(first_of_shape_[i], first_of_shape_[i + 1] - first_of_shape_[i]);
      visit(batches.front().shape, batches);
    }
  }

  std::vector<Shape> shapes_;
  std::span<const Batch> active_;
  std::vector<std::size_t> first_of_shape_;  ///< in active_, of each shape that has any there; and the end
  /// [kinds]
  decltype(rows_of_all(std::make_index_sequence<model::num_joint_kinds>())) rows_;
};

template <class T>
int JointBatches<T>::add_shape(const ArticulationShape& shape, int first_slot, int num_batches,
                               int static_slot) {
  Shape batches;
  batches.num_joints = shape.joints.size();
  batches.first_slot = first_slot;
  batches.num_bodies = shape.num_bodies;
  batches.num_batches = static_cast<std::size_t>(num_batches);
  batches.order.resize(batches.num_joints);
  for (int batch = 0; batch < num_batches; ++batch) {
    const int first = first_slot + batch * shape.num_bodies;
    for (const JointLink& link : shape.joints) {
      JointLane<V>& joint = batches.joints.emplace_back();
      joint.sprung = link.sprung;
      joint.holds = T::broadcast(1);
      joint.slot_a = first + link.body_a;
      joint.slot_b = link.body_b == shape.num_bodies ? static_slot : first + link.body_b;
      const int index = with_kind(link.kind, [this](auto kind) {
        auto& rows = this->template rows_of<kind.value>();
        rows.emplace_back();
        return static_cast<int>(rows.size()) - 1;
      });
      batches.rows.push_back({link.kind, index});
    }
  }
  shapes_.push_back(std::move(batches));
  return num_shapes() - 1;
}

template <class T>
std::vector<typename JointBatches<T>::Batch> JointBatches<T>::all() const {
  std::vector<Batch> batches;
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    const Shape& shape = shapes_[s];
    for (std::size_t i = 0; i < shape.num_batches; ++i) {
      const int first_slot = shape.first_slot + static_cast<int>(i) * shape.num_bodies;
      batches.push_back({s, i, first_slot, first_slot + shape.num_bodies, shape.num_joints > 0});
    }
  }
  return batches;
}

template <class T>
void JointBatches<T>::activate(std::span<const Batch> batches) {
  active_ = batches;
  first_of_shape_.clear();
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (i == 0 || active_[i].shape != active_[i - 1].shape) first_of_shape_.push_back(i);
  }
  first_of_shape_.push_back(active_.size());
}

template <class T>
template <class Visit>
void JointBatches<T>::for_each_rows(const Batch& batch, Visit visit) {
  Shape& shape = shapes_[batch.shape];
  const std::size_t first = batch.index * shape.num_joints;
  for (std::size_t i = first; i < first + shape.num_joints; ++i) {
    const RowsAt at = shape.rows[i];
    with_kind(at.kind, [&](auto kind) {
      visit(shape.joints[i], rows_of<kind.value>()[static_cast<std::size_t>(at.index)]);
    });
  }
}

template <class T>
void JointBatches<T>::order_as_given() {
  for_each_active_shape([&](std::size_t shape, std::span<const Batch>) {
    std::vector<std::size_t>& order = shapes_[shape].order;
    std::iota(order.begin(), order.end(), std::size_t{0});
  });
}

template <class T>
void JointBatches<T>::shuffle(std::uint64_t key) {
  order_as_given();
  for_each_active_shape([&](std::size_t shape, std::span<const Batch>) {
    std::vector<std::size_t>& order = shapes_[shape].order;
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[core::mix_key(key, i, 0) % i]);
  });
}

/// Goes joint by joint, each in all batches in turn: batches share no body, so that the processor works on
/// several at once.
template <class T>
template <class SweptLanes>
void JointBatches<T>::sweep(const JointSolver<T>& solver, const SweptLanes& swept_lanes, bool as_given,
                            BodyLanes<T>& bodies) {
  for_each_active_shape([&](std::size_t s, std::span<const Batch> batches) {
    const Shape& shape = shapes_[s];
    for (std::size_t next = 0; next < shape.num_joints; ++next) {
      const std::size_t joint = as_given ? next : shape.order[next];
      for (const Batch& batch : batches) {
        const RowsAt at = shape.rows[batch.index * shape.num_joints + joint];
        with_kind(at.kind, [&](auto kind) {
          auto& rows = rows_of<kind.value>()[static_cast<std::size_t>(at.index)];
          const V swept = swept_lanes(s, batch.index, joint, rows);
          if (T::any(swept)) solver.solve(rows, swept, bodies);
        });
      }
    }
  });
}

template <class T>
int JointBatches<T>::num_rows(int shape, int joint, int lane) const {
  const RowsAt at = shapes_[static_cast<std::size_t>(shape)].rows[static_cast<std::size_t>(joint)];
  return with_kind(at.kind, [&](auto kind) {
    const auto& rows = rows_of<kind.value>()[static_cast<std::size_t>(at.index)];
    int count = model::traits_of(kind.value).held_rows();
    for_each_control(rows, [&](const auto& control, std::size_t i) {
      if (rows.control_on[i] && T::get(control.low, lane) < T::get(control.high, lane)) ++count;
    });
    return count;
  });
}

}  // namespace pbmpi::solver
