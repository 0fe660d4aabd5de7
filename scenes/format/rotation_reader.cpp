#include "scenes/format/rotation_reader.h"

namespace pbmpi::scenes {

Quat read_rotation(TableReader& table, std::string_view key) {
  auto rotation_table = table.table(key);
  if (!rotation_table) return {};
  const Vec3 axis = rotation_table->direction("axis");
  const double angle_deg = rotation_table->number("angle", Sign::any);
  rotation_table->finish();
  return rotation(radians(angle_deg), axis);
}

}  // namespace pbmpi::scenes
