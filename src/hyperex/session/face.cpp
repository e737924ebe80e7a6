// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/face.hpp"

namespace hyperex::session {

Face read_face(const std::filesystem::path& scan, const std::filesystem::path& landmarks) {
  Face face;
  face.scan = io::read_scan(scan, std::nullopt);
  if (!landmarks.empty()) face.landmarks = io::read_landmarks(landmarks, std::nullopt);
  return face;
}

}  // namespace hyperex::session
