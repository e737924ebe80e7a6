// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/peak_tissue.hpp"

#include <algorithm>

#include "hyperex/core/quantile.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/metrics/finite_tissue.hpp"

namespace hyperex::metrics {
namespace {
using simulate::Performance;
using Inverted = std::vector<std::uint8_t>;

TetSpread spread_of(const Eigen::VectorXd& values, const Inverted& inverted) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  double sound = 0;
  for (std::size_t t = 0; t < inverted.size(); ++t)
    if (!inverted[t]) sound = std::max(sound, values[static_cast<Eigen::Index>(t)]);
  return {sorted.front(),
          quantile_of_sorted(sorted, 0.5),
          quantile_of_sorted(sorted, 0.95),
          quantile_of_sorted(sorted, 0.99),
          sorted.back(),
          sound};
}

/// The spread without inverted tetrahedra; nothing if none remains.
std::optional<TetSpread> spread_of_sound(const Eigen::VectorXd& values, const Inverted& inverted) {
  Eigen::VectorXd sound(values.size());
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < values.size(); ++t)
    if (!inverted[static_cast<std::size_t>(t)]) sound[count++] = values[t];
  if (count == 0) return std::nullopt;
  return spread_of(sound.head(count), Inverted(std::size_t(count), 0));
}

nlohmann::ordered_json json_of(const std::optional<TetSpread>& spread) {
  if (!spread) return nullptr;
  return {{"median", spread->median},
          {"p95", spread->p95},
          {"p99", spread->p99},
          {"max", spread->max},
          {"max_not_inverted", spread->max_not_inverted}};
}

nlohmann::ordered_json max_over_p99(const std::optional<TetSpread>& stress) {
  if (!stress || !(stress->p99 > 0)) return nullptr;
  return stress->max_not_inverted / stress->p99;
}

nlohmann::ordered_json volume_json(const std::optional<TetSpread>& volume) {
  nlohmann::ordered_json json = json_of(volume);
  if (!volume) return json;
  json.erase("max_not_inverted");
  json["min"] = volume->min;
  return json;
}

}  // namespace

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

PeakTissue peak_tissue(const Performance& p) {
  PeakTissue out;
  if (p.tets.rows() == 0) return out;
  out.simulated = true;
  const Points d = p.node_displacement_m[static_cast<std::size_t>(p.peak_frame)].cast<double>();
  const Inverted inverted = fem::inverted_tets(p.nodes, p.tets, d);
  out.inverted_tets = std::count(inverted.begin(), inverted.end(), 1);
  out.finite = p.model.strain == simulate::Strain::finite;
  if (out.finite) {
    const FiniteState state = FiniteTissue(p).at(d);
    out.von_mises_kpa = spread_of_sound(1e-3 * state.von_mises_pa, inverted);
    out.principal_strain = spread_of_sound(greatest_principal(state.green_lagrange), inverted);
    out.principal_stretch = spread_of_sound(state.stretch.col(2), inverted);
    out.volume_ratio = spread_of_sound(state.volume_ratio, inverted);
  } else {
    fem::VoigtRows strain = fem::ElementStrain(p.nodes, p.tets).at(d);
    take_growth_off(p, strain);
    out.von_mises_kpa = spread_of(1e-3 * fem::von_mises_pa(strain, elastic_material(p)), inverted);
    out.principal_strain = spread_of(greatest_principal(strain), inverted);
  }
  return out;
}

nlohmann::ordered_json json_of(const PeakTissue& tissue) {
  if (!tissue.simulated) return nullptr;
  nlohmann::ordered_json json = {{"von_mises_stress_kpa", json_of(tissue.von_mises_kpa)},
                                 {"von_mises_max_over_p99", max_over_p99(tissue.von_mises_kpa)},
                                 {"greatest_principal_strain", json_of(tissue.principal_strain)}};
  if (tissue.finite) {
    json["greatest_principal_stretch"] = json_of(tissue.principal_stretch);
    json["volume_ratio"] = volume_json(tissue.volume_ratio);
  }
  json["inverted_tets"] = tissue.inverted_tets;
  return json;
}

}  // namespace hyperex::metrics
