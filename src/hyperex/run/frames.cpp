// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/frames.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/quantile.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/fem/form/system.hpp"

namespace hyperex::run {
namespace {
using simulate::Performance;

/// The shear of a tensor is half the engineering shear.
io::VtuArray strain_array(const char* name, const fem::VoigtRows& strain) {
  io::VtuArray array{name, strain.cast<float>()};
  array.values.rightCols<3>() /= 2;
  return array;
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

bool is_finite(const Performance& p) {
  return p.model.strain == simulate::Strain::finite;
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

/// Without those turned inside out; null where none is left.
nlohmann::ordered_json spread_of_sound(const Eigen::VectorXd& values,
                                       const std::vector<std::uint8_t>& inverted) {
  Eigen::VectorXd sound(values.size());
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < values.size(); ++t)
    if (!inverted[static_cast<std::size_t>(t)]) sound[count++] = values[t];
  if (count == 0) return nullptr;
  return spread_of(sound.head(count), std::vector<std::uint8_t>(std::size_t(count), 0));
}

/// Greatest stress of elements that are not inverted over the 99th percentile; null where there is
/// none.
nlohmann::ordered_json over_p99(const nlohmann::ordered_json& stress) {
  if (!stress.is_object() || !(stress["p99"] > 0)) return nullptr;
  return stress["max_not_inverted"].get<double>() / stress["p99"].get<double>();
}

nlohmann::ordered_json finite_summary(const Performance& p, const Points& d,
                                      const std::vector<std::uint8_t>& inverted) {
  const FiniteState state = FiniteTissue(p).at(d);
  nlohmann::ordered_json stress = spread_of_sound(1e-3 * state.von_mises_pa, inverted);
  nlohmann::ordered_json over = over_p99(stress);
  nlohmann::ordered_json volume = spread_of_sound(state.volume_ratio, inverted);
  if (volume.is_object()) {
    volume.erase("max_not_inverted");
    volume["min"] = -spread_of_sound(-state.volume_ratio, inverted)["max"].get<double>();
  }
  return {{"von_mises_stress_kpa", std::move(stress)},
          {"von_mises_max_over_p99", std::move(over)},
          {"greatest_principal_strain",
           spread_of_sound(greatest_principal(state.green_lagrange), inverted)},
          {"greatest_principal_stretch", spread_of_sound(state.stretch.col(2), inverted)},
          {"volume_ratio", std::move(volume)},
          {"inverted_tets", std::count(inverted.begin(), inverted.end(), 1)}};
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
      material_(elastic_material(performance)),
      finite_(is_finite(performance) ? std::make_unique<FiniteTissue>(performance) : nullptr) {}

std::vector<io::VtuArray> FrameCells::at(const Points& d) const {
  std::vector<io::VtuArray> cells;
  const auto von_mises = [&](const Eigen::VectorXd& pa) {
    cells.push_back({"von Mises stress (kPa)", (1e-3 * pa).cast<float>()});
  };
  if (finite_) {
    const FiniteState state = finite_->at(d);
    if (with_strain_) {
      cells.push_back(strain_array("Green-Lagrange strain (1)", state.green_lagrange));
      cells.push_back({"Cauchy stress (kPa)", (1e-3 * state.cauchy_pa).cast<float>()});
      cells.push_back({"principal stretches (1)", state.stretch.cast<float>()});
    }
    cells.push_back({"volume ratio J (1)", state.volume_ratio.cast<float>()});
    von_mises(state.von_mises_pa);
  } else {
    const fem::VoigtRows strain = strain_.at(d);
    if (with_strain_) cells.push_back(strain_array("strain (1)", strain));
    von_mises(fem::von_mises_pa(strain, material_));
  }
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
  if (is_finite(p)) return finite_summary(p, d, inverted);
  const fem::VoigtRows strain = fem::ElementStrain(p.nodes, p.tets).at(d);
  nlohmann::ordered_json stress =
      spread_of(1e-3 * fem::von_mises_pa(strain, elastic_material(p)), inverted);
  nlohmann::ordered_json over = over_p99(stress);
  return {{"von_mises_stress_kpa", std::move(stress)},
          {"von_mises_max_over_p99", std::move(over)},
          {"greatest_principal_strain", spread_of(greatest_principal(strain), inverted)},
          {"inverted_tets", std::count(inverted.begin(), inverted.end(), 1)}};
}

}  // namespace hyperex::run
