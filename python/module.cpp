// SPDX-License-Identifier: GPL-3.0-or-later
// The module hyperex._hyperex; hyperex/__init__.py hands out its names.
#include <filesystem>

#include "bind.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/version.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::python {
namespace {

void bind_errors(py::module_& m) {
  static py::handle input_error =
      py::register_exception<InputError>(m, "InputError", PyExc_ValueError);
  input_error.attr("__doc__") =
      "A mistake in the input: one sentence with file, key, value and what was expected.";
  py::register_exception<NumericalError>(m, "NumericalError", PyExc_RuntimeError).attr("__doc__") =
      "The input was sound, but the computation failed.";
  py::register_exception<simulate::Cancelled>(m, "Cancelled", PyExc_RuntimeError).attr("__doc__") =
      "The callback `cancelled` of a run said so. The simulator can be used as before.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const tissue::FieldError& error) {
      PyErr_SetString(input_error.ptr(), error.what());
    } catch (const std::filesystem::filesystem_error& error) {
      const std::string path = error.path1().string();
      PyErr_SetString(PyExc_OSError,
                      ((path.empty() ? "" : path + ": ") + error.code().message()).c_str());
    }
  });
}

}  // namespace
}  // namespace hyperex::python

PYBIND11_MODULE(_hyperex, m) {
  using namespace hyperex::python;
  m.attr("__version__") = std::string(hyperex::version());
  bind_errors(m);
  bind_log(m);
  bind_meshes(m);
  bind_motion(m);
  bind_tissue(m);
  bind_obstacles(m);
  bind_simulator_options(m);
  bind_performance(m);
  bind_simulator(m);
  bind_tissue_field(m);
  bind_measures(m);
  bind_compare(m);
  bind_export(m);
  bind_scene(m);
  bind_estimate(m);
  bind_visits(m);
}
