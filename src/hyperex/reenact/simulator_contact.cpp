// SPDX-License-Identifier: GPL-3.0-or-later
// Contact: frames that were found without it, corrected.
#include <algorithm>
#include <utility>

#include "hyperex/core/stopwatch.hpp"
#include "hyperex/reenact/simulator_impl.hpp"
#include "hyperex/reenact/support.hpp"

namespace hyperex::reenact {
namespace {

constexpr double kHeldNear_m = 0.015;  // of the lips: farther points need not be held

/// Springs that hold driven nodes where they are driven, as contact feels them.
void add_patches(const tissue::TissueMesh& mesh, const std::vector<int>& nodes,
                 double stiffness_pa_per_m, fem::SparseMatrix& stiffness) {
  const Eigen::VectorXd areas = node_areas(mesh.volume.outer);
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis)
      stiffness.coeffRef(3 * node + axis, 3 * node + axis) += areas[node] * stiffness_pa_per_m;
}

/// Of the driven points near the lips.
std::vector<SkinCarrier> carriers_near(const tissue::TissueMesh& mesh, const DrivenPoints& points,
                                       const LipSurfaces& lips) {
  const CarrierMatrix all = carriers(mesh, points.places);
  std::vector<SkinCarrier> near;
  for (Eigen::Index p = 0; p < all.rows(); ++p) {
    const auto distance = [&](const Points& skin) {
      return (skin.rowwise() - points.rest.row(p)).rowwise().norm().minCoeff();
    };
    if (std::min(distance(lips.lower_rest()), distance(lips.upper_rest())) > kHeldNear_m) continue;
    SkinCarrier& one = near.emplace_back();
    for (CarrierMatrix::InnerIterator it(all, p); it; ++it)
      one.emplace_back(int(it.col()), it.value());
  }
  return near;
}

/// Columns of the free unknowns, of forces on some nodes.
Eigen::MatrixXd on_free(const fem::PartitionedFactor& factor, Eigen::Index unknowns,
                        const std::vector<int>& nodes, const Eigen::MatrixXd& force) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, force.cols());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    all.middleRows<3>(3 * Eigen::Index(nodes[n])) = force.middleRows<3>(3 * Eigen::Index(n));
  return all(factor.free(), Eigen::all);
}

}  // namespace

fem::PartitionedFactor& Simulator::Impl::contact_factor(
    std::optional<fem::PartitionedFactor>& own) {
  if (by_forces() && reduced && reduced_current) return reduced->static_factor();
  fem::System system;
  assembler->assemble(material(), system);
  boundary->add_springs(system.stiffness);
  if (by_forces()) {
    own.emplace(std::move(system.stiffness), boundary->prescribed(), "contact", mesh->volume.nodes,
                options.solver.linear, known_order());
  } else {
    add_patches(*mesh, boundary->driven_nodes(), options.contact.patch_pa_per_m, system.stiffness);
    own.emplace(std::move(system.stiffness), boundary->released().prescribed(), "contact",
                mesh->volume.nodes, options.solver.linear);
  }
  return *own;
}

void Simulator::Impl::need_contact(fem::PartitionedFactor& factor) {
  if (contact) return;
  const auto of = [&](const std::vector<int>& vertices) {
    return skin_carriers(*mesh, driven_points->rim, *region, vertices);
  };
  const std::shared_ptr<const LipSurfaces>& lips = readout->lip_surfaces();
  contact.emplace(
      lips, of(lips->lower()), of(lips->upper()),
      by_forces() ? carriers_near(*mesh, *driven_points, *lips) : std::vector<SkinCarrier>(),
      options.contact.point_give, factor);
}

void Simulator::Impl::touch(const std::vector<Shot>& shots, const PointCurve& points,
                            Solution& solution, SimulationResult& result) {
  Stopwatch watch;
  report.contact = {};
  const LipSurfaces& lips = *readout->lip_surfaces();
  if (lips.empty()) return;
  const auto skin_of = [&](std::size_t shot) -> const PointsF& {
    const int frame = shots[shot].frame;
    return frame < 0 ? result.still_displacement_m[std::size_t(-1 - frame)]
                     : result.performance.skin_displacement_m[std::size_t(frame)];
  };
  std::vector<double> depth_m(shots.size());
  const auto measure = [&] {
    for_frames(shots.size(), [&](std::size_t i) { depth_m[i] = lips.depth(skin_of(i)); });
    return 1e3 * *std::max_element(depth_m.begin(), depth_m.end());
  };
  report.contact.overlap_mm = report.contact.left_mm = measure();
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < shots.size(); ++i)
    if (depth_m[i] >= MouthContact::kFelt_m) touching.push_back(i);
  if (!touching.empty()) {
    std::optional<fem::PartitionedFactor> own;
    fem::PartitionedFactor& factor = contact_factor(own);
    ask();
    need_contact(factor);
    ask();
    std::vector<MouthContact::Correction> corrections(touching.size());
    for_frames(touching.size(),
               [&](std::size_t i) { corrections[i] = contact->correct(skin_of(touching[i])); });
    Eigen::MatrixXd force(3 * Eigen::Index(contact->nodes().size()), Eigen::Index(touching.size()));
    for (std::size_t i = 0; i < touching.size(); ++i) {
      force.col(Eigen::Index(i)) = corrections[i].force;
      report.contact.frames += shots[touching[i]].frame >= 0;
      report.contact.residual_mm =
          std::max(report.contact.residual_mm, 1e3 * corrections[i].residual_m);
    }
    Eigen::MatrixXd moved = on_free(factor, solution.displacement.rows(), contact->nodes(), force);
    factor.solve(moved);
    for_frames(touching.size(), [&](std::size_t i) {
      auto column = solution.displacement.col(Eigen::Index(touching[i]));
      for (std::size_t u = 0; u < factor.free().size(); ++u)
        column[factor.free()[u]] += moved(Eigen::Index(u), Eigen::Index(i));
      const Eigen::Map<const Points> nodal(column.data(), mesh->volume.nodes.rows(), 3);
      store(shots[touching[i]], nodal, points, result);
    });
    report.contact.left_mm = measure();
  }
  report.contact.seconds = watch.lap();
}

}  // namespace hyperex::reenact
