// SPDX-License-Identifier: GPL-3.0-or-later
// The cost of finite strain on a face: the embedded face on springs, its mouth opened by patches
// around seven points, by 2 cm at the chin in a second.
//   finite_bench [element size in mm]
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <limits>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/fem/time/finite_newton.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::bench {
namespace {

using Eigen::VectorXd;

constexpr double kPatch_m = 0.005;

struct Face {
  tissue::VolumeMesh mesh;
  fem::Material material;
  std::vector<int> prescribed;
  VectorXd way;  // displacement of the prescribed unknowns, m
  fem::SparseMatrix springs;
};

Face make_face(double element_size_m) {
  const anatomy::EmbeddedFace embedded = anatomy::embedded_face();
  tissue::TissueMeshOptions options;
  options.element_size_m = element_size_m;
  const tissue::TissueMesh tissue =
      tissue::build_tissue_mesh(embedded.mesh, embedded.landmarks, options, "the embedded face");
  Face face;
  face.mesh = tissue.volume;
  const auto tets = static_cast<std::size_t>(face.mesh.tets.rows());
  face.material.young_pa.assign(tets, 192.4e3);
  face.material.poisson.assign(tets, 0.495);
  face.material.viscosity_pa_s.assign(tets, 476.8);
  face.material.density_kg_m3.assign(tets, 1100);

  // Landmarks and their displacements (mm): down at the chin and the lower lip, inwards at the
  // corners.
  const std::vector<std::pair<int, Vec3>> points{
      {48, {3, -5, -2}}, {54, {-3, -5, -2}}, {51, {0, 1, 0}},    {57, {0, -17, -5}},
      {8, {0, -20, -7}}, {58, {1, -15, -4}}, {56, {-1, -15, -4}}};
  std::vector<double> way;
  const auto surface = static_cast<int>(face.mesh.surface_nodes());
  for (int n = 0; n < surface; ++n) {
    double nearest = kPatch_m;
    const Vec3* moved = nullptr;
    for (const auto& [mark, by] : points) {
      const Vec3 at = embedded.landmarks.at("ibug68_" + std::to_string(mark));
      const double distance = (Vec3(face.mesh.nodes.row(n).transpose()) - at).norm();
      if (distance < nearest) {
        nearest = distance;
        moved = &by;
      }
    }
    for (int axis = 0; moved && axis < 3; ++axis) {
      face.prescribed.push_back(3 * n + axis);
      way.push_back(1e-3 * (*moved)[axis]);
    }
  }
  face.way = Eigen::Map<VectorXd>(way.data(), static_cast<Eigen::Index>(way.size()));

  // Springs to the bone at every node below the tissue, stiffer at the border (N/m).
  std::vector<Eigen::Triplet<double>> springs;
  for (int v = 0; v < surface; ++v) {
    const int n = face.mesh.layers * surface + v;
    for (int axis = 0; axis < 3; ++axis)
      springs.emplace_back(3 * n + axis, 3 * n + axis, tissue.on_border[v] ? 1e4 : 50);
  }
  face.springs.resize(face.mesh.nodes.size(), face.mesh.nodes.size());
  face.springs.setFromTriplets(springs.begin(), springs.end());
  return face;
}

template <typename F>
double best_ms(F f) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 7; ++i) {
    Stopwatch watch;
    f();
    best = std::min(best, watch.lap());
  }
  return 1e3 * best;
}

void run(const Face& face, const fem::Assembler& assembler, const fem::Hyperelastic& law,
         double dt_s, const fem::FiniteNewtonOptions& options, std::string_view name) {
  fem::FiniteStrain form(assembler, face.material, law);
  fem::FiniteNewton newton(form, face.prescribed, options, face.springs);
  const int steps = static_cast<int>(std::lround(1 / dt_s));
  fem::FiniteStepReport sum;
  double seconds = 0, slowest = 0, peak = 0, error = 0;
  int inverted = 0;
  const std::clock_t before = std::clock();
  for (int i = 1; i <= steps; ++i) {
    const double share = std::pow(std::sin(M_PI * i / steps), 2);
    Stopwatch watch;
    const fem::FiniteStepReport r = newton.step(dt_s, share * face.way);
    const double s = watch.lap();
    seconds += s;
    slowest = std::max(slowest, s);
    sum.parts += r.parts;
    sum.iterations += r.iterations;
    sum.factorisations += r.factorisations;
    sum.projections += r.projections;
    error = std::max(error, r.error);
    peak = std::max(peak, newton.displacement().cwiseAbs().maxCoeff());
    const Points d =
        Eigen::Map<const Points>(newton.displacement().data(), face.mesh.nodes.rows(), 3);
    for (const auto flag : fem::inverted_tets(face.mesh.nodes, face.mesh.tets, d)) inverted += flag;
  }
  fmt::print(
      "{:34} {:3} steps of {:4.1f} ms: {:6.1f} ms a step (slowest {:6.1f}; {:6.1f} of processors), "
      "{:.2f} iterations, "
      "{:.2f} factors, {} projected, {} parts, peak {:.1f} mm, error {:.1e}, inverted {}\n",
      name, steps, 1e3 * dt_s, 1e3 * seconds / steps, 1e3 * slowest,
      1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC / steps,
      static_cast<double>(sum.iterations) / steps, static_cast<double>(sum.factorisations) / steps,
      sum.projections, sum.parts, 1e3 * peak, error, inverted);
}

void measure(double element_size_m) {
  const Face face = make_face(element_size_m);
  const fem::Assembler assembler(face.mesh.nodes, face.mesh.tets, fem::ElementKind::tet4_star);
  fmt::print("{} nodes, {} tetrahedra, {} of {} unknowns prescribed\n", face.mesh.nodes.rows(),
             face.mesh.tets.rows(), face.prescribed.size(), face.mesh.nodes.size());

  for (const fem::HyperelasticLaw law : fem::kHyperelasticLaws) {
    fem::Hyperelastic h;
    h.law = law;
    h.c01 = 0.2;
    fem::FiniteStrain form(assembler, face.material, h);
    VectorXd d = VectorXd::Zero(face.mesh.nodes.size()), gradient = d;
    for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = 1e-4 * std::sin(static_cast<double>(i));
    form.begin_step({100, -100, 0, 0.01}, 0.5 * d, d);
    fem::SparseMatrix k;
    fmt::print("{:24} energy and forces {:5.2f} ms, tangent {:5.2f} ms, projected {:6.1f} ms\n",
               to_string(law), best_ms([&] { form.energy_and_gradient(d, gradient); }),
               best_ms([&] { form.tangent(d, 1e4, false, k); }),
               best_ms([&] { form.tangent(d, 1e4, true, k); }));
  }
  {
    fem::FiniteStrain form(assembler, face.material, {});
    fem::SparseMatrix k;
    form.tangent(VectorXd::Zero(face.mesh.nodes.size()), 1e4, false, k);
    fem::PartitionedFactor factor(k, face.prescribed, "bench");
    VectorXd x = VectorXd::Ones(static_cast<Eigen::Index>(factor.free().size()));
    fmt::print("factor {:.1f} ms ({:.2f} million entries), solve {:.2f} ms\n",
               best_ms([&] { factor.try_refactor(k); }), factor.factor_entries() / 1e6,
               best_ms([&] { factor.solve(x); }));
  }
  const auto full = [] {
    fem::FiniteNewtonOptions o;
    o.full_newton = true;
    return o;
  }();
  const auto fine = [] {
    fem::FiniteNewtonOptions o;
    o.tolerance = 1e-5;
    return o;
  }();
  fem::Hyperelastic neo, yeoh, branches;
  yeoh.law = fem::HyperelasticLaw::yeoh;
  branches.branches = {{0.5, 0.05}, {0.3, 0.5}};
  run(face, assembler, neo, 1.0 / 30, {}, "neo-hookean");
  run(face, assembler, neo, 0.01, {}, "neo-hookean");
  run(face, assembler, neo, 1.0 / 30, full, "neo-hookean, full Newton");
  run(face, assembler, neo, 1.0 / 30, fine, "neo-hookean, to 1e-5");
  run(face, assembler, yeoh, 1.0 / 30, {}, "yeoh");
  run(face, assembler, branches, 1.0 / 30, {}, "neo-hookean, two branches");
}

}  // namespace
}  // namespace hyperex::bench

int main(int argc, char** argv) {
  hyperex::bench::measure(1e-3 * (argc > 1 ? std::atof(argv[1]) : 3.0));
}
