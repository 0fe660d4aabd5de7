/// A model while a scene adds to it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.h"
#include "scenes/parts/name_index.h"

namespace pbmpi::scenes {

/// Adds the finding of bodies, joints and actors by name, each in logarithmic time. Nothing is ever taken out
/// of its lists or renamed.
class GrowingModel : public model::Model {
 public:
  explicit GrowingModel(model::Model empty) : Model(std::move(empty)) {}

  std::optional<int> find_body(std::string_view name) { return body_names_.find(bodies, name); }
  /// Index of the body, joint or actor of that name. `where`: "file:line:column: what", the beginning of the
  /// message of the core::InputError if there is none.
  /// `also`: a word that may stand for none, offered where it is probably meant.
  int named_body(const std::string& name, const std::string& where, std::string_view also = {});
  int named_joint(const std::string& name, const std::string& where);
  int named_actor(const std::string& name, const std::string& where);
  /// named_actor() and its copies "name.1", "name.2", ..., of which there must be one.
  std::vector<int> named_actors(const std::string& name, const std::string& where);
  bool has_body_beginning_with(const std::string& beginning);
  /// The first geom of a body; null without one.
  const model::Geom* geom_of(int body);

 private:
  NameIndex body_names_, joint_names_, actor_names_;
  std::vector<int> geom_of_body_;  // -1: none
  std::size_t num_known_geoms_ = 0;
};

}  // namespace pbmpi::scenes
