#include <algorithm>

#include "app/common/format.h"
#include "app/pbreport/paper/complexity.h"
#include "app/pbreport/paper/statements.h"
#include "model/joint_traits.h"
#include "stepping/run_event.h"

namespace pbmpi::app {
namespace {

std::int64_t events_of(const SuiteRun& run, const char* kind) {
  const auto found = run.events.find(kind);
  return found == run.events.end() ? 0 : found->second;
}

PaperStatement of_high_speed(const PaperData& data) {
  PaperStatement statement{{"2.3.1", "ODE resolves collisions of high speed even at coarse time steps",
                            "nothing passes through anything without pbmpi's contacts ahead of fast bodies: "
                            "CrashWa (89.4 m/s), hard/contact/bullets_50 (50 m/s), steps of 0.01 s",
                            Finding::undecidable, not_measured},
                           "-",
                           Basis::counts,
                           "jobs/paper.sh",
                           "guards look after each step"};
  SceneList passages;
  bool is_resolved = true;
  for (const PlainRun& run : data.plain) {
    passages.add(run.scene, std::to_string(run.passages));
    is_resolved = is_resolved && run.passages == 0;
  }
  statement.decide(is_resolved, passages, 2, "passages: ");
  return statement;
}

PaperStatement of_penetration(const PaperData& data) {
  PaperStatement statement{{"2.3.1", "a penetration is eliminated after a short number of steps",
                            "quick with 20 iterations is right in the hard cases half_embedded and "
                            "overlapping_rows",
                            Finding::undecidable, not_measured},
                           "-",
                           Basis::counts,
                           "jobs/paper.sh",
                           "bounds of a case: scenes/FORMAT.md"};
  SceneList verdicts;
  bool is_right = true;
  if (data.stability) {
    for (const StabilityScene& scene : data.stability->scenes) {
      if (scene.name != "hard/contact/half_embedded" && scene.name != "hard/contact/overlapping_rows")
        continue;
      for (const StabilityCell& cell : scene.cells) {
        if (cell.setting != "quick, 1 x 20") continue;
        verdicts.add(scene.name.substr(scene.name.rfind('/') + 1), std::string(name_of(cell.judged.verdict)));
        is_right = is_right && cell.judged.verdict == stability::Verdict::pass;
      }
    }
  }
  statement.decide(is_right, verdicts, 2);
  return statement;
}

PaperStatement of_spaces(const PaperData& data) {
  PaperStatement statement{
      {"2.3.1", "the number of spaces has significant impact on collision detection",
       "a core for each space saves a quarter of its time in most scenes of several spaces",
       Finding::undecidable, not_measured},
      "-",
      Basis::clock,
      "jobs/figure6.sh",
      "kinds of spaces are not compared; pbmpi takes a simple one or sweep and prune"};
  SceneList shares;
  std::size_t faster = 0;
  for (const SuiteRun& run : data.suite) {
    if (run.islands.spaces < 2) continue;
    shares.add(run.islands.scene, percent(run.cores.spaces_share));
    if (run.cores.spaces_share <= 0.75) ++faster;
  }
  statement.decide(2 * faster > shares.size(), shares, 6, "left of its time: ");
  return statement;
}

PaperStatement of_expensive_step(const PaperData& data) {
  PaperStatement statement{{"2.3.2", "the forward step is the most expensive part",
                            "more than half of the time in every scene", Finding::undecidable, not_measured},
                           "-",
                           Basis::clock,
                           "jobs/figure6.sh",
                           ""};
  SceneList shares;
  bool leads = true;
  for (const SuiteRun& run : data.suite) {
    const double share = 1 - run.cores.collide_share_serial;
    shares.add(run.islands.scene, percent(share));
    leads = leads && share > 0.5;
  }
  statement.decide(leads, shares, num_scenes);
  return statement;
}

std::string text_of(const Growth& growth) {
  return format("rows to the power of %.2f (%d islands of %d to %d rows)", growth.exponent,
                growth.num_islands, growth.least_rows, growth.most_rows);
}

PaperStatement of_normal_step(const PaperData& data) {
  PaperStatement statement{
      {"2.3.2", "the normal step takes O(m^3) for m constraints",
       "exponent of 2.5 to 3.5 over islands of at least 100 rows", Finding::undecidable, not_measured},
      "3",
      Basis::clock,
      "jobs/paper.sh",
      ""};
  const auto growth = growth_of(data.direct);
  if (!growth) return statement;
  statement.verdict.number = text_of(*growth);
  statement.decide(growth->exponent >= 2.5 && growth->exponent <= 3.5, 1, 1);
  return statement;
}

PaperStatement of_quick_step(const PaperData& data) {
  PaperStatement statement{
      {"2.3.2", "the quick step takes O(m i) for m constraints and i iterations",
       "exponent of m 0.8 to 1.2; from 40 to 80 iterations 1.5 to 2.5 times as much more "
       "as from 20 to 40",
       Finding::undecidable, not_measured},
      "1; 2",
      Basis::clock,
      "jobs/paper.sh",
      "time of a row, CrashWa"};
  const auto growth = growth_of(data.works());
  const SuiteRun* base = data.find("CrashWa");
  const auto with = [&](int iterations) {
    return std::ranges::find_if(data.more_iterations, [&](const IslandWork& work) {
      return work.scene == "CrashWa" && work.iterations == iterations;
    });
  };
  const auto forty = with(40), eighty = with(80);
  if (!growth || base == nullptr || forty == data.more_iterations.end() ||
      eighty == data.more_iterations.end())
    return statement;
  const double at_20 = time_of_a_row(base->work), at_40 = time_of_a_row(*forty),
               at_80 = time_of_a_row(*eighty);
  const double ratio = (at_80 - at_40) / (at_40 - at_20);
  statement.verdict.number = text_of(*growth) + format("; %.2f times", ratio);
  statement.decide(growth->exponent >= 0.8 && growth->exponent <= 1.2 && ratio >= 1.5 && ratio <= 2.5, 1, 1);
  return statement;
}

PaperStatement of_both_steps(const PaperData& data) {
  PaperStatement statement{
      {"2.3.2", "the quick step far outperforms the big matrix in scenes of average size",
       "half its time or less in every scene that was tried", Finding::undecidable, not_measured},
      "-",
      Basis::clock,
      "jobs/paper.sh",
      "CrashWa: one step, before the crash; Environ and Battle2 take minutes. The paper calls 2-Cars, "
      "10-Cars and CrashSk simple"};
  SceneList ratios;
  bool outperforms = true;
  for (const IslandWork& direct : data.direct) {
    const SuiteRun* quick = data.find(direct.scene);
    if (quick == nullptr) continue;
    const double ratio =
        direct.frame_s / direct.steps_per_frame / (quick->work.frame_s / quick->work.steps_per_frame);
    ratios.add(direct.scene, format("%.3g", ratio));
    outperforms = outperforms && ratio >= 2;
  }
  statement.decide(outperforms, ratios, 7, "time of direct over quick's: ");
  return statement;
}

PaperStatement of_large_steps(const PaperData& data) {
  PaperStatement statement{
      {"2.3.2", "ODE's integrator allows large steps, even with collisions of high speed",
       "steps of 0.01 s: no number that is not finite, and no energy gained without a cause",
       Finding::undecidable, not_measured},
      "0.001 to 0.01 s",
      Basis::counts,
      "jobs/figure6.sh",
      "guards of the nine scenes' runs; over seconds: docs/stability.md"};
  if (data.suite.empty()) return statement;
  SceneList blown_up;
  for (const SuiteRun& run : data.suite) {
    using namespace stepping;
    const std::int64_t bad = events_of(run, event_kind::nonfinite) + events_of(run, event_kind::energy_gain);
    if (bad > 0) blown_up.add(run.islands.scene, std::to_string(bad));
  }
  statement.verdict.number = blown_up.empty() ? format("none in %zu scenes", data.suite.size())
                                              : "events of guards: " + blown_up.text();
  statement.decide(blown_up.empty(), data.suite.size(), num_scenes);
  return statement;
}

PaperStatement of_degrees_of_freedom() {
  struct Removed {
    model::JointKind kind;
    int papers;
  };
  constexpr std::array<Removed, 6> table = {{{model::JointKind::ball, 3},
                                             {model::JointKind::hinge, 5},
                                             {model::JointKind::hinge2, 4},
                                             {model::JointKind::slider, 5},
                                             {model::JointKind::universal, 4},
                                             {model::JointKind::fixed, 6}}};
  PaperStatement statement{
      {"2.3.2", "degrees of freedom that a joint removes", "as many rows", Finding::undecidable, ""},
      "",
      Basis::counts,
      "",
      "contact: the paper's 1 is its normal; friction adds two rows"};
  bool is_same = true;
  for (const Removed& one : table) {
    const model::JointTraits& traits = model::traits_of(one.kind);
    const std::string name(traits.name), separator = statement.papers.empty() ? "" : ", ";
    statement.papers += separator + name + format(" %d", one.papers);
    statement.verdict.number += separator + name + format(" %d", traits.held_rows());
    is_same = is_same && traits.held_rows() == one.papers;
  }
  statement.decide(is_same, 1, 1);
  return statement;
}

}  // namespace

std::vector<PaperStatement> engine_statements(const PaperData& data) {
  return {
      of_high_speed(data),
      of_penetration(data),
      of_spaces(data),
      of_expensive_step(data),
      of_normal_step(data),
      of_quick_step(data),
      of_both_steps(data),
      of_large_steps(data),
      of_degrees_of_freedom(),
      undecidable(
          "2.3.2", "ODE's worlds, and islands of a world, can be solved independently", "-",
          "QuickStep draws its row order from one seed of the process, which pbmpi sets before each step: "
          "its runs cannot show what ODE does alone"),
  };
}

}  // namespace pbmpi::app
