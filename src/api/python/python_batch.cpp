#include "api/python/python_batch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <ranges>
#include <span>
#include <string_view>
#include <utility>

namespace pbmpi::python {
namespace py = pybind11;
namespace {

std::string shape_text(std::span<const py::ssize_t> lengths) {
  std::string text = "(";
  for (const py::ssize_t length : lengths)
    text.append(text == "(" ? "" : ", ").append(std::to_string(length));
  return text + (lengths.size() == 1 ? ",)" : ")");
}

py::array to_array(const py::object& given, const std::string& name, const Shape& shape) {
  auto array = py::array::ensure(given);
  if (!array) {
    PyErr_Clear();
    throw py::value_error(name + ": it is no array; it must be " + shape.text());
  }
  return array;
}

void require_shape(const py::array& array, const std::string& name, const Shape& shape) {
  const std::span<const py::ssize_t> lengths(array.shape(), static_cast<std::size_t>(array.ndim()));
  if (!std::ranges::equal(lengths, shape.lengths))
    throw py::value_error(name + ": its shape is " + shape_text(lengths) + "; it must be " + shape.text());
}

void require_kind(const py::array& array, const std::string& name, std::string_view kinds,
                  const std::string& what) {
  if (kinds.find(array.dtype().kind()) == std::string_view::npos)
    throw py::type_error(name + ": it is of type " + py::str(array.dtype()).cast<std::string>() +
                         "; it must hold " + what);
}

/// A long call lets Python's signal handlers run, so that Ctrl-C ends it, after this time, but not before
/// this many steps: steppers take the worlds of a pack through all steps of a call before the next pack,
/// while they are in the cache. 4,096 worlds of CrashSk take twice as long with steps one by one as with 24
/// at once.
constexpr double seconds_at_once = 0.1;
constexpr int least_steps_at_once = 30;

/// A member of BatchState, its name in Python, and the length of its rows.
struct StateArray {
  std::vector<double> BatchState::*member;
  const char* name;
  py::ssize_t length;
};
constexpr std::array<StateArray, 4> state_arrays = {{
    {&BatchState::position, "position", 3},
    {&BatchState::orientation, "orientation", 4},
    {&BatchState::velocity, "velocity", 3},
    {&BatchState::angular_velocity, "angular_velocity", 3},
}};

const StateArray& array_of(std::vector<double> BatchState::*member) {
  return *std::ranges::find(state_arrays, member, &StateArray::member);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

namespace py = pybind11;

std::string Shape::text() const { return meaning + " = " + shape_text(lengths); }

std::vector<double> to_numbers(const py::object& given, const std::string& name, const Shape& shape) {
  const py::array array = to_array(given, name, shape);
  require_kind(array, name, "fiu", "real numbers");
  require_shape(array, name, shape);
  const py::array_t<double, py::array::c_style | py::array::forcecast> numbers(array);
  return {numbers.data(), numbers.data() + numbers.size()};
}

Mask to_mask(const py::object& given, py::ssize_t num_worlds) {
  if (given.is_none()) return Mask(0);
  const Shape shape{{num_worlds}, "[worlds]"};
  const py::array array = to_array(given, "mask", shape);
  require_kind(array, "mask", "b", "bools, one a world of this rank, e.g. batch.steps >= 300");
  require_shape(array, "mask", shape);
  return Mask(array);
}

std::span<const bool> span_of(const Mask& mask) {
  return {mask.data(), static_cast<std::size_t>(mask.size())};
}

py::array_t<double> read_only_view(const std::vector<double>& values, const Shape& shape,
                                   const py::object& owner) {
  py::array_t<double> view(shape.lengths, values.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

PythonBatch::PythonBatch(const BatchOptions& options)
    : batch_(options), steps_at_once_(least_steps_at_once) {}

// The interpreter's lock is taken again only after the batch's is released: no thread waits for one while
// holding the other.
template <class Self, class Work>
auto PythonBatch::alone(Self& self, Work&& work) {
  const py::gil_scoped_release without_interpreter;
  const std::lock_guard lock(self.mutex_);
  return work(self.batch_);
}

void PythonBatch::step(int num_steps) {
  if (num_steps < 0)
    throw py::value_error("step(" + std::to_string(num_steps) + "): steps must be 0 or more");
  while (num_steps > 0) {
    alone(*this, [&](Batch& batch) {
      const int count = std::clamp(num_steps, 1, steps_at_once_);
      const auto start = std::chrono::steady_clock::now();
      batch.step(count);
      num_steps -= count;
      const double possible = count * seconds_at_once / std::max(seconds_since(start), 1e-9);
      steps_at_once_ = static_cast<int>(std::clamp(possible, double{least_steps_at_once}, 1e9));
    });
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

Shape PythonBatch::shape_of(std::vector<double> BatchState::*member) const {
  const py::ssize_t length = array_of(member).length;
  return {{num_worlds(), batch_.num_bodies(), length}, "[worlds][bodies][" + std::to_string(length) + "]"};
}

py::array_t<double> PythonBatch::view(const py::object& self, std::vector<double> BatchState::*member) {
  auto& batch = self.cast<PythonBatch&>();
  const BatchState& state = *alone(batch, [](Batch& of) { return &of.state(); });
  return read_only_view(state.*member, batch.shape_of(member), self);
}

py::array_t<double> PythonBatch::joint_view(const py::object& self,
                                            std::vector<double> BatchJoints::*member) {
  auto& batch = self.cast<PythonBatch&>();
  const BatchJoints& joints = *alone(batch, [](Batch& of) { return &of.joints(); });
  const Shape shape{{batch.num_worlds(), std::ssize(batch.batch_.joint_axes())}, "[worlds][axes]"};
  return read_only_view(joints.*member, shape, self);
}

void PythonBatch::set_state(const py::object& position, const py::object& orientation,
                            const py::object& velocity, const py::object& angular_velocity,
                            const py::object& mask) {
  const Mask worlds = to_mask(mask, num_worlds());
  const std::array given = {&position, &orientation, &velocity, &angular_velocity};
  std::array<std::optional<std::vector<double>>, 4> arrays;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const StateArray& array = state_arrays.at(i);
    if (!given.at(i)->is_none()) arrays.at(i) = to_numbers(*given.at(i), array.name, shape_of(array.member));
  }
  alone(*this, [&](Batch& batch) {
    BatchState state = batch.state();
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (arrays.at(i)) state.*state_arrays.at(i).member = std::move(*arrays.at(i));
    }
    batch.set_state(state, span_of(worlds));
  });
}

void PythonBatch::reset(const py::object& mask, std::uint64_t seed,
                        const std::vector<Parameters>& parameters) {
  const Mask worlds = to_mask(mask, num_worlds());
  alone(*this, [&](Batch& batch) { batch.reset(span_of(worlds), seed, parameters); });
}

py::array_t<std::int64_t> PythonBatch::steps() const {
  const auto steps = alone(*this, [](const Batch& batch) {
    return std::vector<std::int64_t>(batch.steps().begin(), batch.steps().end());
  });
  return py::array_t<std::int64_t>(num_worlds(), steps.data());
}

std::vector<double> PythonBatch::numbers_of_worlds(const py::object& given, const char* name,
                                                   const char* each, py::ssize_t length) const {
  const std::string meaning = "[" + std::string(each) + "]";
  const auto array = py::array::ensure(given);
  if (!array || array.ndim() != 1) {
    PyErr_Clear();
    return to_numbers(given, name, {{num_worlds(), length}, "[worlds]" + meaning});
  }
  const std::vector<double> one = to_numbers(given, name, {{length}, meaning});
  std::vector<double> numbers;
  for (py::ssize_t world = 0; world < num_worlds(); ++world)
    numbers.insert(numbers.end(), one.begin(), one.end());
  return numbers;
}

void PythonBatch::set_motor_velocities(const py::object& velocities) {
  const std::vector<double> wanted =
      numbers_of_worlds(velocities, "velocities", "motors", std::ssize(batch_.motors()));
  alone(*this, [&](Batch& batch) { batch.set_motor_velocities(wanted); });
}

void PythonBatch::set_targets(const py::object& positions) {
  const std::vector<double> wanted =
      numbers_of_worlds(positions, "positions", "motors", std::ssize(batch_.motors()));
  alone(*this, [&](Batch& batch) { batch.set_targets(wanted); });
}

void PythonBatch::set_forces(const py::object& forces, const py::object& torques) {
  const Shape shape{{num_worlds(), batch_.num_bodies(), 3}, "[worlds][bodies][3]"};
  const auto numbers = [&](const py::object& given, const char* name) {
    return given.is_none() ? std::vector<double>{} : to_numbers(given, name, shape);
  };
  const std::vector<double> wanted = numbers(forces, "forces"), turning = numbers(torques, "torques");
  alone(*this, [&](Batch& batch) { batch.set_forces(wanted, turning); });
}

void PythonBatch::set_efforts(const py::object& efforts) {
  const std::vector<double> wanted =
      efforts.is_none() ? std::vector<double>{}
                        : numbers_of_worlds(efforts, "efforts", "axes", std::ssize(batch_.joint_axes()));
  alone(*this, [&](Batch& batch) { batch.set_efforts(wanted); });
}

py::array_t<double> PythonBatch::observable(const std::string& name) const {
  const std::vector<double> values = alone(*this, [&](const Batch& batch) { return batch.observable(name); });
  std::vector<py::ssize_t> shape = {num_worlds()};
  if (std::ssize(values) == 3 * num_worlds() && num_worlds() > 0) shape.push_back(3);
  return py::array_t<double>(shape, values.data());
}

py::bytes PythonBatch::save() const {
  const auto saved = alone(*this, [](const Batch& batch) { return batch.save(); });
  return py::bytes(reinterpret_cast<const char*>(saved.data()), saved.size());
}

void PythonBatch::load(const py::buffer& saved) {
  const py::buffer_info bytes = saved.request();
  if (bytes.ndim != 1 || bytes.itemsize != 1 || bytes.strides[0] != 1)
    throw py::value_error("load: it takes what save() gave, as bytes");
  alone(*this, [&](Batch& batch) {
    batch.load({static_cast<const std::byte*>(bytes.ptr), static_cast<std::size_t>(bytes.size)});
  });
}

std::string PythonBatch::hash(std::optional<int> world) const {
  const std::uint64_t value =
      alone(*this, [&](const Batch& batch) { return world ? batch.hash(*world) : batch.hash(); });
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(value));
  return digits.data();
}

}  // namespace pbmpi::python
