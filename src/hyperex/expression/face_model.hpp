// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::expression {

/// One way in which a face differs from the mean (shape) or moves (animation). At weight 1 the
/// listed vertices have the given displacements; all others are not displaced.
struct DeformationUnit {
  std::string name;  ///< the model's own name, e.g. "jawOpen", "Jaw drop"
  std::string facs;  ///< the action unit of the Facial Action Coding System, e.g. "AU26"; may be
                     ///< empty
  /// Names of ARKit's blend shapes for positive and for negative weights; may be empty.
  std::string arkit, arkit_negative;
  /// The blend shape whose weight multiplies the unit's: a corrective's second one
  /// (correctives.hpp). Empty: none.
  std::string arkit_factor;
  /// Weight of `arkit` = arkit_scale * weight, that of `arkit_negative` = arkit_negative_scale *
  /// -weight; each from 0 to 1.
  double arkit_scale = 1, arkit_negative_scale = 1;
  double typical = 0.3;       ///< prior standard deviation of the weight; 0: not tracked
  std::vector<int> vertices;  ///< n vertices, none twice
  Points displacement_m;      ///< n x 3
};

/// A vertex of the model that is also a point of the landmark network.
struct NetworkPair {
  int vertex = 0;   ///< of the model
  int network = 0;  ///< of the network's 468 points
};

/// A face as a linear model: g = g_mean + S sigma + A alpha (J. Ahlberg, "CANDIDE-3 - an updated
/// parameterised face", LiTH-ISY-R-2326, Linkoping University 2001). Metres; +x the subject's left,
/// +y up, +z forward. V vertices.
struct FaceModel {
  std::string name;
  TriMesh mesh;  ///< g_mean and its triangles; eyes and mouth are open if the model has openings
  std::vector<DeformationUnit> shape_units, animation_units;
  /// Units that recorded weights of blend shapes move and that tracking does not estimate.
  std::vector<DeformationUnit> recorded_units;
  std::vector<NetworkPair> pairs;
  /// Maps a landmark's name to the vertices whose mean it is. Contains the iBUG and anatomical
  /// landmarks that the model defines.
  std::map<std::string, std::vector<int>> landmarks;
  /// Recorded gaze moves the lids only as far as eyeBlink and eyeWide do not move them already
  /// (with_lids_once() in gaze.hpp). False for a rig, whose shapes add up by definition.
  bool lids_once = false;
  int jaw_drop = -1;  ///< row of animation_units: the unit that opens the mouth

  Eigen::Index vertex_count() const { return mesh.points.rows(); }
  /// Row of animation_units with that name, or -1 if there is none.
  int animation_unit(const std::string& unit_name) const;
};

/// `base` + sum_k weights[k] units[k]. There is one weight per unit; each row of `base` is a
/// vertex.
Points deformed(const Points& base, const std::vector<DeformationUnit>& units,
                const Eigen::VectorXd& weights);

/// The mean of a landmark's vertices.
Vec3 landmark_at(const std::vector<int>& vertices, const Points& points);
/// All landmarks of a model in the order of model.landmarks. `points`: positions of its vertices.
Points landmarks_on(const FaceModel& model, const Points& points);

/// The canonical face (face/canonical_face.hpp) with its own animation units
/// (data/canonical_units.csv) and three shape units: width, height and depth by 10 %. Each of its
/// 468 vertices is one point of the network. Always returns the same object.
const FaceModel& canonical_model();

/// Reads CANDIDE-3 from a .wfm file. The model is scaled to a distance of 94 mm between the outer
/// eye corners. Its vertices are paired with the network's points by data/candide_pairs.csv. Throws
/// InputError if the file is malformed (candide.hpp), or if it does not have the 113 vertices and
/// 14 animation units of CANDIDE-3, which the tables require.
FaceModel candide_model(const std::string& wfm_file);

}  // namespace hyperex::expression
