// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a simulation: the structs of simulate/options.hpp.
#include <pybind11/stl.h>

#include <map>

#include "hyperex/simulate/options.hpp"
#include "options_class.hpp"

namespace hyperex::python {
namespace {

using namespace simulate;

void bind_support(py::module_& m) {
  OptionsClass<BoneLayer>(m, "BoneLayer", "Springs between tissue and bone, per area.")
      .field("across_pa_per_m", &BoneLayer::across_pa_per_m, "Across the layer, 0 to 1e12 Pa/m.")
      .field("along_pa_per_m", &BoneLayer::along_pa_per_m, "Along it, 0 to 1e12 Pa/m.");
  OptionsClass<SupportOptions>(m, "SupportOptions", "What holds the tissue.")
      .field("border_held", &SupportOptions::border_held, "The scan's outer border stays.")
      .word("skull", &SupportOptions::skull,
            {{"held", Hold::held}, {"sliding", Hold::sliding}, {"free", Hold::free}},
            "held, sliding or free.")
      .word("mandible", &SupportOptions::mandible,
            {{"follow", Mandible::follow}, {"held", Mandible::held}, {"free", Mandible::free}},
            "follow, held or free.")
      .field("skull_layer", &SupportOptions::skull_layer, "Used where skull is sliding.")
      .field("mandible_layer", &SupportOptions::mandible_layer,
             "Used where the mandible is followed.")
      .field("field_pa_per_m", &SupportOptions::field_pa_per_m,
             "Springs to the interpolated motion of the driven points, 0 to 1e12 Pa/m.")
      .list("jaw_points", &SupportOptions::jaw_points,
            "Names of points that carry the jaw; none: the chin points among the driven.");
}

void bind_drive(py::module_& m) {
  OptionsClass<DriveOptions>(m, "DriveOptions", "Which points move the skin.")
      .list("points", &DriveOptions::points, "Names of the motion's points.")
      .word("by", &DriveOptions::by,
            {{"displacement", DriveBy::displacement},
             {"muscles", DriveBy::muscles},
             {"reactions", DriveBy::reactions}},
            "displacement; muscles or reactions: forces, which other tissue answers.")
      .field("all_points", &DriveOptions::all_points, "Every point of the motion.")
      .list("still_points", &DriveOptions::still_points,
            "Names of landmarks that are kept where they are.")
      .field("patch_radius_m", &DriveOptions::patch_radius_m,
             "Of the skin that a point moves, 0 to 0.03 m; 0: the nearest node.")
      .field("gain", &DriveOptions::gain, "On all displacements.");
  OptionsClass<MuscleOptions>(m, "MuscleOptions", "Muscles, where they are what drives.")
      .custom(
          "gains",
          [](const MuscleOptions& self) -> py::object {
            py::dict gains;
            for (const MuscleGain& gain : self.gains) gains[py::str(gain.muscle)] = gain.gain;
            return gains;
          },
          [](MuscleOptions& self, py::handle v) {
            self.gains.clear();
            for (const auto& [muscle, gain] : v.cast<std::map<std::string, double>>())
              self.gains.push_back({muscle, gain});
          },
          "Factors (0 to 5) on activations by muscle (zyg_major_R), branch of the facial nerve "
          "(zygomatic_R) or side (side_R): a dict, handed out as a copy.")
      .field("mirrored", &MuscleOptions::mirrored,
             "Each muscle takes the activation of its counterpart.");
  OptionsClass<RegionOptions>(m, "RegionOptions",
                              "Which part of the skin follows the recording directly.")
      .word("measured", &RegionOptions::measured,
            {{"none", Measured::none}, {"all", Measured::all}, {"points", Measured::points}},
            "none, all or points.")
      .list("measured_points", &RegionOptions::measured_points,
            "Names; at least one where measured is points.")
      .field("measured_radius_m", &RegionOptions::measured_radius_m,
             "Of the skin around them, 0.001 to 0.2 m.")
      .field("blend_m", &RegionOptions::blend_m, "From measured to physical, 0 to 0.1 m.");
}

void bind_solver(py::module_& m) {
  OptionsClass<fem::MaxwellBranch>(m, "MaxwellBranch", "A spring and a dashpot beside the law.")
      .field("ratio", &fem::MaxwellBranch::ratio, "Its stress at once over the law's, 0 to 100.")
      .field("relaxation_s", &fem::MaxwellBranch::relaxation_s,
             "In which it falls to 1/e at a held stretch, 1e-6 to 1e6 s.");
  OptionsClass<fem::Hyperelastic>(m, "Law", "The hyperelastic law at finite strain.")
      .word("name", &fem::Hyperelastic::law,
            {{"neo-hookean", fem::HyperelasticLaw::neo_hookean},
             {"isochoric-neo-hookean", fem::HyperelasticLaw::isochoric_neo_hookean},
             {"yeoh", fem::HyperelasticLaw::yeoh},
             {"mooney-rivlin", fem::HyperelasticLaw::mooney_rivlin}},
            "neo-hookean, isochoric-neo-hookean, yeoh or mooney-rivlin; its stiffness at small "
            "strain is that of the Tissue.")
      .field("c20", &fem::Hyperelastic::c20, "C20/C10 of yeoh; E = 4 (1 + poisson) C10.")
      .field("c30", &fem::Hyperelastic::c30, "C30/C10 of yeoh.")
      .field("c01", &fem::Hyperelastic::c01, "C01/C10 of mooney-rivlin.")
      .list("maxwell", &fem::Hyperelastic::branches, "MaxwellBranch, parallel to the law.");
  OptionsClass<ModelOptions>(m, "ModelOptions", "The elements.")
      .word("element", &ModelOptions::element,
            {{"tet4-star", fem::ElementKind::tet4_star}, {"tet4", fem::ElementKind::tet4}},
            "tet4-star (for nearly incompressible tissue) or tet4.")
      .word("viscous_form", &ModelOptions::viscous_form,
            {{"isotropic", fem::ViscousForm::isotropic}, {"printed", fem::ViscousForm::printed}},
            "isotropic or printed.")
      .word("strain", &ModelOptions::strain,
            {{"linear", Strain::linear}, {"finite", Strain::finite}}, "linear or finite.")
      .field("law", &ModelOptions::law,
             "A Law; other than the default only where strain is finite: small strain has none.");
  OptionsClass<SolverOptions>(m, "SolverOptions", "How the equations are solved.")
      .word("method", &SolverOptions::method,
            {{"reduced", SolverMethod::reduced}, {"direct", SolverMethod::direct}},
            "reduced, or direct: all unknowns at every step.")
      .word("linear", &SolverOptions::linear,
            {{"auto", fem::LinearSolver::automatic},
             {"cholesky", fem::LinearSolver::cholesky},
             {"iterative", fem::LinearSolver::iterative}},
            "auto, cholesky or iterative.")
      .field("tolerance", &SolverOptions::tolerance,
             "Of the reduced model, over the greatest displacement, 1e-9 to 0.1.")
      .field("newmark_beta", &SolverOptions::newmark_beta, "0.25 to 1.")
      .field("newmark_gamma", &SolverOptions::newmark_gamma, "0.5 to 1, at most 2 beta.")
      .field("finite_step_s", &SolverOptions::finite_step_s,
             "Of a step at finite strain, 0 to 0.5; 0: a frame.")
      .field("finite_tolerance", &SolverOptions::finite_tolerance,
             "Of its iterations, over the greatest displacement, 1e-9 to 0.1.")
      .field("full_newton", &SolverOptions::full_newton, "Factor in each of them, not once a step.")
      .field("verify", &SolverOptions::verify,
             "Run the full model too and measure the reduced one's error.");
  OptionsClass<ContactOptions>(m, "ContactOptions", "What the tissue may not pass through.")
      .field("lips", &ContactOptions::lips, "The lips each other.")
      .field("teeth", &ContactOptions::teeth, "Tissue and teeth (Simulator.set_obstacles).")
      .field("eyes", &ContactOptions::eyes, "Lids and eyeballs, likewise.")
      .field("patch_pa_per_m", &ContactOptions::patch_pa_per_m,
             "Springs that hold driven patches where something touches, 1e5 to 1e12 Pa/m.")
      .field("point_give", &ContactOptions::point_give,
             "Where forces drive: how far driven points yield, over the tissue's own compliance, "
             "1e-6 to 1e6.");
  OptionsClass<TimeOptions>(m, "TimeOptions", "Steps and frames.")
      .field("step_s", &TimeOptions::step_s, "1e-6 to 0.1 s.")
      .field("end_s", &TimeOptions::end_s, "0: the end of the motion.")
      .field("frame_rate_hz", &TimeOptions::frame_rate_hz, "1 to 1000 Hz.")
      .field("peak_time_s", &TimeOptions::peak_time_s,
             "Below 0: where the driven points moved most.");
}

}  // namespace

void bind_simulator_options(py::module_& m) {
  bind_support(m);
  bind_drive(m);
  bind_solver(m);
  OptionsClass<SimulationOptions>(m, "SimulationOptions", "All options of a Simulator.")
      .field("tissue", &SimulationOptions::tissue, "A Tissue.")
      .field("support", &SimulationOptions::support, "SupportOptions.")
      .field("drive", &SimulationOptions::drive, "DriveOptions.")
      .field("muscles", &SimulationOptions::muscles, "MuscleOptions.")
      .field("region", &SimulationOptions::region, "RegionOptions.")
      .field("model", &SimulationOptions::model, "ModelOptions.")
      .field("solver", &SimulationOptions::solver, "SolverOptions.")
      .field("contact", &SimulationOptions::contact, "ContactOptions.")
      .field("time", &SimulationOptions::time, "TimeOptions.");
}

}  // namespace hyperex::python
