// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <opencv2/core.hpp>

#include "hyperex/tracking/network/face_points.hpp"

namespace hyperex::tracking {

/// The landmark network of MediaPipe Face Mesh with attention (face_landmark_with_attention.tflite;
/// I. Grishchenko et al., "Attention Mesh: High-fidelity Face Mesh Prediction in Real-time", CVPR
/// Workshop 2020). A first stage gives 468 points of the whole face. A second stage refines the
/// lips and the eyes, each from the features around the positions found by the first stage. Three
/// operations in the file are custom and are implemented here: the square around a region
/// (Landmarks2TransformMatrix), its bilinear sampling (TransformTensorBilinear) and the
/// transformation back (TransformLandmarks). The file states which points are refined and how large
/// the squares are.
class FaceMeshNetwork {
 public:
  /// `lips`, `eyes`: whether the second stage refines them.
  FaceMeshNetwork(bool lips, bool eyes);
  ~FaceMeshNetwork();
  FaceMeshNetwork(FaceMeshNetwork&&) noexcept;
  FaceMeshNetwork& operator=(FaceMeshNetwork&&) noexcept;

  int size_px() const;  ///< side of the square input picture
  /// `picture`: 1 x 3 x size x size, RGB, 0 to 1. `points` are in pixels of this picture, with (0,
  /// 0) at its upper left corner. Returns the score, 0 to 1. If the score is below `least_score`,
  /// the second stage is skipped.
  double look(const cv::Mat& picture, double least_score, FacePoints& points);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::tracking
