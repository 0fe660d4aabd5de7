/// The numpy arrays that a batch takes and returns.
#pragma once

#include <pybind11/numpy.h>

#include <span>
#include <string>
#include <vector>

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

}  // namespace pbmpi::python
