// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/frame_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "hyperex/geometry/transform.hpp"

namespace hyperex::tracking {

namespace {

constexpr double kLeastCosine = 0.35;  // between a vertex's normal and the line of sight

double square(double x) {
  return x * x;
}

/// Geman and McClure's weight of a residual.
double robust(double residual, double scale) {
  return 1 / square(1 + square(residual / scale));
}

std::vector<bool> outline(const TriMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto t : mesh.triangles.rowwise())
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  // Of the loops of border edges, the longest.
  std::map<int, std::vector<int>> next;
  for (const auto& [edge, count] : uses)
    if (count == 1) {
      next[edge.first].push_back(edge.second);
      next[edge.second].push_back(edge.first);
    }
  std::vector<int> loop_of(std::size_t(mesh.points.rows()), -1);
  std::vector<double> length;
  for (const auto& [seed, unused] : next) {
    if (loop_of[std::size_t(seed)] >= 0) continue;
    const int loop = int(length.size());
    length.push_back(0);
    std::vector<int> waiting = {seed};
    loop_of[std::size_t(seed)] = loop;
    while (!waiting.empty()) {
      const int v = waiting.back();
      waiting.pop_back();
      for (const int w : next[v]) {
        length[std::size_t(loop)] += (mesh.points.row(v) - mesh.points.row(w)).norm();
        if (loop_of[std::size_t(w)] >= 0) continue;
        loop_of[std::size_t(w)] = loop;
        waiting.push_back(w);
      }
    }
  }
  std::vector<bool> on(std::size_t(mesh.points.rows()), false);
  if (length.empty()) return on;
  const int longest = int(std::max_element(length.begin(), length.end()) - length.begin());
  for (std::size_t v = 0; v < on.size(); ++v) on[v] = loop_of[v] == longest;
  return on;
}

Points normals_of(const Points& points, const Triangles& triangles) {
  Points normals = Points::Zero(points.rows(), 3);
  for (const auto t : triangles.rowwise()) {
    const Vec3 a = points.row(t[0]).transpose(), b = points.row(t[1]).transpose(),
               c = points.row(t[2]).transpose();
    const Eigen::RowVector3d n = (b - a).cross(c - a).transpose();
    for (int k = 0; k < 3; ++k) normals.row(t[k]) += n;
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0) normals.row(v) /= length;
  }
  return normals;
}

SparseMatrix free_prior(const TriMesh& mesh, const FitOptions& options) {
  const SparseMatrix laplacian = mesh_laplacian(mesh);
  const SparseMatrix bend = laplacian.transpose() * laplacian;
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < bend.cols(); ++column)
    for (SparseMatrix::InnerIterator it(bend, column); it; ++it) {
      if (it.row() > column) continue;
      // All nine places, for the data couple coordinates.
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          const Eigen::Index row = 3 * it.row() + r, col = 3 * Eigen::Index(column) + c;
          if (row > col) continue;
          double value = r == c ? it.value() / square(options.free_bend_m) : 0;
          if (row == col) value += 1 / square(options.free_m) + 1 / square(options.free_step_m);
          entries.emplace_back(row, col, value);
        }
    }
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v)  // vertices without triangles
    if (bend.coeff(v, v) == 0)
      for (int r = 0; r < 3; ++r)
        for (int c = r; c < 3; ++c)
          entries.emplace_back(3 * v + r, 3 * v + c, r == c ? 1 / square(options.free_m) : 0.0);
  SparseMatrix prior(3 * mesh.points.rows(), 3 * mesh.points.rows());
  prior.setFromTriplets(entries.begin(), entries.end());
  return prior;
}

}  // namespace

FrameFit::FrameFit(const FaceModel& model, const capture::Intrinsics& camera,
                   const Points& neutral_m, double unit_scale, const FitOptions& options)
    : model_(model),
      camera_(camera),
      neutral_m_(neutral_m),
      options_(options),
      on_outline_(outline(model.mesh)),
      free_prior_(free_prior(model.mesh, options)) {
  const Eigen::Index units = Eigen::Index(model.animation_units.size());
  unit_matrix_ = VertexSystem::RowMatrix::Zero(3 * model.vertex_count(), units);
  typical_.resize(units);
  for (Eigen::Index k = 0; k < units; ++k) {
    const DeformationUnit& unit = model.animation_units[std::size_t(k)];
    typical_[k] = unit.typical;
    for (std::size_t i = 0; i < unit.vertices.size(); ++i)
      unit_matrix_.block<3, 1>(3 * unit.vertices[i], k) =
          unit_scale * unit.displacement_m.row(Eigen::Index(i)).transpose();
  }
}

FaceState FrameFit::at_rest() const {
  FaceState state;
  state.weights = Eigen::VectorXd::Zero(typical_.size());
  state.free_m = Points::Zero(neutral_m_.rows(), 3);
  return state;
}

Points FrameFit::vertices(const FaceState& state) const {
  Points points = neutral_m_ + state.free_m;
  const Eigen::VectorXd moved = unit_matrix_ * state.weights;
  points += Eigen::Map<const Points>(moved.data(), points.rows(), 3);
  return points;
}

Eigen::Isometry3d FrameFit::first_pose(const Observation& seen) const {
  Points from(Eigen::Index(model_.pairs.size()), 3), to(from.rows(), 3);
  for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
    from.row(Eigen::Index(i)) = neutral_m_.row(model_.pairs[i].vertex);
    to.row(Eigen::Index(i)) = seen.network_px.row(model_.pairs[i].network);
  }
  const Similarity px_from_head = fit_similarity(from, to);
  const Vec3 centre_px = to.colwise().mean().transpose();
  const Vec3 centre = from.colwise().mean().transpose();
  double distance_m = camera_.fx_px / px_from_head.scale;
  const Vec3 direction = ray(camera_, centre_px.head<2>());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = px_from_head.rotation;
  const auto place = [&] { pose.translation() = distance_m * direction - pose.linear() * centre; };
  place();
  if (seen.depth_m.empty()) return pose;
  for (int round = 0; round < 2; ++round) {
    std::vector<double> differences;
    for (Eigen::Index i = 0; i < to.rows(); ++i) {
      const int u = int(std::lround(to(i, 0))), v = int(std::lround(to(i, 1)));
      if (u < 0 || v < 0 || u >= seen.depth_m.cols || v >= seen.depth_m.rows) continue;
      const float z = seen.depth_m.at<float>(v, u);
      if (z > 0) differences.push_back(double(z) - (pose * Vec3(from.row(i).transpose())).z());
    }
    if (differences.size() < 10) return pose;
    const auto middle = differences.begin() + std::ptrdiff_t(differences.size() / 2);
    std::nth_element(differences.begin(), middle, differences.end());
    distance_m += *middle;
    place();
  }
  return pose;
}

void FrameFit::add_network(VertexSystem& system, const Observation& seen, const FaceState& state,
                           const Points& vertices, FitReport* report) const {
  const Eigen::Matrix3d turn = state.camera_from_head.linear();
  double squares = 0;
  for (const auto& [vertex, network] : model_.pairs) {
    const Vec3 p = state.camera_from_head * Vec3(vertices.row(vertex).transpose());
    const Eigen::Vector2d error =
        project(camera_, p) - seen.network_px.row(network).head<2>().transpose();
    squares += error.squaredNorm();
    const double sigma =
        on_outline_[std::size_t(vertex)] ? options_.network_outline_px : options_.network_px;
    const double weight = robust(error.norm(), options_.network_robust_px) / square(sigma);
    const Eigen::Matrix<double, 2, 3> j = project_jacobian(camera_, p) * turn;
    system.add_row(vertex, j.row(0), error.x(), weight);
    system.add_row(vertex, j.row(1), error.y(), weight);
  }
  if (report) report->network_rms_px = std::sqrt(squares / double(model_.pairs.size()));
}

void FrameFit::add_depth(VertexSystem& system, const Observation& seen, const FaceState& state,
                         const Points& vertices, FitReport* report) const {
  if (seen.depth_m.empty()) return;
  const Eigen::Matrix3d turn = state.camera_from_head.linear();
  const Points normals = normals_of(vertices, model_.mesh.triangles);
  double squares = 0;
  int used = 0, facing = 0;
  for (int v = 0; v < vertices.rows(); ++v) {
    const Vec3 p = state.camera_from_head * Vec3(vertices.row(v).transpose());
    const Vec3 normal = turn * normals.row(v).transpose();
    if (-normal.dot(p.normalized()) < kLeastCosine) continue;
    ++facing;
    const auto patch =
        surface_patch(seen.depth_m, camera_, project(camera_, p), p.z(), options_.patch);
    if (!patch || -patch->normal.dot(p.normalized()) < kLeastCosine) continue;
    const double error = patch->normal.dot(p - patch->point);
    const double weight = patch->share * robust(error, options_.depth_robust_m) /
                          (square(options_.depth_m) + square(patch->spread_m) / 4);
    system.add_row(v, patch->normal.transpose() * turn, error, weight);
    squares += error * error;
    ++used;
  }
  if (report) {
    report->depth_rms_m = used ? std::sqrt(squares / used) : 0;
    report->depth_share = facing ? double(used) / facing : 0;
  }
}

VertexSystem FrameFit::measure(const Observation& seen, const FaceState& state,
                               const Template* skin, FitReport* report) const {
  VertexSystem system(model_.mesh);
  const Points points = vertices(state);
  add_network(system, seen, state, points, report);
  add_depth(system, seen, state, points, report);
  if (skin && options_.photometric_weight > 0) {
    const double share = skin->add_to(system, seen.picture, camera_, state.camera_from_head, points,
                                      options_.photometric_weight);
    if (report) report->photometric_share = share;
  }
  return system;
}

VertexSystem::RowMatrix FrameFit::parameter_jacobian(const FaceState& state) const {
  const Points points = vertices(state);
  VertexSystem::RowMatrix jacobian(3 * points.rows(), 6 + typical_.size());
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    // The head is turned by w and shifted by s in its own frame: y + w x y + s.
    const Vec3 y = points.row(v).transpose();
    jacobian.block<3, 3>(3 * v, 0) << 0, y.z(), -y.y(), -y.z(), 0, y.x(), y.y(), -y.x(), 0;
    jacobian.block<3, 3>(3 * v, 3).setIdentity();
  }
  jacobian.rightCols(typical_.size()) = unit_matrix_;
  return jacobian;
}

void FrameFit::step_parameters(const VertexSystem& system, FaceState& state,
                               const FaceState* before) const {
  const VertexSystem::RowMatrix jacobian = parameter_jacobian(state);
  Eigen::MatrixXd hessian = jacobian.transpose() * system.times(jacobian);
  Eigen::VectorXd gradient = jacobian.transpose() * system.gradient();
  for (Eigen::Index k = 0; k < typical_.size(); ++k) {
    const double prior = 1 / square(options_.units * typical_[k]);
    hessian(6 + k, 6 + k) += prior;
    gradient[6 + k] += prior * state.weights[k];
    if (!before) continue;
    const double step = 1 / square(options_.units_step * typical_[k]);
    hessian(6 + k, 6 + k) += step;
    gradient[6 + k] += step * (state.weights[k] - before->weights[k]);
  }
  hessian.diagonal().head<3>().array() += 1e-3;  // a face that nothing was measured of stays
  hessian.diagonal().segment<3>(3).array() += 1e-3;
  const Eigen::VectorXd step = hessian.ldlt().solve(-gradient);
  if (!step.allFinite()) return;
  const Vec3 turn = step.head<3>();
  Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0)
    move.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  move.translation() = step.segment<3>(3);
  state.camera_from_head = state.camera_from_head * move;
  state.weights += step.tail(typical_.size());
}

void FrameFit::solve_free(const VertexSystem& system, FaceState& state, const FaceState* before) {
  SparseMatrix matrix = free_prior_;
  system.add_to(matrix);
  if (!analysed_) {
    factor_.analyzePattern(matrix);
    analysed_ = true;
  }
  factor_.factorize(matrix);
  if (factor_.info() != Eigen::Success) return;
  Eigen::VectorXd right = -system.gradient();
  if (before)
    right += Eigen::Map<const Eigen::VectorXd>(before->free_m.data(), before->free_m.size()) /
             square(options_.free_step_m);
  const Eigen::VectorXd solution = factor_.solve(right);
  state.free_m = Eigen::Map<const Points>(solution.data(), state.free_m.rows(), 3);
}

FaceState FrameFit::fit(const Observation& seen, const FaceState& start, const FaceState* before,
                        const Template* skin, FitReport* report) {
  FaceState state = start;
  state.free_m.setZero();
  for (int iteration = 0; iteration < options_.iterations; ++iteration) {
    const bool coarse = iteration == 0;  // skin is compared only where it is nearly in place
    step_parameters(measure(seen, state, coarse ? nullptr : skin), state, before);
  }
  solve_free(measure(seen, state, skin, report), state, before);
  return state;
}

}  // namespace hyperex::tracking
