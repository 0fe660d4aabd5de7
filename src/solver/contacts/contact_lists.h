/// The contacts of a pack in one step. They are of six kinds, swept one after the other: with or without a
/// second body, and central, smooth or rough; and of each kind those of many points before those of few,
/// since a slot takes as long as its longest manifold.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <vector>

#include "solver/contacts/contact_builder.h"

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
  }
  /// Leads the rows on to the next substep.
  void advance(const BodyLanes<T>& bodies, const Parameters& parameters) {
    const ContactBuilder<T, two_bodies, kind> builder(bodies, parameters);
    for (const ContactSlot<T>& slot : slots_) builder.advance(slot, points_of(slot));
  }
  void carry(const BodyLanes<T>& bodies, const Parameters& parameters) {
    const ContactBuilder<T, two_bodies, kind> builder(bodies, parameters);
    for (const ContactSlot<T>& slot : slots_) builder.carry(slot, points_of(slot));
  }
  void remember(const BodyLanes<T>& bodies, const Parameters& parameters) {
    const ContactBuilder<T, two_bodies, kind> builder(bodies, parameters);
    for (std::size_t i = 0; i < slots_.size(); ++i)
      builder.remember(slots_[i], points_of(slots_[i]), order.dealt().data() + i * T::num_lanes);
  }
  void bounce(TwistRows<T>& twists, const Parameters& parameters) {
    const ContactSolver<T, two_bodies, kind> solver(parameters, {});
    for (const ContactSlot<T>& slot : slots_) solver.bounce(twists, slot, points_of(slot));
  }
  void push_carried(TwistRows<T>& twists) {
    for (const ContactSlot<T>& slot : slots_)
      ContactSolver<T, two_bodies, kind>::push_carried(twists, slot, points_of(slot));
  }
  /// visit(slot, its points, the manifold of each lane).
  template <class Visit>
  void visit_slots(Visit visit) const {
    for (std::size_t i = 0; i < slots_.size(); ++i)
      visit(slots_[i], points_.data() + slots_[i].first_point, order.dealt().data() + i * T::num_lanes);
  }
  void sweep(TwistRows<T>& twists, const Parameters& parameters, const RowLaw<Scalar>& law, bool backwards) {
    const ContactSolver<T, two_bodies, kind> solver(parameters, law);
    const std::size_t count = slots_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const ContactSlot<T>& slot = slots_[backwards ? count - 1 - i : i];
      solver.solve(twists, slot, points_of(slot), backwards);
    }
  }

 private:
  using Point = ContactPoint<typename T::V, two_bodies, kind>;

  void cut() {
    slots_.resize(static_cast<std::size_t>(order.num_slots()));
    int num_points = 0;
    for (int i = 0; i < order.num_slots(); ++i) {
      ContactSlot<T>& slot = slots_[static_cast<std::size_t>(i)];
      slot.first_point = num_points;
      slot.num_points = order.num_points(i);
      num_points += slot.num_points;
    }
    if (static_cast<std::size_t>(num_points) > points_.size())  // to make points anew costs more than room
      points_.resize(static_cast<std::size_t>(num_points));
  }
  Point* points_of(const ContactSlot<T>& slot) { return points_.data() + slot.first_point; }

  std::vector<ContactSlot<T>> slots_;
  std::vector<Point> points_;
};

template <class T>
class ContactLists {
 public:
  using Parameters = ContactParameters<typename T::Scalar>;

  /// Says which kind of rows contacts without friction get.
  explicit ContactLists(ContactKind frictionless) : frictionless_(frictionless) {}

  void clear() {
    for_each([](auto& list) { list.order.clear(); });
  }

  /// The contacts of one world, in canonical order, of the bodies of which `moves(body)`. `place_of(body)`:
  /// where a body, or the environment, lies. `forces`: with which they start and end, [contacts] or none.
  /// Spans hold during the step.
  template <class Moves, class PlaceOf>
  void add_world(int num_bodies, std::span<const model::Contact> contacts,
                 std::span<model::ContactForce> forces, Moves moves, PlaceOf place_of) {
    for_each([&](auto& list) { list.order.start_world(num_bodies); });
    for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
      const model::Contact& first = contacts[begin];
      const std::size_t last = std::min(contacts.size(), begin + ManifoldOrder::most_points);
      end = begin + 1;
      if (!moves(first.body_a)) continue;
      while (end < last && belong_together(first, contacts[end])) ++end;
      order_of(first, end - begin)
          .add(contacts.subspan(begin, end - begin), forces.empty() ? nullptr : forces.data() + begin,
               place_of(first.body_a), place_of(first.body_b));
    }
  }

  void build(const BodyLanes<T>& bodies, const Parameters& parameters) {
    for_each([&](auto& list) { list.build(bodies, parameters); });
  }
  void advance(const BodyLanes<T>& bodies, const Parameters& parameters) {
    for_each([&](auto& list) { list.advance(bodies, parameters); });
  }
  /// See ContactBuilder.
  void carry(const BodyLanes<T>& bodies, const Parameters& parameters) {
    for_each([&](auto& list) { list.carry(bodies, parameters); });
  }
  void remember(const BodyLanes<T>& bodies, const Parameters& parameters) {
    for_each([&](auto& list) { list.remember(bodies, parameters); });
  }
  void bounce(TwistRows<T>& twists, const Parameters& parameters) {
    for_each([&](auto& list) { list.bounce(twists, parameters); });
  }
  /// Lets the impulses that the contacts start with act on the bodies.
  void push_carried(TwistRows<T>& twists) {
    for_each([&](auto& list) { list.push_carried(twists); });
  }
  /// visit(slot, points, manifolds) of each slot of each kind, as last solved.
  template <class Visit>
  void visit_slots(Visit visit) const {
    for_each([&](const auto& list) { list.visit_slots(visit); });
  }
  void sweep(TwistRows<T>& twists, const Parameters& parameters, const RowLaw<typename T::Scalar>& law,
             bool backwards) {
    for_each([&](auto& list) { list.sweep(twists, parameters, law, backwards); });
  }
  /// visit(slot of a body that is in contact), some of them more than once.
  template <class Visit>
  void for_each_body_slot(Visit visit) const {
    for_each([&](const auto& list) { list.order.for_each_place(visit); });
  }

 private:
  static bool belong_together(const model::Contact& a, const model::Contact& b) {
    return a.body_a == b.body_a && a.body_b == b.body_b && (a.mu > 0) == (b.mu > 0);
  }
  /// The lists of one kind: manifolds of many points and of few.
  template <bool two_bodies, ContactKind kind>
  using Kind = std::array<ContactList<T, two_bodies, kind>, 2>;
  /// Swept by ascending kind.
  template <bool two_bodies>
  using Kinds = std::tuple<Kind<two_bodies, ContactKind::central>, Kind<two_bodies, ContactKind::smooth>,
                           Kind<two_bodies, ContactKind::rough>>;

  ManifoldOrder& order_of(const model::Contact& contact, std::size_t num_points) {
    const std::size_t few = num_points > 2 ? 0 : 1;
    const ContactKind kind = contact.mu > 0 ? ContactKind::rough : frictionless_;
    return contact.body_b == model::no_body ? order_of(one_body_, kind, few)
                                            : order_of(two_bodies_, kind, few);
  }
  template <class Lists>
  static ManifoldOrder& order_of(Lists& lists, ContactKind kind, std::size_t few) {
    if (kind == ContactKind::central) return std::get<0>(lists)[few].order;
    return kind == ContactKind::smooth ? std::get<1>(lists)[few].order : std::get<2>(lists)[few].order;
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
    const auto both = [&](auto&... kind) { ((visit(kind[0]), visit(kind[1])), ...); };
    std::apply(both, self.one_body_);
    std::apply(both, self.two_bodies_);
  }

  ContactKind frictionless_;
  Kinds<false> one_body_;
  Kinds<true> two_bodies_;
};

}  // namespace pbmpi::solver
