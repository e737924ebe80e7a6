// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/alignment.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/drive/common_points.hpp"

namespace hyperex::simulate {
namespace {

/// Width, upper and lower height about the nose apex: the face-part dimensions of [5.1-5.4].
struct FaceParts {
  face::FaceFrame frame;  // origin at the nose apex
  double width, upper, lower;
};

FaceParts face_parts(const io::Landmarks& landmarks) {
  FaceParts parts{face::face_frame(landmarks), 0, 0, 0};
  parts.frame.origin = landmarks.at(face::ibug(30));
  const auto at = [&](int k) { return parts.frame.local(landmarks.at(face::ibug(k))); };
  parts.width = (at(45) - at(36)).x();
  parts.upper = at(27).y();
  parts.lower = -at(8).y();
  return parts;
}

/// [5.1-5.4] from the motion's face to the scan's: x and z by width, y by the height of its half.
void align_by_parts(const motion::Motion& in, const io::Landmarks& landmarks, AlignedMotion& out) {
  io::Landmarks own;
  for (std::size_t i = 0; i < in.names.size(); ++i)
    own[in.names[i]] = in.positions.front().row(i).transpose();
  for (int k : {8, 27, 30, 36, 45, 48, 54})
    if (!own.count(face::ibug(k)))
      throw InputError(in.source, fmt::format("has no point {}, which alignment.method = "
                                              "\"normalised\" needs",
                                              face::ibug(k)));
  const FaceParts a = face_parts(own), s = face_parts(landmarks);
  const double across = s.width / a.width, up = s.upper / a.upper, down = s.lower / a.lower;
  for (Eigen::Index i = 0; i < out.rest.rows(); ++i) {
    const Vec3 q = a.frame.local(in.positions.front().row(i));
    const double height = q.y() >= 0 ? up : down;
    out.rest.row(i) = s.frame.world({q.x() * across, q.y() * height, q.z() * across}).transpose();
    for (std::size_t k = 0; k < in.positions.size(); ++k) {
      const Vec3 d = a.frame.local(in.positions[k].row(i)) - q;
      const Vec3 scaled(d.x() * across, d.y() * height, d.z() * across);
      out.motion.positions[k].row(i) =
          out.rest.row(i) + (s.frame.world(scaled) - s.frame.origin).transpose();
    }
  }
}

}  // namespace

AlignedMotion align(const motion::Motion& stabilised, const io::Landmarks& landmarks,
                    AlignmentMethod method) {
  const CommonPoints pairs = common_points(stabilised, landmarks);
  if (pairs.names.size() < 3 || spread_off_line(pairs.scan) < 0.05)
    throw too_few_common(stabilised, pairs.names);
  AlignedMotion out;
  out.motion = stabilised;
  out.common = pairs.names;
  out.scan_from_motion = fit_similarity(pairs.motion, pairs.scan);
  const Points laid = out.scan_from_motion.apply(pairs.motion);
  out.rms_mm = 1e3 * rms_distance(laid, pairs.scan);
  out.rest = out.scan_from_motion.apply(stabilised.positions.front());
  if (method == AlignmentMethod::normalised) {
    align_by_parts(stabilised, landmarks, out);
    return out;
  }
  if (method == AlignmentMethod::nonrigid)
    out.rest += Rbf(laid, pairs.scan - laid).at_all(out.rest);
  const Eigen::Matrix3d turn = out.scan_from_motion.scale * out.scan_from_motion.rotation;
  for (std::size_t k = 0; k < stabilised.positions.size(); ++k)
    out.motion.positions[k] =
        out.rest + (stabilised.positions[k] - stabilised.positions.front()) * turn.transpose();
  return out;
}

}  // namespace hyperex::simulate
