// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_lines.hpp"

#include <algorithm>
#include <limits>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"

namespace hyperex::muscles {
namespace {

/// Longest straight piece of a line (m).
constexpr double kStep_m = 0.0015;
/// An origin is moved to the bone where it lies at most this far from it.
constexpr double kOffBone_m = 0.010;

class Laying {
 public:
  Laying(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks)
      : mesh_(mesh),
        landmarks_(landmarks),
        frame_(face::face_frame(landmarks)),
        skin_(mesh.volume.outer),
        scale_(scale_of(landmarks)) {}

  MuscleLine lay(const TemplateMuscle& muscle, bool left) const {
    MuscleLine out;
    out.name = muscle.name + (left ? "_L" : "_R");
    out.left = left;
    out.scale = scale_;
    std::vector<Vec3> at;
    for (const TemplatePlace& place : muscle.path) at.push_back(on_skin(place_of(place, left)));
    const std::vector<double> depth = depths(muscle.path, at);
    const auto place = [&](std::size_t i) {
      const Vec3 p = sunk(at[i], depth[i]);
      return i == 0 && depth[i] >= 1 ? on_bone(p, muscle.jaw) : p;
    };
    std::vector<Vec3> line;
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const int pieces = std::max(1, static_cast<int>((at[i + 1] - at[i]).norm() / kStep_m));
      for (int k = i == 0 ? 0 : 1; k <= pieces; ++k) {
        const double t = static_cast<double>(k) / pieces;
        line.push_back(muscle.straight ? Vec3((1 - t) * place(i) + t * place(i + 1))
                                       : Vec3(sunk((1 - t) * at[i] + t * at[i + 1],
                                                   (1 - t) * depth[i] + t * depth[i + 1]) +
                                              (1 - t) * (place(i) - sunk(at[i], depth[i]))));
      }
    }
    out.line.resize(static_cast<Eigen::Index>(line.size()), 3);
    for (std::size_t i = 0; i < line.size(); ++i)
      out.line.row(static_cast<Eigen::Index>(i)) = line[i].transpose();
    out.arc = arc_of(out.line);
    return out;
  }

 private:
  Vec3 place_of(const TemplatePlace& place, bool left) const {
    Vec3 mean = Vec3::Zero();
    for (const auto& [k, weight] : place.ibug) {
      const std::string name = face::ibug(k);
      mean += weight * landmarks_.at(left ? name : anatomy::mirrored_landmark(name));
    }
    const double mm = 1e-3 * scale_;
    return mean + mm * ((left ? 1 : -1) * place.out_mm * frame_.x + place.up_mm * frame_.y);
  }
  Vec3 on_skin(const Vec3& p) const { return skin_.query(p).point; }

  /// The nearest place of the person's own bone, where it is known and near.
  Vec3 on_bone(const Vec3& p, bool mandible) const {
    if (!mesh_.bones) return p;
    const auto near = mesh_.bones->nearest(
        mandible ? anatomy::Bone::mandible : anatomy::Bone::skull, p, kOffBone_m);
    return near.bone == anatomy::Bone::none ? p : near.at;
  }

  /// The closest point of the skin, moved towards the inner surface by the share `depth` of the
  /// thickness.
  Vec3 sunk(const Vec3& p, double depth) const {
    const ClosestPoint c = skin_.query(p);
    Vec3 inner = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      inner += c.weights[k] *
               mesh_.volume.nodes
                   .row(mesh_.volume.inner_node(mesh_.volume.outer.triangles(c.triangle, k)))
                   .transpose();
    return (1 - depth) * c.point + depth * inner;
  }

  /// Depths of the places. Where none is given, it is interpolated by distance along the path
  /// between the neighbours that have one.
  static std::vector<double> depths(const std::vector<TemplatePlace>& path,
                                    const std::vector<Vec3>& at) {
    std::vector<double> depth(path.size()), way(path.size(), 0);
    for (std::size_t i = 1; i < path.size(); ++i) way[i] = way[i - 1] + (at[i] - at[i - 1]).norm();
    for (std::size_t i = 0; i < path.size(); ++i) {
      std::size_t a = i, b = i;
      while (path[a].depth < 0) --a;
      while (path[b].depth < 0) ++b;
      const double t = a == b ? 0 : (way[i] - way[a]) / std::max(way[b] - way[a], 1e-9);
      depth[i] = (1 - t) * path[a].depth + t * path[b].depth;
    }
    return depth;
  }

  const tissue::TissueMesh& mesh_;
  const io::Landmarks& landmarks_;
  face::FaceFrame frame_;
  SurfaceTree skin_;
  double scale_;
};

}  // namespace

double scale_of(const io::Landmarks& landmarks) {
  return (landmarks.at(face::ibug(36)) - landmarks.at(face::ibug(45))).norm() /
         (1e-3 * kTemplateEyes_mm);
}

std::vector<double> arc_of(const Points& line) {
  std::vector<double> arc;
  for (Eigen::Index i = 0; i < line.rows(); ++i)
    arc.push_back(i == 0 ? 0 : arc.back() + (line.row(i) - line.row(i - 1)).norm());
  return arc;
}

std::vector<MuscleLine> muscle_lines(const std::vector<TemplateMuscle>& muscles,
                                     const tissue::TissueMesh& mesh,
                                     const io::Landmarks& landmarks) {
  const Laying laying(mesh, landmarks);
  std::vector<MuscleLine> lines;
  for (std::size_t row = 0; row < muscles.size(); ++row)
    for (const bool left : {true, false}) {
      lines.push_back(laying.lay(muscles[row], left));
      lines.back().row = static_cast<int>(row);
    }
  return lines;
}

OnLine nearest_on_line(const MuscleLine& muscle, const Vec3& p) {
  OnLine best{std::numeric_limits<double>::max()};
  const double length = muscle.arc.back();
  for (Eigen::Index i = 0; i + 1 < muscle.line.rows(); ++i) {
    const Vec3 a = muscle.line.row(i), e = muscle.line.row(i + 1).transpose() - a;
    const double squared = e.squaredNorm();
    if (squared == 0) continue;
    const double t = std::clamp((p - a).dot(e) / squared, 0.0, 1.0);
    const double distance = (p - a - t * e).norm();
    if (distance >= best.distance_m) continue;
    const double arc = muscle.arc[i] + t * (muscle.arc[i + 1] - muscle.arc[i]);
    best = {distance, arc / length, e / std::sqrt(squared)};
  }
  return best;
}

}  // namespace hyperex::muscles
