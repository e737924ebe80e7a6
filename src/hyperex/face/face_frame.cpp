// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/face_frame.hpp"

#include "hyperex/face/ibug.hpp"
#include "hyperex/face/same_place.hpp"

namespace hyperex::face {

FaceFrame face_frame(const io::Landmarks& landmarks) {
  FaceFrame frame;
  frame.origin = 0.5 * (landmarks.at(ibug(48)) + landmarks.at(ibug(54)));
  frame.x = (landmarks.at(ibug(45)) - landmarks.at(ibug(36))).normalized();
  const Vec3 up = landmarks.at(ibug(27)) - landmarks.at(ibug(8));
  frame.z = frame.x.cross(up).normalized();
  frame.y = frame.z.cross(frame.x);
  return frame;
}

std::optional<FaceFrame> face_frame_of_corners(const io::Landmarks& landmarks) {
  const auto eye_left = find_place(landmarks, "exocanthion_L");
  const auto eye_right = find_place(landmarks, "exocanthion_R");
  const auto mouth_left = find_place(landmarks, "cheilion_L");
  const auto mouth_right = find_place(landmarks, "cheilion_R");
  if (!eye_left || !eye_right || !mouth_left || !mouth_right) return std::nullopt;
  FaceFrame frame;
  frame.origin = 0.5 * (*mouth_right + *mouth_left);
  frame.x = (*eye_left - *eye_right).normalized();
  const Vec3 up = *eye_left + *eye_right - *mouth_left - *mouth_right;
  frame.y = (up - up.dot(frame.x) * frame.x).normalized();
  frame.z = frame.x.cross(frame.y);
  if (!(frame.face_from_scan().determinant() > 0.5)) return std::nullopt;
  return frame;
}

}  // namespace hyperex::face
