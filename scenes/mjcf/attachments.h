/// MJCF's `<attach>`: models, or parts of them, that stand in another model.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "scenes/mjcf/settings/defaults.h"
#include "scenes/xml/attributes.h"
#include "scenes/xml/include.h"

namespace pbmpi::scenes::mjcf {

/// One use of a model: the main one, or one that an `<attach>` makes. What `<compiler>` and `<default>` of
/// its file say counts in it alone, and a name in it means what it has itself.
struct Part {
  std::string file;
  const xml::Element* root = nullptr;  ///< `<mujoco>`
  const Context* context = nullptr;
  const Part* into = nullptr;  ///< the part that attaches it; null: the main one
  std::string prefix;          ///< of all of its names, with those of the parts around it

  /// The elements of that name in the root.
  std::vector<const xml::Element*> sections(std::string_view name) const;
};

/// What an `<attach>` puts in its place.
struct Attached {
  const Part* part = nullptr;
  const xml::Element* element = nullptr;  ///< a body, a frame, or the `<worldbody>`
  std::string childclass;                 ///< of the elements around it
};

/// Owns the parts of a model, and what its files say.
class Attachments {
 public:
  /// Reads the model's own file. `texts` and `leave_out` are borrowed.
  Attachments(const std::string& file, const xml::Texts& texts, const xml::LeaveOut& leave_out);
  Attachments(const Attachments&) = delete;
  Attachments& operator=(const Attachments&) = delete;

  /// Adds the part that an `<attach>` in `into` asks for. Its `<option>` does not count: the main model has
  /// that. Throws core::InputError for an unknown model, body or frame.
  Attached attach(const xml::Element& attach, const Part& into);
  /// The main part first.
  const std::deque<Part>& parts() const { return parts_; }
  const Part& main() const { return parts_.front(); }

 private:
  struct Source {
    xml::Element root;
    Context context;
  };
  Source& source_of(const std::string& file);
  /// The file of the `<model>` that the attribute 'model' names.
  std::string file_of(xml::Attributes& attach, const Part& into);

  const xml::Texts& texts_;
  const xml::LeaveOut& leave_out_;
  std::map<std::string, Source> sources_;  ///< by file
  std::deque<Part> parts_;
};

}  // namespace pbmpi::scenes::mjcf
