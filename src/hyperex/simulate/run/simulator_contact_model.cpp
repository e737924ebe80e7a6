// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of contact: the places that may come into contact, and the compliance of the tissue
// there.
#include <algorithm>
#include <utility>

#include "hyperex/fem/solve/condensed_inverse.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/simulate/drive/support.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {
namespace {

/// Driven points farther than this (m) from all places that may come into contact need not be held.
constexpr double kHeldNear_m = 0.015;

/// The carriers of the driven points near such places.
std::vector<SkinCarrier> carriers_near(const tissue::TissueMesh& mesh, const DrivenPoints& points,
                                       const Points& touching) {
  const CarrierMatrix all = carriers(mesh, points.places);
  std::vector<SkinCarrier> near;
  if (touching.rows() == 0) return near;
  for (Eigen::Index p = 0; p < all.rows(); ++p) {
    if ((touching.rowwise() - points.rest.row(p)).rowwise().norm().minCoeff() > kHeldNear_m)
      continue;
    SkinCarrier& one = near.emplace_back();
    for (CarrierMatrix::InnerIterator it(all, p); it; ++it)
      one.emplace_back(int(it.col()), it.value());
  }
  return near;
}

/// The places that may come into contact, and their carriers.
struct MayTouch {
  std::vector<SkinCarrier> lower, upper;
  std::vector<ObstacleSide> sides;
  std::vector<Vec3> rest;  // places at rest

  using OfSkin = std::function<std::vector<SkinCarrier>(const std::vector<int>& vertices)>;
  void add_lips(const LipSurfaces& lips, const OfSkin& of_skin) {
    lower = of_skin(lips.lower());
    upper = of_skin(lips.upper());
    for (const Points* surface : {&lips.lower_rest(), &lips.upper_rest()})
      for (const Vec3& p : surface->rowwise()) rest.push_back(p);
  }
  /// `near`: which of the places are carried.
  void add_side(const std::shared_ptr<const ObstaclePlaces>& all, const std::vector<char>& near,
                const OfSkin& of_skin) {
    std::vector<SkinCarrier> carriers = of_skin(all->skin());
    for (const int node : all->nodes()) carriers.push_back({{node, 1.0}});
    for (std::size_t i = 0; i < carriers.size(); ++i)
      if (!near[i])
        carriers[i].clear();
      else
        rest.push_back(all->rest().row(Eigen::Index(i)));
    sides.push_back({all, std::move(carriers)});
  }
  Points rest_points() const {
    Points out(Eigen::Index(rest.size()), 3);
    for (std::size_t i = 0; i < rest.size(); ++i) out.row(Eigen::Index(i)) = rest[i].transpose();
    return out;
  }
};

}  // namespace

void add_patch_springs(const tissue::TissueMesh& mesh, const std::vector<int>& nodes,
                       double stiffness_pa_per_m, fem::SparseMatrix& stiffness) {
  const Eigen::VectorXd areas = node_areas(mesh.volume.outer);
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis)
      stiffness.coeffRef(3 * node + axis, 3 * node + axis) += areas[node] * stiffness_pa_per_m;
}

void Simulator::Impl::ensure_obstacle_places() {
  stages.places.ensure([&] {
    auto found = std::make_shared<ContactFrames::Places>();
    if (obstacles)
      for (const Obstacle& obstacle : *obstacles)
        if (obstacle.kind == Obstacle::Kind::teeth ? options.contact.teeth : options.contact.eyes)
          found->push_back(std::make_shared<const ObstaclePlaces>(*mesh, *landmarks, obstacle));
    return found;
  });
}

/// The factor of the stiffness that acts in contact. Nodes that may come into contact are
/// eliminated last, so that their compliance follows directly from the factor.
std::unique_ptr<fem::PartitionedFactor> Simulator::Impl::contact_factor(
    const std::vector<int>& nodes) const {
  const Boundary& boundary = *stages.values->boundary;
  fem::System system;
  stages.pattern->assemble(material(), system);
  boundary.add_springs(system.stiffness);
  std::vector<int> prescribed = boundary.prescribed();
  if (!by_forces()) {
    add_patch_springs(*mesh, boundary.driven_nodes(), options.contact.patch_pa_per_m,
                      system.stiffness);
    prescribed = boundary.released().prescribed();
  }
  std::shared_ptr<const fem::NodeOrder> last;
  if (const auto& order = stages.order.pointer())
    last = std::make_shared<const fem::NodeOrder>(fem::order_with_last(
        *order->nodes, order->prescribed, prescribed, int(3 * mesh->volume.nodes.rows()), nodes));
  return std::make_unique<fem::PartitionedFactor>(
      std::move(system.stiffness), std::move(prescribed), "contact", std::move(last));
}

void Simulator::Impl::ensure_contact_model() {
  stages.contact_model.ensure([&] {
    const DrivenPoints& points = stages.points.value();
    const MeasuredRegion& region = stages.measured.value();
    const auto of_skin = [&](const std::vector<int>& vertices) {
      return skin_carriers(*mesh, points.rim, region, vertices);
    };
    const std::shared_ptr<const LipSurfaces>& lips = stages.readout->lip_surfaces();
    MayTouch touch;
    if (options.contact.lips) touch.add_lips(*lips, of_skin);
    const auto& places = stages.places.value();
    for (std::size_t s = 0; s < places.size(); ++s)
      touch.add_side(places[s], stages.near.value()[s], of_skin);
    const Points rest = touch.rest_points();
    std::unique_ptr<fem::PartitionedFactor> factor;
    MouthContact contact(
        lips, std::move(touch.lower), std::move(touch.upper), std::move(touch.sides),
        by_forces() ? carriers_near(*mesh, points, rest) : std::vector<SkinCarrier>(),
        options.contact.point_give, [&](const std::vector<int>& nodes) {
          factor = contact_factor(nodes);
          progress.throw_if_cancelled();
          return fem::condensed_inverse(*factor, nodes);
        });
    return ContactModel{std::move(factor), std::move(contact)};
  });
}

}  // namespace hyperex::simulate
