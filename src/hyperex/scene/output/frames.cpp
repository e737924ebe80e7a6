// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/output/frames.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/quantile.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/fem/form/system.hpp"

namespace hyperex::scene {
namespace {
using reenact::Performance;

/// The shear of a tensor is half the engineering shear.
io::VtuArray strain_array(const fem::VoigtRows& strain) {
  io::VtuArray array{"strain (1)", strain.cast<float>()};
  array.values.rightCols<3>() /= 2;
  return array;
}

/// What von Mises stress takes: Young's modulus and Poisson's ratio.
fem::Material elastic_material(const Performance& p) {
  fem::Material material;
  material.young_pa.assign(p.tet_young_pa.begin(), p.tet_young_pa.end());
  material.poisson.assign(p.tet_poisson.begin(), p.tet_poisson.end());
  return material;
}

Eigen::VectorXd greatest_principal(const fem::VoigtRows& strain) {
  Eigen::VectorXd greatest(strain.rows());
  for (Eigen::Index t = 0; t < strain.rows(); ++t) {
    const auto e = strain.row(t);
    Eigen::Matrix3d tensor;
    tensor << e[0], e[3] / 2, e[5] / 2,  //
        e[3] / 2, e[1], e[4] / 2,        //
        e[5] / 2, e[4] / 2, e[2];
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(tensor, Eigen::EigenvaluesOnly);
    greatest[t] = eigen.eigenvalues().maxCoeff();
  }
  return greatest;
}

nlohmann::ordered_json spread_of(const Eigen::VectorXd& values,
                                 const std::vector<std::uint8_t>& inverted) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  double sound = 0;
  for (std::size_t t = 0; t < inverted.size(); ++t)
    if (!inverted[t]) sound = std::max(sound, values[static_cast<Eigen::Index>(t)]);
  return {{"median", quantile_of_sorted(sorted, 0.5)},
          {"p95", quantile_of_sorted(sorted, 0.95)},
          {"p99", quantile_of_sorted(sorted, 0.99)},
          {"max", sorted.back()},
          {"max_not_inverted", sound}};
}

/// Parameters of the tissue that differ from place to place.
std::vector<io::VtuArray> graded_arrays(const Results& r) {
  std::vector<io::VtuArray> graded;
  const Eigen::Index tets = r.simulation.performance.tets.rows();
  for (int q = 0; r.tissue && q < tissue::parameter_count; ++q)
    if (r.tissue->varies(q))
      graded.push_back({tissue::parameter_info(q).title,
                        (Eigen::Map<const Eigen::VectorXd>(r.tissue->element[q].data(), tets) /
                         tissue::parameter_info(q).si)
                            .cast<float>()});
  return graded;
}

}  // namespace

FrameCells::FrameCells(const Performance& performance, bool with_strain)
    : performance_(performance),
      with_strain_(with_strain),
      strain_(performance.nodes, performance.tets),
      material_(elastic_material(performance)) {}

std::vector<io::VtuArray> FrameCells::at(const Points& d) const {
  const fem::VoigtRows strain = strain_.at(d);
  std::vector<io::VtuArray> cells;
  if (with_strain_) cells.push_back(strain_array(strain));
  cells.push_back(
      {"von Mises stress (kPa)", (1e-3 * fem::von_mises_pa(strain, material_)).cast<float>()});
  const std::vector<std::uint8_t> inverted =
      fem::inverted_tets(performance_.nodes, performance_.tets, d);
  cells.push_back({"inverted",
                   Eigen::Map<const Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1>>(
                       inverted.data(), static_cast<Eigen::Index>(inverted.size()))
                       .cast<float>(),
                   true});
  return cells;
}

void write_frames(const Performance& p, const std::filesystem::path& directory, int every,
                  bool with_strain, const std::vector<io::VtuArray>& more) {
  if (p.nodes.rows() == 0) return;
  std::filesystem::create_directories(directory / "frames");
  std::vector<std::pair<double, std::filesystem::path>> frames;
  const auto step = static_cast<std::size_t>(every);
  for (std::size_t f = 0; f < p.frame_time_s.size(); f += step)
    frames.emplace_back(p.frame_time_s[f],
                        std::filesystem::path("frames") / fmt::format("frame_{:04}.vtu", f));
  const io::VtuMesh mesh(p.nodes, p.tets);
  const FrameCells tissue(p, with_strain);
  tbb::parallel_for(std::size_t(0), frames.size(), [&](std::size_t i) {
    const Points d = p.node_displacement_m[i * step].cast<double>();
    std::vector<io::VtuArray> cells = tissue.at(d);
    cells.insert(cells.end(), more.begin(), more.end());
    mesh.write(directory / frames[i].second, {{"displacement (m)", d.cast<float>()}}, cells);
  });
  io::write_pvd(directory / "frames.pvd", frames);
}

void write_frames(const Results& r, const std::filesystem::path& directory) {
  write_frames(r.simulation.performance, directory, r.scene.output.vtu_every,
               r.scene.output.vtu_strain, graded_arrays(r));
}

nlohmann::ordered_json stress_summary(const Performance& p) {
  if (p.tets.rows() == 0) return nullptr;
  const Points d = p.node_displacement_m[static_cast<std::size_t>(p.peak_frame)].cast<double>();
  const auto inverted = fem::inverted_tets(p.nodes, p.tets, d);
  const fem::VoigtRows strain = fem::ElementStrain(p.nodes, p.tets).at(d);
  return {{"von_mises_stress_kpa",
           spread_of(1e-3 * fem::von_mises_pa(strain, elastic_material(p)), inverted)},
          {"greatest_principal_strain", spread_of(greatest_principal(strain), inverted)},
          {"inverted_tets", std::count(inverted.begin(), inverted.end(), 1)}};
}

}  // namespace hyperex::scene
