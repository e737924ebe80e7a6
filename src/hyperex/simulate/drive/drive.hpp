// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

struct DrivenPoint {
  std::string name;
  Vec3 rest;  ///< scan frame, m
};

/// The displacement of the face between driven points, by radial-basis interpolation (rbf.hpp) of
/// their displacements and of `still` places, which do not move. It meets every driven point and is
/// linear in their displacements. So that the lips can part, it is interpolated on a face whose
/// mouth is opened: skin above the mouth is shifted up and skin below it down, each by up to
/// `mouth_shift_m`. If points of the brows are driven, places 30 mm above them are added. They move
/// as the mean of those of ibug68_0, 16 and 27 that are driven, or not at all if none is. Otherwise
/// the motion of the brows would extend nearly unchanged to the end of the scan.
class DriveField {
 public:
  DriveField(std::vector<DrivenPoint> points, const std::vector<Vec3>& still,
             const tissue::TissueMesh& mesh, const Vec3& up, double mouth_shift_m);
  /// u(place j) = sum_i weight(j, i) d_i; `margin[j]`: of place j, as TissueMesh::upper_margin.
  Eigen::MatrixXd weights(const Points& places, const std::vector<double>& margin) const;
  const std::vector<DrivenPoint>& points() const { return points_; }
  /// The points on the face whose mouth is opened.
  Points opened_points() const { return centres_.topRows(Eigen::Index(points_.size())); }
  /// How far the mouth was opened, over the greatest shift that is used: 0 to 1.
  double openness() const;

  /// A place on the face whose mouth is opened.
  Vec3 opened(const Vec3& p, double margin) const;

 private:
  std::vector<DrivenPoint> points_;
  Points centres_;             // opened: the points, the forehead's places, the still places
  Eigen::Index forehead_ = 0;  // number of the forehead's places
  std::vector<int> forehead_follows_;  // points that they follow
  Vec3 shift_;                         // of skin above the mouth, when it is opened
};

/// How far the lips part in a motion, m: the greatest upward difference between the mean
/// displacements of the upper and of the lower lip's points, halved for each side's shift, and at
/// most 10 mm. 0 where one lip has no points. The motion is taken without gain.
double lip_parting(const AlignedMotion& motion, const std::vector<int>& driven_rows,
                   const Vec3& up);

/// Places that do not move between the driven points: brows, eyes, nose and temples (ibug68_0 to 3,
/// 13 to 16, 17 to 47), without those that are driven.
std::vector<Vec3> still_places(const std::vector<DrivenPoint>& points,
                               const io::Landmarks& landmarks);

/// Skin nodes that take prescribed displacements: a patch around each driven point. A patch reaches
/// `patch_radius_m` where the lips part widely and 1.5 times as far where they stay closed, since
/// the field is a better guess than the tissue in closed lips and a worse one in parting lips
/// (docs/fidelity.md). It never extends across the slit, and it always contains the nodes that
/// carry the point. Its displacement is the field's, corrected so that the driven points end where
/// they are driven: the mesh is linear between its nodes, and so it does not meet them by itself.
/// Points that almost the same nodes carry are met in the mean alone, as two of a lid's edge may
/// be.
struct DrivenPatches {
  std::vector<int> nodes;   ///< outer nodes, rising
  Eigen::MatrixXd weights;  ///< |nodes| x |points|
  Eigen::VectorXd hold;     ///< |nodes|: how firmly (holding_forces.hpp); below 1 in fading patches
  CarrierMatrix carriers;   ///< |points| x |outer nodes|: how the driven points follow the nodes
};

/// Throws InputError ("source: ...") where a point lies farther than 25 mm from the skin.
void check_on_skin(const std::vector<DrivenPoint>& points, const TriMesh& skin,
                   const std::string& source);

/// `fading`: empty, or one flag per point. Around a flagged point the hold falls smoothly from 1
/// to 0 over 20 mm more of the lower face, without the border, except in the patch of another point
/// and at a radius of 0. Throws as check_on_skin().
DrivenPatches driven_patches(const DriveField& field, const tissue::TissueMesh& mesh,
                             double patch_radius_m, const std::string& source,
                             const std::vector<char>& fading = {});

/// One flag per point: whether it lies within 12 mm of one of ibug68_6 to 10.
std::vector<char> on_chin(const std::vector<DrivenPoint>& points, const io::Landmarks& landmarks);

}  // namespace hyperex::simulate
