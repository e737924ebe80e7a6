// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/face_frame.hpp"

namespace hyperex::tissue {

std::string ibug(int k) {
  return "ibug68_" + std::to_string(k);
}

const std::vector<std::string>& all_ibug() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (int k = 0; k < 68; ++k) list.push_back(ibug(k));
    return list;
  }();
  return names;
}

FaceFrame face_frame(const io::Landmarks& landmarks) {
  FaceFrame frame;
  frame.origin = 0.5 * (landmarks.at(ibug(48)) + landmarks.at(ibug(54)));
  frame.x = (landmarks.at(ibug(45)) - landmarks.at(ibug(36))).normalized();
  const Vec3 up = landmarks.at(ibug(27)) - landmarks.at(ibug(8));
  frame.z = frame.x.cross(up).normalized();
  frame.y = frame.z.cross(frame.x);
  return frame;
}

}  // namespace hyperex::tissue
