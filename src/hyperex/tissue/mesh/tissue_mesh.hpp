// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/anatomy/bones.hpp"
#include "hyperex/core/describe.hpp"
#include "hyperex/core/note.hpp"
#include "hyperex/geometry/insert_line.hpp"
#include "hyperex/geometry/thin_mesh.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/mesh/rim.hpp"
#include "hyperex/tissue/mesh/thickness.hpp"
#include "hyperex/tissue/mesh/volume_mesh.hpp"
#include "hyperex/tissue/options.hpp"

namespace hyperex::tissue {

enum class LipCut { automatic, always, never };
constexpr auto words_of(LipCut) {
  return std::array{Word{"auto", LipCut::automatic}, Word{"always", LipCut::always},
                    Word{"never", LipCut::never}};
}

struct TissueMeshOptions {
  double element_size_m = 0.0033;  ///< edges at the mouth; they grow smoothly away from it
  int layers = 2;                  ///< of elements between the skin and the inner surface
  double thickness_m = 0;  ///< > 0: the same everywhere; 0: published_depths(), interpolated
  /// Used where thickness_m is 0, instead of the published depths at the same landmarks.
  std::vector<DepthAt> depths;
  std::filesystem::path depth_per_vertex;  ///< instead, where it has values: a row per scan vertex
  std::vector<DepthRegion> depth_regions;  ///< applied in turn
  LipCut cut_lips = LipCut::automatic;
  double trim_border_m = 0;  ///< width of the strip removed along the scan's outer border

  static constexpr const char* about = "The volume of soft tissue.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(element_size_m), "Edge length of the tetrahedra along the skin.",
             {.unit = kMillimetres, .bounds = {0.0005, 0.03}});
    v.option(HX_MEMBER(layers), "Layers of elements between the skin and the inner surface.",
             {.bounds = {1, 8}});
    v.option(
        HX_MEMBER(thickness_m),
        "Thickness of the soft tissue, the same everywhere. 0: from published depths at "
        "landmarks, interpolated.",
        {.unit = kMillimetres, .bounds = {thickness_m_in.least, thickness_m_in.most, false, true}});
    v.option(HX_MEMBER(cut_lips),
             "Whether the scan is cut between the lips: \"auto\" cuts where they are joined.");
    v.option(HX_MEMBER(trim_border_m),
             "Takes off a strip of this width along the scan's outer border.",
             {.unit = kMillimetres, .bounds = {0, 0.05}});
    v.option(HX_MEMBER(depths),
             "Thickness at a landmark, instead of the published depth there; interpolated in "
             "between. Only where mesh.thickness_mm is 0.",
             {.key = "thickness_point"});
    v.option(HX_MEMBER(depth_per_vertex),
             "Thickness for each vertex of the scan: a CSV file with a column thickness_mm and "
             "one row per vertex, or a PLY file with such a vertex property; 1 to 40. An empty "
             "cell (in PLY: nan) keeps the thickness that the other keys give.",
             {.key = "thickness_per_vertex"});
    v.option(HX_MEMBER(depth_regions),
             "Thickness in a painted part of the face, applied after all of the above and in the "
             "order of the file.",
             {.key = "thickness_region"});
  }
};

/// A scan with more vertices is thinned to edges of a third of an element (thin_mesh) before it is
/// meshed and drawn.
constexpr Eigen::Index thinned_above_vertices = 60000;

/// The skin of a scan that was thinned, as TissueMesh::skin would be without thinning.
struct FullSkin {
  TriMesh skin;
  Eigen::Index scan_vertices = 0;
  std::vector<EdgePoint> appended;
  std::vector<int> source_triangle;
  std::vector<int> kept;           ///< of each vertex of the thinned skin, its vertex of `skin`
  std::vector<int> kept_triangle;  ///< of each of its triangles, the triangle of `skin` that it was
  std::vector<MeshPlace> places;   ///< of each vertex of `skin` on the thinned skin
};

/// The position of a point of the skin on the simulated outer surface.
struct Anchor {
  std::array<int, 3> node{};  ///< outer nodes of the volume mesh
  Vec3 weight = Vec3::Zero();
};

/// A scan prepared for simulation.
struct TissueMesh {
  /// The scan as given. If its lips were cut, each triangle that the cut crosses is replaced by one
  /// of its pieces; the other pieces and the new vertices are appended. If the scan was thinned
  /// (`full`), "the scan" means the thinned scan. Of vertices at exactly the same place, triangles
  /// use the first; the others are carried along, as files refer to the scan's vertices by number.
  TriMesh skin;
  std::shared_ptr<const FullSkin> full;  ///< where the scan was thinned
  Eigen::Index scan_vertices = 0;
  std::vector<EdgePoint> appended;  ///< where each appended vertex lies on the scan
  std::vector<int>
      source_triangle;  ///< of each skin triangle, the scan's triangle that it is part of
  Points lip_cut;       ///< the line of the cut, empty where none was made
  VolumeMesh volume;
  std::vector<Anchor> anchors;       ///< per skin vertex
  std::vector<RimVertex> rim;        ///< vertices that do not follow their anchor, rising
  std::vector<double> upper_margin;  ///< per outer node: path along the surface to the lower lip
                                     ///< minus that to the upper (m)
  std::vector<double> skin_upper_margin;  ///< the same, per skin vertex
  std::vector<char> on_border;  ///< per outer node: on the outer border, not at mouth or eyes
  MeshQuality quality;
  double mean_distance_mm = 0,
         max_distance_mm = 0;  ///< scan vertices to the simulated outer surface
  std::vector<Note> notes;     ///< what was mended, trimmed or cut
  /// The person's own bones, on which the layer ends; null: thickness and bones are estimated.
  std::shared_ptr<const anatomy::Bones> bones;
};

/// build_tissue_mesh() in two steps, so that work on the skin can begin before the volume is built.
class TissueMeshBuilder {
 public:
  /// Makes the skin. `scan` and `landmarks` must outlive this. Throws as build_tissue_mesh().
  TissueMeshBuilder(const TriMesh& scan, const io::Landmarks& landmarks,
                    const TissueMeshOptions& options, std::string source,
                    const std::vector<char>& held = {},
                    std::shared_ptr<const anatomy::Bones> bones = nullptr);

  /// The members of TissueMesh before `volume`, and `skin_upper_margin`. They may be read while
  /// build() runs.
  const TissueMesh& with_skin() const { return *mesh_; }

  /// The same mesh, complete. Call it once.
  std::shared_ptr<const TissueMesh> build();

 private:
  const io::Landmarks& landmarks_;
  TissueMeshOptions options_;
  std::string source_;
  std::shared_ptr<TissueMesh> mesh_ = std::make_shared<TissueMesh>();
  TriMesh working_copy_;
  Eigen::VectorXd skin_depth_;  ///< empty where no file gives any
};

/// Cleans a working copy, cuts joined lips, mends small holes, remeshes with a size that grows away
/// from the mouth, and builds the layer. `landmarks` must hold the 68 iBUG points
/// (complete_landmarks). `source` names the scan in errors. `held`, per scan vertex: thinning keeps
/// it (empty: none). `bones`: the layer ends on them where they lie at most kDeepestBone_m under
/// the skin (bone_depth.hpp); null: none are known. Throws InputError where the scan cannot be
/// used.
TissueMesh build_tissue_mesh(const TriMesh& scan, const io::Landmarks& landmarks,
                             const TissueMeshOptions& options, const std::string& source,
                             const std::vector<char>& held = {},
                             std::shared_ptr<const anatomy::Bones> bones = nullptr);

/// An estimate of the number of nodes on the outer surface of that mesh. Takes milliseconds, since
/// nothing is meshed. `landmarks`: as for build_tissue_mesh().
double expected_surface_nodes(const TriMesh& scan, const io::Landmarks& landmarks,
                              const TissueMeshOptions& options);

}  // namespace hyperex::tissue
