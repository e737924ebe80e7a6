// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/canonical_face.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/carried_file.hpp"
#include "hyperex/face/ibug.hpp"

namespace hyperex::face {

HX_CARRIED_FILE(canonical_face_obj, HYPEREX_CANONICAL_FACE_OBJ)
HX_CARRIED_FILE(canonical_landmarks_csv, HYPEREX_CANONICAL_LANDMARKS_CSV)

namespace {

constexpr int kVertices = 468, kTriangles = 898;
constexpr double kMetresPerCentimetre = 0.01;

// These files are part of the program and are embedded at build time. An error in them is a
// programming error.
void require(bool sound) {
  if (!sound) throw std::logic_error("the canonical face inside this program is damaged");
}

void read_obj(std::string_view text, CanonicalFace& face) {
  std::istringstream lines{std::string(text)};
  lines.exceptions(std::ios::badbit);  // else a lack of memory reads like the end of the text
  lines.imbue(std::locale::classic());
  face.mesh.points.resize(kVertices, 3);
  face.uv.resize(kVertices, 2);
  face.mesh.triangles.resize(kTriangles, 3);
  int points = 0, uvs = 0, triangles = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    words.exceptions(std::ios::badbit);
    words.imbue(std::locale::classic());
    std::string kind;
    words >> kind;
    if (kind == "v") {
      require(points < kVertices);
      auto row = face.mesh.points.row(points++);
      words >> row(0) >> row(1) >> row(2);
    } else if (kind == "vt") {
      require(uvs < kVertices);
      auto row = face.uv.row(uvs++);
      words >> row(0) >> row(1);
    } else if (kind == "f") {
      require(triangles < kTriangles);
      for (int corner = 0, slash_index = 0; corner < 3; ++corner) {
        char slash = 0;
        int vertex = 0;
        words >> vertex >> slash >> slash_index;
        require(vertex >= 1 && vertex <= kVertices);
        face.mesh.triangles(triangles, corner) = vertex - 1;
      }
      ++triangles;
    }
    require(!words.fail());
  }
  require(points == kVertices && uvs == kVertices && triangles == kTriangles);
  face.mesh.points *= kMetresPerCentimetre;
}

void read_landmark_table(std::string_view text, CanonicalFace& face) {
  std::istringstream lines{std::string(text)};
  lines.exceptions(std::ios::badbit);  // else a lack of memory reads like the end of the text
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#' || line == "name,vertices") continue;
    const auto comma = line.find(',');
    require(comma != std::string::npos);
    std::istringstream words(line.substr(comma + 1));
    auto& vertices = face.landmarks[line.substr(0, comma)];
    for (int vertex; words >> vertex;) {
      require(vertex >= 0 && vertex < kVertices);
      vertices.push_back(vertex);
    }
    require(!vertices.empty());
  }
}

/// Rows of the triangles with all three corners on a contour. These triangles close that opening.
std::vector<int> triangles_within(const Triangles& triangles, const std::vector<int>& contour) {
  const std::set<int> on(contour.begin(), contour.end());
  std::vector<int> rows;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    if (on.contains(triangles(f, 0)) && on.contains(triangles(f, 1)) &&
        on.contains(triangles(f, 2)))
      rows.push_back(int(f));
  return rows;
}

}  // namespace

const std::vector<int>& right_eye_contour() {
  static const std::vector<int> contour = {33,  7,   163, 144, 145, 153, 154, 155,
                                           133, 173, 157, 158, 159, 160, 161, 246};
  return contour;
}

const std::vector<int>& left_eye_contour() {
  static const std::vector<int> contour = {263, 249, 390, 373, 374, 380, 381, 382,
                                           362, 398, 384, 385, 386, 387, 388, 466};
  return contour;
}

const std::vector<int>& lip_contour() {
  static const std::vector<int> contour = {78,  191, 80,  81,  82,  13, 312, 311, 310, 415,
                                           308, 324, 318, 402, 317, 14, 87,  178, 88,  95};
  return contour;
}

Vec3 CanonicalFace::landmark(const std::string& name, const Points& vertices) const {
  const auto found = landmarks.find(name);
  HX_ASSERT(found != landmarks.end());
  Vec3 sum = Vec3::Zero();
  for (const int vertex : found->second) sum += vertices.row(vertex).transpose();
  return sum / double(found->second.size());
}

const CanonicalFace& canonical_face() {
  static const CanonicalFace face = [] {
    CanonicalFace made;
    read_obj(canonical_face_obj(), made);
    read_landmark_table(canonical_landmarks_csv(), made);
    made.right_eye = triangles_within(made.mesh.triangles, right_eye_contour());
    made.left_eye = triangles_within(made.mesh.triangles, left_eye_contour());
    made.mouth = triangles_within(made.mesh.triangles, lip_contour());
    require(made.right_eye.size() == 14 && made.left_eye.size() == 14 && made.mouth.size() == 18);
    return made;
  }();
  return face;
}

Triangles opened_triangles(const CanonicalFace& face) {
  std::set<int> dropped(face.mouth.begin(), face.mouth.end());
  dropped.insert(face.right_eye.begin(), face.right_eye.end());
  dropped.insert(face.left_eye.begin(), face.left_eye.end());
  Triangles kept(face.mesh.triangles.rows() - Eigen::Index(dropped.size()), 3);
  for (Eigen::Index f = 0, row = 0; f < face.mesh.triangles.rows(); ++f)
    if (!dropped.contains(int(f))) kept.row(row++) = face.mesh.triangles.row(f);
  return kept;
}

const std::vector<int>& mirrored_vertices() {
  static const std::vector<int> mirror = [] {
    constexpr double kSameVertex_m = 1e-3;
    const Points& points = canonical_face().mesh.points;
    std::vector<int> made(std::size_t(points.rows()));
    for (Eigen::Index v = 0; v < points.rows(); ++v) {
      const Eigen::RowVector3d image(-points(v, 0), points(v, 1), points(v, 2));
      Eigen::Index nearest = 0;
      const double squared = (points.rowwise() - image).rowwise().squaredNorm().minCoeff(&nearest);
      if (squared > kSameVertex_m * kSameVertex_m)
        throw std::logic_error("the canonical face inside this program is not symmetric");
      made[std::size_t(v)] = int(nearest);
    }
    return made;
  }();
  return mirror;
}

std::string mirrored_landmark(const std::string& name) {
  if (name.size() > 2 && name.ends_with("_L")) return name.substr(0, name.size() - 1) + "R";
  if (name.size() > 2 && name.ends_with("_R")) return name.substr(0, name.size() - 1) + "L";
  const auto number = ibug_number(name);
  if (!number) return name;
  static const std::vector<int> mirror = [] {
    std::vector<int> table(68);
    const auto pair = [&](int first, int last, int sum) {
      for (int k = first; k <= last; ++k) table[std::size_t(k)] = sum - k;
    };
    pair(0, 16, 16);                                           // jaw
    pair(17, 26, 43);                                          // brows
    for (int k = 27; k <= 30; ++k) table[std::size_t(k)] = k;  // bridge of the nose
    pair(31, 35, 66);                                          // nostrils
    for (const auto& [a, b] :
         {std::pair{36, 45}, {37, 44}, {38, 43}, {39, 42}, {40, 47}, {41, 46}}) {
      table[std::size_t(a)] = b;
      table[std::size_t(b)] = a;
    }
    pair(48, 54, 102);  // outer lips, above
    pair(55, 59, 114);  // and below
    pair(60, 64, 124);  // inner lips, above
    pair(65, 67, 132);  // and below
    return table;
  }();
  return ibug(mirror[std::size_t(*number)]);
}

}  // namespace hyperex::face
