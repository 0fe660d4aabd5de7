#include "solver/layout/pack_laws.h"

#include "solver/layout/passes.h"

namespace pbmpi::solver {

PackLaws laws_of(const model::Model& model) {
  return {.erp = model.erp,
          .cfm = model.cfm,
          .contact_erp = model.contact_law.soft_erp,
          .contact_cfm = model.contact_law.soft_cfm,
          .bounce_velocity = model.contact_law.bounce_velocity,
          .linear_damping = model.linear_damping,
          .angular_damping = model.angular_damping,
          .turning_contacts = passes_of(model).turning_contacts,
          .outside_iterations =
              model.interest ? std::optional(model.interest->outside_iterations) : std::nullopt};
}

}  // namespace pbmpi::solver
