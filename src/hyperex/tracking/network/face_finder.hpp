// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "hyperex/tracking/network/face_region.hpp"

namespace hyperex::tracking {

/// A face found by the detector, in pixels of the picture, with pixel centres at integers.
struct FoundFace {
  double score = 0;  ///< 0 to 1
  cv::Rect2d box;    ///< from brow to chin and from cheek to cheek
  /// The subject's right eye, left eye, nose tip, mouth, right ear, left ear.
  std::array<cv::Point2d, 6> points;

  /// The square region for the landmark network: 1.5 x the longer side of the box, rotated such
  /// that the eyes are horizontal in it.
  FaceRegion region() const;
};

struct FaceFinderOptions {
  double least_score = 0.5;  ///< of a face, 0 to 1
  /// Boxes with a larger overlap (intersection over union) are merged.
  double same_face_overlap = 0.3;
  /// If the whole picture shows no face, also searches overlapping squares of two thirds of the
  /// shorter side, for faces too small for the network's 128 pixels.
  bool look_closer = true;
};

/// Faces in a picture: the short-range detector of MediaPipe (V. Bazarevsky et al., "BlazeFace:
/// Sub-millisecond Neural Face Detection on Mobile GPUs", CVPR Workshop 2019).
class FaceFinder {
 public:
  explicit FaceFinder(const FaceFinderOptions& options = {});
  ~FaceFinder();
  FaceFinder(FaceFinder&&) noexcept;
  FaceFinder& operator=(FaceFinder&&) noexcept;

  /// The faces in a picture (CV_8UC3, BGR, not empty), the largest box first. The result is valid
  /// until the next call.
  const std::vector<FoundFace>& find(const cv::Mat& bgr);
  /// The faces in one square region of a picture. The region may be rotated; only faces upright in
  /// it are found. FoundFace::box then has its sides parallel to those of the region.
  const std::vector<FoundFace>& find_in(const cv::Mat& bgr, const FaceRegion& square);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::tracking
