// SPDX-License-Identifier: GPL-3.0-or-later
// The reduced model: its basis, its estimated error and its error against the full model at every
// step, and the time from an edit of the tissue to all frames of the skin.
#include <cmath>
#include <numeric>

#include "hyperex/fem/reduced/reduced_model.hpp"
#include "hyperex/simulate/load/muscle_load.hpp"
#include "hyperex/simulate/load/muscle_model.hpp"
#include "hyperex/simulate/run/solve.hpp"
#include "support/face_case.hpp"
#include "support/machine.hpp"
#include "support/timing.hpp"

namespace hyperex::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Tolerance of the drive for the reference run; its shapes are practically exact.
constexpr double kExact = 1e-7;

/// All unknowns at all steps of the full model.
Eigen::MatrixXd full_run(const FaceCase& face, const fem::System& system, const fem::Drive& drive) {
  fem::Newmark newmark(system, face.prescribed(), {face.dt_s()});
  std::vector<double> steps(std::size_t(drive.steps()) + 1);
  std::iota(steps.begin(), steps.end(), 0.0);
  return simulate::run_full(newmark, drive, steps).displacement;
}

struct TrueError {
  double error = 0;       ///< greatest distance of any node at any step / greatest displacement
  Eigen::Index step = 0;  ///< the step of that distance
};
TrueError true_error(const fem::Response& response, const Eigen::MatrixXd& truth) {
  constexpr Eigen::Index kChunk = 90;
  TrueError worst;
  for (Eigen::Index from = 0; from < truth.cols(); from += kChunk) {
    std::vector<double> at;
    for (Eigen::Index k = from; k < std::min(from + kChunk, truth.cols()); ++k)
      at.push_back(static_cast<double>(k));
    const Eigen::MatrixXd d = response.displacement(at);
    for (Eigen::Index k = 0; k < d.cols(); ++k)
      if (const double apart = greatest_apart(d.col(k), truth.col(from + k)); apart > worst.error)
        worst = {apart, from + k};
  }
  worst.error /= greatest(truth);
  return worst;
}

/// Basis size and errors for decreasing tolerances. `drive_of`: makes the drive for a tolerance, as
/// the program does.
template <class DriveOf>
Json sweep(const FaceCase& face, const fem::System& system, DriveOf drive_of,
           const std::vector<double>& tolerances) {
  const Eigen::MatrixXd truth = full_run(face, system, drive_of(kExact));
  fem::ReducedModel model(system, face.prescribed());
  Json rows = Json::array();
  for (const double tolerance : tolerances) {
    const fem::Drive drive = drive_of(tolerance);
    fem::ReducedOptions options;
    options.time.dt_s = face.dt_s();
    options.tolerance = tolerance;
    Stopwatch watch;
    const fem::Response response = model.run(drive, options);
    const double basis_s = watch.lap();
    const TrueError error = true_error(response, truth);
    rows.push_back({{"tolerance", tolerance},
                    {"input_shapes", drive.shapes()},
                    {"basis_size", response.basis_size},
                    {"passes", response.passes},
                    {"basis_s", basis_s},
                    {"estimated_error", response.estimated_error},
                    {"true_error", error.error},
                    {"worst_step", error.step},
                    {"converged", response.converged}});
  }
  return {{"greatest_displacement_m", greatest(truth)}, {"rows", rows}};
}

/// Time from other tissue values on the same face to all frames of the skin, through the Simulator
/// that programs use; and of a run without changes, which only reads out the results.
Json edit_to_frames(const FaceCase& face, fem::ElementKind kind, int repeats) {
  simulate::Simulator simulator = face.simulator();
  simulate::SimulationOptions options = simulator.options();
  options.model.element = kind;
  simulator.set_options(options);
  simulator.run();
  std::vector<double> assemble, factor, basis, all, again;
  std::size_t frames = 0;
  for (int i = 0; i < repeats; ++i) {
    simulate::TissueValues tissue = options.tissue;
    tissue.uniform[tissue::young] *= std::pow(0.95, i + 1);
    tissue.uniform[tissue::viscosity] *= std::pow(1.1, i + 1);
    simulate::SimulationReport report;
    all.push_back(seconds_of([&] {
      simulator.set_tissue(tissue);
      const simulate::SimulationResult result = simulator.run();
      report = result.report;
      frames = result.performance.skin_displacement_m.size();
    }));
    assemble.push_back(report.assemble_s);
    factor.push_back(report.factor_s);
    basis.push_back(report.basis_s);
    again.push_back(seconds_of([&] { simulator.run(); }));
  }
  return {{"assemble_s", median(assemble)},
          {"refactor_s", median(factor)},
          {"basis_s", median(basis)},
          {"again_s", median(again)},
          {"total_s", median(all)},
          {"frames", frames},
          {"skin_vertices", face.mesh().skin.points.rows()}};
}

/// The same face driven by muscles: time of finding the forces of a recording once the muscles'
/// unit responses exist, and time from another strength of the busiest muscle to all frames of the
/// skin.
Json muscles(const FaceCase& face, int repeats) {
  simulate::Simulator simulator = face.simulator();
  simulate::SimulationOptions options = simulator.options();
  options.drive.by = simulate::DriveBy::muscles;
  simulator.set_options(options);
  const simulate::MuscleCourse course = simulator.run().performance.muscles;
  Eigen::Index busiest = 0;
  course.activation.rowwise().maxCoeff().maxCoeff(&busiest);
  const std::string& muscle = course.names[std::size_t(busiest)];
  simulator.hold_load();
  std::vector<double> strength, tissue, fit;
  for (int i = 0; i < repeats; ++i) {
    options.muscles.gains = {{muscle, 1 - 0.9 * (i + 1) / repeats}};
    strength.push_back(seconds_of([&] {
      simulator.set_options(options);
      simulator.run();
    }));
  }
  options.muscles.gains.clear();
  for (int i = 0; i < repeats; ++i) {
    options.tissue.uniform[tissue::young] *= 0.95;
    tissue.push_back(seconds_of([&] {
      simulator.set_options(options);
      simulator.run();
    }));
  }
  simulate::SimulationOptions of = face.simulator().options();
  of.drive.by = simulate::DriveBy::muscles;
  fem::System system;
  const fem::Assembler assembler(face.mesh().volume.nodes, face.mesh().volume.tets,
                                 of.model.element);
  fem::Material material =
      of.tissue.material(std::size_t(face.mesh().volume.tets.rows()), of.model.viscous_form);
  stiffen_lips(face.mesh(), simulator.landmarks(), of.muscles, material);
  assembler.assemble(material, system);
  const simulate::MuscleModel model =
      muscle_model(face.mesh(), simulator.landmarks(), of, system.stiffness, nullptr);
  const simulate::MeasuredRegion region =
      measured_region(face.mesh(), simulator.landmarks(), simulator.motion(), of.region);
  for (int i = 0; i < std::min(repeats, 5); ++i)
    fit.push_back(seconds_of([&] {
      muscle_load(face.mesh(), simulator.landmarks(), simulator.motion(), region, of, model);
    }));
  return {{"strength_to_frames_s", median(strength)},
          {"tissue_to_frames_s", median(tissue)},
          {"samples", simulator.motion().motion.time_s.size()},
          {"forces_s", median(fit)}};
}

Json measure(bool quick) {
  const FaceCase face(Face::subject_a_if_there);
  const std::vector<double> tolerances =
      quick ? std::vector<double>{1e-2, 1e-3} : std::vector<double>{1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
  Json out;
  for (const fem::ElementKind kind : fem::kElementKinds) {
    const fem::System system = face.system(kind);
    const fem::Drive drive = face.drive(1e-3);
    fem::ReducedModel model(system, face.prescribed());
    fem::ReducedOptions options;
    options.time.dt_s = face.dt_s();
    Json e;
    e["free_unknowns"] = model.free_count();
    e["analyse_s"] = model.analyse_seconds();
    e["factor_s"] = model.factor_seconds();
    const fem::Response response = model.run(drive, options);
    e["basis_s"] = median_seconds(quick ? 2 : 5, [&] { model.run(drive, options); });
    e["basis_size"] = response.basis_size;
    e["input_shapes"] = drive.shapes();
    e["input_shapes_s"] = median_seconds(3, [&] { face.drive(1e-3); });
    e["edit"] = edit_to_frames(face, kind, quick ? 3 : 9);
    const auto motion = [&](double tolerance) { return face.drive(tolerance); };
    e["motion"] = sweep(face, system, motion, tolerances);
    const auto hard = [&](double tolerance) { return face.sine(0.27, tolerance); };
    e["hard"] = sweep(face, face.system(kind, 0.1), hard, tolerances);
    out["elements"][std::string(to_string(kind))] = e;
  }
  out["muscles"] = muscles(face, quick ? 3 : 9);
  return out;
}

}  // namespace
}  // namespace hyperex::bench

/// reduced_bench FILE.json [--quick | --edit | --muscles]; --edit: only the cost of an edit,
/// --muscles: only the cost of muscles
int main(int argc, char** argv) {
  using namespace hyperex::bench;
  if (argc > 2 && std::string(argv[2]) == "--edit") {
    const FaceCase face(Face::subject_a_if_there);
    write_json(edit_to_frames(face, hyperex::fem::ElementKind::tet4_star, 21), argv[1]);
    return 0;
  }
  if (argc > 2 && std::string(argv[2]) == "--muscles") {
    write_json(muscles(FaceCase(Face::subject_a_if_there), 9), argv[1]);
    return 0;
  }
  write_json(measure(argc > 2 && std::string(argv[2]) == "--quick"), argc > 1 ? argv[1] : "-");
}
