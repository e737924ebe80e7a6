// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/embedded_scan.hpp"

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/carried_file.hpp"

namespace hyperex::session {

// Painted while the program is built (paint_textures.cpp).
HX_CARRIED_FILE(light_skin_jpeg, HYPEREX_LIGHT_SKIN)
HX_CARRIED_FILE(medium_skin_jpeg, HYPEREX_MEDIUM_SKIN)
HX_CARRIED_FILE(dark_skin_jpeg, HYPEREX_DARK_SKIN)

namespace {

std::string_view texture_of(face::SkinTone tone) {
  switch (tone) {
    case face::SkinTone::medium:
      return medium_skin_jpeg();
    case face::SkinTone::dark:
      return dark_skin_jpeg();
    case face::SkinTone::light:
      break;
  }
  return light_skin_jpeg();
}

}  // namespace

io::Scan embedded_scan(face::SkinTone tone) {
  anatomy::EmbeddedFace face = anatomy::embedded_face();
  const std::string_view texture = texture_of(tone);
  io::Scan scan;
  scan.file = "embedded face";
  scan.corner_uv.resize(3 * face.mesh.triangles.rows(), 2);
  for (Eigen::Index f = 0; f < face.mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      scan.corner_uv.row(3 * f + k) = face.uv.row(face.mesh.triangles(f, k));
  scan.texture = {{texture.begin(), texture.end()}, "image/jpeg"};
  scan.mesh = std::move(face.mesh);
  return scan;
}

}  // namespace hyperex::session
