// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Declarations shared by all files of the Python module. Each subject is one file with one bind_
// function.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <string>

#include "hyperex/io/scan.hpp"

namespace hyperex::python {

namespace py = pybind11;
using namespace pybind11::literals;

/// Other threads of Python go on during the call. For all that takes long or has remarks to make.
using Unlocked = py::call_guard<py::gil_scoped_release>;

void bind_log(py::module_& m);
void bind_meshes(py::module_& m);
void bind_motion(py::module_& m);
void bind_tissue(py::module_& m);
void bind_obstacles(py::module_& m);
void bind_simulator_options(py::module_& m);
void bind_performance(py::module_& m);
void bind_simulator(py::module_& m);
void bind_tissue_field(py::module_& m);
void bind_measures(py::module_& m);
void bind_compare(py::module_& m);
void bind_export(py::module_& m);
void bind_scene(py::module_& m);
void bind_estimate(py::module_& m);
void bind_visits(py::module_& m);

/// From "mm", "cm" or "m"; InputError for another word.
std::optional<io::LengthUnit> unit_from(const std::optional<std::string>& word);

}  // namespace hyperex::python
