// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/teeth/tongue.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "hyperex/anatomy/teeth/lathe.hpp"

namespace hyperex::anatomy {
namespace {

using Eigen::Index;

/// Both rows in the face's frame, and the room inside the lower one; metres.
class Room {
 public:
  Room(const Teeth& teeth, const face::FaceFrame& face) {
    for (const JawTeeth* jaw : {&teeth.upper, &teeth.lower})
      for (const TriMesh* part : {&jaw->crowns, &jaw->gum})
        for (const auto& p : part->points.rowwise()) all_.push_back(face.local(p.transpose()));
    const Points crowns = face.local_points(teeth.lower.crowns.points);
    middle_ = (crowns.col(0).maxCoeff() + crowns.col(0).minCoeff()) / 2;
    back_ = crowns.col(2).minCoeff();
    const double front = crowns.col(2).maxCoeff();
    edge_front_ = edge_back_ = Vec3(0, -1, 0);
    for (const auto& p : crowns.rowwise()) {
      if (std::abs(p.x() - middle_) < kFront_m && p.z() > (front + back_) / 2 &&
          p.y() > edge_front_.y())
        edge_front_ = p.transpose();
      if (p.z() < back_ + 0.01 && p.y() > edge_back_.y()) edge_back_ = p.transpose();
    }
    tip_ = edge_front_.z();
    for (const Vec3& p : all_)
      if (std::abs(p.x() - middle_) < kTip_m && p.z() > (front + back_) / 2 &&
          p.y() < edge_front_.y() + 1e-3 && p.y() > edge_front_.y() - kTipHigh_m)
        tip_ = std::min(tip_, p.z());
    tip_ -= kTongueClearance_m;
    // The row is curved in front: the tip is blunt and needs some width.
    for (double way = 0; way < 0.006 && half(tip_) < kTipHalf_m; way += 2.5e-4) tip_ -= 2.5e-4;
  }

  double middle() const { return middle_; }
  double tip() const { return tip_; }
  double length() const { return tip_ - back_; }
  /// Height of the line along the crowns' tops.
  double tops(double z) const {
    const double span = edge_front_.z() - edge_back_.z();
    const double share = span > 1e-3 ? (edge_front_.z() - z) / span : 0;
    return edge_front_.y() + std::clamp(share, 0.0, 1.2) * (edge_back_.y() - edge_front_.y());
  }
  /// Half of the width that is free at a depth.
  double half(double z) const {
    double least = 0.03;
    for (const Vec3& p : all_) {
      const double along = p.z() - z, up = p.y() - tops(z);
      if (std::abs(along) > kReach_m || up < -kHigh_m || up > kAbove_m) continue;
      const double reach = std::sqrt(kReach_m * kReach_m - along * along);
      least = std::min(least, std::abs(p.x() - middle_) - reach);
    }
    return least;
  }

 private:
  /// The vertices of both rows that limit the tongue: from kHigh_m below the tops of the lower
  /// crowns to kAbove_m above them. kFront_m: half of the width of the row's front.
  static constexpr double kHigh_m = 0.015, kAbove_m = 0.006, kFront_m = 0.006;
  /// Half of the width of the tip's front, and how far under the incisors' edges it reaches.
  static constexpr double kTip_m = 0.0045, kTipHigh_m = 0.009, kTipHalf_m = 0.003;
  /// More than the clearance: rows are vertices.
  static constexpr double kReach_m = kTongueClearance_m + 4e-4;

  std::vector<Vec3> all_;
  Vec3 edge_front_, edge_back_;
  double middle_ = 0, back_ = 0, tip_ = 0;
};

/// One section across a tongue; heights over the crowns' tops.
struct Section {
  double half, top, bottom, groove;
};

/// `way`: behind the tip, of `length` in all, mm; `room`: half of the free width.
Section section_at(double way, double length, double room) {
  constexpr double blunt = 2.3, tip_mm = 13;
  const double open = std::clamp(way / tip_mm, 0.0, 1.0);
  const double round = std::pow(1 - std::pow(1 - open, blunt), 1 / blunt);
  const double falls = smooth_step(0.55 * length, 1.15 * length, way);
  Section out{};
  out.half = std::min(room, 13 * round + 9 * smooth_step(6, 30, way));
  out.top = -4.5 + 2.5 * round + 4.5 * smooth_step(4, 26, way) - 15 * falls;
  out.bottom = -5 - 3.5 * round - 4.5 * smooth_step(4, 16, way) - 2 * falls;
  out.groove = 1.5 * smooth_step(5, 14, way) * (1 - falls);
  return out;
}

std::vector<Vec3> ring_of(const Section& section, double middle_mm, double tops_mm, double z_mm) {
  constexpr int points = 40;
  const double side = section.bottom + 0.55 * (section.top - section.bottom);
  std::vector<Vec3> ring;
  for (int k = 0; k < points; ++k) {
    const double turn = 2 * std::numbers::pi * k / points;
    const double x = section.half * powered(std::cos(turn), 2 / 2.2);
    const double up = powered(std::sin(turn), 2 / 2.2);
    double y = side + up * (up > 0 ? section.top - side : side - section.bottom);
    if (up > 0) y -= section.groove * std::exp(-x * x / 6) * up;
    ring.push_back(1e-3 * Vec3(middle_mm + x, tops_mm + y, z_mm));
  }
  return ring;
}

}  // namespace

TriMesh tongue_in(const Teeth& teeth, const face::FaceFrame& face) {
  constexpr double beyond_mm = 8, least_length_m = 0.018, least_half_m = 0.006;
  if (teeth.lower.crowns.triangles.rows() == 0) return {};
  const Room room(teeth, face);
  const double length = 1e3 * room.length();
  if (room.length() < least_length_m) return {};
  for (double share = 0.35; share < 0.85; share += 0.05)
    if (room.half(room.tip() - share * room.length()) < least_half_m) return {};
  // Behind the tip, mm: close together where it is round.
  std::vector<double> ways;
  for (double way = 0.15; way < length + beyond_mm; way += std::clamp(0.3 * way, 0.35, 2.2))
    ways.push_back(way);
  std::vector<double> half;
  for (const double way : ways) half.push_back(1e3 * room.half(room.tip() - 1e-3 * way));
  Lathe lathe;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double near =
        std::min({half[i > 0 ? i - 1 : 0], half[i], half[std::min(i + 1, half.size() - 1)]});
    const Section section = section_at(ways[i], length, std::max(0.2, near));
    const double z = room.tip() - 1e-3 * ways[i];
    lathe.rings.push_back(ring_of(section, 1e3 * room.middle(), 1e3 * room.tops(z), 1e3 * z));
  }
  for (auto [at, ring] : {std::pair{&lathe.first, &lathe.rings.front()},
                          std::pair{&lathe.last, &lathe.rings.back()}}) {
    at->setZero();
    for (const Vec3& p : *ring) *at += p / double(ring->size());
  }
  TriMesh mesh = lathe.mesh();
  turn_outwards(mesh);
  for (Index v = 0; v < mesh.points.rows(); ++v)
    mesh.points.row(v) = face.world(mesh.points.row(v).transpose()).transpose();
  return mesh;
}

}  // namespace hyperex::anatomy
