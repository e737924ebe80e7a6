// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/neutral.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/geometry/transform.hpp"

namespace hyperex::tracking {

namespace {

double squared(double x) {
  return x * x;
}

/// Weighted sums over the frames of the measured vertices at rest.
struct VertexMean {
  Points sum;
  Eigen::VectorXd weight;
};

double outer_eye_distance(const expression::FaceModel& model, const Points& points) {
  return (expression::landmark_at(model.landmarks.at("exocanthion_L"), points) -
          expression::landmark_at(model.landmarks.at("exocanthion_R"), points))
      .norm();
}

/// The size of the person relative to the model, from similarity transforms of the model to the
/// vertices measured by depth; nothing if there is too little depth.
std::optional<double> scale_from_depth(const expression::FaceModel& model,
                                       const capture::Intrinsics& camera,
                                       const std::vector<Observation>& frames) {
  std::vector<double> scales;
  for (const Observation& seen : frames) {
    if (seen.depth_m.empty()) continue;
    std::vector<Vec3> from, to;
    for (const auto& [vertex, network] : model.pairs) {
      const Eigen::Vector2d px = seen.network_px.row(network).head<2>().transpose();
      const int u = int(std::lround(px.x())), v = int(std::lround(px.y()));
      if (u < 0 || v < 0 || u >= seen.depth_m.cols || v >= seen.depth_m.rows) continue;
      const float z = seen.depth_m.at<float>(v, u);
      if (z <= 0) continue;
      from.push_back(model.mesh.points.row(vertex).transpose());
      to.push_back(double(z) * ray(camera, px));
    }
    if (from.size() < std::max<std::size_t>(12, model.pairs.size() / 4)) continue;
    Points a(Eigen::Index(from.size()), 3), b(a.rows(), 3);
    for (std::size_t i = 0; i < from.size(); ++i) {
      a.row(Eigen::Index(i)) = from[i].transpose();
      b.row(Eigen::Index(i)) = to[i].transpose();
    }
    // Network points on the outline often fall beside the face. Points that fit badly therefore
    // lose weight in five rounds.
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(a.rows());
    Similarity fit = fit_similarity(a, b, weights);
    for (int round = 0; round < 5; ++round) {
      for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const double off = (fit * Vec3(a.row(i).transpose()) - Vec3(b.row(i).transpose())).norm();
        weights[i] = 1 / squared(1 + squared(off / 0.01));
      }
      fit = fit_similarity(a, b, weights);
    }
    scales.push_back(fit.scale);
  }
  if (scales.empty()) return std::nullopt;
  return median(scales);
}

/// Adds the vertices at rest that one frame gives.
void add_frame(const expression::FaceModel& model, const capture::Intrinsics& camera,
               const Observation& seen, const FrameFit& fit, const FaceState& state,
               const PatchOptions& patch_options, VertexMean& mean) {
  const Points now = fit.vertices(state);
  const Eigen::Isometry3d head_from_camera = state.camera_from_head.inverse();
  for (const auto& [vertex, network] : model.pairs) {
    const Eigen::Vector2d px = seen.network_px.row(network).head<2>().transpose();
    const Vec3 expected = state.camera_from_head * Vec3(now.row(vertex).transpose());
    Vec3 found = expected.z() * ray(camera, px);
    double weight = 0.3;
    if (!seen.depth_m.empty()) {
      const auto patch = surface_patch(seen.depth_m, camera, px, expected.z(), patch_options);
      if (patch) {
        found = patch->point;
        weight = 1;
      }
    }
    const Vec3 at_rest =
        head_from_camera * found - (now.row(vertex) - fit.neutral().row(vertex)).transpose();
    if ((at_rest - Vec3(fit.neutral().row(vertex).transpose())).norm() > 0.03) continue;
    mean.sum.row(vertex) += weight * at_rest.transpose();
    mean.weight[vertex] += weight;
  }
}

Eigen::VectorXd fit_shape(const expression::FaceModel& model, double scale,
                          const VertexMean& mean) {
  const Eigen::Index units = Eigen::Index(model.shape_units.size());
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(units, units);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(units);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * model.vertex_count(), units);
  for (Eigen::Index k = 0; k < units; ++k) {
    const expression::DeformationUnit& unit = model.shape_units[std::size_t(k)];
    for (std::size_t i = 0; i < unit.vertices.size(); ++i)
      columns.block<3, 1>(3 * unit.vertices[i], k) =
          scale * unit.displacement_m.row(Eigen::Index(i)).transpose();
    hessian(k, k) += 1 / squared(unit.typical);
  }
  constexpr double kModel_m = 0.004;  // standard deviation of any person's face from the model
  for (Eigen::Index v = 0; v < model.vertex_count(); ++v) {
    if (mean.weight[v] <= 0) continue;
    const Vec3 target =
        (mean.sum.row(v) / mean.weight[v] - scale * model.mesh.points.row(v)).transpose();
    const auto rows = columns.middleRows<3>(3 * v);
    hessian += rows.transpose() * rows / squared(kModel_m);
    right += rows.transpose() * target / squared(kModel_m);
  }
  return hessian.ldlt().solve(right);
}

/// The means, regularised towards the model's shape such that the differences are smooth over the
/// mesh.
Points smoothed(const expression::FaceModel& model, const Points& shape, const VertexMean& mean,
                const NeutralOptions& options) {
  const expression::SparseMatrix laplacian = expression::mesh_laplacian(model.mesh);
  expression::SparseMatrix matrix = laplacian.transpose() * laplacian / squared(options.bend_m);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(model.vertex_count(), 3);
  constexpr double kWeak = 1e2;  // standard deviation 0.1 m: for vertices without any data
  for (Eigen::Index v = 0; v < model.vertex_count(); ++v) {
    const double weight = std::min(1.0, mean.weight[v]) / squared(options.vertex_m);
    matrix.coeffRef(v, v) += weight + kWeak;
    if (mean.weight[v] > 0)
      right.row(v) = weight * (mean.sum.row(v) / mean.weight[v] - shape.row(v));
  }
  const Eigen::SimplicialLDLT<expression::SparseMatrix> factor(matrix);
  return shape + Points(factor.solve(right));
}

}  // namespace

Neutral estimate_neutral(const expression::FaceModel& model, const capture::Intrinsics& camera,
                         const std::vector<Observation>& frames, const NeutralOptions& options) {
  HX_ASSERT(!frames.empty());
  Neutral neutral;
  const auto scale = scale_from_depth(model, camera, frames);
  neutral.metric = scale.has_value();
  neutral.scale =
      scale.value_or(options.eye_distance_m / outer_eye_distance(model, model.mesh.points));
  neutral.shape = Eigen::VectorXd::Zero(Eigen::Index(model.shape_units.size()));
  neutral.points_m = neutral.scale * model.mesh.points;
  FitOptions rigid = options.fit;
  rigid.units = 1e-4;         // at rest: only the head pose is fitted
  rigid.free_iterations = 0;  // not needed here
  for (int round = 0; round < options.rounds; ++round) {
    FrameFit fit(model, camera, neutral.points_m, neutral.scale, rigid);
    VertexMean mean{Points::Zero(model.vertex_count(), 3),
                    Eigen::VectorXd::Zero(model.vertex_count())};
    PatchOptions patch = options.fit.patch;
    patch.gate_m = round == 0 ? 0.03 : 0.012;
    for (const Observation& seen : frames) {
      FaceState state = fit.at_rest();
      state.camera_from_head = fit.first_pose(seen);
      state = fit.fit(seen, state, nullptr, nullptr);
      state.free_m.setZero();
      add_frame(model, camera, seen, fit, state, patch, mean);
    }
    neutral.shape = fit_shape(model, neutral.scale, mean);
    const Points shape =
        neutral.scale * expression::deformed(model.mesh.points, model.shape_units, neutral.shape);
    neutral.points_m = smoothed(model, shape, mean, options);
    if (!neutral.metric)
      neutral.points_m *= options.eye_distance_m / outer_eye_distance(model, neutral.points_m);
  }
  return neutral;
}

void check_size(const expression::FaceModel& model, const Neutral& neutral) {
  const double eyes_m = outer_eye_distance(model, neutral.points_m);
  constexpr double kLeast_m = 0.05, kMost_m = 0.15;
  if (neutral.metric && !(eyes_m >= kLeast_m && eyes_m <= kMost_m))
    throw InputError(fmt::format(
        "tracking: by the depth the outer corners of the eyes are {:.0f} mm apart; expected 50 to "
        "150 mm: is the depth's unit (depth_scale in camera.toml) right, and the camera's fx, fy?",
        1e3 * eyes_m));
}

}  // namespace hyperex::tracking
