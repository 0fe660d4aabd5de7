#include "app/pbreport/paper/figure_scenes.h"

#include <algorithm>
#include <cmath>

#include "app/pbreport/paper/statement.h"

namespace pbmpi::app {

const FigureScene* find_figure(const PaperData& data, const std::string& scene) {
  const auto found = std::ranges::find(data.figures, scene, &FigureScene::name);
  return found == data.figures.end() ? nullptr : &*found;
}

std::vector<const FigureScene*> scenes_with(const PaperData& data, const std::vector<std::string>& methods) {
  std::vector<const FigureScene*> scenes;
  for (const char* name : figure_8_scenes) {
    const FigureScene* scene = find_figure(data, name);
    const auto has = [&](const std::string& label) { return scene->find(label) != nullptr; };
    if (scene != nullptr && std::ranges::all_of(methods, has)) scenes.push_back(scene);
  }
  return scenes;
}

StretchCount count_stretch(const std::vector<double>& stretch) {
  StretchCount count{.all = stretch.size()};
  for (const double one : stretch) {  // a NaN counts as seen
    if (!(one < 0.027)) ++count.perhaps_seen;
    if (!(one <= 0.20)) ++count.seen;
    if (std::isfinite(one)) count.most = std::max(count.most, one);
  }
  return count;
}

}  // namespace pbmpi::app
