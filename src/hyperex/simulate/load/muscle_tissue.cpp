// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/muscle_tissue.hpp"

#include <cmath>

#include "hyperex/simulate/drive/support.hpp"

namespace hyperex::simulate {
namespace {

MuscleModelOptions model_options(const SimulationOptions& options) {
  return {.support = muscle_support(options.support, options.muscles),
          .shape = options.muscles.shape,
          .widening = options.muscles.widening,
          .fold = options.muscles.fold};
}

}  // namespace

SupportOptions muscle_support(const SupportOptions& given, const MuscleOptions& options) {
  SupportOptions support = given;
  support.skull_layer = options.skull_layer;
  support.mandible_layer = options.mandible_layer;
  support.teeth_layer = options.teeth_layer;
  support.teeth_reach_m = options.teeth_reach_m;
  support.field_pa_per_m = options.foundation_pa_per_m;
  support.throat_pa_per_m = options.throat_pa_per_m;
  support.throat_reach_m = options.throat_reach_m;
  return support;
}

void stiffen_lips(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                  const MuscleOptions& options, fem::Material& material) {
  const std::vector<double> to_lips = distances_to_lips(mesh, landmarks);
  const auto columns = static_cast<int>(mesh.volume.surface_nodes());
  for (Eigen::Index t = 0; t < mesh.volume.tets.rows(); ++t) {
    double distance = 0;
    for (int a = 0; a < 4; ++a) distance += 0.25 * to_lips[mesh.volume.tets(t, a) % columns];
    material.young_pa[std::size_t(t)] *=
        1 + (options.lip_stiffening - 1) * std::exp(-std::pow(distance / options.lip_reach_m, 2));
  }
}

MuscleModel muscle_model(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                         const SimulationOptions& options, const fem::SparseMatrix& stiffness,
                         std::shared_ptr<const fem::NodeOrder> order,
                         const std::function<void()>& between) {
  return {mesh,
          landmarks,
          stiffness,
          options.muscles.table(),
          model_options(options),
          std::move(order),
          between};
}

}  // namespace hyperex::simulate
