/// Steps a batch of worlds, restarts some of them, and returns to a saved state.
#include <array>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <stdexcept>

#include <pbmpi/batch.h>

namespace {

void print_hash(const char* what, const pbmpi::Batch& batch) {
  std::cout << what << ": " << std::hex << std::setw(16) << std::setfill('0') << batch.hash() << std::dec
            << '\n';
}

void run() {
  pbmpi::BatchOptions options;
  options.scene = "CrashSk";
  options.num_worlds = 3;
  options.settings = {{"stepper", "sor"}, {"precision", "single"}};
  pbmpi::Batch batch(options);
  std::cout << "pbmpi " << pbmpi::version() << ", worlds: " << batch.num_worlds()
            << ", bodies each: " << batch.num_bodies() << '\n';

  // The number of steps that pbmpi does with this scene: 3 frames of warm-up, and 5 measured ones.
  batch.step(8 * batch.steps_per_frame());
  print_hash("hash", batch);
  const pbmpi::BatchState& state = batch.state();
  std::cout << batch.body_names().front() << " of world 0 is at x = " << state.position.front() << " m\n";

  // World 1 restarts, the others go on; then all return to the saved state.
  const auto saved = batch.save();
  const std::array<bool, 3> mask = {false, true, false};
  batch.reset(mask, 1);
  batch.step(batch.steps_per_frame());
  std::cout << "steps: " << batch.steps()[0] << ' ' << batch.steps()[1] << ' ' << batch.steps()[2] << '\n';
  batch.load(saved);
  print_hash("hash after load", batch);
}

}  // namespace

int main() {
  try {
    run();
  } catch (const std::exception& error) {
    std::cerr << "example: " << error.what() << '\n';
    return 1;
  }
}
