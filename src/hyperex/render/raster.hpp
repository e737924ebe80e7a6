// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inside the room: which triangle each sample of a picture sees, by a depth buffer. Parallel rays
// on a grid need no tree: a face of 70,000 triangles takes milliseconds, while Embree builds its
// tree for a tenth of a second, anew for each pose.
#include <array>
#include <cstdint>
#include <vector>

#include "hyperex/render/camera.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::render {

/// Samples in rows from the top, each at the middle of its square; the camera's target is at the
/// middle of the picture. Triangles that share an edge leave no gap between them. Where two lie
/// equally near the first of them is seen, so that the hits do not depend on the number of threads.
class Raster {
 public:
  static constexpr int most_samples = 1 << 16;  ///< in a row or a column
  /// `band_rows`: rows of samples that look() answers at a time. The surfaces are read, not kept.
  Raster(const std::vector<Surface>& surfaces, const Camera& camera, int width, int height,
         double m_per_sample, int band_rows);

  int bands() const { return int(first_.size()) - 1; }

  /// The first two barycentric weights of a sample, and how they grow from it to the right.
  struct Weights {
    double a, b, a_right, b_right;
    std::array<float, 3> at(int samples) const {
      const double wa = a + samples * a_right, wb = b + samples * b_right;
      return {float(wa), float(wb), float(1 - wa - wb)};
    }
  };
  /// What is linear over the samples: its value at the first, and how it grows to the right and
  /// down.
  struct Plane {
    double first, right, down;
  };
  /// A triangle of a band.
  struct Drawn {
    int surface, triangle, id;
    int x, y;         // the sample at which the planes begin
    double area;      // twice, in samples; negative where the front is seen
    Plane inside[2];  // twice the areas opposite to the first two corners; exact on the grid
    bool faces_viewer() const { return area < 0; }
    Weights weights(int at_x, int at_y) const;
  };
  /// Rows of samples; room that look() fills.
  struct Seen {
    int first_row = 0, rows = 0;
    int stride = 0;            // from a row to the next, some room after the width and the last row
    std::vector<Drawn> drawn;  // the triangles of the band
    std::vector<int> triangle;   // which of them each sample sees, or -1
    std::vector<float> nearest;  // its depth, m to the viewer
  };
  /// What the samples of a band see. Safe to call from several threads.
  void look(int band, Seen& seen) const;
  Eigen::Vector3f normal(int id) const;  // of the facet, unit, camera frame

 private:
  struct Corner {
    double x, y, z;  // samples right and down of the first, and metres to the viewer
  };
  /// Samples of the picture that may lie in a triangle.
  struct Box {
    std::uint16_t left, right, top, bottom;
  };
  struct Triangle {
    std::array<int, 3> corner;  // of corners_
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

  /// Appends those of the surface's triangles that may be seen.
  void add(const Surface& surface, int index, const Camera& camera, double m_per_sample,
           std::vector<Triangle>& seen);
  /// Sets the box; whether the triangle may be seen.
  bool may_be_seen(Triangle& t) const;
  void sort_into_bands(const std::vector<Triangle>& seen);
  void draw(int id, Seen& seen) const;

  int width_, height_, band_rows_;
  double m_per_sample_;
  std::vector<Corner> corners_;  // of all surfaces
  /// Those of band i: from first_[i] to first_[i + 1]; copied where several bands have them, so
  /// that a band reads them in their order.
  std::vector<Triangle> triangles_;
  std::vector<int> first_;
};

}  // namespace hyperex::render
