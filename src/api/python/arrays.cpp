#include "api/python/arrays.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

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

}  // namespace

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

}  // namespace pbmpi::python
