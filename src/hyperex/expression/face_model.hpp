// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::expression {

/// One way in which a face differs (shape) or moves (animation): at weight 1 the listed vertices
/// are displaced, all others stay.
struct DeformationUnit {
  std::string name;  ///< the model's own name, e.g. "jawOpen", "Jaw drop"
  std::string facs;  ///< the action unit of the Facial Action Coding System, e.g. "AU26"; may be
                     ///< empty
  /// Names of ARKit's blend shapes for positive and for negative weights; may be empty.
  std::string arkit, arkit_negative;
  double arkit_scale = 1;     ///< ARKit's weight = arkit_scale * |weight|, at most 1
  double typical = 0.3;       ///< standard deviation of the weight a priori, > 0
  std::vector<int> vertices;  ///< n of them, none twice
  Points displacement_m;      ///< n x 3
};

/// A model's vertex that the landmark network sees too.
struct NetworkPair {
  int vertex = 0;   ///< of the model
  int network = 0;  ///< of the network's 468 points
};

/// A face as a linear model: g = g_mean + S sigma + A alpha (J. Ahlberg, "CANDIDE-3 - an updated
/// parameterised face", LiTH-ISY-R-2326, Linkoping University 2001). Metres; +x the subject's left,
/// +y up, +z forward. V vertices.
struct FaceModel {
  std::string name;
  TriMesh mesh;  ///< g_mean with its triangles, eyes and mouth open where the model allows
  std::vector<DeformationUnit> shape_units, animation_units;
  std::vector<NetworkPair> pairs;
  /// Name -> vertices whose mean the landmark is: iBUG points and anatomical ones, those that the
  /// model has.
  std::map<std::string, std::vector<int>> landmarks;
  int jaw_drop = -1;  ///< row of animation_units: opens the mouth

  Eigen::Index vertex_count() const { return mesh.points.rows(); }
  /// Row of animation_units, -1 where there is none of that name.
  int animation_unit(const std::string& unit_name) const;
};

/// `base` + sum_k weights[k] units[k]. `weights` as long as `units`; a row of `base` a vertex.
Points deformed(const Points& base, const std::vector<DeformationUnit>& units,
                const Eigen::VectorXd& weights);

/// The mean of a landmark's vertices.
Vec3 landmark_at(const std::vector<int>& vertices, const Points& points);
/// All landmarks of a model on `points`, its vertices, in the order of model.landmarks.
Points landmarks_on(const FaceModel& model, const Points& points);

/// The blend shapes that a unit's `arkit` names: "mouthSmile*" both sides, Left and Right; a name
/// without a star itself; nothing for "".
std::vector<std::string> arkit_names(const std::string& pattern);

/// The canonical face (face/canonical_face.hpp) with animation units of its own
/// (data/canonical_units.csv) and three shape units: width, height and depth by 10 %. Each of
/// its 468 vertices is one of the network's points. The same object ever after.
const FaceModel& canonical_model();

/// CANDIDE-3 from a .wfm file, scaled so that its outer eye corners are 94 mm apart, paired with
/// the network's points by data/candide_pairs.csv. Throws InputError where the file is
/// malformed (candide.hpp) or has not CANDIDE-3's 113 vertices and 14 animation units, which the
/// tables are made for.
FaceModel candide_model(const std::string& wfm_file);

}  // namespace hyperex::expression
