/// The contacts of fine islands in a step (fine_islands.h).
#pragma once

#include <span>
#include <vector>

#include "solver/contacts/contact_recall.h"
#include "solver/contacts/renewed_contacts.h"
#include "solver/pack/pack.h"
#include "solver/parts/parted_world.h"

namespace pbmpi::solver {

/// Takes the contacts of fine islands out of a step's, shows them to the pack part by part, and puts those
/// with which the step ends back in their places. A new contact starts with the force of the one before it.
class FineContacts final : public RenewedContacts {
 public:
  /// Begins a step. The worlds and what they refer to must live until its end.
  void begin(std::span<const PartedWorld> worlds);
  bool any() const { return any_; }
  /// Has this world fine islands in the step?
  bool any(int world) const { return any_ && is_fine(world); }
  /// The contacts of the other islands of a world, without approaches.
  model::SolvedContacts others(int world);
  /// After end(): all contacts of a world with fine islands, and their forces, as the step ended.
  model::SolvedContacts ended(int world) { return at(world).ended.solved(); }

  /// Begins a part of the step with these bodies [num_worlds], which are whole islands, in `pack`, which is
  /// borrowed until end_part(). Null if no island among them is fine.
  RenewedContacts* begin_part(std::span<const std::vector<int>> bodies, Pack& pack);
  void end_part();
  void end();

  std::span<const int> pieces() const override { return pieces_; }
  std::span<const int> bodies(std::size_t group, int world) const override {
    return groups_[group].bodies[static_cast<std::size_t>(world)];
  }
  std::span<const int> approaching(int world) const override {
    return worlds_[static_cast<std::size_t>(world)].approaching;
  }
  std::span<const model::SolvedContacts> contacts(std::size_t group) const override {
    return groups_[group].solved;
  }
  void find(std::size_t group, double piece_s) override;

 private:
  /// Contacts of a world with their forces.
  struct OwnContacts {
    std::vector<model::Contact> contacts;
    std::vector<model::ContactForce> forces;

    void clear();
    void add(const model::SolvedContacts& from, std::size_t index);
    /// Adds others, too, in canonical order. All contacts of a pair of geoms come from one side.
    void merge(const model::SolvedContacts& from);
    model::SolvedContacts solved() { return {contacts, forces}; }
  };
  struct World {
    OwnContacts others, ended;
    std::vector<int> approaching;
    std::vector<int> group_of_body;  ///< [num_bodies] of the part; -1: none
    ContactRecall recall;
  };
  /// Of the current part; [num_worlds].
  struct Group {
    std::vector<std::vector<int>> bodies;
    std::vector<OwnContacts> contacts;
    std::vector<model::SolvedContacts> solved;  ///< `contacts`
  };

  bool is_fine(int world) const;
  World& at(int world) { return worlds_[static_cast<std::size_t>(world)]; }
  void split(std::size_t world);
  void sort_bodies(std::span<const std::vector<int>> bodies);
  void sort_contacts();

  std::span<const PartedWorld> parted_;
  std::vector<World> worlds_;  ///< at least [num_worlds]
  Pack* pack_ = nullptr;
  std::vector<int> pieces_;
  std::vector<Group> groups_;  ///< at least [pieces]
  bool any_ = false;
};

}  // namespace pbmpi::solver
