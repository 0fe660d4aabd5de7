/// The border of the library: turns exceptions thrown inside into those that its header promises.
#include "pbmpi/batch.h"

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "api/version.h"
#include "api/world_set.h"
#include "core/error.h"

namespace pbmpi {
namespace {

template <class Function>
decltype(auto) translated(Function&& function) {
  try {
    return std::forward<Function>(function)();
  } catch (const core::InputError& error) {
    throw std::invalid_argument(error.what());
  } catch (const core::RunError& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace

// Hidden, whatever visibility the compiler is told for the enclosing class.
struct __attribute__((visibility("hidden"))) Batch::Worlds final : api::WorldSet {
  using WorldSet::WorldSet;
};

Batch::Batch(const BatchOptions& options)
    : worlds_(translated([&] { return std::make_unique<Worlds>(options); })) {}
Batch::~Batch() = default;
Batch::Batch(Batch&&) noexcept = default;
Batch& Batch::operator=(Batch&&) noexcept = default;

int Batch::num_worlds() const { return worlds_->recipe().num_worlds(); }
int Batch::num_local_worlds() const { return static_cast<int>(worlds_->ids().size()); }
std::span<const int> Batch::world_ids() const { return worlds_->ids(); }
int Batch::num_bodies() const { return worlds_->layout().num_bodies(); }
std::span<const std::string> Batch::body_names() const { return worlds_->layout().body_names(); }
double Batch::dt_s() const { return worlds_->dt_s(); }
int Batch::steps_per_frame() const { return worlds_->recipe().steps_per_frame(); }
std::span<const std::int64_t> Batch::steps() const { return worlds_->steps(); }

void Batch::step(int num_steps) {
  translated([&] { worlds_->step(num_steps); });
}

const BatchState& Batch::state() {
  return translated([&]() -> const BatchState& { return worlds_->state(); });
}

void Batch::set_state(const BatchState& state, std::span<const bool> mask) {
  translated([&] { worlds_->set_state(state, mask); });
}

void Batch::reset(std::span<const bool> mask, std::uint64_t seed, std::span<const Parameters> parameters) {
  translated([&] { worlds_->reset(mask, seed, parameters); });
}

std::span<const Motor> Batch::motors() const { return worlds_->layout().motors(); }

void Batch::set_motor_velocities(std::span<const double> velocities) {
  translated([&] { worlds_->set_motor_velocities(velocities); });
}

void Batch::set_targets(std::span<const double> positions) {
  translated([&] { worlds_->set_targets(positions); });
}

std::span<const JointAxis> Batch::joint_axes() const { return worlds_->layout().joint_axes(); }

const BatchJoints& Batch::joints() {
  return translated([&]() -> const BatchJoints& { return worlds_->joints(); });
}

void Batch::set_forces(std::span<const double> forces, std::span<const double> torques) {
  translated([&] { worlds_->set_forces(forces, torques); });
}

void Batch::set_efforts(std::span<const double> efforts) {
  translated([&] { worlds_->set_efforts(efforts); });
}

std::vector<std::string> Batch::observable_names() const { return Worlds::observable_names(); }

std::vector<double> Batch::observable(std::string_view name) const {
  return translated([&] { return worlds_->observable(name); });
}

std::vector<std::byte> Batch::save() const {
  return translated([&] { return worlds_->save(); });
}

void Batch::load(std::span<const std::byte> saved) {
  translated([&] { worlds_->load(saved); });
}

std::uint64_t Batch::hash(int world) const {
  return translated([&] { return worlds_->hash(world); });
}

std::uint64_t Batch::hash() const {
  return translated([&] { return worlds_->hash(); });
}

std::string version() { return api::library_version; }

}  // namespace pbmpi
