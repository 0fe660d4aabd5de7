#include "solver/parts/fine_contacts.h"

#include <algorithm>

namespace pbmpi::solver {

void FineContacts::begin(std::span<const PartedWorld> worlds) {
  parted_ = worlds;
  any_ = false;
  for (std::size_t w = 0; w < worlds.size(); ++w) any_ |= is_fine(static_cast<int>(w));
  if (!any_) return;
  if (worlds_.size() < worlds.size()) worlds_.resize(worlds.size());
  for (std::size_t w = 0; w < worlds.size(); ++w) split(w);
}

bool FineContacts::is_fine(int world) const {
  const IslandShares* shares = parted_[static_cast<std::size_t>(world)].shares;
  return shares != nullptr && shares->any_fine();
}

void FineContacts::split(std::size_t world) {
  World& own = worlds_[world];
  own.others.clear();
  own.ended.clear();
  own.approaching.clear();
  const PartedWorld& parted = parted_[world];
  if (!any(static_cast<int>(world))) return;
  for (std::size_t i = 0; i < parted.contacts.contacts.size(); ++i) {
    const model::Contact& contact = parted.contacts.contacts[i];
    if (contact.is_approach()) {
      own.approaching.push_back(contact.body_a);
      if (contact.body_b != model::no_body) own.approaching.push_back(contact.body_b);
    } else if (parted.shares->pieces(contact.body_a) == 1) {
      own.others.add(parted.contacts, i);
    }
  }
}

model::SolvedContacts FineContacts::others(int world) {
  return any(world) ? at(world).others.solved() : parted_[static_cast<std::size_t>(world)].contacts;
}

RenewedContacts* FineContacts::begin_part(std::span<const std::vector<int>> bodies, Pack& pack) {
  pieces_.clear();
  if (!any_) return nullptr;
  pack_ = &pack;
  for (std::size_t w = 0; w < bodies.size(); ++w) {
    if (!any(static_cast<int>(w))) continue;
    for (const int body : bodies[w]) {
      const int pieces = parted_[w].shares->pieces(body);
      if (pieces > 1 && std::ranges::find(pieces_, pieces) == pieces_.end()) pieces_.push_back(pieces);
    }
  }
  if (pieces_.empty()) return nullptr;
  std::ranges::sort(pieces_);
  if (groups_.size() < pieces_.size()) groups_.resize(pieces_.size());
  sort_bodies(bodies);
  sort_contacts();
  return this;
}

void FineContacts::sort_bodies(std::span<const std::vector<int>> bodies) {
  for (Group& group : groups_) {
    group.bodies.resize(bodies.size());
    group.contacts.resize(bodies.size());
    for (std::size_t w = 0; w < bodies.size(); ++w) {
      group.bodies[w].clear();
      group.contacts[w].clear();
    }
  }
  for (std::size_t w = 0; w < bodies.size(); ++w) {
    if (!any(static_cast<int>(w))) continue;
    std::vector<int>& group_of_body = worlds_[w].group_of_body;
    group_of_body.assign(parted_[w].model->bodies.size(), -1);
    for (const int body : bodies[w]) {
      const auto found = std::ranges::find(pieces_, parted_[w].shares->pieces(body));
      if (found == pieces_.end()) continue;
      const auto group = static_cast<std::size_t>(found - pieces_.begin());
      group_of_body[static_cast<std::size_t>(body)] = static_cast<int>(group);
      groups_[group].bodies[w].push_back(body);
    }
    for (Group& group : groups_) parted_[w].shares->sort_by_island(group.bodies[w]);
  }
}

void FineContacts::sort_contacts() {
  for (std::size_t w = 0; w < parted_.size(); ++w) {
    if (!any(static_cast<int>(w))) continue;
    const model::SolvedContacts& all = parted_[w].contacts;
    for (std::size_t i = 0; i < all.contacts.size(); ++i) {
      const model::Contact& contact = all.contacts[i];
      const int group = worlds_[w].group_of_body[static_cast<std::size_t>(contact.body_a)];
      if (group >= 0 && !contact.is_approach())
        groups_[static_cast<std::size_t>(group)].contacts[w].add(all, i);
    }
  }
  for (std::size_t group = 0; group < pieces_.size(); ++group) {
    groups_[group].solved.clear();
    for (OwnContacts& own : groups_[group].contacts) groups_[group].solved.push_back(own.solved());
  }
}

void FineContacts::find(std::size_t group, double piece_s) {
  for (std::size_t w = 0; w < parted_.size(); ++w) {
    const std::vector<int>& bodies = groups_[group].bodies[w];
    if (bodies.empty()) continue;
    const int world = static_cast<int>(w);
    OwnContacts& own = groups_[group].contacts[w];
    ContactRecall& recall = worlds_[w].recall;
    parted_[w].shares->collide(*pack_, world, bodies, piece_s, own.contacts);
    recall.recall(
        own.contacts, own.forces, [&](int body) { return pack_->centre(world, body); },
        [](const model::ContactForce&) { return false; });
    own.forces.assign(recall.forces().begin(), recall.forces().end());
    groups_[group].solved[w] = own.solved();
  }
}

void FineContacts::end_part() {
  for (std::size_t group = 0; group < pieces_.size(); ++group) {
    for (std::size_t w = 0; w < parted_.size(); ++w)
      worlds_[w].ended.merge(groups_[group].contacts[w].solved());
  }
  pieces_.clear();
}

void FineContacts::end() {
  if (!any_) return;
  for (std::size_t w = 0; w < parted_.size(); ++w) worlds_[w].ended.merge(worlds_[w].others.solved());
}

void FineContacts::OwnContacts::clear() {
  contacts.clear();
  forces.clear();
}

void FineContacts::OwnContacts::add(const model::SolvedContacts& from, std::size_t index) {
  contacts.push_back(from.contacts[index]);
  forces.push_back(from.forces[index]);
}

void FineContacts::OwnContacts::merge(const model::SolvedContacts& from) {
  const auto join = [](auto& own, const auto& more) {
    const auto num_own = std::ssize(own);
    own.insert(own.end(), more.begin(), more.end());
    std::ranges::inplace_merge(own, own.begin() + num_own, {}, [](const auto& each) { return each.geoms; });
  };
  join(contacts, from.contacts);
  join(forces, from.forces);
}

}  // namespace pbmpi::solver
