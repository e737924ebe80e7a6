// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_forces.hpp"

#include <cmath>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/fem/element/tet4.hpp"
#include "hyperex/geometry/smooth_step.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::muscles {
namespace {

/// Where the weight is below this, the tissue is not pulled.
constexpr double kLeastWeight = 1e-3;

bool on_lip(MuscleLip lip, const tissue::TissueMesh& mesh, Eigen::Index tet) {
  if (lip == MuscleLip::both) return true;
  const auto columns = static_cast<int>(mesh.volume.surface_nodes());
  double margin = 0;
  for (int a = 0; a < 4; ++a) margin += mesh.upper_margin[mesh.volume.tets(tet, a) % columns];
  return (margin > 0) == (lip == MuscleLip::upper);
}

}  // namespace

Eigen::VectorXd muscle_force(const MuscleLine& line, const TemplateMuscle& muscle,
                             const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                             const ForceShape& shape) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  const tissue::VolumeMesh& volume = mesh.volume;
  const Points normals = vertex_normals(volume.outer);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * volume.nodes.rows());
  const double reach =
      (muscle.band > 0 ? muscle.band : shape.band) * 1e-3 * muscle.width_mm * line.scale;
  const double ramp = muscle.ramp > 0 ? muscle.ramp : shape.ramp;
  const double farthest = reach * std::sqrt(-std::log(kLeastWeight));
  const Vec3 low = line.line.colwise().minCoeff().transpose().array() - farthest;
  const Vec3 high = line.line.colwise().maxCoeff().transpose().array() + farthest;
  for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
    const Eigen::Matrix<double, 4, 3> corner = fem::corners_of(volume.nodes, volume.tets, t);
    const Vec3 centre = corner.colwise().mean();
    if ((centre.array() < low.array()).any() || (centre.array() > high.array()).any()) continue;
    if (!on_lip(muscle.lip, mesh, t)) continue;
    const OnLine near = nearest_on_line(line, centre);
    double weight = std::exp(-std::pow(near.distance_m / reach, 2));
    if (shape.midline_m > 0)
      weight *=
          smooth_step(0.5 * ((line.left ? 1 : -1) * frame.local(centre).x() / shape.midline_m + 1));
    if (weight < kLeastWeight) continue;
    const fem::Tet4 tet = fem::make_tet4(corner);
    for (int a = 0; a < 4; ++a) {
      const Vec3 at_node =
          muscle.kind == MuscleKind::pull
              ? Vec3(-0.25 * std::pow(near.share, ramp) * near.tangent)
              : Vec3(-near.tangent * near.tangent.dot(tet.gradient.row(a).transpose()));
      const Vec3 n = normals.row(volume.tets(t, a) % volume.surface_nodes());
      force.segment<3>(3 * volume.tets(t, a)) +=
          weight * tet.volume * (at_node - shape.tangential * n * n.dot(at_node));
    }
  }
  return force;
}

}  // namespace hyperex::muscles
