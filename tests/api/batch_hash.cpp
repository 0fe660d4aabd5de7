/// batch_hash SCENE WORLDS STEPS [NAME=VALUE ...]: prints the hash of a batch after so many steps, for a
/// script that compares it with pbmpi's.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "pbmpi/batch.h"

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  try {
    pbmpi::BatchOptions options;
    options.scene = argv[1];
    options.num_worlds = std::atoi(argv[2]);
    for (int i = 4; i < argc; ++i) {
      const std::string setting = argv[i];
      const std::size_t equals = setting.find('=');
      options.settings[setting.substr(0, equals)] = setting.substr(equals + 1);
    }
    pbmpi::Batch batch(options);
    batch.step(std::atoi(argv[3]));
    std::printf("%016llx\n", static_cast<unsigned long long>(batch.hash()));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "batch_hash: %s\n", error.what());
    return 1;
  }
}
