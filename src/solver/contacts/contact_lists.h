/// The contacts of a pack in one step. They are of eight kinds: with or without a second body, and central,
/// smooth, rough or patched.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "solver/contacts/contact_builder.h"
#include "solver/contacts/contact_colors.h"
#include "solver/contacts/contact_memory.h"
#include "solver/contacts/sweep_order.h"

namespace pbmpi::solver {

/// Contacts of one kind.
template <class T, bool two_bodies, ContactKind kind>
class ContactList {
 public:
  using Scalar = typename T::Scalar;
  using Parameters = ContactParameters<Scalar>;

  ManifoldOrder order;  ///< to be filled before build()

  void build(const BodyLanes<T>& bodies, const Parameters& parameters) {
    const std::span<const Manifold> manifolds = order.deal(T::num_lanes, bodies.static_slot);
    cut();
    const ContactBuilder<T, two_bodies, kind> builder(bodies, parameters);
    for (std::size_t i = 0; i < slots_.size(); ++i)
      builder.build(&manifolds[i * T::num_lanes], slots_[i], points_of(slots_[i]));
    may_bounce_ = parameters.restitution && has_bounce();
  }
  /// Advances the rows to the next substep.
  void advance(const BodyLanes<T>& bodies, const Parameters& parameters) {
    const ContactBuilder<T, two_bodies, kind> builder(bodies, parameters);
    for (const Slot& slot : slots_) builder.advance(slot, points_of(slot));
  }
  void carry(const Parameters& parameters) {
    const ContactMemory<T, two_bodies, kind> memory(parameters);
    for (Slot& slot : slots_) memory.carry(slot, points_of(slot));
  }
  void remember(const Parameters& parameters) {
    const ContactMemory<T, two_bodies, kind> memory(parameters);
    for (std::size_t i = 0; i < slots_.size(); ++i)
      memory.remember(slots_[i], points_of(slots_[i]), order.dealt().data() + i * T::num_lanes);
  }
  void forget_open(const TwistRows<T>& twists, const Parameters& parameters) {
    for (Slot& slot : slots_)
      ContactSolver<T, two_bodies, kind>::forget_open(twists, parameters.slip_velocity, slot,
                                                      points_of(slot));
  }
  void bounce(TwistRows<T>& twists, const Parameters& parameters) {
    if (!may_bounce_) return;
    const ContactSolver<T, two_bodies, kind> solver(parameters, {});
    for (Slot& slot : slots_) solver.bounce(twists, slot, points_of(slot));
  }
  void push_carried(TwistRows<T>& twists) {
    for (const Slot& slot : slots_)
      ContactSolver<T, two_bodies, kind>::push_carried(twists, slot, points_of(slot));
  }
  /// Calls visit(slot, its points, the manifold of each lane) for each slot.
  template <class Visit>
  void visit_slots(Visit visit) const {
    for (std::size_t i = 0; i < slots_.size(); ++i)
      visit(slots_[i], points_.data() + slots_[i].first_point, order.dealt().data() + i * T::num_lanes);
  }
  /// Likewise, and may change the points.
  template <class Visit>
  void change_slots(Visit visit) {
    for (std::size_t i = 0; i < slots_.size(); ++i)
      visit(slots_[i], points_of(slots_[i]), order.dealt().data() + i * T::num_lanes);
  }
  /// Solves the contacts of one colour. `last`: see ContactSolver::solve().
  void sweep(TwistRows<T>& twists, const Parameters& parameters, const RowLaw<Scalar>& law, int color,
             const SweepOrder::Points& points, bool last) {
    const ManifoldOrder::SlotRange range = order.slots_of(color);
    if (range.first == range.end) return;
    const ContactSolver<T, two_bodies, kind> solver(parameters, law);
    for (int i = range.first; i < range.end; ++i) {
      Slot& slot = slots_[static_cast<std::size_t>(i)];
      solver.solve(twists, slot, points_of(slot), points, last);
    }
  }

 private:
  using Point = ContactPoint<typename T::V, two_bodies, kind>;
  using Slot = SlotOf<T, two_bodies, kind>;

  void cut() {
    slots_.resize(static_cast<std::size_t>(order.num_slots()));
    int num_points = 0;
    for (int i = 0; i < order.num_slots(); ++i) {
      Slot& slot = slots_[static_cast<std::size_t>(i)];
      slot.first_point = num_points;
      slot.num_points = order.num_points(i);
      num_points += slot.num_points;
    }
    if (static_cast<std::size_t>(num_points) > points_.size())  // constructing points costs more than memory
      points_.resize(static_cast<std::size_t>(num_points));
  }
  Point* points_of(const Slot& slot) { return points_.data() + slot.first_point; }
  PBMPI_LANES bool has_bounce() {
    for (const Slot& slot : slots_) {
      for (int i = 0; i < slot.num_points; ++i) {
        if (T::any(points_of(slot)[i].bounce)) return true;
      }
    }
    return false;
  }

  bool may_bounce_ = false;  ///< do bodies of any contact part when they touch in this step?
  std::vector<Slot> slots_;
  std::vector<Point> points_;
};

template <class T>
class ContactLists {
 public:
  using Parameters = ContactParameters<typename T::Scalar>;

  /// `frictionless`: the kind of rows that contacts without friction get; `rough`: the same as with friction.
  explicit ContactLists(ContactKind frictionless) : frictionless_(frictionless) {}

  /// `rubbing`: the kind of rows that contacts with friction get from now on, rough or patched.
  void start(ContactKind rubbing) { rubbing_ = rubbing; }
  void clear() {
    for_each([](auto& list) { list.order.clear(); });
    num_colors_ = 0;
  }

  /// Calls visit(manifold) for those of one world, in canonical order, of which the first body is one with
  /// `moves(body)`. `place_of(body)`: the lane place of a body or the environment.
  template <class Moves, class PlaceOf, class Visit>
  void paint_world(int num_bodies, const model::SolvedContacts& solved, Moves moves, PlaceOf place_of,
                   Visit visit) {
    const std::span<const model::Contact> contacts = solved.contacts;
    if (!contacts.empty()) painter_.start(num_bodies);
    for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
      const model::Contact& first = contacts[begin];
      const std::size_t last = std::min(contacts.size(), begin + ManifoldOrder::most_points);
      end = begin + 1;
      if (!moves(first.body_a)) continue;
      while (end < last && belong_together(first, contacts[end])) ++end;
      const model::SolvedContacts points = solved.part(begin, end - begin);
      visit(Manifold{points.contacts.data(), points.forces.data(), static_cast<short>(end - begin),
                     static_cast<short>(painter_.paint(first.body_a, first.body_b)), place_of(first.body_a),
                     place_of(first.body_b)});
    }
  }
  /// Adds a manifold, whose points must stay valid during the step.
  void add(const Manifold& manifold) {
    num_colors_ = std::max(num_colors_, manifold.color + 1);
    order_of(*manifold.points).add(manifold);
  }

  void build(const BodyLanes<T>& bodies, const Parameters& parameters) {
    for_each([&](auto& list) { list.build(bodies, parameters); });
  }
  void advance(const BodyLanes<T>& bodies, const Parameters& parameters) {
    for_each([&](auto& list) { list.advance(bodies, parameters); });
  }
  /// See ContactMemory.
  void carry(const Parameters& parameters) {
    for_each([&](auto& list) { list.carry(parameters); });
  }
  void remember(const Parameters& parameters) {
    for_each([&](auto& list) { list.remember(parameters); });
  }
  /// See ContactSolver.
  void forget_open(const TwistRows<T>& twists, const Parameters& parameters) {
    for_each([&](auto& list) { list.forget_open(twists, parameters); });
  }
  void bounce(TwistRows<T>& twists, const Parameters& parameters) {
    for_each([&](auto& list) { list.bounce(twists, parameters); });
  }
  /// Applies the impulses with which the contacts start to the bodies.
  void push_carried(TwistRows<T>& twists) {
    for_each([&](auto& list) { list.push_carried(twists); });
  }
  /// Calls visit(slot, points, manifolds) for each slot of each kind, as last solved.
  template <class Visit>
  void visit_slots(Visit visit) const {
    for_each([&](const auto& list) { list.visit_slots(visit); });
  }
  /// Likewise, and may change the points.
  template <class Visit>
  void change_slots(Visit visit) {
    for_each([&](auto& list) { list.change_slots(visit); });
  }
  /// Sweeps colour by colour, in an order that the key gives; in ascending order without a key. `last`: is it
  /// the substep's last sweep?
  void sweep(TwistRows<T>& twists, const Parameters& parameters, const RowLaw<typename T::Scalar>& law,
             std::optional<std::uint64_t> key, bool last) {
    if (key) {
      order_.shuffle(num_colors_, *key);
    } else {
      order_.sort(num_colors_);
    }
    for (const int color : order_.colors())
      for_each([&](auto& list) { list.sweep(twists, parameters, law, color, order_.points(), last); });
  }
  /// Calls visit(slot) for the slots of bodies in contact, for some of them more than once.
  template <class Visit>
  void for_each_body_slot(Visit visit) const {
    for_each([&](const auto& list) { list.order.for_each_place(visit); });
  }

 private:
  bool belong_together(const model::Contact& a, const model::Contact& b) const {
    if (a.body_a != b.body_a || a.body_b != b.body_b || (a.mu > 0) != (b.mu > 0)) return false;
    return rubbing_ != ContactKind::patched || a.mu == 0 || make_a_patch(a, b);
  }
  /// Do the contacts lie in one plane, to a hundredth of the friction force?
  static bool make_a_patch(const model::Contact& a, const model::Contact& b) {
    constexpr double least_cosine = 0.99995;
    return a.mu == b.mu && a.normal.dot(b.normal) > least_cosine;
  }
  template <bool two_bodies>
  using Kinds = std::tuple<
      ContactList<T, two_bodies, ContactKind::central>, ContactList<T, two_bodies, ContactKind::smooth>,
      ContactList<T, two_bodies, ContactKind::rough>, ContactList<T, two_bodies, ContactKind::patched>>;

  ManifoldOrder& order_of(const model::Contact& contact) {
    const bool rubs = contact.mu > 0 || frictionless_ == ContactKind::rough;
    const ContactKind kind = rubs ? rubbing_ : frictionless_;
    return contact.body_b == model::no_body ? order_of(one_body_, kind) : order_of(two_bodies_, kind);
  }
  template <class Lists>
  static ManifoldOrder& order_of(Lists& lists, ContactKind kind) {
    switch (kind) {
      case ContactKind::central:
        return std::get<0>(lists).order;
      case ContactKind::smooth:
        return std::get<1>(lists).order;
      case ContactKind::rough:
        return std::get<2>(lists).order;
      case ContactKind::patched:
        break;
    }
    return std::get<3>(lists).order;
  }
  template <class Visit>
  void for_each(Visit visit) {
    for_each(*this, visit);
  }
  template <class Visit>
  void for_each(Visit visit) const {
    for_each(*this, visit);
  }
  template <class Self, class Visit>
  static void for_each(Self& self, Visit visit) {
    const auto all = [&](auto&... list) { (visit(list), ...); };
    std::apply(all, self.one_body_);
    std::apply(all, self.two_bodies_);
  }

  ContactKind frictionless_, rubbing_ = ContactKind::rough;
  ContactColors painter_;
  int num_colors_ = 0;  ///< the most that a world has
  SweepOrder order_;
  Kinds<false> one_body_;
  Kinds<true> two_bodies_;
};

}  // namespace pbmpi::solver
