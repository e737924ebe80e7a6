// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/lid_skin.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <map>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/geodesic.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kHalfLength_mm = 12;

/// Half of the aperture of an eye, mm, `along_mm` from its middle.
double half_aperture_mm(double along_mm) {
  return 5 * (1 - std::pow(along_mm / kHalfLength_mm, 2));
}

/// Two flat lids of each eye in the face's frame (x to its left, y up), and landmarks of the face.
/// The lids join beyond the corners of the eyes.
class Lids : public testing::Test {
 protected:
  Lids() {
    landmarks_ = anatomy::embedded_face().landmarks;
    frame_ = face::face_frame(landmarks_);
    for (const double side : {-1.0, 1.0}) add_eye(side);
    for (const double side : {-1.0, 1.0}) {
      const bool left = side > 0;
      place(left ? 42 : 39, side, -kHalfLength_mm, 0);
      place(left ? 45 : 36, side, kHalfLength_mm, 0);
      for (const auto& [along_mm, upper, lower] : {std::tuple{-5.0, left ? 43 : 38, left ? 47 : 40},
                                                   {5.0, left ? 44 : 37, left ? 46 : 41}}) {
        place(upper, side, along_mm, half_aperture_mm(along_mm));
        place(lower, side, along_mm, -half_aperture_mm(along_mm));
      }
    }
    for (int v = 0; v < int(mesh_.skin.points.rows()); ++v)
      mesh_.anchors.push_back({{v, v, v}, {1, 0, 0}});
  }

  Vec3 at(double side, double along_mm, double up_mm) const {
    return frame_.world({1e-3 * side * (30 + along_mm), 0.06 + 1e-3 * up_mm, 0.03});
  }
  void place(int point, double side, double along_mm, double up_mm) {
    landmarks_[face::ibug(point)] = at(side, along_mm, up_mm);
  }
  void add_eye(double side) {
    constexpr int half_columns = 16, rows = 12;  // of a lid, 1 mm apart
    std::map<std::tuple<int, int, bool>, int> vertex;
    const auto vertex_at = [&](int column, int row, bool upper) {
      // Beyond the corners both lids have the middle line in common.
      const bool joined = row == 0 && std::abs(column) >= kHalfLength_mm;
      const auto [it, added] =
          vertex.try_emplace({column, row, upper || joined}, int(mesh_.skin.points.rows()));
      if (added) {
        const double edge_mm = std::max(0.0, half_aperture_mm(column));
        mesh_.skin.points.conservativeResize(mesh_.skin.points.rows() + 1, 3);
        mesh_.skin.points.bottomRows(1) =
            at(side, column, (upper ? 1 : -1) * (edge_mm + row)).transpose();
        upper_.push_back(upper && !joined);
        along_mm_.push_back(column);
      }
      return it->second;
    };
    const auto add = [&](int a, int b, int c) {
      mesh_.skin.triangles.conservativeResize(mesh_.skin.triangles.rows() + 1, 3);
      mesh_.skin.triangles.bottomRows(1) << a, b, c;
    };
    for (int column = -half_columns; column < half_columns; ++column)
      for (int row = 0; row < rows; ++row)
        for (const bool upper : {true, false}) {
          int a = vertex_at(column, row, upper), b = vertex_at(column + 1, row, upper),
              c = vertex_at(column + 1, row + 1, upper), d = vertex_at(column, row + 1, upper);
          if (upper != (side > 0)) {
            std::swap(a, d);
            std::swap(b, c);
          }
          add(a, b, c);
          add(a, c, d);
        }
  }
  /// Displacements of the skin, mm, up, where the nodes have `of_nodes`.
  Eigen::VectorXd moved(const std::vector<tissue::RimVertex>& rim,
                        const Eigen::VectorXd& of_nodes) const {
    Eigen::VectorXd out = of_nodes;
    for (const tissue::RimVertex& one : rim) {
      out[one.vertex] = 0;
      for (std::size_t k = 0; k < one.node.size(); ++k)
        out[one.vertex] += one.weight[k] * of_nodes[one.node[k]];
    }
    return out;
  }
  /// The rim where these points drive.
  std::vector<tissue::RimVertex> rim(const std::vector<std::string>& names) const {
    std::vector<Match> places;
    for (const std::string& name : names) {
      const int v = nearest_vertex(mesh_.skin.points, landmarks_.at(name));
      places.push_back({{v, v, v}, {1, 0, 0}});
    }
    return share_lid_apertures(mesh_, landmarks_, names, places, {});
  }
  /// A blink that closes the eyes at their landmarks alone: elsewhere the lids move less.
  Eigen::VectorXd blink() const {
    Eigen::VectorXd down(mesh_.skin.points.rows());
    for (Eigen::Index v = 0; v < down.size(); ++v) {
      const double off_mm = std::abs(along_mm_[std::size_t(v)]) - 5;
      const double whole = 2 * half_aperture_mm(5) * std::exp(-off_mm * off_mm / 30);
      down[v] = upper_[std::size_t(v)] ? -6.0 / 7 * whole : 1.0 / 7 * whole;
    }
    return down;
  }
  /// The widest gap that is left between the edges, mm.
  double gap_mm(const Eigen::VectorXd& up_mm) const {
    double most_mm = 0;
    for (Eigen::Index v = 0; v < up_mm.size(); ++v)
      for (Eigen::Index w = 0; w < up_mm.size(); ++w) {
        const auto a = std::size_t(v), b = std::size_t(w);
        if (!upper_[a] || upper_[b] || along_mm_[a] != along_mm_[b]) continue;
        const Vec3 between = (mesh_.skin.points.row(v) - mesh_.skin.points.row(w)).transpose();
        const double rest_mm = 1e3 * between.dot(frame_.y);
        if (std::abs(between.dot(frame_.x)) > 1e-6 ||
            std::abs(rest_mm - 2 * half_aperture_mm(along_mm_[a])) > 1e-6)
          continue;
        most_mm = std::max(most_mm, std::abs(rest_mm + up_mm[v] - up_mm[w]));
      }
    return most_mm;
  }

  io::Landmarks landmarks_;
  face::FaceFrame frame_;
  tissue::TissueMesh mesh_;
  std::vector<char> upper_;
  std::vector<double> along_mm_;
};

std::vector<std::string> points_of_lids() {
  std::vector<std::string> names;
  for (const int k : {37, 38, 40, 41, 43, 44, 46, 47}) names.push_back(face::ibug(k));
  return names;
}

TEST_F(Lids, CloseAlongTheirWholeLength) {
  const Eigen::VectorXd before = blink();
  EXPECT_GT(gap_mm(before), 1.5);
  EXPECT_LT(gap_mm(moved(rim(points_of_lids()), before)), 0.3);
}

TEST_F(Lids, KeepTheirPointsAndSkinFarFromThem) {
  const Eigen::VectorXd before = blink(), after = moved(rim(points_of_lids()), before);
  for (const std::string& name : points_of_lids()) {
    const int v = nearest_vertex(mesh_.skin.points, landmarks_.at(name));
    EXPECT_NEAR(after[v], before[v], 0.15) << name;
  }
  for (Eigen::Index v = 0; v < before.size(); ++v) {
    const double up_mm = 1e3 * frame_.local(mesh_.skin.points.row(v).transpose()).y() - 60;
    if (std::abs(up_mm) > 12.1) {
      EXPECT_EQ(after[v], before[v]) << v;
    }
  }
}

TEST_F(Lids, MoveAsOneWhereTheEyeMovesAsOne) {
  const Eigen::VectorXd up = Eigen::VectorXd::Constant(mesh_.skin.points.rows(), 2);
  EXPECT_LT((moved(rim(points_of_lids()), up) - up).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Lids, StayWherePointsDoNotDrive) {
  EXPECT_TRUE(rim({"ibug68_37", "ibug68_38", "ibug68_40"}).empty());
  EXPECT_TRUE(rim({}).empty());
}

TEST_F(Lids, OfAnEyeWithScannedBallStay) {
  for (const double side : {-1.0, 1.0}) {
    const auto first = int(mesh_.skin.points.rows());
    mesh_.skin.points.conservativeResize(first + 3, 3);
    mesh_.skin.points.row(first) = at(side, -20, -20).transpose();
    mesh_.skin.points.row(first + 1) = at(side, 20, -20).transpose();
    mesh_.skin.points.row(first + 2) = at(side, 0, 30).transpose();
    for (int k = 0; k < 3; ++k) mesh_.skin.points.row(first + k) -= 1e-3 * frame_.z.transpose();
    mesh_.skin.triangles.conservativeResize(mesh_.skin.triangles.rows() + 1, 3);
    mesh_.skin.triangles.bottomRows(1) << first, first + (side > 0 ? 1 : 2),
        first + (side > 0 ? 2 : 1);
    for (int v = first; v < first + 3; ++v) mesh_.anchors.push_back({{v, v, v}, {1, 0, 0}});
  }
  EXPECT_TRUE(rim(points_of_lids()).empty());
}

}  // namespace
}  // namespace hyperex::simulate
