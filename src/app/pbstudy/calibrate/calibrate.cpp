#include <malloc.h>

#include <iostream>
#include <memory>

#include "app/common/provenance.h"
#include "app/pbstudy/calibrate/calibrate_cases.h"
#include "app/pbstudy/study/study_runner.h"
#include "app/pbstudy/study/table_columns.h"
#include "core/statistics.h"
#include "core/system/awaited.h"
#include "core/system/peak_memory.h"
#include "mpi/comm/agreement.h"
#include "synthetic/fixed_cost_stepper.h"

namespace pbmpi::app {
namespace {

using io::Parameter;

/// The seconds of each round, case by case; on root.
using CaseTimes = std::vector<std::vector<double>>;

double time_case(const mpi::Communicator& comm, const TimedCase& one) {
  if (one.part == TimedPart::frame && one.ranks == 1) return time_frame(mpi::Communicator(), one);
  if (one.part == TimedPart::frame) return time_frame(comm, one);
  return is_collective(one) ? time_message(comm, one) : time_root(one);
}

/// Does this rank take part in a case?
bool takes_part(const mpi::Communicator& comm, const TimedCase& one) {
  if (!is_collective(one)) return comm.is_root();
  return one.part == TimedPart::frame || comm.rank() < 2;
}

/// Ranks that take no part in a case wait in a barrier, so that they take no time from those that do.
CaseTimes time_all(const mpi::Communicator& comm, const std::vector<TimedCase>& cases,
                   const CalibrateOptions& options) {
  CaseTimes times(cases.size());
  for (int round = 0; round < options.repeats; ++round) {
    for (const std::size_t i : order_of_round(cases.size(), options.seed, round)) {
      if (takes_part(comm, cases[i])) times[i].push_back(time_case(comm, cases[i]));
      comm.barrier();
    }
  }
  return times;
}

/// Heap bytes per body in a world of many bodies.
double bytes_of_a_body() {
  constexpr int bodies = 4096;
  const auto model = synthetic::make_model(bodies);
  synthetic::FixedCostStepper stepper(0);
  const std::size_t before = mallinfo2().uordblks + mallinfo2().hblkhd;
  stepper.add(0, model, model::initial_state(*model), 0);
  return static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd - before) / bodies;
}

std::vector<io::TableColumn> case_columns(const std::vector<TimedCase>& cases, const CaseTimes& times) {
  const auto integers = [&](const char* name, const char* unit, std::int64_t TimedCase::*number) {
    return column(name, unit, cases, [&](const TimedCase& one) { return one.*number; });
  };
  const auto seconds = [&](const char* name, double q) {
    return column(name, "s", times, [&](const auto& rounds) { return core::quantile(rounds, q); });
  };
  return {column("part", "", cases,
                 [](const TimedCase& one) {
                   return std::string(timed_part_names[static_cast<std::size_t>(one.part)]);
                 }),
          integers("ranks", "", &TimedCase::ranks),
          integers("worlds", "", &TimedCase::worlds),
          integers("bodies", "", &TimedCase::bodies),
          integers("steps", "", &TimedCase::steps),
          integers("bytes", "B", &TimedCase::bytes),
          seconds("seconds", 0.5),
          seconds("seconds_p10", 0.1),
          seconds("seconds_p90", 0.9)};
}

io::TableFile file_of(const Provenance& provenance, const CalibrateOptions& options, std::int64_t rank_bytes,
                      std::vector<io::TableColumn> columns) {
  io::TableFile file = study_file("calibrate", provenance, options.seed, options.repeats);
  for (const Parameter& one :
       {Parameter::of("hosts", static_cast<std::int64_t>(distinct(provenance.hosts).size())),
        Parameter::of("processors", std::int64_t{provenance.processors}),
        Parameter::of("rank_bytes", rank_bytes), Parameter::of("body_bytes", bytes_of_a_body())})
    file.parameters.push_back(one);
  file.tables["cases"] = std::move(columns);
  return file;
}

}  // namespace

core::ExitCode run_calibrate(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const CalibrateOptions options = parse_calibrate_options(args);
  std::unique_ptr<io::TableWriter> writer;
  mpi::agree_on_errors(comm, [&] {
    if (comm.is_root()) writer = std::make_unique<io::TableWriter>(options.output);
  });
  const Provenance provenance = collect_provenance(comm, options.command_line);
  std::array<std::int64_t, 1> rank_bytes = {core::peak_memory_bytes()};
  comm.allreduce(rank_bytes, mpi::Reduce::max);
  const std::vector<TimedCase> cases = make_calibrate_cases(comm.size(), options.largest_ranks);
  const core::Awaited all_ranks("root, which times what the other ranks have no part in");
  const CaseTimes times = time_all(comm, cases, options);
  mpi::agree_on_errors(comm, [&] {
    if (!comm.is_root()) return;
    writer->write(io::study_filetype,
                  file_of(provenance, options, rank_bytes[0], case_columns(cases, times)));
    if (options.common.quiet) return;
    std::cout << cases.size() << " cases, " << options.repeats << " times each, in " << options.output
              << "\nnext: pbreport " << options.output << "\n"
              << std::flush;
  });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
