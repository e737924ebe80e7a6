// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/frame_fit.hpp"

#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "hyperex/core/one_thread.hpp"
#include "hyperex/expression/mesh_border.hpp"
#include "hyperex/expression/tables.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/geometry/transform.hpp"

namespace hyperex::tracking {

namespace {

constexpr double kLeastCosine = 0.2;  // between a vertex's normal and the line of sight

double square(double x) {
  return x * x;
}

/// Weight of a residual for the Geman-McClure loss.
double robust(double residual, double scale) {
  return 1 / square(1 + square(residual / scale));
}

std::vector<bool> outline(const TriMesh& mesh) {
  std::vector<bool> on(std::size_t(mesh.points.rows()), false);
  for (const auto& [a, b] : expression::border_edges(mesh).outline)
    on[std::size_t(a)] = on[std::size_t(b)] = true;
  return on;
}

/// The network's points of a kind (expression/data/network_points.csv).
std::set<int> network_points(const std::string& kind) {
  std::set<int> points;
  for (const auto& row : expression::table_rows(expression::network_points_table(), "kind,points"))
    if (row.at(0) == kind)
      for (const int point : expression::table_indices(row.at(1), 468)) points.insert(point);
  return points;
}

expression::SparseMatrix free_prior(const TriMesh& mesh, const FitOptions& options) {
  const expression::SparseMatrix laplacian = expression::mesh_laplacian(mesh);
  const expression::SparseMatrix bend = laplacian.transpose() * laplacian;
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < bend.cols(); ++column)
    for (expression::SparseMatrix::InnerIterator it(bend, column); it; ++it) {
      if (it.row() > column) continue;
      // All nine entries, because the data couple the coordinates.
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
          entries.emplace_back(
              3 * v + r, 3 * v + c,
              r == c ? 1 / square(options.free_m) + 1 / square(options.free_step_m) : 0.0);
  expression::SparseMatrix prior(3 * mesh.points.rows(), 3 * mesh.points.rows());
  prior.setFromTriplets(entries.begin(), entries.end());
  return prior;
}

}  // namespace

FrameFit::FrameFit(const expression::FaceModel& model, const capture::Intrinsics& camera,
                   const Points& neutral_m, double unit_scale, const FitOptions& options)
    : model_(model),
      camera_(camera),
      neutral_m_(neutral_m),
      options_(options),
      nothing_measured_(model.mesh),
      on_outline_(outline(model.mesh)),
      free_prior_(free_prior(model.mesh, options)) {
  on_inner_lip_.assign(on_outline_.size(), false);
  in_lip_ = on_inner_lip_;
  slots_ = nothing_measured_.slots(free_prior_);
  keep_blas_to_one_thread();
  factor_.analyzePattern(free_prior_);
  const std::set<int> inside = network_points("inside_lip");
  const auto& inner_lip = face::lip_contour();
  for (const auto& [vertex, network] : model.pairs) {
    in_lip_[std::size_t(vertex)] = inside.contains(network);
    on_inner_lip_[std::size_t(vertex)] =
        std::find(inner_lip.begin(), inner_lip.end(), network) != inner_lip.end();
  }
  // Inside the lips, highlights and shadows move, and the colour is uniform.
  for (const auto t : model.mesh.triangles.rowwise())
    skin_triangle_.push_back(!in_lip_[std::size_t(t[0])] || !in_lip_[std::size_t(t[1])] ||
                             !in_lip_[std::size_t(t[2])]);
  const Eigen::Index units = Eigen::Index(model.animation_units.size());
  unit_matrix_ = VertexSystem::RowMatrix::Zero(3 * model.vertex_count(), units);
  typical_.resize(units);
  for (Eigen::Index k = 0; k < units; ++k) {
    const expression::DeformationUnit& unit = model.animation_units[std::size_t(k)];
    typical_[k] = unit.typical;
    for (std::size_t i = 0; i < unit.vertices.size(); ++i)
      unit_matrix_.block<3, 1>(3 * unit.vertices[i], k) =
          unit_scale * unit.displacement_m.row(Eigen::Index(i)).transpose();
  }
  off_units_m_.resize(model.vertex_count());
  const VertexSystem::RowMatrix typical_moves = unit_matrix_ * typical_.asDiagonal();
  for (Eigen::Index v = 0; v < off_units_m_.size(); ++v)
    off_units_m_[v] = options.off_units_share * typical_moves.middleRows<3>(3 * v).norm() +
                      (in_lip_[std::size_t(v)] ? options.off_units_lip_m : 0);
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
    const double sigma = on_outline_[std::size_t(vertex)] ? options_.network_outline_px
                         : in_lip_[std::size_t(vertex)]   ? options_.network_inner_lip_px
                                                          : options_.network_px;
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
  const Points normals = vertex_normals({vertices, model_.mesh.triangles});
  double squares = 0;
  int used = 0, facing = 0;
  for (int v = 0; v < vertices.rows(); ++v) {
    // Its window would contain both the lip and what lies behind it.
    if (on_inner_lip_[std::size_t(v)]) continue;
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

VertexSystem FrameFit::measure(const Observation& seen, const FaceState& state, const Skin* skin,
                               bool coarse, FitReport* report) const {
  VertexSystem system = nothing_measured_;
  const Points points = vertices(state);
  add_network(system, seen, state, points, report);
  add_depth(system, seen, state, points, report);
  if (skin && options_.photometric_weight > 0) {
    const auto add = [&](const Template& then, const FinePicture& now) {
      return then.add_to(system, now, camera_, state.camera_from_head, points,
                         options_.photometric_weight);
    };
    const SkinPictures& now = seen.pictures;
    const double share =
        coarse ? add(skin->coarse_grey, now.coarse_grey) : add(skin->grey, now.grey);
    coarse ? add(skin->coarse_chroma, now.coarse_chroma) : add(skin->chroma, now.chroma);
    if (report) report->photometric_share = share;
  }
  return system;
}

VertexSystem::RowMatrix FrameFit::parameter_jacobian(const FaceState& state) const {
  const Points points = vertices(state);
  VertexSystem::RowMatrix jacobian(3 * points.rows(), 6 + typical_.size());
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    // Rotation by w and translation by s in the head frame: y + w x y + s.
    const Vec3 y = points.row(v).transpose();
    jacobian.block<3, 3>(3 * v, 0) << 0, y.z(), -y.y(), -y.z(), 0, y.x(), y.y(), -y.x(), 0;
    jacobian.block<3, 3>(3 * v, 3).setIdentity();
  }
  jacobian.rightCols(typical_.size()) = unit_matrix_;
  return jacobian;
}

Eigen::VectorXd FrameFit::parameter_step(const VertexSystem& system,
                                         const VertexSystem::RowMatrix& moved,
                                         const VertexSystem::RowMatrix& jacobian,
                                         const FaceState& state, const FaceState* before) const {
  const int n = int(jacobian.cols());
  // J^T H J by BLAS: four times as fast as Eigen without vectorisation.
  Eigen::MatrixXd hessian(n, n);
  cblas_dgemm(CblasRowMajor, CblasTrans, CblasNoTrans, n, n, int(jacobian.rows()), 1,
              jacobian.data(), n, moved.data(), n, 0, hessian.data(), n);
  // The gradient is that for zero free displacements, so that these only take what the units leave.
  const Eigen::Map<const Eigen::VectorXd> free(state.free_m.data(), state.free_m.size());
  Eigen::VectorXd gradient = jacobian.transpose() * system.gradient() - moved.transpose() * free;
  for (Eigen::Index k = 0; k < typical_.size(); ++k) {
    const double prior = 1 / square(options_.units * typical_[k]);
    hessian(6 + k, 6 + k) += prior;
    gradient[6 + k] += prior * state.weights[k];
    if (!before) continue;
    const double step = 1 / square(options_.units_step * typical_[k]);
    hessian(6 + k, 6 + k) += step;
    gradient[6 + k] += step * (state.weights[k] - before->weights[k]);
  }
  hessian.diagonal().head<6>().array() += 1e-3;  // keeps the pose of a face without measurements
  return hessian.ldlt().solve(-gradient);
}

void FrameFit::move(FaceState& state, const Eigen::VectorXd& step) const {
  const Vec3 turn = step.head<3>();
  Eigen::Isometry3d head = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0)
    head.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  head.translation() = step.segment<3>(3);
  state.camera_from_head = state.camera_from_head * head;
  state.weights += step.tail(typical_.size());
}

void FrameFit::iterate(const VertexSystem& system, FaceState& state, const FaceState* before,
                       bool free_moves) {
  const VertexSystem::RowMatrix jacobian = parameter_jacobian(state);
  const VertexSystem limited = system.limited(off_units_m_);
  const Eigen::VectorXd step =
      parameter_step(limited, limited.times(jacobian), jacobian, state, before);
  if (!step.allFinite()) return;
  move(state, step);
  if (!free_moves) return;
  // Free displacements d: the new ones solve (H + S) d_new = H (d - J step) - g + prior.
  const Eigen::Map<Eigen::VectorXd> free(state.free_m.data(), state.free_m.size());
  Eigen::VectorXd right = system.times(free - jacobian * step) - system.gradient();
  if (before)
    right += Eigen::Map<const Eigen::VectorXd>(before->free_m.data(), before->free_m.size()) /
             square(options_.free_step_m);
  expression::SparseMatrix matrix = free_prior_;
  system.add_to(matrix, slots_);
  const OneOpenMpThread alone;
  factor_.factorize(matrix);
  if (factor_.info() != Eigen::Success) return;
  const Eigen::VectorXd solution = factor_.solve(right);
  if (solution.allFinite())
    state.free_m = Eigen::Map<const Points>(solution.data(), state.free_m.rows(), 3);
}

Skin FrameFit::skin_of(const Observation& seen, const FaceState& state) const {
  const Points points = vertices(state);
  const auto of = [&](const FinePicture& picture, PhotometricOptions options, bool coarse) {
    if (coarse) options.least_gradient *= options_.coarse_gradient;
    return Template(picture, camera_, state.camera_from_head, points, model_.mesh.triangles,
                    skin_triangle_, options);
  };
  const SkinPictures& now = seen.pictures;
  return {of(now.grey, options_.grey, false), of(now.chroma, options_.chroma, false),
          of(now.coarse_grey, options_.grey, true), of(now.coarse_chroma, options_.chroma, true)};
}

SkinPictures skin_pictures(const cv::Mat& bgr, cv::Rect region, const FitOptions& options) {
  return {fine_picture(bgr, region, Channel::grey, options.fine_sigma_px),
          fine_picture(bgr, region, Channel::chroma, options.chroma_sigma_px),
          fine_picture(bgr, region, Channel::grey, options.coarse_sigma_px),
          fine_picture(bgr, region, Channel::chroma, options.coarse_sigma_px)};
}

FaceState FrameFit::fit(const Observation& seen, const FaceState& start, const FaceState* before,
                        const Skin* skin, FitReport* report) {
  FaceState state = start;
  {
    // The first iteration uses the network's points corrected by their offsets in the previous
    // frame, because the network's errors in successive frames are nearly equal. Skin is compared
    // only later, when it is nearly in place.
    Observation moved = seen;
    if (before && before->network_offset_px.rows())
      for (std::size_t i = 0; i < model_.pairs.size(); ++i)
        moved.network_px.row(model_.pairs[i].network).head<2>() +=
            before->network_offset_px.row(Eigen::Index(i));
    iterate(measure(moved, state, nullptr), state, before, false);
  }
  for (int iteration = 1; iteration < options_.iterations; ++iteration) {
    const bool last = iteration + 1 == options_.iterations;
    iterate(measure(seen, state, skin, iteration <= options_.coarse_iterations,
                    last ? report : nullptr),
            state, before, iteration + options_.free_iterations >= options_.iterations);
  }
  const Points points = vertices(state);
  state.network_offset_px.resize(Eigen::Index(model_.pairs.size()), 2);
  for (std::size_t i = 0; i < model_.pairs.size(); ++i)
    state.network_offset_px.row(Eigen::Index(i)) =
        project(camera_,
                state.camera_from_head * Vec3(points.row(model_.pairs[i].vertex).transpose()))
            .transpose() -
        seen.network_px.row(model_.pairs[i].network).head<2>();
  return state;
}

}  // namespace hyperex::tracking
