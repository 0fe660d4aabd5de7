/// pbmpi_manual FOLDER: writes the manual pages of the programs below FOLDER. Part of the build, not
/// installed.
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "app/manual/pages/roff.h"

namespace {

using namespace pbmpi::app;

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path);
  file << text << std::flush;
  if (!file) throw std::runtime_error(path.string() + ": it cannot be written");
}

void write_manuals(const std::filesystem::path& folder) {
  for (const ProgramManual& program : all_manuals()) {
    const std::string& name = program.program.name;
    write(folder / "man1" / (name + ".1"), roff_page(program.program, program));
    for (const Manual& command : program.commands)
      write(folder / "man1" / (page_name(command) + ".1"), roff_page(command, program));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: pbmpi_manual FOLDER\n";
    return 2;
  }
  try {
    write_manuals(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "pbmpi_manual: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
