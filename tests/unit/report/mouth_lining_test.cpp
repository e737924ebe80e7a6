// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/mouth_lining.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/teeth/teeth_fit.hpp"
#include "hyperex/anatomy/teeth/tongue.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;

/// The embedded face with the teeth that a run gives it.
struct Mouth {
  anatomy::EmbeddedFace face = anatomy::embedded_face();
  anatomy::Teeth teeth;
  Opening opening;

  Mouth() {
    const tissue::TissueMesh mesh =
        tissue::build_tissue_mesh(face.mesh, face.landmarks, {}, "embedded");
    teeth = anatomy::fit_teeth(mesh.volume.outer, tissue::boundary_of(mesh.volume), face.landmarks)
                .teeth;
    teeth.tongue = anatomy::tongue_in(teeth, face::face_frame(face.landmarks));
    opening = of(&teeth);
  }
  Opening of(const anatomy::Teeth* rows) const {
    for (const Opening& one : face_backing(face.mesh, face.landmarks, rows).openings)
      if (one.mouth) return one;
    throw std::runtime_error("no mouth");
  }
  static const Mouth& get() {
    static const Mouth one;
    return one;
  }
  std::vector<const TriMesh*> content() const {
    return {&teeth.upper.crowns, &teeth.upper.gum, &teeth.lower.crowns, &teeth.lower.gum,
            &teeth.tongue};
  }
};

/// An open mouth: the jaw turned about the condyles, the lower lip with it, less at the corners.
struct Open {
  Eigen::Isometry3d jaw = Eigen::Isometry3d::Identity();
  Points skin;

  explicit Open(const Mouth& mouth) : skin(mouth.face.mesh.points) {
    const Vec3 hinge =
        (mouth.face.landmarks.at(face::ibug(1)) + mouth.face.landmarks.at(face::ibug(15))) / 2;
    jaw.linear() = Eigen::AngleAxisd(0.24, Vec3::UnitX()).toRotationMatrix();
    jaw.translation() = hinge - jaw.linear() * hinge;
    const double half =
        (mouth.face.landmarks.at("cheilion_L").x() - mouth.face.landmarks.at("cheilion_R").x()) / 2;
    for (std::size_t i = 0; i < mouth.opening.loop.size(); ++i) {
      const int v = mouth.opening.loop[i];
      const Vec3 p = skin.row(v);
      const double across = std::min(1.0, std::abs(p.x()) / half);
      const double open = 0.4 + 0.6 * (1 - across * across);
      const double corner = 0.4 * std::pow(across, 4);
      const double share = mouth.opening.jaw[Index(i)] > 0.5 ? open : corner;
      skin.row(v) += share * (jaw * p - p).transpose();
    }
  }
  Points moved(const Points& rest) const {
    return (rest * jaw.linear().transpose()).rowwise() + jaw.translation().transpose();
  }
};

/// The least distance of a part to a lining before its back wall: the embedded face ends before the
/// last teeth do.
double clear_of(const TriMesh& part, const Opening& opening, const TriMesh& mesh) {
  const SurfaceTree lining(mesh);
  const auto n = Index(opening.loop.size()), rim = Index(opening.rings.size() - 1) * n;
  double nearest = 1;
  Index walled = 0;
  for (Index v = 0; v < part.points.rows(); ++v) {
    const ClosestPoint at = lining.query(part.points.row(v));
    const Index first = mesh.triangles.row(at.triangle).minCoeff();
    if (first >= rim || part.points(v, 2) < mesh.points(rim + first % n, 2) + 2e-3)
      ++walled;
    else
      nearest = std::min(nearest, std::sqrt(at.squared_distance));
  }
  EXPECT_LT(walled, 2 * part.points.rows() / 3);
  return nearest;
}

TEST(MouthLining, LeavesRoomForTeethGumsAndTongueAtRest) {
  const Mouth& mouth = Mouth::get();
  ASSERT_FALSE(mouth.teeth.lower.empty());
  ASSERT_GT(mouth.teeth.tongue.triangles.rows(), 0);
  const TriMesh lining = pocket(mouth.opening, mouth.face.mesh.points);
  for (const TriMesh* part : mouth.content()) {
    const double nearest = clear_of(*part, mouth.opening, lining);
    EXPECT_GT(nearest, 1e-3);
    EXPECT_LT(nearest, 0.02) << "it lies around them";
  }
}

TEST(MouthLining, LiesBehindTheSkin) {
  const Mouth& mouth = Mouth::get();
  const TriMesh& skin = mouth.face.mesh;
  const SurfaceTree tree(skin);
  const Points normals = vertex_normals(skin);
  const anatomy::Teeth none;
  for (const Opening& opening : {mouth.opening, mouth.of(nullptr), mouth.of(&none)}) {
    const auto n = Index(opening.loop.size());
    EXPECT_EQ(opening.rest.topRows(n), Points(skin.points(opening.loop, Eigen::all)));
    int looked = 0;
    for (Index v = n; v < opening.rest.rows(); ++v) {
      const ClosestPoint at = tree.query(opening.rest.row(v));
      const Vec3 off = opening.rest.row(v).transpose() - at.point;
      EXPECT_GT(off.norm(), 1e-4) << v;
      Vec3 out = Vec3::Zero();
      for (int k = 0; k < 3; ++k)
        out += at.weights[k] * normals.row(skin.triangles(at.triangle, k)).transpose();
      const double along = off.dot(out.normalized()) / off.norm();
      if (std::abs(along) < 0.7) continue;  // before the lips' edge
      EXPECT_LT(along, 0) << v;
      ++looked;
    }
    EXPECT_GT(looked, 2 * n);
  }
}

TEST(MouthLining, UpperLipLeadsToTheRoofAndLowerLipToTheFloor) {
  const Mouth& mouth = Mouth::get();
  const Opening& opening = mouth.opening;
  const auto n = Index(opening.loop.size());
  const double upper_lip = mouth.face.landmarks.at(face::ibug(62)).y();
  const double lower_lip = mouth.face.landmarks.at(face::ibug(66)).y();
  double roof = -1, floor = 1;
  for (Index v = n; v < opening.rest.rows() - 1; ++v) {
    const double jaw = opening.jaw[v % n], y = opening.rest(v, 1);
    if (jaw == 0) {
      EXPECT_GT(y, upper_lip - 0.004) << v;
      roof = std::max(roof, y);
    }
    if (jaw == 1) {
      EXPECT_LT(y, lower_lip + 0.004) << v;
      floor = std::min(floor, y);
    }
  }
  EXPECT_GT(roof, mouth.teeth.upper.gum.points.col(1).maxCoeff());
  EXPECT_LT(floor, mouth.teeth.lower.gum.points.col(1).minCoeff());
}

TEST(MouthLining, IsPinkAtTheLipsAndDarkBehind) {
  const Opening& opening = Mouth::get().opening;
  const std::size_t n = opening.loop.size(), rings = opening.rings.size();
  ASSERT_EQ(opening.colours.size(), rings * n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(opening.colours[i], opening.colours[0]);
    for (std::size_t r = 1; r < rings; ++r)
      EXPECT_LE(opening.colours[r * n + i][0], opening.colours[(r - 1) * n + i][0])
          << r << " " << i;
  }
  EXPECT_GT(opening.colours[0][0], 120);
  EXPECT_GT(opening.colours[0][0], opening.colours[0][1] + 40);
  EXPECT_LT(opening.colours.back()[0], 60);
}

TEST(MouthLining, IsLinearInTheSkinAndTheJaw) {
  const Mouth& mouth = Mouth::get();
  const Open open(mouth);
  const Points& rest = mouth.face.mesh.points;
  EXPECT_LT((pocket(mouth.opening, rest).points - mouth.opening.rest).cwiseAbs().maxCoeff(), 1e-12);
  const Points lips = pocket(mouth.opening, open.skin).points - mouth.opening.rest;
  const Points jaw = pocket(mouth.opening, rest, open.jaw).points - mouth.opening.rest;
  const Points both = pocket(mouth.opening, open.skin, open.jaw).points - mouth.opening.rest;
  EXPECT_LT((both - lips - jaw).cwiseAbs().maxCoeff(), 1e-12);
  const Points half = pocket(mouth.opening, 0.5 * rest + 0.5 * open.skin).points;
  EXPECT_LT((half - mouth.opening.rest - 0.5 * lips).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(lips.rowwise().norm().maxCoeff(), 0.01);
  EXPECT_GT(jaw.rowwise().norm().maxCoeff(), 0.01);
}

TEST(MouthLining, StaysOutsideOfTheRowsInAnOpenMouth) {
  const Mouth& mouth = Mouth::get();
  const Open open(mouth);
  const TriMesh lining = pocket(mouth.opening, open.skin, open.jaw);
  for (const TriMesh* part : mouth.content()) {
    const bool lower = part != &mouth.teeth.upper.crowns && part != &mouth.teeth.upper.gum;
    const TriMesh now{lower ? open.moved(part->points) : part->points, part->triangles};
    EXPECT_GT(clear_of(now, mouth.opening, lining), 5e-4);
  }
}

/// Where a ray first meets a mesh, as a share of `way`.
std::optional<double> meets(const TriMesh& mesh, const Vec3& from, const Vec3& way) {
  std::optional<double> first;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Vec3 a = mesh.points.row(t[0]);
    Eigen::Matrix3d system;
    system << mesh.points.row(t[1]).transpose() - a, mesh.points.row(t[2]).transpose() - a, -way;
    if (std::abs(system.determinant()) < 1e-18) continue;
    const Vec3 share = system.inverse() * (from - a);
    if (share[0] < 0 || share[1] < 0 || share[0] + share[1] > 1 || share[2] < 0) continue;
    if (!first || share[2] < *first) first = share[2];
  }
  return first;
}

TEST(MouthLining, NobodyLooksThroughAnOpenMouth) {
  const Mouth& mouth = Mouth::get();
  const Open open(mouth);
  const TriMesh lining = pocket(mouth.opening, open.skin, open.jaw);
  std::vector<TriMesh> content;
  for (const TriMesh* part : mouth.content()) {
    const bool lower = part != &mouth.teeth.upper.crowns && part != &mouth.teeth.upper.gum;
    content.push_back({lower ? open.moved(part->points) : part->points, part->triangles});
  }
  const auto n = Index(mouth.opening.loop.size());
  const Points edge = lining.points.topRows(n);
  const Vec3 centre = edge.colwise().mean().transpose();
  int teeth = 0, tongue = 0, rays = 0;
  for (const Vec3& way :
       {Vec3(0, 0, -1), Vec3(0.6, 0, -1), Vec3(-0.6, 0, -1), Vec3(0, 0.5, -1), Vec3(0, -0.5, -1)})
    for (Index i = 0; i < n; i += 3)
      for (const double share : {0.25, 0.6, 0.9}) {
        const Vec3 from = centre + share * (edge.row(i).transpose() - centre) - 1e-4 * way;
        const auto wall = meets(lining, from, way);
        EXPECT_TRUE(wall) << "from " << from.transpose() << " along " << way.transpose();
        if (!wall) continue;
        ++rays;
        const auto before = [&](std::size_t part) {
          const auto at = meets(content[part], from, way);
          return at && *at < *wall;
        };
        if (before(0) || before(2)) ++teeth;
        if (before(4)) ++tongue;
      }
  EXPECT_GT(rays, 300);
  EXPECT_GT(teeth, rays / 5);
  EXPECT_GT(tongue, rays / 20);
}

}  // namespace
}  // namespace hyperex::report
