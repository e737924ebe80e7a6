// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/render/colour.hpp"
#include "hyperex/render/image.hpp"

namespace hyperex::render {

/// |V| x 3, 0 to 255.
using VertexColours = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// What is drawn of a surface. It is coloured by `scalar` where given, else by `colours`, else
/// plain. The mesh is referred to, not copied.
struct Surface {
  const TriMesh& mesh;
  Eigen::VectorXf scalar =
      {};  ///< one per vertex, through the map moss over `range`; NaN: plain there
  Range range = {};
  VertexColours colours = {};
  Colour plain = palette::skin;
  bool smooth = true;  ///< shaded by averaged vertex normals; false: facet by facet
};

/// A disc of fixed size at a point; drawn where no surface hides the point.
struct Marker {
  Vec3 at = Vec3::Zero();
  Colour colour = palette::driven;
  double radius_px = 4;
};

/// A line through points; its hidden stretches are left out.
struct Polyline {
  Points points;
  Colour colour = palette::cut;
  double width_px = 2;
  bool closed = false;
};

struct RenderOptions {
  int width_px = 480, height_px = 600;
  int samples = 2;  ///< rays a pixel and axis, >= 1
  Colour background = palette::background;
  /// How far below a surface (along the view) a marker or line still shows, m.
  double overlay_bias_m = 1e-3;
  /// Where a surface is seen from behind (its triangles run clockwise) the background is painted.
  bool hide_backs = false;
};

/// Draws the surfaces as parallel rays meet them (back faces darkened) under two
/// lamps fixed to the camera, then draws markers and lines over them. The same picture for any
/// number of threads. Throws std::invalid_argument where sizes do not agree (scalar or colours and
/// vertices; an index out of range; no pixels).
Image render(const std::vector<Surface>& surfaces, const Camera& camera,
             const RenderOptions& options = {}, const std::vector<Marker>& markers = {},
             const std::vector<Polyline>& lines = {});

/// Where the ray through a place of the picture first meets a surface.
struct Picked {
  int surface = -1, triangle = -1;
  Vec3 weights = Vec3::Zero();  ///< barycentric
  Vec3 point = Vec3::Zero();    ///< m
  double facing = 0;  ///< cosine between the facet's normal and the view; < 0: from behind
};

/// Rays through places of a picture of that camera: `places` n x 2, x right, y down, pixel centres
/// at half integers. Nothing where a ray meets no surface.
std::vector<std::optional<Picked>> pick(const std::vector<Surface>& surfaces, const Camera& camera,
                                        int width_px, int height_px,
                                        const Eigen::MatrixX2d& places);

}  // namespace hyperex::render
