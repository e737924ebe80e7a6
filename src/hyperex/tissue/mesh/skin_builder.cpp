// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/skin_builder.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/closest_point.hpp"

namespace hyperex::tissue {
namespace {

double length_of(const Points& line) {
  double length = 0;
  for (Eigen::Index i = 0; i + 1 < line.rows(); ++i)
    length += (line.row(i + 1) - line.row(i)).norm();
  return length;
}

}  // namespace

SkinBuilder::SkinBuilder(const TriMesh& scan, const io::Landmarks& landmarks,
                         const std::string& source, TissueMesh& out)
    : scan_(scan), landmarks_(landmarks), source_(source), out_(out) {
  try {
    clean_ = clean_mesh(scan);
  } catch (const std::invalid_argument& e) {
    throw InputError(source, e.what());
  }
  for (const auto& note : clean_.notes)
    out_.notes.push_back(make_note("scan.mended", "scan: " + note));
  first_ = first_at_same_place(scan.points);
  out_.skin = scan;
  // Files with several normals or textures at a vertex repeat it. The skin would fall into pieces,
  // each with a border of its own.
  out_.skin.triangles =
      scan.triangles.unaryExpr([&](int vertex) { return first_[std::size_t(vertex)]; });
  out_.scan_vertices = scan.points.rows();
  out_.source_triangle.resize(scan.triangles.rows());
  std::iota(out_.source_triangle.begin(), out_.source_triangle.end(), 0);
  uncut_triangles_ = clean_.mesh.triangles.rows();
}

void SkinBuilder::cut(LipCut mode) {
  if (mode == LipCut::never) return;
  const bool open = anatomy::mouth_is_open(clean_.mesh, landmarks_);
  if (open) {
    if (mode == LipCut::always)
      out_.notes.push_back(make_note("lips.open_already", "the mouth is open already: not cut"));
    return;
  }
  const Vec3 forward = face::face_frame(landmarks_).z;
  const auto attempt = [&](const Points& line, const char* course) {
    const CutSurface surface = cut_along_line(clean_.mesh, line, forward);
    apply(surface);
    out_.notes.push_back(make_note(
        "lips.cut",
        fmt::format(
            "the lips are joined in the scan and were cut from corner to corner {}, {:.0f} mm long",
            course, 1e3 * length_of(out_.lip_cut))));
  };
  if (const auto crease = anatomy::lip_line_of_crease(clean_.mesh, landmarks_)) {
    try {
      return attempt(*crease, "along the crease between them");
    } catch (const std::invalid_argument&) {  // the landmarks' line may still go round what it met
    }
  }
  try {
    attempt(anatomy::lip_line_of_landmarks(landmarks_),
            "along a curve through the landmarks of the inner lips (no clear crease was found)");
  } catch (const std::invalid_argument& e) {
    throw InputError(source_, fmt::format("the closed lips could not be cut ({}); expected a "
                                          "surface without holes between the mouth corners",
                                          e.what()));
  }
}

std::vector<double> SkinBuilder::on_skin(const std::vector<double>& values) const {
  std::vector<double> out(out_.skin.points.rows(), 0.0);
  std::map<std::array<double, 3>, double> at_place;  // the scan may hold a vertex several times
  const auto place = [&](Eigen::Index v) {
    const auto p = out_.skin.points.row(v);
    return std::array{p[0], p[1], p[2]};
  };
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (v < clean_.source_vertex.size())
      at_place[place(clean_.source_vertex[v])] = values[v];
    else
      out[out_.scan_vertices + static_cast<Eigen::Index>(v - clean_.source_vertex.size())] =
          values[v];
  }
  for (Eigen::Index v = 0; v < out_.scan_vertices; ++v)
    if (const auto it = at_place.find(place(v)); it != at_place.end()) out[v] = it->second;
  return out;
}

/// Brings the cut of the working copy into the scan as given.
void SkinBuilder::apply(const CutSurface& cut) {
  const Eigen::Index old = clean_.mesh.points.rows();
  const auto added = static_cast<Eigen::Index>(cut.appended.size());
  out_.skin.points.conservativeResize(out_.scan_vertices + added, 3);
  for (Eigen::Index i = 0; i < added; ++i) {
    const EdgePoint& e = cut.appended[i];
    out_.appended.push_back({clean_.source_vertex[e.a], clean_.source_vertex[e.b], e.t});
    out_.skin.points.row(out_.scan_vertices + i) = cut.mesh.points.row(old + i);
  }
  const Eigen::Index clean_triangles = clean_.mesh.triangles.rows();
  out_.skin.triangles.conservativeResize(
      scan_.triangles.rows() + cut.mesh.triangles.rows() - clean_triangles, 3);
  for (Eigen::Index f = 0; f < cut.mesh.triangles.rows(); ++f) {
    const int parent = cut.source_triangle[f], scan_parent = clean_.source_triangle[parent];
    const Eigen::Index row =
        f < clean_triangles ? scan_parent : scan_.triangles.rows() + f - clean_triangles;
    for (int k = 0; k < 3; ++k)
      out_.skin.triangles(row, k) = scan_corner(cut.mesh.triangles(f, k), parent, scan_parent);
    if (f >= clean_triangles) out_.source_triangle.push_back(scan_parent);
  }
  out_.lip_cut.resize(cut.left_rim.size(), 3);
  for (std::size_t i = 0; i < cut.left_rim.size(); ++i)
    out_.lip_cut.row(i) = cut.mesh.points.row(cut.left_rim[i]);
  clean_.mesh = cut.mesh;
}

/// The skin's vertex for one of the cut working copy, in the scan triangle that it came from: the
/// first of the scan's at that place.
int SkinBuilder::scan_corner(int vertex, int clean_triangle, int scan_triangle) const {
  const auto old = static_cast<int>(clean_.source_vertex.size());
  if (vertex >= old) return static_cast<int>(out_.scan_vertices) + vertex - old;
  for (int k = 0; k < 3; ++k)
    if (clean_.mesh.triangles(clean_triangle, k) == vertex)
      return first_[std::size_t(scan_.triangles(scan_triangle, k))];
  throw std::logic_error("a piece of a triangle has a foreign corner");
}

int SkinBuilder::skin_vertex(int vertex) const {
  const auto old = static_cast<int>(clean_.source_vertex.size());
  return vertex < old ? clean_.source_vertex[vertex]
                      : static_cast<int>(out_.scan_vertices) + vertex - old;
}

/// The skin's triangle that one of the cut working copy is.
Eigen::Index SkinBuilder::skin_row(Eigen::Index clean_triangle) const {
  return clean_triangle < uncut_triangles_
             ? clean_.source_triangle[clean_triangle]
             : scan_.triangles.rows() + clean_triangle - uncut_triangles_;
}

/// The places of the skin's vertices on the thinned surface. Vertices that the working copy lacks
/// (islands, unused ones) get the nearest point of it.
std::vector<MeshPlace> SkinBuilder::places_of_skin(const ThinMesh& thin) const {
  std::vector<int> clean_vertex(out_.skin.points.rows(), -1);
  for (Eigen::Index f = 0; f < clean_.mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      clean_vertex[out_.skin.triangles(skin_row(f), k)] = clean_.mesh.triangles(f, k);
  std::vector<MeshPlace> places(clean_vertex.size());
  const SurfaceTree tree(thin.mesh);
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (clean_vertex[v] >= 0) {
      places[v] = thin.places[clean_vertex[v]];
      continue;
    }
    const ClosestPoint near = tree.query(out_.skin.points.row(Eigen::Index(v)).transpose());
    for (int k = 0; k < 3; ++k) places[v].vertex[k] = thin.mesh.triangles(near.triangle, k);
    places[v].weight = near.weights;
  }
  for (std::size_t v = 0; v < first_.size(); ++v) places[v] = places[std::size_t(first_[v])];
  return places;
}

void SkinBuilder::thin(double element_size_m, const std::vector<char>& held) {
  if (out_.scan_vertices <= thinned_above_vertices) return;
  std::vector<char> kept(clean_.mesh.points.rows(), 0);
  for (std::size_t v = 0; v < kept.size() && !held.empty(); ++v)
    if (const int s = skin_vertex(static_cast<int>(v)); s < out_.scan_vertices) kept[v] = held[s];
  ThinOptions options;
  options.edge_m = element_size_m / 3;
  ThinMesh thinned = thin_mesh(clean_.mesh, options, kept);
  auto full = std::make_shared<FullSkin>();
  full->places = places_of_skin(thinned);
  for (const int v : thinned.source_vertex) full->kept.push_back(skin_vertex(v));
  for (const int f : thinned.source_triangle)
    full->kept_triangle.push_back(static_cast<int>(skin_row(f)));
  full->skin = std::move(out_.skin);
  full->scan_vertices = out_.scan_vertices;
  full->appended = std::move(out_.appended);
  full->source_triangle = std::move(out_.source_triangle);
  out_.notes.push_back(make_note(
      "scan.thinned",
      fmt::format("the scan's {} vertices were thinned to {} for computing and drawing: the others "
                  "lie up to {:.2f} mm from that surface; skin_peak.ply has them all",
                  out_.scan_vertices, thinned.mesh.points.rows(),
                  1e3 * thinned.greatest_distance_m)));
  out_.skin = thinned.mesh;
  out_.scan_vertices = out_.skin.points.rows();
  out_.appended.clear();
  out_.source_triangle.resize(out_.skin.triangles.rows());
  std::iota(out_.source_triangle.begin(), out_.source_triangle.end(), 0);
  out_.full = std::move(full);
  clean_ = {};
  clean_.mesh = std::move(thinned.mesh);
  clean_.source_vertex.resize(clean_.mesh.points.rows());
  std::iota(clean_.source_vertex.begin(), clean_.source_vertex.end(), 0);
}

}  // namespace hyperex::tissue
