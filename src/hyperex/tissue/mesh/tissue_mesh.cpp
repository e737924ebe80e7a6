// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/check_options.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/geodesic.hpp"
#include "hyperex/geometry/hole_filling.hpp"
#include "hyperex/geometry/remesh.hpp"
#include "hyperex/geometry/short_border_edges.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/tissue/mesh/corner_linings.hpp"
#include "hyperex/tissue/mesh/on_skin.hpp"
#include "hyperex/tissue/mesh/seams.hpp"
#include "hyperex/tissue/mesh/skin_builder.hpp"
#include "hyperex/tissue/mesh/skin_depth.hpp"
#include "hyperex/tissue/mesh/unfold.hpp"

namespace hyperex::tissue {
namespace {

/// Distances from the centre of the mouth at which the mesh is graded: the centre of the inversion
/// lies this far in front of the lips (edges double at this distance beside the mouth).
constexpr double grading_m = 0.12;
/// Nodes on an area of 1 for a wanted edge of 1: 1.2 times those of equilateral triangles of that
/// edge, as remeshing stays below it. Within 4 % on three faces with elements of 2.2 to 5 mm.
constexpr double nodes_of_square_edges = 1.39;
/// Holes up to this length around are mended; eyes, mouth and nostrils are left open.
constexpr double mended_hole_m = 0.03;
/// Least length of a border edge, relative to the requested size. Smoothing folds moves the rims of
/// the lips together at the end of the slit; elements between nodes half a millimetre apart would
/// be stretched twentyfold when the mouth opens.
constexpr double least_border_edge_share = 0.3;
/// The rims of the lips touch at rest and must not be joined again.
constexpr CleanOptions cleaned_again{.join_duplicates = false};

double loop_extent(const TriMesh& mesh, const std::vector<int>& loop) {
  Points p(loop.size(), 3);
  for (std::size_t i = 0; i < loop.size(); ++i) p.row(i) = mesh.points.row(loop[i]);
  return (p.colwise().maxCoeff() - p.colwise().minCoeff()).norm();
}

/// The vertices of the border loop of greatest extent.
std::vector<int> outer_border(const TriMesh& mesh) {
  std::vector<int> best;
  double extent = -1;
  for (auto& loop : boundary_loops(mesh.triangles))
    if (const double e = loop_extent(mesh, loop); e > extent) {
      extent = e;
      best = loop;
    }
  return best;
}

/// Small holes closed, the outer border trimmed by `trim_m`.
TriMesh mend(TriMesh mesh, const io::Landmarks& landmarks, double trim_m,
             std::vector<Note>& notes) {
  std::vector<Vec3> open;  // around these, holes stay
  for (int k = 31; k < 68; ++k) open.push_back(landmarks.at(face::ibug(k)));
  int mended = 0;
  const auto border = outer_border(mesh);
  for (const auto& loop : boundary_loops(mesh.triangles)) {
    if (loop.size() < 3 || loop == border || loop_length(loop, mesh.points) > mended_hole_m)
      continue;
    Vec3 centre = Vec3::Zero();
    for (int v : loop) centre += mesh.points.row(v).transpose() / double(loop.size());
    double nearest = 1;
    for (const Vec3& p : open) nearest = std::min(nearest, (p - centre).norm());
    if (nearest < 0.012) continue;
    mended += fill_hole(mesh, loop);
  }
  if (mended > 0)
    notes.push_back(
        make_note("mesh.holes_mended", fmt::format("{} small holes of the scan mended", mended)));
  if (trim_m > 0 && !border.empty()) {
    const auto far = EdgePaths(mesh).distances(border, trim_m);
    std::vector<char> drop(far.size());
    for (std::size_t v = 0; v < far.size(); ++v) drop[v] = std::isfinite(far[v]);
    mesh = without_triangles(mesh, touching(mesh.triangles, drop));
    notes.push_back(make_note(
        "mesh.border_trimmed",
        fmt::format("{:.1f} mm trimmed off the border for the simulation", trim_m * 1e3)));
  }
  return mesh;
}

TriMesh subset(const TriMesh& mesh, const std::vector<int>& triangles) {
  TriMesh part{mesh.points, Triangles(triangles.size(), 3)};
  for (std::size_t i = 0; i < triangles.size(); ++i)
    part.triangles.row(i) = mesh.triangles.row(triangles[i]);
  return part;
}

/// Anchors every skin vertex at the closest point of the outer surface, near the mouth of that
/// lip's own side: through the air the other lip may be nearer.
void anchor_skin(TissueMesh& out, const io::Landmarks& landmarks) {
  const TriMesh& outer = out.volume.outer;
  const std::vector<double>& skin_margin = out.skin_upper_margin;
  std::vector<int> part[2];  // lower, upper
  const auto margin_of = [&](int f) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += out.upper_margin[outer.triangles(f, k)];
    return sum / 3;
  };
  for (int f = 0; f < outer.triangles.rows(); ++f) part[margin_of(f) > 0].push_back(f);
  const SurfaceTree whole(outer);
  auto closest = whole.query_all(out.skin.points);
  if (!part[0].empty() && !part[1].empty()) {
    const SurfaceTree side[2] = {SurfaceTree(subset(outer, part[0])),
                                 SurfaceTree(subset(outer, part[1]))};
    const face::FaceFrame frame = face::face_frame(landmarks);
    const double reach = 1.8 * (landmarks.at(face::ibug(54)) - frame.origin).norm();
    constexpr double sure_m =
        0.004;  // beside the mouth corners the paths to both lips are equally long
    for (Eigen::Index v = 0; v < out.skin.points.rows(); ++v) {
      if (std::abs(skin_margin[v]) < sure_m) continue;
      if ((out.skin.points.row(v).transpose() - frame.origin).norm() > reach) continue;
      const bool upper = skin_margin[v] > 0;
      if ((margin_of(closest[v].triangle) > 0) == upper) continue;
      closest[v] = side[upper].query(out.skin.points.row(v));
      closest[v].triangle = part[upper][closest[v].triangle];
    }
  }
  double sum = 0, worst = 0;
  out.anchors.resize(closest.size());
  for (std::size_t v = 0; v < closest.size(); ++v) {
    for (int k = 0; k < 3; ++k) out.anchors[v].node[k] = outer.triangles(closest[v].triangle, k);
    out.anchors[v].weight = closest[v].weights;
    const double d = std::sqrt(closest[v].squared_distance);
    sum += d;
    worst = std::max(worst, d);
  }
  out.mean_distance_mm = 1e3 * sum / double(closest.size());
  out.max_distance_mm = 1e3 * worst;
}

/// Thickness wanted under each vertex of `outer`. `skin_depth`: of the skin's vertices, where files
/// say any; else empty.
Eigen::VectorXd thickness_over(const TriMesh& outer, const TissueMesh& out,
                               const Eigen::VectorXd& skin_depth, const io::Landmarks& landmarks,
                               const TissueMeshOptions& options) {
  if (skin_depth.size() == 0) return unpainted_depth(outer.points, landmarks, options);
  const SideTree tree = skin_tree(out, landmarks);
  const std::vector<double> margin = anatomy::upper_lip_margin(outer, landmarks);
  Eigen::VectorXd thickness(outer.points.rows());
  for (Eigen::Index v = 0; v < thickness.size(); ++v)
    thickness[v] =
        tree.query(outer.points.row(v).transpose(), margin[std::size_t(v)]).value(skin_depth);
  return thickness;
}

/// The layer under `outer`; a few triangles folded into corners, under which none fits, are given
/// up.
VolumeMesh thicken(TriMesh outer, const Eigen::VectorXd& skin_depth, const io::Landmarks& landmarks,
                   const TissueMeshOptions& options, const std::string& source, TissueMesh& out) {
  VolumeMeshOptions volume;
  volume.layers = options.layers;
  volume.bones = out.bones.get();
  constexpr double given_up_share = 0.01;
  const double most = std::max(6.0, given_up_share * double(outer.triangles.rows()));
  std::size_t given_up = 0;
  while (true) {
    try {
      VolumeMesh mesh = build_volume_mesh(
          outer, thickness_over(outer, out, skin_depth, landmarks, options), volume);
      if (given_up > 0)
        out.notes.push_back(make_note(
            "mesh.folds_given_up",
            fmt::format(
                "triangles of the simulated skin under which no layer of tissue fits, and which "
                "were dropped: {}",
                given_up)));
      return mesh;
    } catch (const FoldedSurface& folded) {
      given_up += folded.triangles.size();
      if (double(given_up) > most) throw InputError(source, folded.what());
      std::vector<char> drop(outer.triangles.rows(), 0);
      for (int f : folded.triangles) drop[f] = 1;
      outer = without_triangles(outer, drop);
    }
  }
}

/// Some steps know no file: cleaning, say.
template <class Step>
void naming(const std::string& source, Step step) {
  try {
    step();
  } catch (const std::invalid_argument& e) {
    throw InputError(source, e.what());
  }
}

/// The requested edge length on the tissue's outer surface.
GradedSize graded_size(const io::Landmarks& landmarks, const TissueMeshOptions& options) {
  GradedSize size;
  size.edge_m = options.element_size_m;
  size.focus = 0.5 * (landmarks.at(face::ibug(51)) + landmarks.at(face::ibug(57)));
  size.centre = size.focus + grading_m * face::face_frame(landmarks).z;
  return size;
}

}  // namespace

namespace {

/// Vertices of the scan that are at one place move as the first of them, which is the one that
/// triangles of the skin have.
void move_repeated_vertices(TissueMesh& mesh) {
  const std::vector<int> first = first_at_same_place(mesh.skin.points.topRows(mesh.scan_vertices));
  std::map<int, std::size_t> at_rim;
  for (std::size_t i = 0; i < mesh.rim.size(); ++i) at_rim[mesh.rim[i].vertex] = i;
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] == int(v)) continue;
    mesh.anchors[v] = mesh.anchors[std::size_t(first[v])];
    if (const auto at = at_rim.find(first[v]); at != at_rim.end() && !at_rim.contains(int(v))) {
      RimVertex copy = mesh.rim[at->second];
      copy.vertex = int(v);
      mesh.rim.push_back(std::move(copy));
    }
  }
}

}  // namespace

TissueMeshBuilder::TissueMeshBuilder(const TriMesh& scan, const io::Landmarks& landmarks,
                                     const TissueMeshOptions& options, std::string source,
                                     const std::vector<char>& held,
                                     std::shared_ptr<const anatomy::Bones> bones)
    : landmarks_(landmarks), options_(options), source_(std::move(source)) {
  if (const auto problems = out_of_bounds(options); !problems.empty()) throw InputError(problems);
  naming(source_, [&] {
    TissueMesh& out = *mesh_;
    out.bones = std::move(bones);
    SkinBuilder skin(scan, landmarks, source_, out);
    skin.cut(options.cut_lips);
    skin.thin(options.element_size_m, held);
    out.skin_upper_margin = skin.on_skin(anatomy::upper_lip_margin(skin.mesh(), landmarks));
    if (is_painted(options_)) skin_depth_ = skin_depth(out, landmarks, options_);
    working_copy_ = skin.mesh();
  });
}

std::shared_ptr<const TissueMesh> TissueMeshBuilder::build() {
  naming(source_, [&] {
    TissueMesh& out = *mesh_;
    if (const int dropped = remove_corner_linings(working_copy_, landmarks_); dropped > 0)
      out.notes.push_back(
          make_note("mesh.lip_linings_dropped",
                    fmt::format("{} triangles on the inner sides of the lips were removed at the "
                                "corners of the mouth, where they lie on each other",
                                dropped)));
    const TriMesh mended =
        mend(std::move(working_copy_), landmarks_, options_.trim_border_m, out.notes);
    const GradedSize size = graded_size(landmarks_, options_);
    TriMesh outer = remesh_graded(mended, size);
    outer = clean_mesh(unfold(outer, out.notes), cleaned_again).mesh;
    remove_short_border_edges(outer, size, least_border_edge_share);

    out.volume = thicken(outer, skin_depth_, landmarks_, options_, source_, out);
    append(out.notes, out.volume.notes);
    out.quality = quality_of(out.volume.nodes, out.volume.tets);
    out.upper_margin = anatomy::upper_lip_margin(out.volume.outer, landmarks_);
    out.on_border.assign(out.volume.surface_nodes(), 0);
    for (int v : outer_border(out.volume.outer)) out.on_border[v] = 1;
    anchor_skin(out, landmarks_);
    out.rim = smooth_seams(out.skin, out.volume.outer, out.anchors,
                           rim_vertices(out.skin, out.volume.outer, out.anchors, out.on_border));
    move_repeated_vertices(out);
  });
  return std::move(mesh_);
}

TissueMesh build_tissue_mesh(const TriMesh& scan, const io::Landmarks& landmarks,
                             const TissueMeshOptions& options, const std::string& source,
                             const std::vector<char>& held,
                             std::shared_ptr<const anatomy::Bones> bones) {
  return *TissueMeshBuilder(scan, landmarks, options, source, held, std::move(bones)).build();
}

double expected_surface_nodes(const TriMesh& scan, const io::Landmarks& landmarks,
                              const TissueMeshOptions& options) {
  const GradedSize size = graded_size(landmarks, options);
  const Eigen::VectorXd areas = triangle_areas(scan);
  double edges = 0;  // area in the edge lengths that are wanted there
  for (Eigen::Index f = 0; f < areas.size(); ++f) {
    const auto corner = [&](int k) -> Vec3 { return scan.points.row(scan.triangles(f, k)); };
    edges += areas[f] / std::pow(size.at((corner(0) + corner(1) + corner(2)) / 3), 2);
  }
  return nodes_of_square_edges * edges;
}

}  // namespace hyperex::tissue
