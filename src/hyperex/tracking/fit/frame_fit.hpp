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

/// A picture in the channels that are compared, fine and coarse.
struct SkinPictures {
  FinePicture grey, chroma, coarse_grey, coarse_chroma;
};

/// What one frame shows of a face.
struct Observation {
  Points network_px;      ///< 468 x 3: the landmark network's points, pixels
  cv::Mat depth_m;        ///< CV_32F or empty
  SkinPictures pictures;  ///< values may be empty: nothing is compared then
};

/// The skin in the frame that others are compared with.
struct Skin {
  Template grey, chroma, coarse_grey, coarse_chroma;
};

/// A face in one frame.
struct FaceState {
  Eigen::Isometry3d camera_from_head = Eigen::Isometry3d::Identity();
  Eigen::VectorXd weights;  ///< of the animation units
  Points free_m;            ///< |V| x 3, head frame: what the units do not explain
  /// One row per pair of the model: where the fit put the vertex less where the network saw it.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> network_offset_px;
};

/// How much each source counts. Standard deviations a priori; a larger one counts less.
struct FitOptions {
  int iterations = 3;             ///< by network and depth, with coarse skin, with fine skin ...
  double network_px = 3;          ///< of a network point
  double network_outline_px = 6;  ///< of one on the face's outline, which slides on the skin
  /// Of a point within the lips' outer border: the network sees how the lips look there, not
  /// where the skin goes.
  double network_inner_lip_px = 4;
  double network_robust_px = 10;  ///< Geman-McClure
  double depth_m = 0.0005;        ///< of a vertex against the surface, along its normal
  double depth_robust_m = 0.004;
  PatchOptions patch{.radius_px = 2};
  double photometric_weight = 1;
  PhotometricOptions grey{.channel = Channel::grey, .pixels_as_one = 30};
  PhotometricOptions chroma{
      .channel = Channel::chroma, .noise = 4, .robust = 25, .least_gradient = 4};
  double fine_sigma_px = 0.8, chroma_sigma_px = 1.2;
  double coarse_sigma_px = 2.5;  ///< of the smoother pictures that are compared first
  double coarse_gradient = 0.5;  ///< PhotometricOptions::least_gradient there, of that of the fine
  int coarse_iterations = 1;
  int free_iterations = 1;  ///< the last so many solve for the free displacements too
  /// How far a vertex may be off any weights of the units, of its typical displacement by them, and
  /// what is added to that within the lips: many pixels that agree on it say no more about pose and
  /// units than this.
  double off_units_share = 0.7, off_units_lip_m = 0.003;
  double units = 0.5;           ///< times the unit's typical weight
  double units_step = 0.5;      ///< times the typical weight, from one frame to the next
  double free_m = 0.015;        ///< of a vertex off the units
  double free_bend_m = 0.0007;  ///< of a vertex against the mean of its neighbours
  double free_step_m = 0.004;   ///< from one frame to the next
};

/// `region`: around the face.
SkinPictures skin_pictures(const cv::Mat& bgr, cv::Rect region, const FitOptions& options);

/// Fits pose, units and free displacements of one person's face to one frame:
///   min  sum |project(T (N + A alpha + d)) - u|^2 / s_u^2           network points, robust
///      + sum (n . (T (N + A alpha + d) - q))^2 / s_q^2              depth, point to plane, robust
///      + sum (I(project(.)) - I_0)^2 / s_I^2                        skin against its template
///      + |alpha / s_alpha|^2 + |alpha - alpha_before|^2 / ... + |d|^2 / ... + |L d|^2 / ...
/// by Gauss and Newton's method with weights renewed in each iteration: pose and alpha first (d =
/// 0), then d with those held. Own code rather than Ceres: the measurements are first summed to a
/// form over vertex displacements, which both steps share and which costs 60 times less than a row
/// of derivatives by all parameters for every pixel.
class FrameFit {
 public:
  /// `neutral_m`: the person's vertices at rest, head frame; `unit_scale`: the person's size
  /// relative to the model's.
  FrameFit(const expression::FaceModel& model, const capture::Intrinsics& camera,
           const Points& neutral_m, double unit_scale, const FitOptions& options);

  /// From `start`; `before`, where given, is the state a frame earlier.
  FaceState fit(const Observation& seen, const FaceState& start, const FaceState* before,
                const Skin* skin, FitReport* report = nullptr);
  /// What to compare later frames with.
  Skin skin_of(const Observation& seen, const FaceState& state) const;

  /// Vertices in the head's frame.
  Points vertices(const FaceState& state) const;
  const Points& neutral() const { return neutral_m_; }
  FaceState at_rest() const;

  /// A pose from the network's points alone (scaled orthography), its distance from depth where
  /// there is any.
  Eigen::Isometry3d first_pose(const Observation& seen) const;

  /// Sum of the robust costs without priors, and its derivative by pose (turn and shift in the
  /// head's frame) and units: for the comparison with finite differences. Weights of robust losses
  /// and planes are those at `state`.
  VertexSystem measure(const Observation& seen, const FaceState& state, const Skin* skin,
                       bool coarse = false, FitReport* report = nullptr) const;
  /// d vertex / d (turn, shift, weights), 3 |V| x (6 + K).
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
  /// One step of Gauss and Newton from `state`, which is where `system` was measured.
  void iterate(const VertexSystem& system, FaceState& state, const FaceState* before,
               bool free_moves);

  const expression::FaceModel& model_;
  capture::Intrinsics camera_;
  Points neutral_m_;
  FitOptions options_;
  VertexSystem nothing_measured_;
  std::vector<bool> skin_triangle_;      // false: within the lips
  VertexSystem::RowMatrix unit_matrix_;  // 3|V| x K
  Eigen::VectorXd typical_;
  Eigen::VectorXd off_units_m_;  // of a vertex
  std::vector<bool> on_outline_, in_lip_, on_inner_lip_;
  expression::SparseMatrix free_prior_;  // upper triangle, with the pattern of the data
  Eigen::CholmodSupernodalLLT<expression::SparseMatrix, Eigen::Upper> factor_;
  std::vector<Eigen::Index> slots_;  // of the data in free_prior_
};

}  // namespace hyperex::tracking
