#include "solver/contacts/contact_recall.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace pbmpi::solver {

using model::ContactForce;

namespace {

/// The end of the rows of one pair of geoms that start at `begin`.
std::size_t end_of_pair(std::span<const ContactForce> rows, std::size_t begin) {
  std::size_t end = begin;
  while (end < rows.size() && rows[end].geoms == rows[begin].geoms) ++end;
  return end;
}

bool comes_first(const ContactForce& a, const ContactForce& b) { return a.geoms < b.geoms; }

}  // namespace

void ContactRecall::match(std::span<const ContactForce> before) {
  std::size_t old = 0;
  for (std::size_t begin = 0, end = 0; begin < forces_.size(); begin = end) {
    end = end_of_pair(forces_, begin);
    while (old < before.size() && comes_first(before[old], forces_[begin])) ++old;
    if (old == before.size()) return;
    if (forces_[begin].geoms != before[old].geoms) continue;
    const std::span<const ContactForce> rows = before.subspan(old, end_of_pair(before, old) - old);
    taken_.assign(rows.size(), 0);
    for (std::size_t i = begin; i < end; ++i) {
      double least = std::numeric_limits<double>::infinity();
      std::size_t nearest = rows.size();
      for (std::size_t row = 0; row < rows.size(); ++row) {
        const double square = (rows[row].arm - forces_[i].arm).squaredNorm();
        if (taken_[row] != 0 || !(square < least)) continue;
        least = square;
        nearest = row;
      }
      if (nearest == rows.size()) break;
      taken_[nearest] = 1;
      forces_[i].normal = rows[nearest].normal;
      forces_[i].friction = rows[nearest].friction;
    }
  }
}

std::vector<model::LoadedContact> ContactRecall::loaded(std::span<const model::Contact> contacts) const {
  std::vector<model::LoadedContact> loaded;
  loaded.reserve(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) loaded.push_back({contacts[i], forces_[i]});
  return loaded;
}

void ContactRecall::store(std::vector<ContactForce>& memory) const {
  memory.clear();
  std::merge(forces_.begin(), forces_.end(), kept_.begin(), kept_.end(), std::back_inserter(memory),
             comes_first);
}

}  // namespace pbmpi::solver
