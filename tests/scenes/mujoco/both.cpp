#include "both.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>

#include <mujoco/mujoco.h>

#include "../physics/every_stepper.h"
#include "scenes/scene.h"

namespace pbmpi::scenes {
namespace {

/// A file with this text, removed with the object.
class TextFile {
 public:
  explicit TextFile(const std::string& text) {
    std::string path = "/tmp/pbmpi_mujoco_XXXXXX";
    const int file = mkstemp(path.data());
    if (file < 0) throw std::runtime_error("no file in /tmp");
    close(file);
    path_ = path;
    std::ofstream(path_) << text;
  }
  ~TextFile() { unlink(path_.c_str()); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

Centres by_mujoco(const std::string& mjcf, double dt_s, double seconds) {
  const TextFile file(mjcf);
  char error[1000] = "";
  const std::unique_ptr<mjModel, void (*)(mjModel*)> model(
      mj_loadXML(file.path().c_str(), nullptr, error, sizeof error), mj_deleteModel);
  if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
  model->opt.timestep = dt_s;
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
  for (long step = std::lround(seconds / dt_s); step > 0; --step) mj_step(model.get(), data.get());
  mj_forward(model.get(), data.get());
  Centres centres;
  for (int body = 1; body < model->nbody; ++body) {
    const mjtNum* at = data->xipos + 3 * body;
    centres[mj_id2name(model.get(), mjOBJ_BODY, body)] = {at[0], at[1], at[2]};
  }
  return centres;
}

Centres by_pbmpi(const std::string& mjcf, const stepping::StepperSettings& settings, double seconds) {
  const auto model = parse_scene({"test", "test.xml", mjcf}, settings.dt_s)->build(0, 1);
  const auto stepper = make_stepper(settings);
  stepper->add(0, model, model::initial_state(*model), 0);
  core::PhaseTimes times;
  stepper->advance(static_cast<int>(std::lround(seconds / settings.dt_s)), times);
  Centres centres;
  for (std::size_t i = 0; i < model->bodies.size(); ++i)
    centres[model->bodies[i].name.substr(5)] = stepper->state(0).position[i];  // strips "test."
  return centres;
}

double largest_distance(const Centres& a, const Centres& b) {
  double largest = 0;
  int num_common = 0;
  for (const auto& [name, at] : a) {
    const auto other = b.find(name);
    if (other == b.end()) continue;
    ++num_common;
    const double distance = (at - other->second).norm();
    largest = std::isfinite(distance) ? std::max(largest, distance) : distance;
  }
  if (num_common == 0) throw std::runtime_error("no body in common");
  return largest;
}

}  // namespace pbmpi::scenes
