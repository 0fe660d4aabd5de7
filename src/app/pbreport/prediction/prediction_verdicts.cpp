#include "app/pbreport/prediction/prediction_verdicts.h"

#include <algorithm>
#include <optional>

#include "app/common/format.h"
#include "app/pbreport/study/instruction_mix.h"

namespace pbmpi::app {
namespace {

/// A bar's gain over 20Iter; none if one of the two was not modelled, or its run blew up: a world that has
/// lost bodies has less to compute.
std::optional<double> gain(const PredictionScene& scene, const std::string& fvp, const std::string& name) {
  const PredictionRun* run = scene.find(name);
  if (run != nullptr && run->is_broken()) return std::nullopt;
  const std::vector<Bar> bars = figure_8(scene, fvp);
  for (const Bar& bar : bars) {
    if (bar.name == name && std::isfinite(bar.rate.hz) && std::isfinite(bars.front().rate.hz))
      return bar.rate.hz / bars.front().rate.hz - 1;
  }
  return std::nullopt;
}

std::optional<double> mean_gain(const PredictionStudy& study, const std::string& name) {
  double sum = 0;
  int count = 0;
  for (const PredictionScene& scene : study.scenes) {
    if (const auto one = gain(scene, study.fvp, name)) {
      sum += *one;
      ++count;
    }
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

const PredictionScene* find_scene(const PredictionStudy& study, const std::string& name) {
  const auto found = std::ranges::find(study.scenes, name, &PredictionScene::name);
  return found == study.scenes.end() ? nullptr : &*found;
}

PaperVerdict of_feec(const PredictionStudy& study) {
  PaperVerdict verdict{"5.4", "FEEC raises the frame rate by 220 % on average", "at least half of that",
                       Finding::undecidable, "no cycles"};
  if (const auto gained = mean_gain(study, "FEEC")) {
    verdict.finding = finding_if(*gained >= 1.1);
    verdict.number = format("%+.0f %%", 100 * *gained);
  }
  return verdict;
}

PaperVerdict of_comparison(const PredictionStudy& study) {
  PaperVerdict verdict{"5.4", "value prediction is less attractive than FEEC", "it gains less on average",
                       Finding::undecidable, "no cycles"};
  const auto feec = mean_gain(study, "FEEC"), fvp = mean_gain(study, study.fvp),
             evp = mean_gain(study, "EVP");
  if (feec && fvp && evp) {
    verdict.finding = finding_if(std::max(*fvp, *evp) < *feec);
    verdict.number = format("%s %+.1f %%, EVP %+.1f %%, FEEC %+.0f %%", study.fvp.c_str(), 100 * *fvp,
                            100 * *evp, 100 * *feec);
  }
  return verdict;
}

PaperVerdict of_battle2(const PredictionStudy& study) {
  PaperVerdict verdict{"5.4", "FVP6 raises Battle2's frame rate by 24 %", "at least half of that",
                       Finding::undecidable, "not measured"};
  const PredictionScene* scene = find_scene(study, "Battle2");
  if (scene == nullptr) return verdict;
  if (const auto gained = gain(*scene, study.fvp, study.fvp)) {
    verdict.finding = finding_if(*gained >= 0.12);
    verdict.number = format("%+.1f %%", 100 * *gained);
  } else {
    verdict.number = "no frame was measured before the run ended";
  }
  return verdict;
}

PaperVerdict of_fight(const PredictionStudy& study) {
  PaperVerdict verdict{"5.4", "FVP6 alone sees more frames of Fight satisfied", "more than 20Iter",
                       Finding::undecidable, "not measured"};
  const PredictionScene* scene = find_scene(study, "Fight");
  const PredictionRun* fvp = scene == nullptr ? nullptr : scene->find(study.fvp);
  if (fvp == nullptr || !std::isfinite(fvp->predicted.satisfied)) return verdict;
  const double before = scene->base().unpredicted.satisfied, after = fvp->predicted.satisfied;
  verdict.number = format("%.0f %% instead of %.0f %%", 100 * after, 100 * before);
  const bool no_room = before == after && (before == 1 || before == 0);
  verdict.finding = no_room ? Finding::undecidable : finding_if(after > before);
  return verdict;
}

/// Scenes in which FEEC with FVP is slower than FEEC alone, and the number of scenes compared.
std::pair<std::vector<const PredictionScene*>, int> degraded(const PredictionStudy& study) {
  std::pair<std::vector<const PredictionScene*>, int> result;
  for (const PredictionScene& scene : study.scenes) {
    const auto alone = gain(scene, study.fvp, "FEEC"), both = gain(scene, study.fvp, "FEEC+" + study.fvp);
    if (!alone || !both) continue;
    ++result.second;
    if (*both < *alone) result.first.push_back(&scene);
  }
  return result;
}

std::string names_of(const std::vector<const PredictionScene*>& scenes) {
  std::string text;
  for (const PredictionScene* scene : scenes) text += (text.empty() ? "" : ", ") + scene->name;
  return text;
}

PaperVerdict of_both(const PredictionStudy& study) {
  PaperVerdict verdict{"5.4", "FVP6 with FEEC slows three tests down, and is marginally faster in the rest",
                       "slower in two to four scenes", Finding::undecidable, "no cycles"};
  const auto [slower, count] = degraded(study);
  if (count == 0) return verdict;
  verdict.finding = finding_if(slower.size() >= 2 && slower.size() <= 4);
  verdict.number = format("slower in %zu of %d scenes", slower.size(), count) +
                   (slower.empty() ? "" : " (" + names_of(slower) + ")");
  return verdict;
}

PaperVerdict of_islands(const PredictionStudy& study) {
  PaperVerdict verdict{"5.4", "it is slower there mainly because larger islands form",
                       "fewer islands in most of these scenes", Finding::undecidable, "slower in no scene"};
  const auto slower = degraded(study).first;
  int fewer = 0, known = 0;
  for (const PredictionScene* scene : slower) {
    const PredictionRun* run = scene->find("FEEC+" + study.fvp);
    if (!std::isfinite(run->islands)) continue;
    ++known;
    if (run->islands < run->base_islands) ++fewer;
  }
  if (known == 0) return verdict;
  verdict.finding = finding_if(2 * fewer > known);
  verdict.number = format("fewer islands in %d of %d", fewer, known);
  return verdict;
}

PaperVerdict of_blow_ups(const PredictionStudy& study) {
  PaperVerdict verdict{"5.1", "results blow up, even with a threshold of 1e-12",
                       "a number that is not finite, or a crash, with 1e-12", Finding::undecidable,
                       "no run with 1e-12"};
  std::string all;
  int at_least = 0, runs = 0;
  for (const char* name : {"FVP6", "FVP8", "FVP10", "FVP12"}) {
    int broken = 0, known = 0;
    for (const PredictionScene& scene : study.scenes) {
      const PredictionRun* run = scene.find(name);
      if (run == nullptr || (!run->ended && !run->has_crashed())) continue;
      ++known;
      if (run->is_broken()) ++broken;
    }
    if (known > 0) all += format("%s%s in %d of %d scenes", all.empty() ? "" : ", ", name, broken, known);
    if (std::string_view(name) == "FVP12") {
      at_least = broken;
      runs = known;
    }
  }
  if (runs == 0) return verdict;
  verdict.finding = finding_if(at_least > 0);
  verdict.number = "not finite or crashed: " + all;
  return verdict;
}

PaperVerdict of_evp(const PredictionStudy& study) {
  PaperVerdict verdict{"5.1", "exact prediction leaves the result as it is", "the same bits in every scene",
                       Finding::undecidable, "not measured"};
  if (study.scenes.empty()) return verdict;
  int same = 0;
  for (const PredictionScene& scene : study.scenes) same += scene.base().same_hash ? 1 : 0;
  const auto count = static_cast<int>(study.scenes.size());
  verdict.finding = finding_if(same == count);
  verdict.number = format("the same bits in %d of %d scenes", same, count);
  return verdict;
}

PaperVerdict of_scopes(const PredictionStudy& study) {
  PaperVerdict verdict{"5.1", "prediction in collision, in the forward step or in both behaves alike",
                       "drift within a factor of ten", Finding::undecidable, "no case of single phases"};
  for (const PredictionScene& scene : study.scenes) {
    const PredictionRun *both = scene.find(study.fvp), *collision = scene.find(study.fvp + " collision"),
                        *step = scene.find(study.fvp + " step");
    if (both == nullptr || collision == nullptr || step == nullptr) continue;
    const auto [least, most] = std::minmax({both->drift_rms, collision->drift_rms, step->drift_rms});
    verdict.finding = finding_if(most <= 10 * least);
    verdict.number = scene.name + format(": drift %.3g mm, %.3g mm, %.3g mm", 1e3 * collision->drift_rms,
                                         1e3 * step->drift_rms, 1e3 * both->drift_rms);
    return verdict;
  }
  return verdict;
}

PaperVerdict of_majority(const PredictionStudy& study) {
  PaperVerdict verdict{"6", "FVP6 does not significantly accelerate the majority of workloads",
                       "less than 10 % in most scenes", Finding::undecidable, "no cycles"};
  int slow = 0, known = 0;
  for (const PredictionScene& scene : study.scenes) {
    const auto gained = gain(scene, study.fvp, study.fvp);
    if (!gained) continue;
    ++known;
    if (*gained < 0.1) ++slow;
  }
  if (known == 0) return verdict;
  verdict.finding = finding_if(2 * slow > known);
  verdict.number = format("less than 10 %% in %d of %d scenes", slow, known);
  return verdict;
}

PaperVerdict of_mix(const PredictionStudy& study) {
  std::vector<InstructionMix> scenes;
  for (const PredictionScene& scene : study.scenes) scenes.push_back(scene.base().mix);
  return judge_mix(scenes);
}

PaperVerdict of_collision(const PredictionStudy& study) {
  std::vector<double> shares;
  for (const PredictionScene& scene : study.scenes) shares.push_back(scene.base().collision_share);
  return judge_collision_share(shares);
}

}  // namespace

std::vector<PaperVerdict> judge_paper(const PredictionStudy& study) {
  return {of_evp(study),     of_blow_ups(study), of_scopes(study),     of_battle2(study),
          of_fight(study),   of_feec(study),     of_comparison(study), of_both(study),
          of_islands(study), of_majority(study), of_mix(study),        of_collision(study)};
}

}  // namespace pbmpi::app
