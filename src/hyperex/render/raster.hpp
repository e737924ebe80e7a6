// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the module: a depth buffer that finds which triangle each sample of a picture shows.
// Parallel rays on a grid need no search tree: a face of 70,000 triangles takes milliseconds, while
// Embree needs a tenth of a second to build its tree for each pose.
#include <array>
#include <cstdint>
#include <vector>

#include "hyperex/render/camera.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::render {

/// Samples in rows from the top, each at the middle of its square. The camera's target is at the
/// middle of the picture. Triangles that share an edge leave no gap between them. Where two
/// triangles are equally near the first is visible, so that the result does not depend on the
/// number of threads.
class Raster {
 public:
  static constexpr int most_samples = 1 << 16;  ///< per row or column
  /// `band_rows`: rows of samples in each band, that is, in each call of look(). The surfaces are
  /// not kept.
  Raster(const std::vector<Surface>& surfaces, const Camera& camera, int width, int height,
         double m_per_sample, int band_rows);

  int bands() const { return int(first_.size()) - 1; }

  /// The first two barycentric weights at a sample, and their increase per sample to the right.
  struct Weights {
    double a, b, a_right, b_right;
    std::array<float, 3> at(int samples) const {
      const double wa = a + samples * a_right, wb = b + samples * b_right;
      return {float(wa), float(wb), float(1 - wa - wb)};
    }
  };
  /// A linear function over the samples: its value at the first one, and its increase per sample to
  /// the right and down.
  struct Plane {
    double first, right, down;
  };
  /// A triangle of a band.
  struct Drawn {
    int surface, triangle, id;
    int x, y;         // the sample at which the planes begin
    double area;      // twice the area, in samples; negative where the front is seen
    Plane inside[2];  // twice the areas opposite the first two corners; exact on the grid
    bool faces_viewer() const { return area < 0; }
    Weights weights(int at_x, int at_y) const;
  };
  /// The visible triangles of a band, as filled in by look().
  struct Seen {
    int first_row = 0, rows = 0;
    int stride = 0;             // from one row to the next; there is room beyond width and last row
    std::vector<Drawn> drawn;   // the triangles of the band
    std::vector<int> triangle;  // index into `drawn` of the triangle that each sample sees, or -1
    std::vector<float> nearest;  // its depth, m towards the viewer
  };
  /// Finds what the samples of a band see. Safe to call from several threads.
  void look(int band, Seen& seen) const;
  Eigen::Vector3f normal(int id) const;  // of the facet, unit length, in the camera's frame

 private:
  struct Corner {
    double x, y, z;  // x, y: samples right of and below the first one; z: metres towards the viewer
  };
  /// The range of samples that may lie in a triangle.
  struct Box {
    std::uint16_t left, right, top, bottom;
  };
  struct Triangle {
    std::array<int, 3> corner;  // indices into corners_
    int surface, triangle;
    Box box;
  };
  const Corner& corner(const Triangle& t, int k) const {
    return corners_[std::size_t(t.corner[std::size_t(k)])];
  }
  /// Twice the area, in samples; negative where the front is seen.
  double area(const Triangle& t) const {
    const Corner &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }

  /// Appends those triangles of the surface that may be visible.
  void add(const Surface& surface, int index, const Camera& camera, double m_per_sample,
           std::vector<Triangle>& seen);
  /// Sets the box. Returns whether the triangle may be visible.
  bool may_be_seen(Triangle& t) const;
  void sort_into_bands(const std::vector<Triangle>& seen);
  void draw(int id, Seen& seen) const;

  int width_, height_, band_rows_;
  double m_per_sample_;
  std::vector<Corner> corners_;  // of all surfaces
  /// The triangles of band i: from first_[i] to first_[i + 1]. A triangle in several bands is
  /// copied, so that a band reads its triangles from contiguous memory.
  std::vector<Triangle> triangles_;
  std::vector<int> first_;
};

}  // namespace hyperex::render
