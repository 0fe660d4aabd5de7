/// What the ranks must know of a field of interest that follows a body.
#include "mpi/spaces/space_step.h"

#include <algorithm>
#include <cmath>

namespace pbmpi::mpi {

using core::Phase;

/// Once the events of the step are done. Where all bodies are on one rank nobody else has to know.
void SpaceStep::post_center() {
  if (field_->follows() == model::no_body) return;
  const int owner = ownership_->owner[stepper_->map().space_of_body(field_->follows())];
  if (owner != comm_->rank()) return;
  const model::Vec3& center = stepper_->state().position[field_->follows()];
  field_->set_center(center);
  if (!crosses_ && mail_) mail_->finish();  // what was posted in the step before has been taken
  for (int rank = 0; ownership_->is_divided() && rank < comm_->size(); ++rank) {
    if (rank == owner) continue;
    MessageWriter message;
    message.put(std::span<const double>(center.data(), 3));
    mail_->post(message.take(), rank, center_tag);
  }
}

void SpaceStep::take_center(core::LapTimer& timer) {
  if (field_->follows() == model::no_body || !ownership_->is_divided()) return;
  const int owner = ownership_->owner[stepper_->map().space_of_body(field_->follows())];
  if (owner == comm_->rank()) return;
  MessageReader message(mail_->take(owner, center_tag));
  const auto center = message.get<double>();
  field_->set_center({center[0], center[1], center[2]});
  timer.lap(Phase::wait);
}

/// Islands of which no unit is near get few iterations, as far as this rank can tell: others may touch them.
void SpaceStep::weigh_outside() {
  const model::SpaceMap& map = stepper_->map();
  std::vector<char> near(islands_.weight.size(), 0);
  unit_near_.clear();
  for (std::size_t i = 0; i < own_units().size(); ++i) {
    const std::vector<int>& bodies = map.bodies_of_unit[own_units()[i]];
    const bool is_near = std::any_of(bodies.begin(), bodies.end(), [&](int body) {
      return field_->is_near(stepper_->state().position[body]);
    });
    unit_near_.push_back(is_near ? 1 : 0);
    near[islands_.of_unit[i]] |= unit_near_.back();
  }
  for (std::size_t island = 0; island < near.size(); ++island) {
    if (near[island]) continue;
    islands_.weight[island] =
        static_cast<std::int32_t>(std::ceil(field_->outside_share() * islands_.weight[island]));
  }
}

void SpaceStep::note_near(int rank, std::span<const char> near) {
  for (std::size_t i = 0; i < near.size(); ++i) findings_.near[ownership_->units[rank][i]] = near[i];
}

void SpaceStep::join_near() {
  std::vector<char> near(findings_.near.size(), 0);  // at the lowest unit of an island
  for (std::size_t unit = 0; unit < near.size(); ++unit) near[findings_.island[unit]] |= findings_.near[unit];
  for (std::size_t unit = 0; unit < near.size(); ++unit) findings_.near[unit] = near[findings_.island[unit]];
}

}  // namespace pbmpi::mpi
