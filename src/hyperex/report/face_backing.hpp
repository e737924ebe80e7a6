// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "hyperex/anatomy/eyeballs.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

// What pictures put behind the holes of a scanned skin, so that it looks like a face and not like a
// mask: dark pockets behind mouth, eyes and nostrils, and plain eyeballs. For the eye alone, and of
// no figure; lids may touch the same eyeballs (simulate/contact/obstacles.hpp).

/// A ring of a pocket as shares: of the pocket's depth, and of the width of the hole's edge.
struct PocketRing {
  double depth, width;
};

/// A hole of the skin. Its pocket hangs on its edge and goes along with the skin.
struct Opening {
  std::vector<int> loop;  ///< vertices of the skin around it, in the direction of its triangles
  Vec3 inward;            ///< unit length, into the head
  double depth_m = 0;
  /// Behind the edge. That of the mouth widens behind the lips, to hold the teeth.
  std::array<PocketRing, 2> rings = {{{0.35, 1.05}, {0.9, 0.8}}};
};

using anatomy::Eyeball;

struct FaceBacking {
  std::vector<Opening> openings;
  std::vector<Eyeball> eyeballs;  ///< right and left; none where landmarks are missing
  Vec3 forward = Vec3::Zero();    ///< out of the face, unit length; 0 where landmarks are missing
};

/// `skin`: at rest, metres. `landmarks`: positions on it, the iBUG points or their anatomical
/// names; without the outer corners of the eyes and those of the mouth nothing is put behind the
/// skin, without the inner corners no eyeballs. Openings are all closed borders of at most 250 mm
/// whose middle lies between the outer corners of the eyes, but the longest, the skin's own end.
/// Eyeballs: anatomy::eyeballs_behind().
FaceBacking face_backing(const TriMesh& skin, const io::Landmarks& landmarks);
/// The backing of the skin at rest, by the landmarks of the first sample.
FaceBacking face_backing(const simulate::Performance& performance);

/// How much of the light that falls on the lips reaches vertices of teeth and gum behind them, 0 to
/// 1: all of it in front, 0.35 from 35 mm behind there on. `row`: the jaw's, for what is in front.
Eigen::VectorXd light_in_mouth(const TriMesh& part, const TriMesh& row, const Vec3& forward);

/// The pocket of an opening for vertices at `points`: the edge, two rings behind it and a point. A
/// linear function of `points` but for a constant.
TriMesh pocket(const Opening& opening, const Points& points);

/// sRGB of the edge and of each ring behind it; the point has the last. The same as the page's
/// (web/src/replay/face/backing.ts).
inline constexpr std::array<std::array<std::uint8_t, 3>, 3> kPocketColours = {
    {{0x5e, 0x30, 0x29}, {0x32, 0x13, 0x0f}, {0x18, 0x08, 0x06}}};

/// An eyeball as three meshes in the order sclera, iris, pupil: each of one colour.
std::vector<TriMesh> eyeball_parts(const Eyeball& eyeball);

}  // namespace hyperex::report
