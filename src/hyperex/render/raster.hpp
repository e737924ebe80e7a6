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

  /// Rows of samples; room that look() fills.
  struct Seen {
    int first_row = 0, rows = 0;
    int stride = 0;              // from a row to the next, some room after the picture's width
    std::vector<int> triangle;   // the id that all below take, or -1
    std::vector<float> nearest;  // its depth, m to the viewer
  };
  /// What the samples of a band see. Safe to call from several threads.
  void look(int band, Seen& seen) const;
  int surface(int id) const { return triangles_[std::size_t(id)].surface; }
  int triangle(int id) const { return triangles_[std::size_t(id)].triangle; }
  bool faces_viewer(int id) const { return area(triangles_[std::size_t(id)]) < 0; }
  Eigen::Vector3f normal(int id) const;  // of the facet, unit, camera frame
  /// The first two barycentric weights of a sample, and how they grow from it to the right.
  struct Weights {
    double a, b, a_right, b_right;
    std::array<float, 3> at(int samples) const {
      const double wa = a + samples * a_right, wb = b + samples * b_right;
      return {float(wa), float(wb), float(1 - wa - wb)};
    }
  };
  Weights weights(int id, int x, int y) const;

 private:
  struct Corner {
    double x, y, z;  // samples right and down of the first, and metres to the viewer
  };
  /// Samples of the picture that may lie in a triangle.
  struct Box {
    std::uint16_t left, right, top, bottom;
  };
  /// Small, since all of them together are read in no order that a cache could foresee.
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

  void add(const Surface& surface, int index, const Camera& camera, double m_per_sample);
  /// Sets the box; whether the triangle may be seen.
  bool may_be_seen(Triangle& t) const;
  void sort_into_bands();
  void draw(int id, Seen& seen) const;

  int width_, height_, band_rows_;
  double m_per_sample_;
  std::vector<Corner> corners_;       // of all surfaces
  std::vector<Triangle> triangles_;   // those that may be seen
  std::vector<int> first_, of_band_;  // triangles of band i: of_band_[first_[i]] to first_[i + 1]
};

}  // namespace hyperex::render
