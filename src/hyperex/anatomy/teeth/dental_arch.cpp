// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/teeth/dental_arch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "hyperex/anatomy/teeth/lathe.hpp"

namespace hyperex::anatomy {
namespace {

using Eigen::Index;

constexpr double pi = std::numbers::pi;
constexpr int kSectors = 20;

enum class Kind { incisor, canine, premolar, molar };

/// Millimetres. The first five figures are published ones (see the header).
struct Crown {
  Kind kind;
  double length, width, neck_width, depth, neck_depth;
  double lean_deg;  ///< of its axis, the edge towards the lips: assumed
  double short_of;  ///< the plane of occlusion, by so much
};

constexpr std::array<Crown, 7> kUpper = {{
    {Kind::incisor, 10.5, 8.5, 7.0, 7.0, 6.0, 16, 0.0},
    {Kind::incisor, 9.0, 6.5, 5.0, 6.0, 5.0, 14, 0.6},
    {Kind::canine, 10.0, 7.5, 5.5, 8.0, 7.0, 8, -0.2},
    {Kind::premolar, 8.5, 7.0, 5.0, 9.0, 8.0, 2, 0.1},
    {Kind::premolar, 8.5, 7.0, 5.0, 9.0, 8.0, 0, 0.2},
    {Kind::molar, 7.5, 10.0, 8.0, 11.0, 10.0, 2, 0.2},
    {Kind::molar, 7.0, 9.0, 7.0, 11.0, 10.0, 4, 0.2},
}};
constexpr std::array<Crown, 7> kLower = {{
    {Kind::incisor, 9.0, 5.0, 3.5, 6.0, 5.3, 14, -2.5},
    {Kind::incisor, 9.5, 5.5, 4.0, 6.5, 5.8, 12, -2.5},
    {Kind::canine, 11.0, 7.0, 5.5, 7.5, 7.0, 6, -2.7},
    {Kind::premolar, 8.5, 7.0, 5.0, 7.5, 6.5, -4, -0.9},
    {Kind::premolar, 8.0, 7.0, 5.0, 8.0, 7.0, -8, 0.5},
    {Kind::molar, 7.5, 11.0, 9.0, 10.5, 9.0, -12, 0.5},
    {Kind::molar, 7.0, 10.5, 8.0, 10.0, 9.0, -14, 0.5},
}};
constexpr double kUpperWidth = 56, kLowerWidth = 52;

double mixed(double a, double b, double share) {
  return a + (b - a) * share;
}

/// The left half of an arch from the mid-line, in the plane x, z (mm); z is 0 in front.
class ArchCurve {
 public:
  ArchCurve(double width, double length) {
    double low = 1, high = 200;
    for (int i = 0; i < 50; ++i) {
      const double middle = (low + high) / 2;
      trace(width, middle);
      (length_ < length ? low : high) = middle;
    }
  }

  /// Beyond the end it goes on straight.
  Eigen::Vector2d at(double s) const {
    const double step = length_ / double(kPieces);
    const double along = std::clamp(s / step, 0.0, kPieces - 1e-9);
    const auto i = static_cast<std::size_t>(along);
    const Eigen::Vector2d on = even_[i] + (along - double(i)) * (even_[i + 1] - even_[i]);
    const Eigen::Vector2d last = (even_[kPieces] - even_[kPieces - 1]) / step;
    return on + std::max(0.0, s - length_) * last;
  }
  Eigen::Vector2d tangent(double s) const {
    constexpr double h = 0.5;
    if (s < h) {  // mirrored at the mid-line
      const Eigen::Vector2d back = at(std::abs(s - h));
      return (at(s + h) - Eigen::Vector2d(s < h ? -back.x() : back.x(), back.y())).normalized();
    }
    return (at(s + h) - at(s - h)).normalized();
  }

 private:
  static constexpr std::size_t kPieces = 400;

  void trace(double width, double depth) {
    std::array<Eigen::Vector2d, kPieces + 1> raw;
    std::array<double, kPieces + 1> way{};
    for (std::size_t i = 0; i <= kPieces; ++i) {
      const double x = width / 2 * std::sin(pi / 2 * double(i) / kPieces);
      const double u = x / width;
      const double z =
          3.0314 * depth * std::pow(0.5 + u, 0.8) * std::pow(std::max(0.0, 0.5 - u), 0.8);
      raw[i] = {x, z - depth};
      if (i > 0) way[i] = way[i - 1] + (raw[i] - raw[i - 1]).norm();
    }
    length_ = way[kPieces];
    std::size_t j = 0;
    for (std::size_t i = 0; i <= kPieces; ++i) {
      const double s = length_ * double(i) / kPieces;
      while (j + 1 < kPieces && way[j + 1] < s) ++j;
      even_[i] = raw[j] + (s - way[j]) / (way[j + 1] - way[j]) * (raw[j + 1] - raw[j]);
    }
  }

  std::array<Eigen::Vector2d, kPieces + 1> even_;  // at equal ways
  double length_ = 0;
};

/// A position on a jaw: m along the arch, l outwards, h towards the other jaw, mm.
struct Stand {
  Vec3 origin, m, l, h;
  Vec3 at(double along, double out, double up) const {
    return origin + along * m + out * l + up * h;
  }
};

Stand stand_at(const ArchCurve& curve, double s, double edge_y, double lean_deg, bool upper) {
  const Eigen::Vector2d on = curve.at(s), t = curve.tangent(s);
  const Vec3 along(t.x(), 0, t.y()), out(-t.y(), 0, t.x()), up(0, upper ? -1 : 1, 0);
  const double lean = lean_deg * pi / 180;
  return {Vec3(on.x(), edge_y, on.y()), along, std::cos(lean) * out - std::sin(lean) * up,
          std::cos(lean) * up + std::sin(lean) * out};
}

/// The depth of the chewing surface below the cusps' tips at (u, v) in the crown's outline: -1 to 1
/// along the arch and outwards.
double under_tips(const Crown& crown, double u, double v) {
  switch (crown.kind) {
    case Kind::incisor:
      return 0.7 * std::pow(std::abs(u), 7);
    case Kind::canine:
      return 1.5 * std::pow(std::abs(u), 1.5);
    case Kind::premolar: {
      const double across = std::sin(std::min(1.0, std::abs(v) / 1.2) * pi);
      return 1.2 * (1 - std::cos(u * pi / 2) * across) + (v < 0 ? 0.4 : 0);
    }
    case Kind::molar: {
      const double across = std::sin(std::min(1.0, std::abs(v) / 1.2) * pi);
      const double along = 0.45 + 0.55 * std::pow(std::abs(std::sin(u * pi)), 0.8);
      return 1.0 * (1 - along * across);
    }
  }
  return 0;
}

TriMesh crown_mesh(const Crown& crown, const Stand& stand) {
  const bool front = crown.kind == Kind::incisor || crown.kind == Kind::canine;
  const double power = 2 / (crown.kind == Kind::molar ? 3.2 : front ? 2.7 : 2.5);
  // Edges of front teeth are thin; they lie over the root's middle, less in canines.
  const double edge = front ? (crown.kind == Kind::canine ? 1.2 : 0.75) : 0.32 * crown.depth;
  const auto ring = [&](double t, double shrink, double rise) {
    std::vector<Vec3> out;
    const double neck = smooth_step(-0.1, 0.62, t);
    double width = mixed(crown.neck_width, crown.width, neck) / 2;
    if (!front) width *= 1 - 0.1 * smooth_step(0.65, 1.05, t);
    const double bulge = mixed(crown.neck_depth, crown.depth, smooth_step(0, 0.25, t)) / 2;
    const double to_edge = std::clamp(t, 0.0, 1.0);
    const double lip = mixed(bulge, edge, front ? std::pow(to_edge, 2.1) : std::pow(to_edge, 4));
    const double tongue =
        mixed(bulge, edge, front ? 1 - std::pow(1 - to_edge, 1.7) : std::pow(to_edge, 3));
    for (int k = 0; k < kSectors; ++k) {
      const double turn = 2 * pi * k / kSectors;
      const double u = shrink * powered(std::cos(turn), power);
      const double v = shrink * powered(std::sin(turn), power);
      const double tips = front ? under_tips(crown, u, v) * to_edge * to_edge
                                : under_tips(crown, u, v) * smooth_step(0.45, 1, t);
      out.push_back(
          stand.at(width * u, v > 0 ? lip * v : tongue * v, (t - 1) * crown.length + rise - tips));
    }
    return out;
  };
  Lathe lathe;
  const double root = -3 / crown.length;
  lathe.rings.push_back(ring(root, 0.7, 0));
  for (const double t : {0.0, 0.12, 0.28, 0.45, 0.62, 0.78, 0.9})
    lathe.rings.push_back(ring(t, 1, 0));
  if (front) {
    lathe.rings.push_back(ring(0.975, 0.97, 0));
    lathe.rings.push_back(ring(1, 0.75, 0));
  } else {
    for (const double shrink : {0.93, 0.7, 0.4}) lathe.rings.push_back(ring(1, shrink, 0));
  }
  lathe.first = stand.at(0, 0, (root - 1) * crown.length);
  const double tips = front ? 0 : under_tips(crown, 0, 0);
  lathe.last = stand.at(0, 0, -tips);
  return lathe.mesh();
}

/// The neck that the gum follows at a place of the arch, interpolated linearly between the middles
/// of the teeth.
struct Neck {
  double s, edge_y, lean_deg, length, depth;
};

struct Jaw {
  std::array<Crown, 7> crown;
  std::array<double, 8> contact{};  ///< ways along the arch from the mid-line
  ArchCurve curve;
  bool upper;
  double front_z;

  Jaw(const std::array<Crown, 7>& crowns, double width, bool is_upper, double front)
      : crown(crowns), curve(width, length_of(crowns)), upper(is_upper), front_z(front) {
    for (std::size_t i = 0; i < 7; ++i) contact[i + 1] = contact[i] + crown[i].width;
  }
  static double length_of(const std::array<Crown, 7>& crowns) {
    double sum = 0;
    for (const Crown& one : crowns) sum += one.width;
    return sum;
  }
  double middle(std::size_t i) const { return (contact[i] + contact[i + 1]) / 2; }
  double edge_y(std::size_t i) const { return (upper ? 1 : -1) * crown[i].short_of; }
  Stand stand(double s, double y, double lean_deg) const {
    Stand out = stand_at(curve, s, y, lean_deg, upper);
    out.origin.z() += front_z;
    return out;
  }

  Neck neck(double s) const {
    const auto of = [&](std::size_t i) {
      return Neck{middle(i), edge_y(i), crown[i].lean_deg, crown[i].length, crown[i].neck_depth};
    };
    if (s <= middle(0)) return of(0);
    for (std::size_t i = 1; i < 7; ++i)
      if (s <= middle(i)) {
        const Neck a = of(i - 1), b = of(i);
        const double t = smooth_step(a.s, b.s, s);
        return {s, mixed(a.edge_y, b.edge_y, t), mixed(a.lean_deg, b.lean_deg, t),
                mixed(a.length, b.length, t), mixed(a.depth, b.depth, t)};
      }
    return of(6);
  }
  /// 0 at a tooth's middle, 1 where it meets its neighbour.
  double between(double s) const {
    for (std::size_t i = 0; i < 7; ++i)
      if (s <= contact[i + 1]) return std::abs(s - middle(i)) / (crown[i].width / 2);
    return 0;
  }
};

TriMesh gum_mesh(const Jaw& jaw) {
  constexpr double beyond = 3, height = 8, before = 1.0, margin = 0.7, papilla = 0.5;
  constexpr int sectors = 18;
  Lathe lathe;
  const double end = jaw.contact[7] + beyond;
  const int half = static_cast<int>(std::ceil(end / 0.9));
  for (int i = -half; i <= half; ++i) {
    const double way = end * i / half, s = std::abs(way);
    const Neck neck = jaw.neck(s);
    const Stand stand = jaw.stand(s, neck.edge_y, neck.lean_deg);
    const double filled = papilla * neck.length * std::pow(jaw.between(s), 2.4);
    const double end_off = std::max(0.0, s - (end - beyond)) / beyond;
    const double closing = std::sqrt(std::max(0.02, 1 - end_off * end_off));
    const double out = (neck.depth / 2 + before) * closing;
    const double top = (margin + filled) * closing, bottom = -height * closing;
    std::vector<Vec3> ring;
    for (int k = 0; k < sectors; ++k) {
      const double turn = 2 * pi * k / sectors;
      const double up = mixed(bottom, top, 0.5 + 0.5 * powered(std::sin(turn), 2 / 2.6));
      const double narrow = 1 - 0.5 * smooth_step(-0.5, std::max(0.5, top), up);
      const double off = out * narrow * powered(std::cos(turn), 2 / 2.6);
      Vec3 at = stand.at(0, off, up - neck.length);
      if (way < 0) at.x() = -at.x();
      ring.push_back(at);
    }
    lathe.rings.push_back(std::move(ring));
  }
  for (auto [at, ring] : {std::pair{&lathe.first, &lathe.rings.front()},
                          std::pair{&lathe.last, &lathe.rings.back()}}) {
    at->setZero();
    for (const Vec3& p : *ring) *at += p / double(ring->size());
  }
  return lathe.mesh();
}

void append(TriMesh& all, const TriMesh& part) {
  const Index points = all.points.rows(), triangles = all.triangles.rows();
  all.points.conservativeResize(points + part.points.rows(), 3);
  all.points.bottomRows(part.points.rows()) = part.points;
  all.triangles.conservativeResize(triangles + part.triangles.rows(), 3);
  all.triangles.bottomRows(part.triangles.rows()) = part.triangles.array() + int(points);
}

JawTeeth jaw_teeth(const Jaw& jaw, double scale) {
  JawTeeth out;
  for (std::size_t i = 0; i < jaw.crown.size(); ++i) {
    const Stand stand = jaw.stand(jaw.middle(i), jaw.edge_y(i), jaw.crown[i].lean_deg);
    TriMesh left = crown_mesh(jaw.crown[i], stand);
    for (const bool right : {false, true}) {
      if (right) left.points.col(0) *= -1;
      turn_outwards(left);
      append(out.crowns, left);
      const int quadrant = jaw.upper ? (right ? 1 : 2) : (right ? 4 : 3);
      out.tooth.resize(std::size_t(out.crowns.triangles.rows()), 10 * quadrant + int(i) + 1);
    }
  }
  out.gum = gum_mesh(jaw);
  turn_outwards(out.gum);
  out.crowns.points *= 1e-3 * scale;
  out.gum.points *= 1e-3 * scale;
  return out;
}

}  // namespace

Teeth dental_arches(const ArchSize& size) {
  if (!(size.scale > 0) || !(size.breadth >= 0.6 && size.breadth <= 1.2))
    throw std::invalid_argument("dental arches: a size out of range");
  const Jaw upper(kUpper, size.breadth * kUpperWidth, true, 0);
  const Jaw lower(kLower, size.breadth * kLowerWidth, false, -1e3 * kOverjet_m);
  return {jaw_teeth(upper, size.scale), jaw_teeth(lower, size.scale)};
}

}  // namespace hyperex::anatomy
