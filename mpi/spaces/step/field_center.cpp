#include "mpi/spaces/step/field_center.h"

#include "mpi/comm/message.h"

namespace pbmpi::mpi {

int FieldCenter::owner() const {
  if (shared_->field == nullptr || shared_->field->follows() == model::no_body) return -1;
  return shared_->ownership->owner[shared_->stepper->map().space_of_body(shared_->field->follows())];
}

void FieldCenter::post() {
  const Communicator& comm = *shared_->comm;
  if (owner() != comm.rank()) return;
  const model::Vec3& center = shared_->stepper->state().position[shared_->field->follows()];
  shared_->field->set_center(center);
  // Where nothing crosses no verdict ends a step; the messages of the previous step have been received by
  // now.
  if (!shared_->crosses && shared_->mail) shared_->mail->finish();
  for (int rank = 0; shared_->ownership->is_divided() && rank < comm.size(); ++rank) {
    if (rank == comm.rank()) continue;
    MessageWriter message;
    message.put(std::span<const double>(center.data(), 3));
    shared_->mail->post(message.take(), rank, center_tag);
  }
}

void FieldCenter::take(core::LapTimer& timer) {
  const int from = owner();
  if (from < 0 || from == shared_->comm->rank() || !shared_->ownership->is_divided()) return;
  MessageReader message(shared_->mail->take(from, center_tag));
  const auto center = message.get<double>();
  shared_->field->set_center({center[0], center[1], center[2]});
  timer.lap(core::Phase::wait);
}

}  // namespace pbmpi::mpi
