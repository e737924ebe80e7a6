// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "hyperex/tracking/network/face_finder.hpp"
#include "hyperex/tracking/network/face_points.hpp"
#include "hyperex/tracking/network/face_region.hpp"

namespace hyperex::tracking {

/// The region for the landmark network around these points: 1.5 x the longer side of their bounding
/// box, rotated such that the eyes are horizontal in it.
FaceRegion region_of(const FacePoints& points_px);

struct FaceLandmarks {
  FacePoints points_px;
  double score = 0;       ///< confidence that the points show a face, 0 to 1
  int faces_in_view = 1;  ///< at the last search of the whole picture
  /// true: found by the detector in this picture; false: tracked from the previous one.
  bool found_anew = false;
  FaceRegion region;  ///< the square of the picture that was the network's input
};

struct LandmarkOptions {
  FaceFinderOptions finder = {};
  /// The second stage for the lips takes 0.6 ms and reduces the error of their motion by a third.
  /// The one for eyes and brows increased their error by a third (95th percentile) on the face it
  /// was measured on.
  bool lips_again = true, eyes_again = false;
  /// Also evaluates the mirror image of the square and takes the mean, in which left-right errors
  /// of the network cancel. Takes twice the time and reduces the error of the motion of lips and
  /// chin by 7 % (mean of seven recordings).
  bool mirrored_too = false;
  double least_score = 0.5;  ///< below this score (0 to 1) the face counts as lost
  /// For a newly found face, the square is recomputed from the points until it converges, at most
  /// this number of times.
  int settling_rounds = 8;
  /// Number of pictures between two searches of the whole picture while a face is tracked (these
  /// keep faces_in_view up to date); 0: none.
  int look_around_every = 30;
};

/// Finds a face and tracks it from picture to picture, with the 468 points of MediaPipe Face Mesh
/// (Y. Kartynnik et al., "Real-time Facial Surface Geometry from Monocular Video on Mobile GPUs",
/// CVPR Workshop 2019; lips as in FaceMeshNetwork). The points in one picture define the region for
/// the next. A lost face is searched for in the whole picture. Of several faces, the largest is
/// chosen and then tracked until it is lost. The pictures may differ in size. The same pictures
/// always give the same points.
class LandmarkTracker {
 public:
  explicit LandmarkTracker(const LandmarkOptions& options = {});
  ~LandmarkTracker();
  LandmarkTracker(LandmarkTracker&&) noexcept;
  LandmarkTracker& operator=(LandmarkTracker&&) noexcept;

  /// The face in a picture (CV_8UC3, BGR, not empty; std::invalid_argument otherwise), or nothing
  /// where there is none.
  std::optional<FaceLandmarks> track(const cv::Mat& bgr);
  /// The points in a given region, independent of the tracked face and of the score. The state of
  /// the tracker is not changed.
  FaceLandmarks look_at(const cv::Mat& bgr, const FaceRegion& region);
  /// The same, but the region is recomputed from the points until it converges (settling_rounds).
  /// Stops if the score falls below least_score.
  FaceLandmarks settle(const cv::Mat& bgr, const FaceRegion& first);
  /// Ends the tracking of the current face.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::tracking
