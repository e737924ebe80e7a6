// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/metrics/curve_spread.hpp"

namespace hyperex::bench {

std::vector<MeshRow> models_on_meshes(const std::filesystem::path& scene) {
  std::vector<MeshRow> rows;
  for (const double element_mm : {2.5, 3.0, 3.3, 4.0}) {
    Study study(scene, {fmt::format("mesh.element_size_mm={}", element_mm)});
    std::vector<Trial> trials(3, study.own_trial());
    for (std::size_t m = 1; m < 3; ++m)
      trials[m].tissue = study.tissue_of(study.scene().variants[m - 1].scene);
    double end[3] = {};
    study.simulate_all(trials, [&](std::size_t m, const simulate::SimulationResult& run) {
      end[m] = metrics::signed_difference(study.symmetry_of(run.performance.landmarks)).back();
    });
    rows.push_back({element_mm, int(study.mesh().volume.tets.rows()), end[0], end[1] - end[0],
                    end[2] - end[0]});
  }
  return rows;
}

bool by_mesh(const std::vector<MeshRow>& rows) {
  double low = INFINITY, high = -INFINITY;
  for (const MeshRow& row : rows) {
    low = std::min(low, row.own);
    high = std::max(high, row.own);
  }
  return high - low > std::max(std::abs(low), std::abs(high));
}

bool tissue_stays(const std::vector<MeshRow>& rows) {
  const auto stays = [&](double MeshRow::*added) {
    double low = INFINITY, high = -INFINITY;
    for (const MeshRow& row : rows) {
      low = std::min(low, row.*added);
      high = std::max(high, row.*added);
    }
    return low * high > 0 &&
           std::max(std::abs(low), std::abs(high)) < 2 * std::min(std::abs(low), std::abs(high));
  };
  return stays(&MeshRow::added_2) && stays(&MeshRow::added_3);
}

}  // namespace hyperex::bench
