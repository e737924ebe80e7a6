// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <stdexcept>
#include <vector>

#include "hyperex/anatomy/register_face.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/field/presets.hpp"
#include "hyperex/tissue/field/regions.hpp"
#include "hyperex/tissue/mesh/side_tree.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "hyperex/tissue/options.hpp"

namespace hyperex::tissue {

/// Invalid options. Names of landmarks in the options are checked only if `landmarks` is not empty;
/// all else is checked without a scan.
std::vector<FieldProblem> problems_of(const TissueFieldOptions& options,
                                      const io::Landmarks& landmarks);

/// False if the options give the same values everywhere, those of uniform_parameters().
bool is_graded(const TissueFieldOptions& options);

/// One value of each parameter per vertex of the skin (TissueMesh::skin), SI.
using SkinField = std::array<Eigen::VectorXd, parameter_count>;

/// One value of each parameter per vertex of the skin and per tetrahedron; SI.
struct TissueField {
  SkinField skin;                 ///< of the outermost layer
  std::vector<SkinField> deeper;  ///< of the layers under it, inwards; empty: there are no layers
  Eigen::MatrixXd layer_share;    ///< of each tetrahedron (layer_shares()); empty: the same
  std::array<std::vector<double>, parameter_count> element;
  /// The volume at rest over that of the mesh, per vertex of the skin and per tetrahedron.
  /// Empty: 1.
  Eigen::VectorXd skin_volume_ratio;
  std::vector<double> volume_ratio;
  double added_volume_m3 = 0;  ///< of all regions, both sides
  std::vector<Note> notes;     ///< on layers

  /// Over the skin.
  bool varies(int parameter) const {
    return skin[parameter].size() > 0 &&
           skin[parameter].maxCoeff() > skin[parameter].minCoeff() * (1 + 1e-9);
  }
  /// Over the skin or from layer to layer.
  bool varies_within(int parameter) const;
};

/// A problem that can only be found with the scan: an empty region, or a parameter out of its
/// range.
struct FieldError : std::runtime_error {
  explicit FieldError(FieldProblem p)
      : std::runtime_error("tissue." + p.key + ": expected " + p.expected), problem(std::move(p)) {}
  FieldProblem problem;
};

/// Reads the files of values per vertex as make() will, and returns notes on how they were matched
/// with the scan. Throws InputError where they cannot be used.
std::vector<Note> notes_on_files(const TissueFieldOptions& options, const TriMesh& scan);

/// Fields on one mesh. Parts that do not depend on the options are computed once, so that a variant
/// needs only its own solution.
///   1. Each parameter is uniform, or uniform in each layer; or, where points give it, interpolated
///      between them, alike in all layers. E itself is interpolated, not its logarithm: fields then
///      add up, as the source's models 2 and 3 do about model 1.
///   2. A preset's factor multiplies it.
///   3. The file per vertex replaces it where it has values.
///   4. Regions in turn, in each layer: u <- u (1 + w (factor - 1)), or u <- u + w (value - u), w
///      the region's share at the vertex.
///   5. The volume that a region adds is shared out by w: a tetrahedron of volume V grows to
///      V (1 + volume w / sum over all of w V). Where mirror makes two sides of a region, each
///      takes the volume.
///   6. A tetrahedron takes the field at the point of the skin above its centroid: constant through
///      the thickness, or the mean over its layers (layer_means()).
class TissueFieldMaker {
 public:
  /// `landmarks`: completed. `face`: the canonical face laid over the scan, for named regions; none
  /// where no options will name any (needs_registration). Mesh and landmarks must outlive this.
  TissueFieldMaker(const TissueMesh& mesh, const io::Landmarks& landmarks,
                   const anatomy::RegisteredFace* face);

  /// problems_of(options) must be empty. Throws FieldError, InputError (the file per vertex).
  TissueField make(const TissueFieldOptions& options) const;
  /// The share (0 to 1) of a region's change that applies at each vertex of the skin. Throws as
  /// make().
  Eigen::VectorXd region_shares(const TissueFieldOptions& options, std::size_t index) const;

 private:
  std::vector<SkinField> skin_fields(const TissueFieldOptions& options) const;
  void interpolate(const TissueFieldOptions& options, SkinField& field) const;
  void apply_region(const TissueFieldOptions& options, std::size_t index, SkinField& field,
                    const Eigen::VectorXd& shares) const;
  void add_volumes(const TissueFieldOptions& options, TissueField& field) const;
  Eigen::VectorXd region_depth(const TissueFieldOptions& options, std::size_t index) const;

  const TissueMesh& mesh_;
  const io::Landmarks& landmarks_;
  std::vector<int> joined_;
  SideTree skin_tree_;
  std::optional<RegionMap> regions_;
  std::vector<PlaceOnMesh> above_;  ///< of each tetrahedron's centroid
};

/// Whether a region adds volume or takes it away.
bool adds_volume(const TissueFieldOptions& options);

/// Whether the options name a region of the face.
bool needs_registration(const TissueFieldOptions& options);

}  // namespace hyperex::tissue
