#include "app/common/engine_texts.h"

#include "app/common/version.h"
#include "engines/optional_engines.h"
#include "ode/ode_stepper.h"
#include "solver/pack/simd.h"
#include "stepping/names.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::app {

std::string simd_text(const stepping::StepperSettings& settings) {
  if (!traits_of(settings.kind).has_lanes) return "";
  const stepping::Simd simd =
      settings.simd == stepping::Simd::automatic ? solver::best_simd() : settings.simd;
  const int lanes = solver::num_lanes(simd, settings.precision);
  return std::string(name_of(simd)) + ", " + std::to_string(lanes) + (lanes == 1 ? " lane" : " lanes");
}

std::string ode_text() {
  const std::string version = ode_version;
  return ode::precision_text() == "single" ? version + ", single precision" : version;
}

std::optional<std::pair<std::string, std::string>> optional_engine_text(stepping::StepperKind kind) {
  const engines::OptionalEngine* engine = engines::find_optional_engine(kind);
  if (engine == nullptr) return std::nullopt;
  return std::pair("library_" + std::string(name_of(kind)),
                   std::string(engine->version) + ", double precision");
}

std::vector<std::pair<std::string, std::string>> engine_versions() {
  std::vector<std::pair<std::string, std::string>> versions = {{"library_ode", ode_text()}};
  for (const engines::OptionalEngine& engine : engines::optional_engines()) {
    if (engine.in_build()) versions.push_back(*optional_engine_text(engine.stepper));
  }
  return versions;
}

}  // namespace pbmpi::app
