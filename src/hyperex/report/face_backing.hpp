// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "hyperex/anatomy/eyeballs.hpp"
#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

// Surfaces behind the holes of a scanned skin, without which it would look like a mask: the lining
// of the mouth, dark pockets behind eyes and nostrils, and eyeballs (eye_model.hpp). Only for
// display; no figure depends on them. (Contact of the lids uses the same eyeballs:
// simulate/contact/obstacles.hpp.)

using Srgb = std::array<std::uint8_t, 3>;

/// How a ring of a pocket moves: the shares that it takes of the motion of the corresponding vertex
/// of the edge, of the middle of the edge, and of the jaw.
struct PocketRing {
  double edge, centre, jaw;
};

/// A hole of the skin. Its pocket is attached to its edge and moves with the skin; that of the
/// mouth also moves with the jaw.
struct Opening {
  std::vector<int> loop;  ///< vertices of the skin around it, in the direction of its triangles
  Vec3 inward;            ///< unit length, into the head
  double depth_m = 0;
  bool mouth = false;
  bool eye = false;
  /// At rest: the edge, the rings behind it, each of the loop's length, and a point.
  Points rest = {};
  std::vector<PocketRing> rings = {};  ///< behind the edge, and the point's last
  /// Per vertex of the loop: the share of the jaw's motion that its rings take, 0 (upper lip) to 1.
  /// The point takes one half.
  Eigen::VectorXd jaw = {};
  std::vector<Srgb> colours = {};  ///< per row of `rest`
};

using anatomy::Eyeball;

struct FaceBacking {
  std::vector<Opening> openings;
  std::vector<Eyeball> eyeballs;  ///< right and left; none where landmarks are missing
  Vec3 forward = Vec3::Zero();    ///< out of the face, unit length; 0 where landmarks are missing
};

/// `skin`: at rest, metres. `landmarks`: positions on it, under iBUG or anatomical names. Nothing
/// is put behind the skin if the outer corners of the eyes or the corners of the mouth are missing.
/// Eyeballs (anatomy::eyeballs_behind()) also need the inner corners of the eyes. The openings are
/// all closed borders of at most 250 mm whose middle lies between the outer corners of the eyes,
/// except the longest border, which is the outer one. Beside the eyes they are those that face
/// forward and lie more than 10 mm from the outer border. `teeth`: the lining of the mouth leaves
/// room for them; null: for average rows (mouth_lining.hpp).
FaceBacking face_backing(const TriMesh& skin, const io::Landmarks& landmarks,
                         const anatomy::Teeth* teeth = nullptr);
/// The landmarks of the first sample; none where there is no sample.
io::Landmarks landmarks_at_rest(const simulate::Performance& performance);
/// The backing of the skin at rest, by landmarks_at_rest().
FaceBacking face_backing(const simulate::Performance& performance,
                         const anatomy::Teeth* teeth = nullptr);

/// Whether the skin has an opening at the right and at the left eye, through which the eyeball
/// shows. False where landmarks are missing.
std::array<bool, 2> open_eyes(const FaceBacking& backing, const Points& skin,
                              const io::Landmarks& landmarks);

/// The share (0 to 1) of the light falling on the lips that reaches vertices of teeth and gum: 1 at
/// the front of the row, decreasing to 0.35 at 35 mm behind it. `row`: that of the jaw, which
/// defines the front.
Eigen::VectorXd light_in_mouth(const TriMesh& part, const TriMesh& row, const Vec3& forward);

/// How much of the light that falls on the lips passes between them, 0.15 (closed) to 1: 0.15 +
/// 0.85 (1 - exp(-h / 1.5 mm)), where h is twice the opening's area over the length of its edge,
/// the mean opening of a slit. `points`: the skin's vertices, metres.
double light_between_lips(const std::vector<int>& loop, const Points& points);

/// The pocket of an opening for the skin's vertices at `points` and for the jaw's motion since
/// rest: the edge, the rings behind it and a point. An affine function of both.
TriMesh pocket(const Opening& opening, const Points& points,
               const Eigen::Affine3d& jaw = Eigen::Affine3d::Identity());

/// sRGB of a nostril's edge and of each ring behind it; the point has the colour of the last ring.
inline constexpr std::array<Srgb, 3> kPocketColours = {
    {{0x5e, 0x30, 0x29}, {0x32, 0x13, 0x0f}, {0x18, 0x08, 0x06}}};
/// The same for an eye: the wet inner side of the lids, which fills the corners beside the eyeball.
inline constexpr std::array<Srgb, 3> kLidColours = {
    {{0xa8, 0x6e, 0x64}, {0x94, 0x58, 0x50}, {0x52, 0x26, 0x22}}};

}  // namespace hyperex::report
