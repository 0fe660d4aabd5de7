/// The parts of a pack that a step takes one after the other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/islands.h"
#include "solver/contacts/manifold_order.h"
#include "solver/joints/joint_batches.h"
#include "solver/layout/lane_places.h"

namespace pbmpi::solver {

/// A chunk has the batches of some cells, and the contacts of their bodies: cells are in one chunk if
/// contacts connect them. Chunks have nothing in common, so that a step may take all substeps of one before
/// it begins with the next, while its bodies and rows stay in the cache.
template <class T>
class StepChunks {
 public:
  using Batch = typename JointBatches<T>::Batch;
  struct Chunk {
    std::span<const Batch> batches;       ///< in the order of their slots
    std::span<const Manifold> manifolds;  ///< in the order in which they were added
  };

  /// Starts a step; `places` is borrowed until the next one. `whole`: the step looks at worlds as a whole,
  /// and everything is one chunk.
  void start(const LanePlaces& places, bool whole) {
    places_ = &places;
    cells_.reset(places.num_cells());
    for (int cell = 1; whole && cell < places.num_cells(); ++cell) cells_.unite(0, cell);
    added_.clear();
  }
  void add(const Manifold& manifold) {
    if (places_->num_cells() > 1 && manifold.b.slot != places_->num_slots())
      cells_.unite(places_->cell(manifold.a.slot), places_->cell(manifold.b.slot));
    added_.push_back(manifold);
  }
  /// Bodies in these two slots belong to one chunk.
  void unite(int slot_a, int slot_b) { cells_.unite(places_->cell(slot_a), places_->cell(slot_b)); }
  /// Cuts the manifolds and these batches, which are borrowed, into chunks.
  void cut(std::span<const Batch> batches) {
    all_batches_ = batches;
    chunk_of_cell_.assign(static_cast<std::size_t>(places_->num_cells()), -1);
    num_chunks_ = 0;
    for (int cell = 0; cell < places_->num_cells(); ++cell) {
      const auto first = static_cast<std::size_t>(cells_.find(cell));
      if (chunk_of_cell_[first] < 0) chunk_of_cell_[first] = num_chunks_++;
      chunk_of_cell_[static_cast<std::size_t>(cell)] = chunk_of_cell_[first];
    }
    if (num_chunks_ == 1) return;
    sort(
        batches, [this](const Batch& batch) { return chunk_at(batch.first_slot); }, batches_, first_batch_);
    sort(
        std::span<const Manifold>(added_), [this](const Manifold& one) { return chunk_at(one.a.slot); },
        manifolds_, first_manifold_);
  }
  int size() const { return num_chunks_; }
  /// The chunk of the bodies in a slot.
  int chunk_at(int slot) const { return chunk_of_cell_[static_cast<std::size_t>(places_->cell(slot))]; }
  Chunk operator[](int chunk) const {
    if (num_chunks_ == 1) return {all_batches_, added_};
    return {part(batches_, first_batch_, chunk), part(manifolds_, first_manifold_, chunk)};
  }

 private:
  template <class Item, class ChunkOf>
  void sort(std::span<const Item> items, ChunkOf chunk_of, std::vector<Item>& sorted,
            std::vector<std::size_t>& first) {
    first.assign(static_cast<std::size_t>(num_chunks_) + 1, 0);
    for (const Item& item : items) ++first[static_cast<std::size_t>(chunk_of(item)) + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    next_.assign(first.begin(), first.end());
    sorted.resize(items.size());
    for (const Item& item : items) sorted[next_[static_cast<std::size_t>(chunk_of(item))]++] = item;
  }
  template <class Item>
  static std::span<const Item> part(const std::vector<Item>& sorted, const std::vector<std::size_t>& first,
                                    int chunk) {
    const auto at = static_cast<std::size_t>(chunk);
    return std::span(sorted).subspan(first[at], first[at + 1] - first[at]);
  }

  const LanePlaces* places_ = nullptr;
  model::DisjointSets cells_{0};
  std::vector<int> chunk_of_cell_;  ///< [cells]
  int num_chunks_ = 0;
  std::span<const Batch> all_batches_;
  std::vector<Manifold> added_;
  // Of several chunks:
  std::vector<Batch> batches_;                             ///< chunk by chunk
  std::vector<Manifold> manifolds_;                        ///< chunk by chunk
  std::vector<std::size_t> first_batch_, first_manifold_;  ///< [chunks + 1]
  std::vector<std::size_t> next_;                          ///< scratch
};

}  // namespace pbmpi::solver
