// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/lid_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "hyperex/face/ibug.hpp"

namespace hyperex::rig {
namespace {

constexpr double kMostOfPoints = 1.8, kMostOfOther = 1.6;
constexpr double kLeast_m = 0.002;   // beyond what was expected: less is seen by nobody
constexpr double kRegion = 0.8;      // of the eye's width, around its middle
constexpr double kStill_m = 0.0005;  // an eye that moves by less is no measure of the other
constexpr std::size_t kMostNamed = 3;

/// The skin of one eye: vertices, and those of them next to landmarks.
struct LidSkin {
  std::vector<Eigen::Index> vertices, at_landmarks;
};

std::optional<LidSkin> lid_skin(const Points& skin, const io::Landmarks& landmarks, int first) {
  Points eye(6, 3);
  for (int k = 0; k < 6; ++k) {
    const auto at = landmarks.find(face::ibug(first + k));
    if (at == landmarks.end()) return {};
    eye.row(k) = at->second.transpose();
  }
  const Eigen::RowVector3d middle = eye.colwise().mean();
  const double reach = kRegion * (eye.row(0) - eye.row(3)).norm();
  LidSkin out;
  for (Eigen::Index v = 0; v < skin.rows(); ++v)
    if ((skin.row(v) - middle).norm() < reach) out.vertices.push_back(v);
  for (const auto& [name, at] : landmarks) {
    if ((at.transpose() - middle).norm() >= reach) continue;
    Eigen::Index nearest = 0;
    (skin.rowwise() - at.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    out.at_landmarks.push_back(nearest);
  }
  return out;
}

double farthest_m(const report::RigShape& shape, const std::vector<Eigen::Index>& vertices) {
  double most = 0;
  for (const Eigen::Index v : vertices)
    most = std::max(most, double(shape.displacement_m.row(v).norm()));
  return most;
}

/// The shape of the other side; null for shapes of both or of none of an eye.
const report::RigShape* mirrored(const report::RigShape& shape, const std::string& side,
                                 const std::string& other,
                                 const std::vector<report::RigShape>& shapes) {
  const std::string& name = shape.name;
  if (!name.ends_with(side) || !(name.starts_with("eye") || name.starts_with("cheekSquint")))
    return nullptr;
  const std::string wanted = name.substr(0, name.size() - side.size()) + other;
  const auto at = std::ranges::find(shapes, wanted, &report::RigShape::name);
  return at == shapes.end() ? nullptr : &*at;
}

/// A shape that moves the skin of its eye too far.
struct Doubt {
  double by_m = 0;
  std::string words;
};

std::optional<Doubt> doubt_of(const report::RigShape& shape, const report::RigShape& mirror,
                              const LidSkin& own, const LidSkin& other, bool sides_alike) {
  const double by_m = farthest_m(shape, own.vertices);
  const double points_m = farthest_m(shape, own.at_landmarks);
  const double other_m = farthest_m(mirror, other.vertices);
  const bool beyond_points = by_m > kMostOfPoints * points_m && by_m > points_m + kLeast_m;
  const bool beyond_other = sides_alike && other_m > kStill_m && by_m > kMostOfOther * other_m &&
                            by_m > other_m + kLeast_m;
  if (!beyond_points && !beyond_other) return {};
  return Doubt{by_m,
               fmt::format("{} by {:.1f} mm (landmarks there by {:.1f}, {} by {:.1f})", shape.name,
                           1e3 * by_m, 1e3 * points_m, mirror.name, 1e3 * other_m)};
}

Note note_of(const char* eye, std::vector<Doubt> doubts) {
  std::ranges::sort(doubts, std::ranges::greater(), &Doubt::by_m);
  std::string list;
  for (std::size_t i = 0; i < std::min(doubts.size(), kMostNamed); ++i)
    list += (i == 0 ? "" : ", ") + doubts[i].words;
  if (doubts.size() > kMostNamed) list += fmt::format(" and {} more", doubts.size() - kMostNamed);
  return make_warning("rig.lid_doubtful",
                      fmt::format("the skin around the {} eye moves farther than expected, so that "
                                  "the lid is probably torn: {}. Look at the landmarks of the lids "
                                  "(hyperex landmarks --picture)",
                                  eye, list));
}

}  // namespace

std::vector<Note> lid_doubts(const Points& skin, const io::Landmarks& landmarks,
                             const std::vector<report::RigShape>& shapes, bool sides_alike) {
  const auto right = lid_skin(skin, landmarks, 36), left = lid_skin(skin, landmarks, 42);
  if (!right || !left) return {};
  std::vector<Note> notes;
  const auto look_at = [&](const char* eye, const char* side, const char* other_side,
                           const LidSkin& own, const LidSkin& other) {
    std::vector<Doubt> doubts;
    for (const report::RigShape& shape : shapes)
      if (const report::RigShape* mirror = mirrored(shape, side, other_side, shapes))
        if (auto doubt = doubt_of(shape, *mirror, own, other, sides_alike))
          doubts.push_back(std::move(*doubt));
    if (!doubts.empty()) notes.push_back(note_of(eye, std::move(doubts)));
  };
  look_at("right", "Right", "Left", *right, *left);
  look_at("left", "Left", "Right", *left, *right);
  return notes;
}

}  // namespace hyperex::rig
