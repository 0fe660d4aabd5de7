#include "engines/optional_engines.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "engines/engine_builds.h"
#include "stepping/names.h"
#ifdef PBMPI_HAS_BULLET
#include "bullet/bullet_stepper.h"
#endif
#ifdef PBMPI_HAS_MUJOCO
#include "mujoco/mujoco_stepper.h"
#endif

namespace pbmpi::engines {
namespace {

constexpr std::array<OptionalEngine, 2> engines = {{
    {stepping::StepperKind::bullet, "Bullet", "libbullet-dev", "PBMPI_BULLET", bullet_version},
    {stepping::StepperKind::mujoco, "MuJoCo", "libmujoco-dev", "PBMPI_MUJOCO", mujoco_version},
}};

void append(std::string& list, const std::string& item) { list += (list.empty() ? "" : ", ") + item; }

}  // namespace

std::span<const OptionalEngine> optional_engines() { return engines; }

const OptionalEngine* find_optional_engine(stepping::StepperKind kind) {
  const auto found = std::ranges::find(engines, kind, &OptionalEngine::stepper);
  return found == engines.end() ? nullptr : &*found;
}

std::string absence_text(const OptionalEngine& engine) {
  return "this build has no stepper " + std::string(name_of(engine.stepper)) + ", since " +
         std::string(engine.name) + " was not there or not wanted when it was configured; install " +
         std::string(engine.package) + " and configure anew (-D" + std::string(engine.cmake_option) +
         "=ON), or use sor, quick or direct";
}

void require_in_build(stepping::StepperKind kind, const std::string& where) {
  const OptionalEngine* engine = find_optional_engine(kind);
  if (engine != nullptr && !engine->in_build()) throw core::InputError(where + ": " + absence_text(*engine));
}

std::string builds_text() {
  std::string present, absent;
  for (const OptionalEngine& engine : engines) {
    const std::string stepper(name_of(engine.stepper));
    if (engine.in_build())
      append(present, stepper + " (" + std::string(engine.name) + " " + std::string(engine.version) + ")");
    else
      append(absent, stepper + " (Debian: " + std::string(engine.package) + ")");
  }
  if (absent.empty()) return present;
  return present + (present.empty() ? "" : "; ") + "not in this build: " + absent;
}

std::vector<std::string> refusals([[maybe_unused]] stepping::StepperKind kind,
                                  [[maybe_unused]] const model::Model& model) {
#ifdef PBMPI_HAS_MUJOCO
  if (kind == stepping::StepperKind::mujoco) return mujoco::refusals(model);
#endif
  return {};
}

std::vector<std::string> inexpressible([[maybe_unused]] stepping::StepperKind kind,
                                       [[maybe_unused]] const model::Model& model) {
#ifdef PBMPI_HAS_BULLET
  if (kind == stepping::StepperKind::bullet) return bullet::inexpressible(model);
#endif
#ifdef PBMPI_HAS_MUJOCO
  if (kind == stepping::StepperKind::mujoco) return mujoco::inexpressible(model);
#endif
  return {};
}

}  // namespace pbmpi::engines
