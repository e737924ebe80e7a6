// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Arrays of NumPy from what C++ holds. A view shares the memory, is read-only and keeps its owner
// alive.
#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::python {

namespace py = pybind11;

py::array read_only(py::array array);

template <class Scalar, int Columns, int Order>
py::array_t<Scalar> view(const Eigen::Matrix<Scalar, Eigen::Dynamic, Columns, Order>& matrix,
                         py::handle owner) {
  if constexpr (Columns == 1)
    return read_only(py::array_t<Scalar>({matrix.size()}, {sizeof(Scalar)}, matrix.data(), owner));
  static_assert(Columns == 1 || Order & Eigen::RowMajor, "rows of NumPy's arrays are contiguous");
  const auto stride = static_cast<py::ssize_t>(sizeof(Scalar)) * matrix.cols();
  return read_only(py::array_t<Scalar>({matrix.rows(), matrix.cols()},
                                       {stride, static_cast<py::ssize_t>(sizeof(Scalar))},
                                       matrix.data(), owner));
}

template <class Scalar>
py::array_t<Scalar> view(const std::vector<Scalar>& values, py::handle owner) {
  return read_only(py::array_t<Scalar>({static_cast<py::ssize_t>(values.size())}, {sizeof(Scalar)},
                                       values.data(), owner));
}

/// frames x rows x 3, a copy: C++ holds each frame by itself.
py::array stacked(const std::vector<PointsF>& frames, Eigen::Index rows);
py::array stacked(const std::vector<Points>& frames, Eigen::Index rows);

}  // namespace hyperex::python
