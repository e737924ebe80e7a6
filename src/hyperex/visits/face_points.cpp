// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/face_points.hpp"

#include <algorithm>
#include <string>

#include "hyperex/face/ibug.hpp"
#include "hyperex/metrics/point_pairs.hpp"

namespace hyperex::visits {
namespace {

struct Definition {
  FacePoint point;
  const char* landmark;   ///< empty: it has no anatomical landmark
  std::vector<int> ibug;  ///< their mean is used if there is no landmark
};

const std::vector<Definition>& definitions() {
  static const std::vector<Definition> all = {
      {FacePoint::corner_R, "cheilion_R", {48}},
      {FacePoint::corner_L, "cheilion_L", {54}},
      {FacePoint::inner_upper_lip, "", {62}},
      {FacePoint::inner_lower_lip, "", {66}},
      {FacePoint::upper_lip, "labiale_superius", {51}},
      {FacePoint::subnasale, "subnasale", {33}},
      {FacePoint::upper_lid_R, "palpebrale_superius_R", {37, 38}},
      {FacePoint::upper_lid_L, "palpebrale_superius_L", {43, 44}},
      {FacePoint::lower_lid_R, "palpebrale_inferius_R", {40, 41}},
      {FacePoint::lower_lid_L, "palpebrale_inferius_L", {46, 47}},
      {FacePoint::brow_R, "", {18, 19, 20}},
      {FacePoint::brow_L, "", {23, 24, 25}},
      {FacePoint::outer_eye_R, "exocanthion_R", {36}},
      {FacePoint::outer_eye_L, "exocanthion_L", {45}},
      {FacePoint::alare_R, "alare_R", {31}},
      {FacePoint::alare_L, "alare_L", {35}},
      {FacePoint::crista_philtri_R, "crista_philtri_inferior_R", {50}},
      {FacePoint::crista_philtri_L, "crista_philtri_inferior_L", {52}}};
  return all;
}

}  // namespace

ByFacePoint<std::vector<int>> face_points_of(const motion::Motion& motion) {
  ByFacePoint<std::vector<int>> columns;
  for (const Definition& definition : definitions()) {
    std::vector<int>& found = at(columns, definition.point);
    const int own = *definition.landmark ? metrics::column_of(motion, definition.landmark) : -1;
    if (own >= 0) {
      found = {own};
      continue;
    }
    for (const int point : definition.ibug)
      found.push_back(metrics::column_of(motion, face::ibug(point)));
    if (std::ranges::find(found, -1) != found.end()) found.clear();
  }
  return columns;
}

Points track_of(const motion::Motion& motion, const std::vector<int>& columns) {
  Points track = Points::Zero(Eigen::Index(motion.positions.size()), 3);
  for (Eigen::Index k = 0; k < track.rows(); ++k) {
    for (const int column : columns) track.row(k) += motion.positions[std::size_t(k)].row(column);
    track.row(k) /= double(columns.size());
  }
  return track;
}

}  // namespace hyperex::visits
