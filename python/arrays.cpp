// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.hpp"

#include <algorithm>

namespace hyperex::python {
namespace {

template <class Matrix>
py::array stack(const std::vector<Matrix>& frames, Eigen::Index rows) {
  using Scalar = typename Matrix::Scalar;
  py::array_t<Scalar> all({static_cast<py::ssize_t>(frames.size()), rows, Eigen::Index(3)});
  Scalar* to = all.mutable_data();
  for (const Matrix& frame : frames) to = std::copy_n(frame.data(), frame.size(), to);
  return read_only(std::move(all));
}

}  // namespace

py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array stacked(const std::vector<PointsF>& frames, Eigen::Index rows) {
  return stack(frames, rows);
}
py::array stacked(const std::vector<Points>& frames, Eigen::Index rows) {
  return stack(frames, rows);
}

}  // namespace hyperex::python
