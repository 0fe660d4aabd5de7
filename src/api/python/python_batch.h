/// pbmpi::Batch as Python sees it.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pbmpi/batch.h"

namespace pbmpi::python {

/// Lengths of an array's dimensions, and their names, e.g. {4096, 20, 3} "[worlds][bodies][3]".
struct Shape {
  std::vector<pybind11::ssize_t> lengths;
  std::string meaning;

  /// "[worlds][bodies][3] = (4096, 20, 3)".
  std::string text() const;
};

/// Copies an array of numbers to doubles, in row-major order. `name`: the argument's. Throws
/// pybind11::value_error for another shape, pybind11::type_error for anything but real numbers.
std::vector<double> to_numbers(const pybind11::object& given, const std::string& name, const Shape& shape);

/// An array of bools, one a world, contiguous; of length 0 for None. Throws as to_numbers() does.
using Mask = pybind11::array_t<bool, pybind11::array::c_style>;
Mask to_mask(const pybind11::object& given, pybind11::ssize_t num_worlds);
std::span<const bool> span_of(const Mask& mask);

/// An array that shows `values` without a copy, is read-only, and keeps `owner` alive.
pybind11::array_t<double> read_only_view(const std::vector<double>& values, const Shape& shape,
                                         const pybind11::object& owner);

/// A batch that several threads of an interpreter may use: long calls run without the interpreter's lock, and
/// calls wait for each other. Shapes and errors are those of Batch; a wrong array throws as above.
class PythonBatch {
 public:
  /// Called without the interpreter's lock.
  explicit PythonBatch(const BatchOptions& options);

  /// Does not lock, since what this reference is used to read never changes.
  const Batch& batch() const { return batch_; }

  /// Lets Python's signal handlers run about ten times a second, and ends early with their exception; other
  /// threads may use the batch then.
  void step(int num_steps);

  /// The member of BatchState as an array that shows it without a copy and keeps `self` alive.
  static pybind11::array_t<double> view(const pybind11::object& self,
                                        std::vector<double> BatchState::*member);
  /// An argument that is None leaves its member as it is.
  void set_state(const pybind11::object& position, const pybind11::object& orientation,
                 const pybind11::object& velocity, const pybind11::object& angular_velocity,
                 const pybind11::object& mask);
  void reset(const pybind11::object& mask, std::uint64_t seed, const std::vector<Parameters>& parameters);

  /// [worlds] steps since each world's start.
  pybind11::array_t<std::int64_t> steps() const;
  /// The member of BatchJoints, likewise.
  static pybind11::array_t<double> joint_view(const pybind11::object& self,
                                              std::vector<double> BatchJoints::*member);
  /// [worlds][bodies][3] each; None: none.
  void set_forces(const pybind11::object& forces, const pybind11::object& torques);
  /// [worlds][axes], or [axes] for all worlds alike; None: none.
  void set_efforts(const pybind11::object& efforts);
  /// [worlds][motors], or [motors] for all worlds alike.
  void set_motor_velocities(const pybind11::object& velocities);
  void set_targets(const pybind11::object& positions);
  /// [worlds], or [worlds][3] for a vector.
  pybind11::array_t<double> observable(const std::string& name) const;

  pybind11::bytes save() const;
  void load(const pybind11::buffer& saved);
  /// 16 hexadecimal digits: the hash of one world of this rank, or of all worlds of all ranks.
  std::string hash(std::optional<int> world) const;

 private:
  /// Calls work(batch) with the batch locked, and without the interpreter's lock.
  template <class Self, class Work>
  static auto alone(Self& self, Work&& work);
  pybind11::ssize_t num_worlds() const { return batch_.num_local_worlds(); }
  Shape shape_of(std::vector<double> BatchState::*member) const;
  /// Numbers of shape [worlds][`each`], or of [`each`] for all worlds alike. `each`: "motors".
  std::vector<double> numbers_of_worlds(const pybind11::object& given, const char* name, const char* each,
                                        pybind11::ssize_t length) const;

  mutable std::mutex mutex_;
  Batch batch_;
  int steps_at_once_;  ///< between two calls of the signal handlers
};

}  // namespace pbmpi::python
