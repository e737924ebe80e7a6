// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "experiments/study.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::bench {

/// Pictures of one face, all at the same scale. They show the surroundings of its landmarks.
class FacePictures {
 public:
  explicit FacePictures(const Study& study);

  /// Surfaces in the scan's frame, with scalars and colours as for render::render().
  struct Layer {
    TriMesh mesh;
    Eigen::VectorXf scalar = {};
    render::Range range = {};
    render::Colour plain = render::palette::skin;
  };
  render::Image draw(const std::vector<Layer>& layers, const Vec3& view, int width_px = 300,
                     int height_px = 380, const std::vector<render::Marker>& markers = {}) const;
  /// The mouth and the nose alone, from the front.
  render::Image draw_mouth(const std::vector<Layer>& layers, int width_px, int height_px,
                           const std::vector<render::Marker>& markers) const;
  /// A disc at a place of the scan's frame.
  render::Marker marker(const Vec3& at, const render::Colour& colour) const;

 private:
  render::Image draw(const std::vector<Layer>& layers, const render::Camera& camera, int width_px,
                     int height_px, const std::vector<render::Marker>& markers) const;

  const face::FaceFrame& frame_;
  Points framed_;
  double widened_;
};

/// The skin of a performance moved by `displacement`.
TriMesh moved_skin(const simulate::Performance& p, const PointsF& displacement);

/// Writes a JPEG: pictures of faces are several times as large as PNG.
void write_jpeg(const std::filesystem::path& file, const render::Image& image);

}  // namespace hyperex::bench
