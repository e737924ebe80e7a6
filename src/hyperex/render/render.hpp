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

/// A surface to draw. It is coloured by `scalar` where given, else by `colours`, else by `plain`.
/// The mesh is held by reference, not copied.
struct Surface {
  const TriMesh& mesh;
  Eigen::VectorXf scalar =
      {};  ///< one per vertex, coloured by the map moss over `range`; NaN: plain there
  Range range = {};
  VertexColours colours = {};
  Colour plain = palette::skin;
  bool smooth = true;  ///< true: shaded by averaged vertex normals; false: by facet normals
};

/// A disc of fixed size at a point; drawn where no surface hides the point, and hollow where it
/// lies a little behind one.
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

/// A translucent sheet of triangles, each between the first point and two neighbours of the others.
/// Its hidden parts are left out; lines and markers lie over it.
struct Fan {
  Points points;  ///< at least three rows, else nothing is drawn
  Colour colour = palette::cut;
  double opacity = 0.3;  ///< 0 to 1
};

struct RenderOptions {
  int width_px = 480, height_px = 600;
  int samples = 2;  ///< rays per pixel along each axis, >= 1
  Colour background = palette::background;
  /// A marker, line or fan is drawn if it lies less than this behind a surface, along the view, m.
  double overlay_bias_m = 1e-3;
  /// A marker that lies deeper, but less than this behind a surface, is drawn hollow, m.
  double hollow_within_m = 5e-3;
  /// Paints the background where a surface is seen from behind (its triangles run clockwise).
  bool hide_backs = false;
};

/// Draws the surfaces with parallel rays under two lamps fixed to the camera, back faces darker,
/// then draws fans, lines and markers over them. The picture does not depend on the number of
/// threads. Throws std::invalid_argument where sizes do not agree (scalar or colours and vertices;
/// an index out of range; no pixels).
Image render(const std::vector<Surface>& surfaces, const Camera& camera,
             const RenderOptions& options = {}, const std::vector<Marker>& markers = {},
             const std::vector<Polyline>& lines = {}, const std::vector<Fan>& fans = {});

/// Where the ray through a position in the picture first meets a surface.
struct Picked {
  int surface = -1, triangle = -1;
  Vec3 weights = Vec3::Zero();  ///< barycentric
  Vec3 point = Vec3::Zero();    ///< m
  double facing = 0;  ///< cosine between the facet's normal and the view; < 0: from behind
};

/// Casts rays through positions in a picture of that camera. `places`: n x 2, x right, y down,
/// pixel centres at half integers. An entry is empty where the ray meets no surface.
std::vector<std::optional<Picked>> pick(const std::vector<Surface>& surfaces, const Camera& camera,
                                        int width_px, int height_px,
                                        const Eigen::MatrixX2d& places);

}  // namespace hyperex::render
