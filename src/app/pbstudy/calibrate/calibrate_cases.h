/// The cases of "pbstudy calibrate": each a part of the harness, timed under one load.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbstudy/study/study_options.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

struct CalibrateOptions {
  int repeats = 9;            ///< rounds in which each case is timed once
  int largest_ranks = 16384;  ///< the most ranks for which root's work is timed
  std::uint64_t seed = 1;     ///< for the order of cases in a round
  std::string output;
  CommonOptions common;
  std::string command_line;
};

/// Throws core::InputError with one clear message.
CalibrateOptions parse_calibrate_options(const std::vector<std::string>& args);

Manual calibrate_manual();
Study run_calibrate;

/// The part that was timed.
enum class TimedPart {
  frame,    ///< worlds without physics, on one rank
  unpack,   ///< root: reads the worlds of all other ranks from one array
  balance,  ///< root: decides that no world moves
  table,    ///< the table of where the bodies of all worlds begin
  hash,     ///< the hash of a run from those of its worlds
  bodies,   ///< hashes of worlds from their bodies
  message,  ///< half a message there and back
  send,     ///< a message of a burst, at its sender
  receive,  ///< a message of a burst, at its receiver
};
inline constexpr std::array<std::string_view, 9> timed_part_names = {
    "frame", "unpack", "balance", "table", "hash", "bodies", "message", "send", "receive"};

/// Members that do not concern its part are 0.
struct TimedCase {
  TimedPart part = TimedPart::frame;
  std::int64_t ranks = 1;
  std::int64_t worlds = 0;
  std::int64_t bodies = 0;  ///< per world
  std::int64_t steps = 0;   ///< per frame
  std::int64_t bytes = 0;   ///< per message
  double seconds = 0;
};

/// Cases without seconds; `num_ranks`: the ranks available. Those of one rank come first, then those in which
/// all ranks take part: frames of all of them, and messages.
std::vector<TimedCase> make_calibrate_cases(int num_ranks, int largest_ranks);

/// Does a case need other ranks?
bool is_collective(const TimedCase& one);

/// The cases 0 to `num_cases` - 1 in the random order of a round.
std::vector<std::size_t> order_of_round(std::size_t num_cases, std::uint64_t seed, int round);

/// Seconds of a frame of worlds without physics; the shortest of a few. Collective over `comm`, which is the
/// null communicator for frames of one rank.
double time_frame(const mpi::Communicator& comm, const TimedCase& one);

/// Seconds of root's work for one.ranks ranks, none of which is there. Not collective.
double time_root(const TimedCase& one);

/// Seconds of a message between ranks 0 and 1; collective over the two. Measured at the rank that the part
/// names.
double time_message(const mpi::Communicator& comm, const TimedCase& one);

}  // namespace pbmpi::app
