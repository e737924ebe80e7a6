// SPDX-License-Identifier: GPL-3.0-or-later
// The reduced model: its basis, its error as estimated and against the full model at every step,
// what a run costs once the basis exists, and from an edit of the tissue to the first frame.
#include "hyperex/fem/reduced/dense.hpp"
#include "hyperex/fem/reduced/reduced_model.hpp"
#include "hyperex/fem/reduced/reduced_newmark.hpp"
#include "support/face_case.hpp"
#include "support/machine.hpp"
#include "support/timing.hpp"

namespace hyperex::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Tolerance of the drive that the truth is run with: its shapes leave out next to nothing.
constexpr double kExact = 1e-7;

/// All unknowns at all steps of the full model.
Eigen::MatrixXd full_run(const FaceCase& face, const fem::System& system, const fem::Drive& drive) {
  fem::Newmark newmark(system, face.prescribed(), {face.dt_s()});
  Eigen::VectorXd d = Eigen::VectorXd::Zero(system.stiffness.cols()), v = d;
  const fem::Kinematics first = drive.prescribed_at(0);
  d(face.prescribed()) = first.d;
  v(face.prescribed()) = first.v;
  newmark.start(d, v, first.a, drive.force_at(0));
  Eigen::MatrixXd out(d.size(), drive.steps() + 1);
  out.col(0) = d;
  for (int step = 1; step <= drive.steps(); ++step) {
    newmark.step(drive.prescribed_at(step), drive.force_at(step));
    out.col(step) = newmark.displacement();
  }
  return out;
}

struct TrueError {
  double error = 0;  ///< greatest distance of any node at any step, over the greatest displacement
  Eigen::Index step = 0;  ///< at which
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

/// Basis size and errors as the tolerance falls. `drive_of`: the drive as the program makes it for
/// a tolerance.
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

/// Stepping and reading out with a basis that is there. The basis is taken from a response; its
/// projections are made again here, which is not part of the time.
Json run_with_basis(const FaceCase& face, const fem::System& system, const fem::Drive& drive,
                    const fem::Response& response, int repeats) {
  fem::Response run = response;
  const Eigen::MatrixXd v = response.shapes.leftCols(response.basis_size);
  const Eigen::MatrixXd shapes = response.shapes.rightCols(drive.shapes());
  const auto projected = [&](const fem::SparseMatrix& m, const Eigen::MatrixXd& of) {
    return Eigen::MatrixXd(v.transpose() * fem::symmetric_product(m, of));
  };
  const Eigen::MatrixXd k = projected(system.stiffness, v), c = projected(system.damping, v),
                        m = projected(system.mass, v);
  const Eigen::MatrixXd static_ = v.transpose() * drive.force - projected(system.stiffness, shapes);
  const Eigen::MatrixXd viscous = projected(system.damping, shapes),
                        inertial = projected(system.mass, shapes);
  const std::vector<double> at = face.frames_in_steps();

  std::vector<double> step_s, nodes_s, skin_s, all_s;
  double apart = 0;
  for (int i = 0; i <= repeats; ++i) {
    Stopwatch watch;
    Eigen::MatrixXd force = static_ * drive.s;
    force.noalias() -= viscous * drive.rate;
    force.noalias() -= inertial * drive.second;
    const fem::ReducedMotion motion =
        fem::integrate_reduced(k, c, m, force, fem::NewmarkOptions{face.dt_s()});
    const double stepped = watch.lap();
    run.course << motion.d, drive.s;
    watch.lap();
    const Eigen::MatrixXd nodes = run.displacement(at);
    const double read = watch.lap();
    const std::vector<PointsF> skin = face.carry_to_skin(nodes);
    const double carried = watch.lap();
    apart = (run.course - response.course).cwiseAbs().maxCoeff() /
            response.course.cwiseAbs().maxCoeff();
    if (i == 0) continue;
    step_s.push_back(stepped);
    nodes_s.push_back(read);
    skin_s.push_back(carried);
    all_s.push_back(stepped + read + carried);
  }
  return {{"steps", drive.steps()},
          {"frames", at.size()},
          {"skin_vertices", face.mesh().skin.points.rows()},
          {"stepping_s", median(step_s)},
          {"nodes_s", median(nodes_s)},
          {"skin_s", median(skin_s)},
          {"total_s", median(all_s)},
          {"courses_apart", apart}};
}

/// From other tissue values on the same mesh to a frame on the skin.
Json edit_to_frame(const FaceCase& face, fem::ElementKind kind, const fem::Drive& drive,
                   int repeats) {
  const auto& volume = face.mesh().volume;
  const fem::Assembler assembler(volume.nodes, volume.tets, kind);
  fem::System system;
  face.assemble(assembler, face.material(), system);
  fem::ReducedModel model(system, face.prescribed());
  fem::Newmark newmark(system, face.prescribed(), {face.dt_s()});
  fem::ReducedOptions options;
  options.time.dt_s = face.dt_s();
  std::vector<double> parts[4], all, direct;
  for (int i = 0; i < repeats; ++i) {
    fem::Material material = face.material(1 + 0.1 * (i + 1));
    for (double& young : material.young_pa) young *= 1 - 0.05 * (i + 1);
    Stopwatch watch;
    face.assemble(assembler, material, system);
    parts[0].push_back(watch.lap());
    model.refill(system);
    parts[1].push_back(watch.lap());
    const fem::Response response = model.run(drive, options);
    parts[2].push_back(watch.lap());
    const auto skin = face.carry_to_skin(response.displacement({drive.steps() / 2.0}));
    parts[3].push_back(watch.lap());
    all.push_back(parts[0][i] + parts[1][i] + parts[2][i] + parts[3][i]);

    watch.lap();
    newmark.refill(system);
    newmark.step(drive.prescribed_at(1), drive.force_at(1));
    face.carry_to_skin(newmark.displacement());
    direct.push_back(parts[0][i] + watch.lap());
  }
  return {{"assemble_s", median(parts[0])}, {"refactor_s", median(parts[1])},
          {"basis_s", median(parts[2])},    {"frame_s", median(parts[3])},
          {"total_s", median(all)},         {"direct_total_s", median(direct)}};
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
    e["run"] = run_with_basis(face, system, drive, response, quick ? 5 : 15);
    e["edit"] = edit_to_frame(face, kind, drive, quick ? 3 : 5);
    const auto motion = [&](double tolerance) { return face.drive(tolerance); };
    e["motion"] = sweep(face, system, motion, tolerances);
    const auto hard = [&](double tolerance) { return face.sine(0.27, tolerance); };
    e["hard"] = sweep(face, face.system(kind, 0.1), hard, tolerances);
    out["elements"][std::string(to_string(kind))] = e;
  }
  return out;
}

}  // namespace
}  // namespace hyperex::bench

/// reduced_bench FILE.json [--quick]
int main(int argc, char** argv) {
  using namespace hyperex::bench;
  write_json(measure(argc > 2 && std::string(argv[2]) == "--quick"), argc > 1 ? argv[1] : "-");
}
