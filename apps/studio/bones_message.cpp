// SPDX-License-Identifier: GPL-3.0-or-later
#include "bones_message.hpp"

#include <algorithm>

#include "hyperex/core/describe.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/simulate/drive/jaw.hpp"
#include "hyperex/simulate/drive/osteotomy.hpp"

namespace hyperex::studio {
namespace {
using nlohmann::json;

/// Bone farther behind the condyles than this is not drawn.
constexpr double kBehind_m = 0.03;

json triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// The part of a bone in front of a frontal plane.
json surface_json(const TriMesh& bone, const face::FaceFrame& frame, double behind_m,
                  report::BinaryBlock& block) {
  std::vector<int> vertex_of(std::size_t(bone.points.rows()), -1), triangles;
  std::vector<float> points;
  for (const auto& corners : bone.triangles.rowwise()) {
    const bool in_front = std::all_of(corners.begin(), corners.end(), [&](int v) {
      return frame.local(bone.points.row(v).transpose()).z() > behind_m;
    });
    if (!in_front) continue;
    for (const int v : corners) {
      int& at = vertex_of[std::size_t(v)];
      if (at < 0) {
        at = int(points.size() / 3);
        for (int k = 0; k < 3; ++k) points.push_back(float(bone.points(v, k)));
      }
      triangles.push_back(at);
    }
  }
  return {{"points", block.add(points)}, {"triangles", block.add(triangles)}};
}

}  // namespace

json bones_json(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                report::BinaryBlock& block) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  const double behind_m =
      frame.local(simulate::JawHinge(landmarks, mesh.bones.get()).centre).z() - kBehind_m;
  json segments = json::array();
  for (const simulate::BoneSegment& segment : simulate::usual_segments(landmarks, mesh.bones.get()))
    segments.push_back({{"part", word_of(segment.part)},
                        {"cut", word_of(segment.cut)},
                        {"turns_about", triple(segment.turns_about)},
                        {"plane_at", triple(segment.plane_at)},
                        {"plane_normal", triple(segment.plane_normal)},
                        {"half_width_m", segment.half_width_m},
                        {"ends_at", segment.ends_at ? triple(*segment.ends_at) : json()}});
  json out = {{"axes", {triple(frame.x), triple(frame.y), triple(frame.z)}},
              {"middle", triple(frame.origin)},
              {"segments", segments},
              {"skull", nullptr},
              {"mandible", nullptr}};
  if (!mesh.bones) return out;
  for (const auto& [name, bone] :
       {std::pair{"skull", &mesh.bones->skull()}, std::pair{"mandible", &mesh.bones->mandible()}})
    if (bone->triangles.rows() > 0) out[name] = surface_json(*bone, frame, behind_m, block);
  return out;
}

}  // namespace hyperex::studio
