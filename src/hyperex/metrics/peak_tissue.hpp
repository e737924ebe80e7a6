// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <optional>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::metrics {

/// Quantiles of a value over the tetrahedra.
struct TetSpread {
  double min = 0, median = 0, p95 = 0, p99 = 0, max = 0;
  double max_not_inverted = 0;  ///< in tetrahedra that are not inverted
};

/// Strain and stress of the tissue at the peak. At small strain, over all tetrahedra. At finite
/// strain (Cauchy stress, Green-Lagrange strain), inverted tetrahedra are excluded. A spread is
/// absent if no tissue was simulated or if no tetrahedron remains.
struct PeakTissue {
  bool simulated = false;  ///< false: all of the skin was measured
  bool finite = false;     ///< finite strain
  std::optional<TetSpread> von_mises_kpa;
  std::optional<TetSpread> principal_strain;  ///< greatest principal strain
  /// At finite strain: greatest principal stretch; J.
  std::optional<TetSpread> principal_stretch, volume_ratio;
  std::ptrdiff_t inverted_tets = 0;
};

PeakTissue peak_tissue(const simulate::Performance& performance);

/// The entry "at_peak" of summary.json; null if no tissue was simulated. In addition to the
/// spreads, it contains von_mises_max_over_p99: the greatest stress in non-inverted elements
/// divided by the 99th percentile.
nlohmann::ordered_json json_of(const PeakTissue& tissue);

/// The greatest principal value of each strain. The rows are xx, yy, zz, xy, yz, xz with
/// engineering shear.
Eigen::VectorXd greatest_principal(const fem::VoigtRows& strain);

}  // namespace hyperex::metrics
