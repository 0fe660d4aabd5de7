/// The masses with which bodies of articulations that have rotors answer to contacts.
#pragma once

#include <array>
#include <vector>

#include "solver/layout/body_lanes.h"

namespace pbmpi::solver {

/// A light leg behind a geared motor resists a contact by far more than its own mass. Contacts that counted
/// with that alone would find the force which stops it only after many sweeps, and remember it as long after
/// it has come to rest: it would be thrown up. They are told the mean of the body's own inertia M and of its
/// share of what the articulation makes it, A^-1 / n, where A is the body's twist under a wrench of 1 with
/// all joints and rotors, and n the number of bodies of the articulation in contact. Turning and moving are
/// taken as independent.
///
/// The impulses p = J^T lambda of contacts are the same whatever the mass: as soon as they are known, the
/// body moves as M says, by M^-1 p, and the articulation is solved anew with that. Sweeps that solve contacts
/// and articulations in turn contract where the apparent masses B^-1 are so large that no eigenvalue of B^-1
/// A over all bodies reaches 2: half of M gives at most a half, half of the shares at most one.
template <class T>
class ApparentMasses {
 public:
  using V = typename T::V;
  using Wide = typename T::Wide;
  using W = typename Wide::V;

  bool any() const { return !lent_.empty(); }

  /// Replaces the masses in `bodies` by the apparent ones. `answer` [6][6]: the twist of the slot's body
  /// under a wrench of 1; `is_touched`: 1 in the lanes in which contacts touch it, else 0; `num_touched`: n.
  void lend(int slot, const W (&answer)[6][6], const V& is_touched, const V& num_touched,
            BodyLanes<T>& bodies) {
    BodyLane<V>& body = bodies.bodies[slot];
    const W own_answer = T::widen(body.inv_mass), bodies_touched = T::widen(num_touched);
    W square = Wide::broadcast(0);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) square += answer[i][j] * answer[i][j];
    }
    // The norm is at least the largest eigenvalue.
    const W share_of_answer =
        T::widen(T::sqrt(T::narrow(square))) * bodies_touched + own_answer * Wide::broadcast(least_share);
    const Sym3L<W> own_turn = widened(body.inv_inertia);
    Sym3L<W> share_of_turn = own_turn;
    int column = 0, row = 0;
    for (W Sym3L<W>::*part : parts<W>()) {
      share_of_turn.*part *= Wide::broadcast(least_share);
      share_of_turn.*part += answer[3 + row][3 + column] * bodies_touched;
      if (++row == 3) row = ++column;
    }
    const Sym3L<W> own_inertia = inverse(own_turn), share_of_inertia = inverse(share_of_turn);
    Lent& lent = lent_.emplace_back();
    lent.slot = slot;
    lent.is_touched = is_touched;
    lent.inv_mass = body.inv_mass;
    lent.inv_inertia = body.inv_inertia;
    const W half = Wide::broadcast(0.5);
    lent.mass = T::narrow((1 / own_answer + 1 / share_of_answer) * half);
    Sym3L<W> inertia;
    for (W Sym3L<W>::*part : parts<W>()) inertia.*part = (own_inertia.*part + share_of_inertia.*part) * half;
    lent.inertia = narrowed(inertia);
    lent.shown_inv_inertia = narrowed(inverse(inertia));
    show(lent, body);
  }
  /// Lends the same apparent masses once more, after the bodies have moved.
  void lend_again(BodyLanes<T>& bodies) {
    for (Lent& lent : lent_) {
      BodyLane<V>& body = bodies.bodies[lent.slot];
      lent.inv_mass = body.inv_mass;
      lent.inv_inertia = body.inv_inertia;
      show(lent, body);
    }
  }
  /// Puts the bodies' own masses back.
  void give_back(BodyLanes<T>& bodies) const {
    for (const Lent& lent : lent_) {
      bodies.bodies[lent.slot].inv_mass = lent.inv_mass;
      bodies.bodies[lent.slot].inv_inertia = lent.inv_inertia;
    }
  }
  /// Lets the impulses that changed the contacts' rows since the slots were up to date act on the bodies' own
  /// masses. The articulations must be solved next.
  void settle(BodyLanes<T>& bodies) const {
    for (const Lent& lent : lent_) {
      const BodyLane<V>& body = bodies.bodies[lent.slot];
      const Twist<V> before = bodies.twists[lent.slot];
      Twist<V> now = bodies.contact_twists.slot(lent.slot);
      const Vec3L<V> linear = before.linear + (now.linear - before.linear) * (lent.mass * body.inv_mass);
      const Vec3L<V> angular =
          before.angular + body.inv_inertia * (lent.inertia * (now.angular - before.angular));
      const auto is_lent = lent.is_touched > T::broadcast(0);
      for (V Vec3L<V>::*part : {&Vec3L<V>::x, &Vec3L<V>::y, &Vec3L<V>::z}) {
        now.linear.*part = is_lent ? linear.*part : now.linear.*part;
        now.angular.*part = is_lent ? angular.*part : now.angular.*part;
      }
      bodies.contact_twists.set_slot(lent.slot, now);
    }
  }
  void clear() { lent_.clear(); }

 private:
  /// The least answer of a share, of the body's own: what joints hold has none, but for rounding.
  static constexpr double least_share = 1e-4;

  template <class L>
  static constexpr std::array<L Sym3L<L>::*, 6> parts() {
    return {&Sym3L<L>::xx, &Sym3L<L>::xy, &Sym3L<L>::xz, &Sym3L<L>::yy, &Sym3L<L>::yz, &Sym3L<L>::zz};
  }
  static Sym3L<W> widened(const Sym3L<V>& m) {
    return {T::widen(m.xx), T::widen(m.xy), T::widen(m.xz), T::widen(m.yy), T::widen(m.yz), T::widen(m.zz)};
  }
  static Sym3L<V> narrowed(const Sym3L<W>& m) {
    return {T::narrow(m.xx), T::narrow(m.xy), T::narrow(m.xz),
            T::narrow(m.yy), T::narrow(m.yz), T::narrow(m.zz)};
  }

  struct alignas(sizeof(V)) Lent {
    int slot;
    V is_touched;
    V inv_mass;
    Sym3L<V> inv_inertia;
    V mass;                      ///< apparent
    Sym3L<V> inertia;            ///< apparent, world frame at the step's start
    Sym3L<V> shown_inv_inertia;  ///< its inverse
  };
  static void show(const Lent& lent, BodyLane<V>& body) {
    const auto is_lent = lent.is_touched > T::broadcast(0);
    body.inv_mass = is_lent ? 1 / lent.mass : body.inv_mass;
    for (V Sym3L<V>::*part : parts<V>())
      body.inv_inertia.*part = is_lent ? lent.shown_inv_inertia.*part : body.inv_inertia.*part;
  }
  std::vector<Lent> lent_;
};

}  // namespace pbmpi::solver
