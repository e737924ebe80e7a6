// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a simulation: the structs of simulate/options.hpp.
#include <pybind11/stl.h>

#include "hyperex/simulate/options.hpp"
#include "options_class.hpp"

namespace hyperex::python {

void bind_simulator_options(py::module_& m) {
  using namespace simulate;
  OptionsClass<BoneLayer>(m, "BoneLayer");
  OptionsClass<SupportOptions>(m, "SupportOptions");
  OptionsClass<DriveOptions>(m, "DriveOptions");
  OptionsClass<MuscleOptions>(m, "MuscleOptions");
  OptionsClass<RegionOptions>(m, "RegionOptions");
  OptionsClass<fem::MaxwellBranch>(m, "MaxwellBranch");
  OptionsClass<fem::Hyperelastic>(m, "Law");
  OptionsClass<ModelOptions>(m, "ModelOptions");
  OptionsClass<SolverOptions>(m, "SolverOptions");
  OptionsClass<ContactOptions>(m, "ContactOptions");
  OptionsClass<BoneMove>(m, "BoneMove");
  OptionsClass<SurgeryOptions>(m, "SurgeryOptions");
  OptionsClass<TimeOptions>(m, "TimeOptions");
  OptionsClass<SimulationOptions>(m, "SimulationOptions");
}

}  // namespace hyperex::python
