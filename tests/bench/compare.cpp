#include "compare.h"

#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <filesystem>

#include "core/clock.h"
#include "core/hash.h"
#include "core/statistics.h"
#include "io/run/run_file.h"
#include "mpi/comm/communicator.h"
#include "ode/collide/narrow_phase.h"
#include "ode/objects/engine.h"
#include "ode/ode_stepper.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/step_options.h"

namespace pbmpi::bench {
namespace {

/// CPU seconds of this thread: where other programs share the machine, wall time says little.
double cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Seconds of each measured frame, and the contents of the frames.
struct Result {
  std::string name;
  std::vector<double> frame_s;
  std::vector<double> frame_cpu_s;
  double num_contacts = 0;  ///< mean per step over the measured frames
  std::uint64_t hash = 0;

  double world_steps_per_s(const Subject& subject) const {
    const double steps = static_cast<double>(subject.models.size()) * subject.steps_per_frame;
    return steps / core::quantile(frame_s, 0.5);
  }
};

/// One way to step the subject's worlds.
class Side {
 public:
  explicit Side(std::string name) : name_(std::move(name)) {}
  virtual ~Side() = default;
  virtual void advance_frame() = 0;
  virtual int num_contacts() const = 0;
  virtual model::State state(int world) const = 0;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

/// pbmpi's side, driven as by its frame loop: seeds, canonical contacts, state and observables read out, and
/// recorded if `file` names a file.
class Ours final : public Side {
 public:
  Ours(const Subject& subject, std::string name, std::unique_ptr<stepping::WorldStepper> stepper,
       const std::string& file)
      : Side(std::move(name)), subject_(&subject), stepper_(std::move(stepper)) {
    for (int world = 0; world < num_worlds(); ++world) {
      const auto& model = subject.models[static_cast<std::size_t>(world)];
      stepper_->add(world, model, model::initial_state(*model), 0);
    }
    if (!file.empty()) open(file);
  }
  ~Ours() override {
    if (!file_) return;
    file_->close(false, "");
    std::filesystem::remove(path_);
  }

  void advance_frame() override {
    times_ = {};
    stepper_->advance(subject_->steps_per_frame, times_);
    if (file_) record();
  }
  int num_contacts() const override {
    int sum = 0;
    for (int world = 0; world < num_worlds(); ++world) sum += stepper_->observables(world).contacts;
    return sum;
  }
  model::State state(int world) const override { return stepper_->state(world); }

 private:
  static constexpr int most_frames = 1000;

  int num_worlds() const { return static_cast<int>(subject_->models.size()); }

  std::vector<stepping::LocalWorld> worlds() const {
    std::vector<stepping::LocalWorld> views;
    for (int world = 0; world < num_worlds(); ++world) {
      views.push_back(
          {world, &stepper_->model(world), &stepper_->state(world), &stepper_->observables(world)});
    }
    return views;
  }

  void open(const std::string& path) {
    path_ = path;
    io::RunSetup setup;
    setup.path = path;
    for (const auto& model : subject_->models) {
      setup.table.body_offset.push_back(setup.table.num_bodies() + model->num_bodies());
    }
    setup.worlds = worlds();
    setup.hosts = {"bench"};
    setup.num_frames = most_frames;
    file_ = std::make_unique<io::RunFile>(io::FileGroup{mpi::Communicator::world().fortran_handle(), 0, 1},
                                          std::move(setup));
  }

  void record() {
    const auto views = worlds();
    stepping::FrameRecord frame;
    frame.frame = frame_++;
    frame.step = frame_ * subject_->steps_per_frame;
    frame.time_s = static_cast<double>(frame.step) * subject_->dt_s;
    frame.measured = true;
    frame.worlds = views;
    frame.phases = times_;
    frame.wall_s = times_.useful_s();
    file_->frame_done(frame);
  }

  const Subject* subject_;
  std::unique_ptr<stepping::WorldStepper> stepper_;
  core::PhaseTimes times_;
  std::string path_;
  std::unique_ptr<io::RunFile> file_;
  std::int64_t frame_ = 0;
};

class Bare final : public Side {
 public:
  explicit Bare(const Subject& subject)
      : Side("bare ODE"), subject_(&subject), loop_(subject.models, subject.dt_s, subject.iterations) {}
  void advance_frame() override { loop_.advance(subject_->steps_per_frame); }
  int num_contacts() const override { return loop_.num_contacts(); }
  model::State state(int world) const override { return loop_.state(world); }

 private:
  const Subject* subject_;
  BareOde loop_;
};

void time_frame(Side& side, Result& result) {
  const double start_s = core::now_s();
  const double start_cpu_s = cpu_s();
  side.advance_frame();
  result.frame_cpu_s.push_back(cpu_s() - start_cpu_s);
  result.frame_s.push_back(core::now_s() - start_s);
  result.num_contacts += side.num_contacts();
}

std::uint64_t hash_of(const Side& side, std::size_t num_worlds) {
  core::Hash64 hash;
  for (std::size_t world = 0; world < num_worlds; ++world)
    hash.add(model::hash(side.state(static_cast<int>(world))));
  return hash.value();
}

std::unique_ptr<Side> sor_side(const Subject& subject, const std::string& name,
                               stepping::StepperSettings settings) {
  settings.dt_s = subject.dt_s;
  return std::make_unique<Ours>(subject, name, solver::make_sor_stepper(settings, ode::make_narrow_phase),
                                "");
}

/// sor's default settings with this precision and these instructions.
stepping::StepperSettings sor_settings(stepping::Precision precision, stepping::Simd simd) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.precision = precision;
  settings.simd = simd;
  return settings;
}

/// ODE's law, with the subject's iterations.
stepping::StepperSettings ode_law_settings(const Subject& subject) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  settings.precision = stepping::Precision::single;
  settings.iterations = subject.iterations;
  return settings;
}

/// The bare loop comes first: the others are compared with it.
std::vector<std::unique_ptr<Side>> make_sides(const Subject& subject) {
  using stepping::Precision;
  using stepping::Simd;
  const auto quick = [&] {
    stepping::StepperSettings settings = default_settings(stepping::StepperKind::quick);
    settings.dt_s = subject.dt_s;
    settings.iterations = subject.iterations;
    return ode::make_ode_stepper(settings);
  };
  const std::string path =
      (std::filesystem::temp_directory_path() / ("bench_worlds." + std::to_string(::getpid()) + ".h5"))
          .string();
  stepping::StepperSettings with_ode = sor_settings(Precision::single, Simd::automatic);
  with_ode.law.colliders = stepping::Colliders::ode;
  std::vector<std::unique_ptr<Side>> sides;
  sides.push_back(std::make_unique<Bare>(subject));
  sides.push_back(std::make_unique<Ours>(subject, "quick", quick(), ""));
  sides.push_back(std::make_unique<Ours>(subject, "quick, recorded", quick(), path));
  sides.push_back(sor_side(subject, "sor double, 1 lane", sor_settings(Precision::double_, Simd::off)));
  sides.push_back(sor_side(subject, "sor double, widest", sor_settings(Precision::double_, Simd::automatic)));
  sides.push_back(sor_side(subject, "sor single, widest", sor_settings(Precision::single, Simd::automatic)));
  sides.push_back(sor_side(subject, "sor single, dCollide", with_ode));
  sides.push_back(sor_side(subject, "sor single, law ode", ode_law_settings(subject)));
  return sides;
}

/// The sides alternate frame by frame, and take turns at going first.
void run_round(const Subject& subject, int frames, std::vector<Result>& results) {
  const auto sides = make_sides(subject);
  results.resize(sides.size());
  for (int frame = 0; frame < subject.warmup; ++frame) {
    for (const auto& side : sides) side->advance_frame();
  }
  for (int frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const std::size_t next = (i + static_cast<std::size_t>(frame)) % sides.size();
      time_frame(*sides[next], results[next]);
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    results[i].name = sides[i]->name();
    results[i].hash = hash_of(*sides[i], subject.models.size());
  }
}

/// Median of the frames' CPU time ratios to `bare`, as "time 1.010, speed 0.99".
void print(const Subject& subject, const Result& result, const Result& bare) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < result.frame_cpu_s.size(); ++i) {
    ratios.push_back(result.frame_cpu_s[i] / bare.frame_cpu_s[i]);
  }
  const double ratio = core::quantile(ratios, 0.5);
  std::printf(
      "  %-20s %9.0f world-steps/s  frame %8.3f ms  %5.1f contacts/world  time x %6.3f  speed x %6.2f  hash "
      "%s\n",
      result.name.c_str(), result.world_steps_per_s(subject), 1e3 * core::quantile(result.frame_s, 0.5),
      result.num_contacts / static_cast<double>(result.frame_s.size() * subject.models.size()), ratio,
      1 / ratio, core::to_hex(result.hash).c_str());
}

}  // namespace

void compare(const Subject& subject, int frames, int rounds) {
  const ode::Engine engine;
  std::vector<Result> results;
  for (int round = 0; round < rounds; ++round) run_round(subject, frames, results);
  std::printf(
      "%s: %zu worlds, %d bodies, dt %g s, ODE and law ode with %d iterations, %d x %d frames of %d steps;\n"
      "time and speed are medians of the frames' CPU time ratios to the bare ODE loop of the same round\n",
      subject.name.c_str(), subject.models.size(), subject.num_bodies(), subject.dt_s, subject.iterations,
      rounds, frames, subject.steps_per_frame);
  for (const Result& result : results) print(subject, result, results.front());
}

}  // namespace pbmpi::bench
