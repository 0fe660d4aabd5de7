/// The contacts of a chunk in one step: those that serve all of it, and of islands that get contacts of their
/// own in each piece of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solver/contacts/contact_lists.h"
#include "solver/contacts/renewed_contacts.h"

namespace pbmpi::solver {

/// One list holds the contacts that last for the step, and one more each group of RenewedContacts. The lists
/// have no body in common, so that each is swept by itself.
template <class T>
class ContactGroups {
 public:
  using Parameters = ContactParameters<typename T::Scalar>;

  /// See ContactLists.
  explicit ContactGroups(ContactKind frictionless) : frictionless_(frictionless) {
    lists_.emplace_back(frictionless);
  }

  /// Starts a step. `rubbing`: see ContactLists; `renewed`: null, or what finds contacts anew; borrowed.
  void start(ContactKind rubbing, RenewedContacts* renewed) {
    renewed_ = renewed;
    while (lists_.size() < 1 + num_groups()) lists_.emplace_back(frictionless_);
    for (ContactLists<T>& list : lists_) list.start(rubbing);
  }
  /// The contacts that last for the step.
  ContactLists<T>& lasting() { return lists_.front(); }

  /// Begins a chunk with the manifolds that last. `renews`: the islands of all groups belong to it, too.
  void begin_chunk(std::span<const Manifold> manifolds, bool renews) {
    num_lists_ = renews ? 1 + num_groups() : 1;
    lasting().clear();
    for (const Manifold& manifold : manifolds) lasting().add(manifold);
  }
  /// Finds the contacts of the groups of which a piece begins with this substep, of `h` [s] each; before the
  /// first they are known. They must be built next. True if there is any such group; place_of(world, body):
  /// as ContactLists::paint_world(); num_bodies(world).
  template <class PlaceOf, class NumBodies>
  bool renew(int substep, int substeps, const Parameters& parameters, PlaceOf place_of, NumBodies num_bodies);

  void build(const BodyLanes<T>& bodies, const Parameters& parameters) {
    for (ContactLists<T>& list : all()) list.build(bodies, parameters);
  }
  /// Of the groups of the last renew().
  void build_renewed(const BodyLanes<T>& bodies, const Parameters& parameters) {
    for (const std::size_t list : renewed_lists_) lists_[list].build(bodies, parameters);
  }
  void advance(const BodyLanes<T>& bodies, const Parameters& parameters) {
    for (ContactLists<T>& list : all()) list.advance(bodies, parameters);
  }
  void carry(const Parameters& parameters) {
    for (ContactLists<T>& list : all()) list.carry(parameters);
  }
  void remember(const Parameters& parameters) {
    for (ContactLists<T>& list : all()) list.remember(parameters);
  }
  void forget_open(const TwistRows<T>& twists, const Parameters& parameters) {
    for (ContactLists<T>& list : all()) list.forget_open(twists, parameters);
  }
  void bounce(TwistRows<T>& twists, const Parameters& parameters) {
    for (ContactLists<T>& list : all()) list.bounce(twists, parameters);
  }
  void push_carried(TwistRows<T>& twists) {
    for (ContactLists<T>& list : all()) list.push_carried(twists);
  }
  void sweep(TwistRows<T>& twists, const Parameters& parameters, const RowLaw<typename T::Scalar>& law,
             std::optional<std::uint64_t> key, bool last) {
    for (ContactLists<T>& list : all()) list.sweep(twists, parameters, law, key, last);
  }
  template <class Visit>
  void visit_slots(Visit visit) const {
    for (std::size_t i = 0; i < num_lists_; ++i) lists_[i].visit_slots(visit);
  }
  template <class Visit>
  void change_slots(Visit visit) {
    for (ContactLists<T>& list : all()) list.change_slots(visit);
  }
  template <class Visit>
  void for_each_body_slot(Visit visit) const {
    for (std::size_t i = 0; i < num_lists_; ++i) lists_[i].for_each_body_slot(visit);
  }

 private:
  std::size_t num_groups() const { return renewed_ == nullptr ? 0 : renewed_->pieces().size(); }
  std::span<ContactLists<T>> all() { return std::span(lists_).first(num_lists_); }

  ContactKind frictionless_;
  std::vector<ContactLists<T>> lists_;
  std::size_t num_lists_ = 1;  ///< of the chunk
  RenewedContacts* renewed_ = nullptr;
  std::vector<std::size_t> renewed_lists_;
};

template <class T>
template <class PlaceOf, class NumBodies>
bool ContactGroups<T>::renew(int substep, int substeps, const Parameters& parameters, PlaceOf place_of,
                             NumBodies num_bodies) {
  renewed_lists_.clear();
  for (std::size_t i = 1; i < num_lists_; ++i) {
    const int length = substeps_of_piece(substep, renewed_->pieces()[i - 1], substeps);
    if (length == 0) continue;
    ContactLists<T>& list = lists_[i];
    if (substep > 0) {
      list.remember(parameters);
      renewed_->find(i - 1, static_cast<double>(parameters.h) * length);
    }
    list.clear();
    int world = 0;
    for (const model::SolvedContacts& contacts : renewed_->contacts(i - 1)) {
      list.paint_world(
          num_bodies(world), contacts, [](int) { return true; },
          [&](int body) { return place_of(world, body); },
          [&](const Manifold& manifold) { list.add(manifold); });
      ++world;
    }
    renewed_lists_.push_back(i);
  }
  return !renewed_lists_.empty();
}

}  // namespace pbmpi::solver
