/// The masses with which bodies of articulations that have rotors answer to contacts.
#pragma once

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
    const W bodies_touched = T::widen(num_touched);
    W square = Wide::broadcast(0);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) square += answer[i][j] * answer[i][j];
    }
    // The norm is at least the largest eigenvalue.
    const V share_of_mass = 1 / (num_touched * T::sqrt(T::narrow(square)));
    const Sym3L<W> share_of_inertia = inverse(Sym3L<W>{
        answer[3][3] * bodies_touched, answer[4][3] * bodies_touched, answer[5][3] * bodies_touched,
        answer[4][4] * bodies_touched, answer[5][4] * bodies_touched, answer[5][5] * bodies_touched});
    const Sym3L<V> own_inertia = inverse(body.inv_inertia);
    const V half = T::broadcast(0.5F);
    const auto mean = [&](const V& own, const W& share) { return (own + T::narrow(share)) * half; };
    Lent& lent = lent_.emplace_back();
    lent.slot = slot;
    lent.is_touched = is_touched;
    lent.inv_mass = body.inv_mass;
    lent.inv_inertia = body.inv_inertia;
    lent.mass = (1 / body.inv_mass + share_of_mass) * half;
    lent.inertia = {mean(own_inertia.xx, share_of_inertia.xx), mean(own_inertia.xy, share_of_inertia.xy),
                    mean(own_inertia.xz, share_of_inertia.xz), mean(own_inertia.yy, share_of_inertia.yy),
                    mean(own_inertia.yz, share_of_inertia.yz), mean(own_inertia.zz, share_of_inertia.zz)};
    const Sym3L<V> inv_inertia = inverse(lent.inertia);
    const auto is_lent = is_touched > T::broadcast(0);
    body.inv_mass = is_lent ? 1 / lent.mass : body.inv_mass;
    for (V Sym3L<V>::*part :
         {&Sym3L<V>::xx, &Sym3L<V>::xy, &Sym3L<V>::xz, &Sym3L<V>::yy, &Sym3L<V>::yz, &Sym3L<V>::zz})
      body.inv_inertia.*part = is_lent ? inv_inertia.*part : body.inv_inertia.*part;
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
  struct alignas(sizeof(V)) Lent {
    int slot;
    V is_touched;
    V inv_mass;
    Sym3L<V> inv_inertia;
    V mass;            ///< apparent
    Sym3L<V> inertia;  ///< apparent, world frame at the step's start
  };
  std::vector<Lent> lent_;
};

}  // namespace pbmpi::solver
