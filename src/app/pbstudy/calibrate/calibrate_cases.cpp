#include "app/pbstudy/calibrate/calibrate_cases.h"

#include <algorithm>
#include <numeric>

#include "core/random.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description calibrate_options_description() {
  po::options_description how("How to measure");
  how.add_options()  //
      ("repeats", po::value<int>()->default_value(9)->value_name("N"),
       "rounds, in each of which every case is timed once, in an order of its own")  //
      ("largest-ranks", po::value<int>()->default_value(16384)->value_name("N"),
       "ranks up to which one process plays root; 131072 takes about 2 GB of memory");
  add_seed_option("of the order of the cases", how);
  po::options_description write("What to write");
  write.add_options()("output,o", po::value<std::string>()->default_value("calibrate.h5")->value_name("FILE"),
                      "HDF5 file of the study (io/SCHEMA.md)");
  po::options_description all;
  all.add(how).add(write).add(common_options_description());
  return all;
}

}  // namespace

Manual calibrate_manual() {
  return {
      .name = "pbstudy calibrate",
      .about =
          "pbstudy calibrate measures what pbmpi costs beside the physics. Worlds of known cost, without any "
          "physics, go through the frame loop of a run; two ranks exchange messages; one process does "
          "what root does for up to --largest-ranks ranks, without these. From the times come the costs of a "
          "frame, a world, a body, a rank, a message and a byte, with which pbreport computes what a frame "
          "takes on numbers of ranks that this machine does not have.",
      .usage = "mpirun -n 2 pbstudy calibrate [options]",
      .options = calibrate_options_description(),
      .notes = {"Give each rank a core of its own. One rank measures no messages; with more than two, two of "
                "them do. The study takes seconds and keeps no journal."},
      .examples = {"mpirun -n 2 pbstudy calibrate", "pbreport calibrate.h5 --markdown"}};
}

CalibrateOptions parse_calibrate_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_command_line(args, calibrate_options_description());
  CalibrateOptions options;
  options.common = common_options(values);
  options.command_line = "pbstudy calibrate";
  for (const std::string& arg : args) options.command_line += " " + arg;
  options.repeats = given(values, "repeats", 1).value_or(9);
  options.largest_ranks = given(values, "largest-ranks", 64).value_or(16384);
  options.seed = given_seed(values);
  options.output = output_path(values, "output").value();
  return options;
}

std::vector<TimedCase> make_calibrate_cases(int num_ranks, int largest_ranks) {
  std::vector<TimedCase> cases;
  const auto add_frames = [&](std::int64_t ranks) {
    for (const std::int64_t worlds : {4, 64, 1024}) {
      for (const std::int64_t bodies : {1, 37}) {
        for (const std::int64_t steps : {1, 6})
          cases.push_back({TimedPart::frame, ranks, worlds, bodies, steps, 0, 0});
      }
    }
  };
  add_frames(1);
  for (std::int64_t ranks = 64; ranks <= largest_ranks; ranks *= ranks < 16384 ? 16 : 8) {
    for (const std::int64_t each : {1, 4}) {
      const std::int64_t worlds = ranks * each;
      for (const std::int64_t bodies : {1, 37})
        cases.push_back({TimedPart::unpack, ranks, worlds, bodies, 0, 0, 0});
      for (const TimedPart part : {TimedPart::balance, TimedPart::table, TimedPart::hash})
        cases.push_back({part, ranks, worlds, 0, 0, 0, 0});
    }
  }
  cases.push_back({TimedPart::bodies, 1, 256, 37, 0, 0, 0});
  if (num_ranks == 1) return cases;
  add_frames(num_ranks);
  for (const std::int64_t bytes : {8, 4096, 65536, 1048576})
    cases.push_back({TimedPart::message, 2, 0, 0, 0, bytes, 0});
  cases.push_back({TimedPart::send, 2, 0, 0, 0, 8, 0});
  cases.push_back({TimedPart::receive, 2, 0, 0, 0, 8, 0});
  return cases;
}

bool is_collective(const TimedCase& one) {
  const bool is_message =
      one.part == TimedPart::message || one.part == TimedPart::send || one.part == TimedPart::receive;
  return is_message || (one.part == TimedPart::frame && one.ranks > 1);
}

std::vector<std::size_t> order_of_round(std::size_t num_cases, std::uint64_t seed, int round) {
  std::vector<std::size_t> order(num_cases);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return core::mix_key(seed, static_cast<std::uint64_t>(round), i); };
  std::ranges::sort(order, {}, key);
  return order;
}

}  // namespace pbmpi::app
