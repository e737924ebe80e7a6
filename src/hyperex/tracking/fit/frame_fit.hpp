// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/CholmodSupport>
#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "hyperex/capture/frame.hpp"
#include "hyperex/expression/face_model.hpp"
#include "hyperex/tracking/fit/depth_view.hpp"
#include "hyperex/tracking/fit/photometric.hpp"
#include "hyperex/tracking/fit/vertex_system.hpp"
#include "hyperex/tracking/tracked.hpp"

namespace hyperex::tracking {

/// A picture in the two channels that are compared, each at a fine and a coarse scale.
struct SkinPictures {
  FinePicture grey, chroma, coarse_grey, coarse_chroma;
};

/// The measurements in one frame.
struct Observation {
  Points network_px;      ///< 468 x 3: the landmark network's points, pixels
  cv::Mat depth_m;        ///< CV_32F or empty
  SkinPictures pictures;  ///< if the pictures are empty, they are not compared
};

/// The appearance of the skin in the reference frame, with which other frames are compared.
struct Skin {
  Template grey, chroma, coarse_grey, coarse_chroma;
};

/// A face in one frame.
struct FaceState {
  Eigen::Isometry3d camera_from_head = Eigen::Isometry3d::Identity();
  Eigen::VectorXd weights;  ///< of the animation units
  Points free_m;  ///< |V| x 3, head frame: displacements in addition to those of the units
  /// One row per pair of the model: the fitted position of the vertex in the picture minus the
  /// network's.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> network_offset_px;
};

/// Weights of the terms. All are prior standard deviations; a larger one means less weight.
struct FitOptions {
  int iterations = 3;     ///< the first without skin, then with coarse skin, then with fine skin
  double network_px = 3;  ///< of a point of the network
  /// For points on the outline of the face, which slide over the skin.
  double network_outline_px = 6;
  /// For points inside the outer border of the lips. There, the network follows the appearance of
  /// the lips rather than the motion of the skin.
  double network_inner_lip_px = 4;
  double network_robust_px = 10;  ///< scale of the Geman-McClure loss
  double depth_m = 0.0005;  ///< of a vertex's distance from the measured surface along its normal
  double depth_robust_m = 0.004;
  PatchOptions patch{.radius_px = 2};
  double photometric_weight = 1;
  PhotometricOptions grey{.channel = Channel::grey, .pixels_as_one = 30};
  PhotometricOptions chroma{
      .channel = Channel::chroma, .noise = 4, .robust = 25, .least_gradient = 4};
  double fine_sigma_px = 0.8, chroma_sigma_px = 1.2;
  double coarse_sigma_px = 2.5;  ///< smoothing of the coarse pictures, which are compared first
  /// PhotometricOptions::least_gradient for coarse pictures, relative to that for fine ones.
  double coarse_gradient = 0.5;
  int coarse_iterations = 1;
  /// Number of iterations, the last ones, in which the free displacements are fitted too.
  int free_iterations = 1;
  /// Standard deviation of a vertex from any combination of the units, relative to its typical
  /// displacement by them, and an additional length inside the lips. It limits the weight that many
  /// consistent pixels can have on pose and units.
  double off_units_share = 0.7, off_units_lip_m = 0.003;
  double units = 0.5;       ///< relative to the unit's typical weight
  double units_step = 0.5;  ///< change between frames, relative to the typical weight
  double free_m = 0.015;    ///< of a vertex's free displacement
  /// For a vertex's free displacement relative to the mean of its neighbours.
  double free_bend_m = 0.0007;
  double free_step_m = 0.004;  ///< change of a free displacement between frames
};

/// `region`: the region around the face.
SkinPictures skin_pictures(const cv::Mat& bgr, cv::Rect region, const FitOptions& options);

/// Fits head pose, unit weights and free displacements of a person's face to one frame:
///   min  sum |project(T (N + A alpha + d)) - u|^2 / s_u^2           network points, robust
///      + sum (n . (T (N + A alpha + d) - q))^2 / s_q^2              depth, point to plane, robust
///      + sum (I(project(.)) - I_0)^2 / s_I^2                        skin relative to its template
///      + |alpha / s_alpha|^2 + |alpha - alpha_before|^2 / ... + |d|^2 / ... + |L d|^2 / ...
/// by the Gauss-Newton method with weights updated in each iteration. Pose and alpha are solved
/// first with d = 0, then d with these fixed. Ceres is not used: here, the measurements are first
/// summed to a quadratic form over the vertex displacements, which both steps share. This takes a
/// sixtieth of the time of a row of derivatives with respect to all parameters for every pixel.
class FrameFit {
 public:
  /// `neutral_m`: the person's vertices at rest, head frame. `unit_scale`: the size of the person
  /// relative to the model.
  FrameFit(const expression::FaceModel& model, const capture::Intrinsics& camera,
           const Points& neutral_m, double unit_scale, const FitOptions& options);

  /// Fits a frame, starting from `start`. `before`: the state in the previous frame, or null.
  FaceState fit(const Observation& seen, const FaceState& start, const FaceState* before,
                const Skin* skin, FitReport* report = nullptr);
  /// The template with which later frames are compared.
  Skin skin_of(const Observation& seen, const FaceState& state) const;

  /// Positions of the vertices in the head frame.
  Points vertices(const FaceState& state) const;
  const Points& neutral() const { return neutral_m_; }
  FaceState at_rest() const;

  /// The pose from the network's points only (scaled orthographic projection). The distance from
  /// the camera follows from the depth, if there is any.
  Eigen::Isometry3d first_pose(const Observation& seen) const;

  /// Sum of the robust losses without priors, and its derivatives with respect to pose (rotation
  /// and translation in the head frame) and units. Used for comparison with finite differences. The
  /// robust weights and the planes are those at `state`.
  VertexSystem measure(const Observation& seen, const FaceState& state, const Skin* skin,
                       bool coarse = false, FitReport* report = nullptr) const;
  /// Derivatives of the vertices with respect to rotation, translation and weights, 3 |V| x (6 +
  /// K).
  VertexSystem::RowMatrix parameter_jacobian(const FaceState& state) const;

 private:
  void add_network(VertexSystem& system, const Observation& seen, const FaceState& state,
                   const Points& vertices, FitReport* report) const;
  void add_depth(VertexSystem& system, const Observation& seen, const FaceState& state,
                 const Points& vertices, FitReport* report) const;
  Eigen::VectorXd parameter_step(const VertexSystem& system, const VertexSystem::RowMatrix& moved,
                                 const VertexSystem::RowMatrix& jacobian, const FaceState& state,
                                 const FaceState* before) const;
  void move(FaceState& state, const Eigen::VectorXd& step) const;
  /// One Gauss-Newton step from `state`, at which `system` was measured.
  void iterate(const VertexSystem& system, FaceState& state, const FaceState* before,
               bool free_moves);

  const expression::FaceModel& model_;
  capture::Intrinsics camera_;
  Points neutral_m_;
  FitOptions options_;
  VertexSystem nothing_measured_;
  std::vector<bool> skin_triangle_;      // false: inside the lips
  VertexSystem::RowMatrix unit_matrix_;  // 3|V| x K
  Eigen::VectorXd typical_;
  Eigen::VectorXd off_units_m_;  // per vertex
  std::vector<bool> on_outline_, in_lip_, on_inner_lip_;
  expression::SparseMatrix free_prior_;  // upper triangle, with the pattern of the data
  Eigen::CholmodSupernodalLLT<expression::SparseMatrix, Eigen::Upper> factor_;
  std::vector<Eigen::Index> slots_;  // positions of the data in free_prior_
};

}  // namespace hyperex::tracking
