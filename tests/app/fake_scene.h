/// A scene for tests of options.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.h"

namespace pbmpi::app {

/// Only its defaults and its name matter.
class FakeScene final : public scenes::Scene {
 public:
  explicit FakeScene(scenes::RunDefaults defaults, std::string name = "Fake")
      : name_(std::move(name)), defaults_(std::move(defaults)) {}
  const std::string& name() const override { return name_; }
  const std::string& title() const override { return name_; }
  const std::string& text() const override { return name_; }
  const scenes::RunDefaults& defaults() const override { return defaults_; }
  const std::vector<std::string>& notes() const override { return notes_; }
  const std::optional<stability::HardCase>& hard_case() const override { return hard_case_; }
  std::shared_ptr<const model::Model> build(int, std::uint64_t, const scenes::Overrides&) const override {
    return nullptr;
  }

 private:
  std::string name_;
  scenes::RunDefaults defaults_;
  std::vector<std::string> notes_;
  std::optional<stability::HardCase> hard_case_;
};

}  // namespace pbmpi::app
