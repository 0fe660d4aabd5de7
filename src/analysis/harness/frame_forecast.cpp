#include "analysis/harness/frame_forecast.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "analysis/harness/frame_traffic.h"

namespace pbmpi::analysis {
namespace {

/// When a rank begins to hand on, and when it is done, counted from the moment when the ranks have packed.
struct Stream {
  double first_s = 0, last_s = 0;
  std::int64_t bytes = 0;
};

double message_s(const LinkCosts& link) { return std::max(link.overhead_s, link.gap_s); }

/// A rank that receives streams and forwards the data piece by piece.
class RelayedStream {
 public:
  RelayedStream(const LinkCosts& link, std::int64_t piece_bytes, std::int64_t own_bytes)
      : link_(link), piece_bytes_(piece_bytes), bytes_(own_bytes), is_full_(own_bytes >= piece_bytes) {}

  void take(const Stream& child) {
    if (child.bytes == 0) return;
    const double pieces = std::ceil(static_cast<double>(child.bytes) / static_cast<double>(piece_bytes_));
    const double begin_s = std::max(now_s_, child.first_s + link_.latency_s);
    const double busy_s = pieces * message_s(link_) + static_cast<double>(child.bytes) * link_.byte_s;
    const auto last_bytes = static_cast<double>(std::min(child.bytes, piece_bytes_));
    // Not before the child's last piece has arrived.
    const double end_s = std::max(
        begin_s + busy_s, child.last_s + link_.latency_s + message_s(link_) + last_bytes * link_.byte_s);
    if (!is_full_ && bytes_ + child.bytes >= piece_bytes_) {
      const auto missing = static_cast<double>(std::max<std::int64_t>(piece_bytes_ - bytes_, 0));
      full_s_ = begin_s + (end_s - begin_s) * missing / static_cast<double>(child.bytes);
      is_full_ = true;
    }
    now_s_ = end_s;
    bytes_ += child.bytes;
  }

  Stream handed_on() const {
    const double pieces = std::ceil(static_cast<double>(bytes_) / static_cast<double>(piece_bytes_));
    const double last_s = now_s_ + pieces * link_.overhead_s;
    return {is_full_ ? full_s_ + link_.overhead_s : last_s, last_s, bytes_};
  }
  double now_s() const { return now_s_; }

 private:
  LinkCosts link_;
  std::int64_t piece_bytes_;
  std::int64_t bytes_;
  double now_s_ = 0;
  bool is_full_;
  double full_s_ = 0;  ///< when the first piece became full
};

double ranks_of(const HarnessLoad& load) { return static_cast<double>(load.num_ranks); }
double worlds_of_a_rank(const HarnessLoad& load) { return static_cast<double>(load.worlds_of(0)); }

double step_s(const HarnessLoad& load) {
  const double worlds = worlds_of_a_rank(load);
  const double mean_s = worlds * load.steps_per_frame * load.step_s;
  return mean_s * (1 + load.variation * std::sqrt(2 * std::log(ranks_of(load)) / std::max(worlds, 1.0)));
}

}  // namespace

double FrameForecast::total_s() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }

FramePart FrameForecast::wall() const {
  const auto most = std::max_element(seconds.begin() + 1, seconds.end());
  return static_cast<FramePart>(most - seconds.begin());
}

double gather_s(const HarnessLoad& load, const LinkCosts& link, const GatherShape& shape) {
  const mpi::RankTree tree(load.num_ranks, shape.radix);
  const std::int64_t bytes_each = bytes_of_world(load.bodies_each);
  std::vector<Stream> streams(static_cast<std::size_t>(load.num_ranks));
  for (int rank = load.num_ranks - 1; rank >= 0; --rank) {  // children have higher numbers
    RelayedStream stream(link, shape.piece_bytes, rank == 0 ? 0 : bytes_each * load.worlds_of(rank));
    for (const int child : tree.children(rank)) stream.take(streams[static_cast<std::size_t>(child)]);
    if (rank == 0) return stream.now_s();
    streams[static_cast<std::size_t>(rank)] = stream.handed_on();
  }
  return 0;
}

FrameForecast frame_forecast(const HarnessLoad& load, const HarnessCosts& costs, const GatherShape& shape) {
  const double worlds = worlds_of_a_rank(load), all_worlds = static_cast<double>(load.num_worlds);
  const double bodies = static_cast<double>(load.bodies_each);
  const double round_s = costs.link.latency_s + 2 * costs.link.overhead_s;
  FrameForecast frame;
  frame[FramePart::step] = step_s(load);
  frame[FramePart::harness] =
      costs.frame_s + worlds * (costs.world_frame_s + load.steps_per_frame * costs.world_step_s +
                                bodies * costs.body_frame_s);
  if (load.num_ranks == 1) return frame;
  frame[FramePart::agreement] = rounds_of_allreduce(load.num_ranks) * round_s;
  frame[FramePart::gather] = gather_s(load, costs.link, shape);
  frame[FramePart::unpack] = (all_worlds - worlds) * (costs.unpack_world_s + bodies * costs.unpack_body_s);
  frame[FramePart::balance] = all_worlds * costs.balance_world_s + ranks_of(load) * costs.balance_rank_s;
  frame[FramePart::verdict] = std::ceil(std::log2(ranks_of(load))) * round_s;
  return frame;
}

}  // namespace pbmpi::analysis
