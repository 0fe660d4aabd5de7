// A wall of blocks in running bond, laid dry: each block is a body of its own.
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/actors/actor_builder.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {
namespace {

struct Opening {
  double from_m = 0, to_m = 0;  ///< along the wall, from its middle; an empty range means no opening
  int num_courses = 0;          ///< number of courses of its height; the next course holds the lintel
};

struct Wall {
  double length_m = 0, thickness_m = 0;
  int num_courses = 0;
  double block_length_m = 0, block_height_m = 0;
  double density_kg_m3 = 0;
  Opening opening;
  model::Material material;
};

// Gap between neighbours of a course. Dry blocks rest on the courses below and carry those above; without the
// gap each block would also press on its neighbours, and rounding would decide how hard.
constexpr double joint_width_m = 0.002;
// Fractions of a block's length: masons place no piece shorter than a quarter, and support a lintel on a
// half.
constexpr double shortest_piece = 0.25;
constexpr double lintel_bearing = 0.5;
constexpr std::size_t most_pieces = 1'000'000;  // of a course: beyond any memory

struct Piece {
  double from_m = 0, to_m = 0;  ///< along the wall, from its middle
};

/// Adds the pieces that fill [from, to], cut at `phase` + whole block lengths; a cut that would leave a
/// splinter is not made.
void lay(const Wall& wall, double from_m, double to_m, double phase_m, std::vector<Piece>& pieces) {
  const double block = wall.block_length_m;
  const double least = shortest_piece * block;
  if (to_m - from_m < least) return;
  double start = from_m;
  for (double k = std::floor((from_m - phase_m) / block); phase_m + k * block < to_m - least; ++k) {
    const double cut = phase_m + k * block;
    if (cut < start + least) continue;
    if (pieces.size() >= most_pieces)
      throw std::length_error("a course of the wall has more than a million blocks; make them longer");
    pieces.push_back({start, cut});
    start = cut;
  }
  pieces.push_back({start, to_m});
}

std::vector<Piece> pieces_of_course(const Wall& wall, int course) {
  const double half = wall.length_m / 2;
  // Every second course starts with half a block, so each block rests on two.
  const double phase = -half + (course % 2 == 0 ? 0 : wall.block_length_m / 2);
  const Opening& hole = wall.opening;
  std::vector<Piece> pieces;
  if (hole.num_courses == 0 || course > hole.num_courses) {
    lay(wall, -half, half, phase, pieces);
    return pieces;
  }
  const double bearing = course == hole.num_courses ? lintel_bearing * wall.block_length_m : 0;
  lay(wall, -half, hole.from_m - bearing, phase, pieces);
  if (bearing > 0) pieces.push_back({hole.from_m - bearing, hole.to_m + bearing});
  lay(wall, hole.to_m + bearing, half, phase, pieces);
  return pieces;
}

class WallBuilder : ActorBuilder {
 public:
  WallBuilder(const Wall& wall, const Placement& place, model::Model& model)
      : ActorBuilder(place, model::ActorKind::wall, model), wall_(wall) {
    model.actors[actor_].self_collision = true;
  }

  void build() {
    for (int course = 0; course < wall_.num_courses; ++course) {
      const double height = (course + 0.5) * wall_.block_height_m - (course + 1) * initial_depth_m;
      int number = 0;
      for (const Piece& piece : pieces_of_course(wall_, course))
        add_block(std::to_string(course + 1) + "_" + std::to_string(++number), height, piece);
    }
  }

 private:
  void add_block(const std::string& name, double height_m, const Piece& piece) {
    const double length = piece.to_m - piece.from_m - joint_width_m;
    const std::array<double, 3> size = {length, wall_.thickness_m, wall_.block_height_m};
    const double mass_kg = wall_.density_kg_m3 * volume(model::Shape::box, size);
    const int block = add_part(name, mass_kg, solid_inertia(model::Shape::box, size, mass_kg),
                               compose(place_.pose, {{(piece.from_m + piece.to_m) / 2, 0, height_m}, {}}));
    add_geom(block, model::Shape::box, size, {}, wall_.material);
  }

  const Wall& wall_;
};

/// A wall has a whole number of courses; otherwise the error is reported at `key`.
int courses(TableReader& table, const char* key, double height_m, double block_height_m) {
  const double courses = height_m / block_height_m;
  const double whole = std::round(courses);
  if (whole < 1) table.fail(key, "no course of blocks fits below this height; raise it or take lower blocks");
  if (std::abs(courses - whole) > 1e-6) {  // rounding of a user's digits
    table.fail(key, "the height must be a whole number of courses; a block is " +
                        std::to_string(block_height_m) + " m high");
  }
  return static_cast<int>(whole);
}

Opening read_opening(TableReader& actor, const Wall& wall) {
  auto table = actor.table("opening");
  if (!table) return {};
  const double width = table->number("width", Sign::positive);
  const double height = table->number("height", Sign::positive);
  const double middle = table->number("position", Sign::any, 0.0);
  table->finish();
  Opening hole{middle - width / 2, middle + width / 2,
               courses(*table, "height", height, wall.block_height_m)};
  const double pier = (lintel_bearing + shortest_piece) * wall.block_length_m;
  if (hole.from_m - pier < -wall.length_m / 2 || hole.to_m + pier > wall.length_m / 2) {
    table->fail("width",
                "the opening leaves no pier beside it that could bear the lintel; narrow or move it");
  }
  if (hole.num_courses >= wall.num_courses) {
    table->fail("height", "no course is left above the opening for the lintel; lower it");
  }
  return hole;
}

}  // namespace

ActorPlan read_wall(TableReader& actor, const SceneContext&) {
  Wall wall;
  wall.length_m = actor.number("length", Sign::positive);
  const double height = actor.number("height", Sign::positive);
  const Vec3 block = actor.vector("block", Sign::positive);
  wall.block_length_m = block.x();
  wall.thickness_m = block.y();
  wall.block_height_m = block.z();
  wall.density_kg_m3 = actor.number("density", Sign::positive, 600.0);  // autoclaved aerated concrete
  wall.material =
      read_material(actor, {0.7, 0});  // concrete on concrete, 0.6 to 0.8 (ACI 318, shear friction)
  if (block.x() > wall.length_m) {
    actor.fail("length", "the wall has no block: one is longer than the wall; lengthen it");
  }
  if (shortest_piece * block.x() <= joint_width_m) {
    actor.fail("block", "the block's length must be above 8 mm (joints are 2 mm wide)");
  }
  wall.num_courses = courses(actor, "height", height, wall.block_height_m);
  wall.opening = read_opening(actor, wall);
  return [wall](const Placement& place, model::Model& model) { WallBuilder(wall, place, model).build(); };
}

}  // namespace pbmpi::scenes
