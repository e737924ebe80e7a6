// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/load/shape_posterior.hpp"
#include "hyperex/simulate/performance.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::metrics {

/// Uncertainty of the skin between the driven points, given how real faces move
/// (simulate/load/shape_posterior.hpp).
struct SkinUncertainty {
  Eigen::VectorXf distance_mm;  ///< per skin vertex: expected (rms) distance from the true face
  Eigen::VectorXf
      determined;  ///< per skin vertex: share of the prior variance that the points remove
};

/// The driven points of a run, and the displacement of the skin at each point at the peak. For a
/// point of a lip, the skin of that lip is used.
struct DrivenMotion {
  std::vector<simulate::DrivenPoint> points;
  simulate::MovedPlaces places;
};
/// `upper_margin`: TissueMesh::skin_upper_margin of the run.
DrivenMotion driven_motion(const simulate::Performance& performance,
                           const std::vector<double>& upper_margin);

/// `mesh`, `landmarks`: those of the run.
SkinUncertainty skin_uncertainty(const simulate::Performance& performance,
                                 const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

/// The entry "uncertainty" of summary.json: for each region of the face (regions.hpp)
/// distance_rms_mm and determined, the mean share.
nlohmann::ordered_json json_of(const SkinUncertainty& uncertainty, const TriMesh& skin,
                               const io::Landmarks& landmarks);

}  // namespace hyperex::metrics
