// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/simulate/contact/lip_surfaces.hpp"
#include "hyperex/simulate/drive/point_curve.hpp"
#include "hyperex/simulate/drive/skin_measured.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::simulate {

/// What is read off a moving face: the skin, its landmarks, the lips. Depends on the face alone
/// and serves any number of runs. Const members may be called from several threads.
class Readout {
 public:
  /// `mesh` must outlive this.
  Readout(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

  /// Displacement of the skin (|skin| x 3, m): of the tissue's nodes (|nodes| x 3) or, where
  /// measured, of the tracked points (P x 3).
  /// `rim`: as DrivenPoints has it.
  PointsF skin(const MeasuredRegion& region, const std::vector<tissue::RimVertex>& rim,
               const Points& nodes, const Points& points) const;
  /// The landmarks as the moved skin carries them, a sample a frame.
  motion::Motion landmark_tracks(const std::vector<double>& time_s,
                                 const std::vector<PointsF>& frames) const;

  /// Over the frames: the greatest depth of LipSurfaces, by which the lips pass through each other,
  /// and the greatest distance between upper and lower lip (ibug68_62, 66) over the first frame's.
  struct Lips {
    double overlap_mm = 0, gap_mm = 0;
  };
  /// `each` calls a function with every frame from 0 to a count, side by side or not.
  using EachFrame = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;
  Lips lips(const motion::Motion& tracks, const std::vector<PointsF>& frames,
            const EachFrame& each) const;

  const std::shared_ptr<const LipSurfaces>& lip_surfaces() const { return surfaces_; }

 private:
  const tissue::TissueMesh& mesh_;
  std::vector<std::string> names_;
  Points rest_;                // of the landmarks
  std::vector<Match> places_;  // of them on the skin
  std::shared_ptr<const LipSurfaces> surfaces_;
};

/// As floats. What a float could hold with fewer digits alone becomes 0: some libraries' threads
/// flush such numbers and others do not, and which thread works must not show.
PointsF in_single_precision(const Points& points);

/// The points of a motion that drive, and where they lie on the skin.
struct DrivenPoints {
  /// `wanted`: names; those that the motion does not have are left out.
  DrivenPoints(const tissue::TissueMesh& mesh, const AlignedMotion& motion,
               const std::vector<std::string>& wanted);

  std::vector<int> rows;  ///< in the motion
  std::vector<std::string> names;
  Points rest;                         ///< positions at rest (n x 3, m)
  std::vector<Match> places;           ///< on the skin
  std::vector<tissue::RimVertex> rim;  ///< the mesh's, through these places (rim_through)

  /// Of each, over the frames: the greatest distance (m) from where it is driven.
  std::vector<double> off_m(const Performance& performance, const PointCurve& wanted) const;
};

/// The frame nearest to `peak_time_s`; below 0: that in which the points of `rows` moved most in
/// the mean.
int peak_frame(const std::vector<double>& time_s, double peak_time_s, const std::vector<int>& rows,
               const PointCurve& points);

}  // namespace hyperex::simulate
