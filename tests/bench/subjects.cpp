#include "subjects.h"

#include "scenes/scene.h"
#include "support/models.h"

namespace pbmpi::bench {
namespace {

constexpr std::uint64_t seed = 1;

Subject from_scene(const std::string& name, int num_worlds) {
  const auto scene = scenes::parse_scene(scenes::find_scene(name));
  const scenes::RunDefaults& defaults = scene->defaults();
  Subject subject{scene->name(),  {}, defaults.dt_s, defaults.iterations, defaults.steps_per_frame,
                  defaults.warmup};
  const int count = num_worlds > 0 ? num_worlds : defaults.replicas;
  for (int world = 0; world < count; ++world) subject.models.push_back(scene->build(world, seed));
  return subject;
}

}  // namespace

int Subject::num_bodies() const {
  int sum = 0;
  for (const auto& model : models) sum += model->num_bodies();
  return sum;
}

Subject load_subject(const std::string& name, int num_worlds) {
  if (name != "crash" && name != "pile") return from_scene(name, num_worlds);
  Subject subject;
  subject.name = name;
  const int count = num_worlds > 0 ? num_worlds : 100;
  for (int world = 0; world < count; ++world) {
    subject.models.push_back(
        std::make_shared<model::Model>(name == "crash" ? support::crash(world) : support::pile(40)));
  }
  return subject;
}

}  // namespace pbmpi::bench
