// SPDX-License-Identifier: GPL-3.0-or-later
#include "unit/report/made_up_face.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include <cmath>
#include <numbers>
#include <numeric>

#include "hyperex/anatomy/teeth/dental_arch.hpp"
#include "hyperex/anatomy/teeth/tongue.hpp"

namespace hyperex::report::testing {
namespace {

constexpr double width_m = 0.16, height_m = 0.2;

Vec3 on_bump(double u, double v) {  // u, v in -1 .. 1
  const double nose = 0.02 * std::exp(-30 * (u * u + v * v));
  return {0.5 * width_m * u, 0.5 * height_m * v,
          0.06 * std::cos(1.2 * u) * std::cos(0.9 * v) + nose};
}

/// A grid of side x side vertices; the middle of one row is doubled, so that the part above can
/// leave the part below.
void build_skin(int side, simulate::Performance& out) {
  const int cut_row = side / 3;
  const int cut_from = side / 2 - side / 6, cut_to = side / 2 + side / 6;
  std::vector<Vec3> points;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      points.push_back(on_bump(2. * i / (side - 1) - 1, 2. * j / (side - 1) - 1));
  out.scan_vertices = side * side;
  std::vector<int> below(side, -1);
  for (int i = cut_from + 1; i < cut_to; ++i) {
    below[i] = static_cast<int>(points.size());
    out.appended.push_back({cut_row * side + i, cut_row * side + i, 0});
    points.push_back(points[cut_row * side + i]);
  }
  const auto vertex = [&](int i, int j, bool from_below) {
    return from_below && j == cut_row && below[i] >= 0 ? below[i] : j * side + i;
  };
  out.skin_rest.triangles.resize(2 * (side - 1) * (side - 1), 3);
  Eigen::Index f = 0;
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      const bool under = j + 1 == cut_row;
      const int a = vertex(i, j, under), b = vertex(i + 1, j, under);
      const int c = vertex(i + 1, j + 1, under), d = vertex(i, j + 1, under);
      out.skin_rest.triangles.row(f++) << a, b, c;
      out.skin_rest.triangles.row(f++) << a, c, d;
    }
  out.source_triangle.resize(f);
  std::iota(out.source_triangle.begin(), out.source_triangle.end(), 0);
  out.skin_rest.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) out.skin_rest.points.row(i) = points[i];
  out.lip_cut_rest.resize(cut_to - cut_from + 1, 3);
  for (int i = cut_from; i <= cut_to; ++i)
    out.lip_cut_rest.row(i - cut_from) = points[cut_row * side + i];
}

/// Below the cut the skin turns about an axis through the ears; cheeks swell.
Vec3 displaced(const Vec3& p, bool jaw, double phase) {
  Vec3 d(0.002 * phase * phase * p.x() / 0.08, 0, 0.003 * phase * std::cos(20 * p.y()));
  if (!jaw) return d;
  const double turn = 0.25 * phase;
  const double y = p.y() - 0.02, z = p.z() + 0.05;
  d.y() += std::cos(turn) * y - std::sin(turn) * z - y;
  d.z() += std::sin(turn) * y + std::cos(turn) * z - z;
  return d;
}

void move_skin(int side, int frames, simulate::Performance& out) {
  const double cut_y = out.skin_rest.points(side * (side / 3), 1);
  for (int f = 0; f < frames; ++f) {
    const double t = f / 30.0;
    const double phase = std::pow(std::sin(std::numbers::pi * f / (frames - 1)), 2);
    PointsF displacement(out.skin_rest.points.rows(), 3);
    for (Eigen::Index v = 0; v < displacement.rows(); ++v) {
      const Vec3 p = out.skin_rest.points.row(v);
      const bool jaw = p.y() < cut_y - 1e-9 || v >= out.scan_vertices;
      displacement.row(v) = displaced(p, jaw, phase).cast<float>();
    }
    const Vec3 hinge(0, 0.02, -0.05);
    Eigen::Isometry3d jaw_now = Eigen::Isometry3d::Identity();
    jaw_now.linear() = Eigen::AngleAxisd(0.25 * phase, Vec3::UnitX()).toRotationMatrix();
    jaw_now.translation() = hinge - jaw_now.linear() * hinge;
    out.jaw_now_from_rest.push_back(jaw_now);
    out.frame_time_s.push_back(t);
    out.skin_displacement_m.push_back(displacement);
  }
  out.peak_frame = frames / 2;
}

void add_landmarks(int side, simulate::Performance& out) {
  const auto vertex = [&](double u, double v) {
    return static_cast<int>((v + 1) / 2 * (side - 1)) * side +
           static_cast<int>((u + 1) / 2 * (side - 1));
  };
  const std::vector<std::pair<std::string, int>> chosen = {
      {"exocanthion_L", vertex(0.5, 0.4)}, {"exocanthion_R", vertex(-0.5, 0.4)},
      {"cheilion_L", vertex(0.35, -0.35)}, {"cheilion_R", vertex(-0.35, -0.35)},
      {"ibug68_57", vertex(0, -0.45)},     {"ibug68_8", vertex(0, -0.8)}};
  for (const auto& [name, at] : chosen) out.landmarks.names.push_back(name);
  out.landmarks.time_s = out.frame_time_s;
  for (const auto& displacement : out.skin_displacement_m) {
    Points positions(static_cast<Eigen::Index>(chosen.size()), 3);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      positions.row(i) = out.skin_rest.points.row(chosen[i].second) +
                         displacement.row(chosen[i].second).cast<double>();
    out.landmarks.positions.push_back(positions);
  }
  out.landmarks.positions.back().row(4).setConstant(NAN);  // a point lost in the last frame
  out.driven_names = {"ibug68_57", "ibug68_8"};
  out.driven_points_rest = out.landmarks.positions.front().bottomRows(2);
  out.held_points_rest = out.skin_rest.points.topRows(side);
  out.held_points_rest.col(2).array() -= 0.008;
}

io::Image striped_png(int size) {
  std::vector<unsigned char> pixels;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (const int value : {x / 8 % 2 ? 230 : 60, 255 * y / size, 128})
        pixels.push_back(static_cast<unsigned char>(value));
  io::Image image;
  image.mime_type = "image/png";
  stbi_write_png_to_func(
      [](void* out, void* data, int count) {
        auto& bytes = static_cast<io::Image*>(out)->bytes;
        const auto* first = static_cast<std::uint8_t*>(data);
        bytes.insert(bytes.end(), first, first + count);
      },
      &image, size, size, 3, pixels.data(), 3 * size);
  return image;
}

void dress(Surface surface, const simulate::Performance& performance, io::Scan& scan) {
  const auto& skin = performance.skin_rest;
  if (surface == Surface::coloured) {
    scan.vertex_colour.resize(performance.scan_vertices, 4);
    for (Eigen::Index v = 0; v < performance.scan_vertices; ++v)
      scan.vertex_colour.row(v) << 200, static_cast<std::uint8_t>(v % 256), 120, 255;
  } else if (surface == Surface::textured) {
    scan.texture = striped_png(64);
    scan.corner_uv.resize(3 * skin.triangles.rows(), 2);
    for (Eigen::Index f = 0; f < skin.triangles.rows(); ++f) {
      const double middle = skin.points(skin.triangles.row(f), 0).mean();
      for (int k = 0; k < 3; ++k) {
        const auto p = skin.points.row(skin.triangles(f, k));
        // Either half of the face has its own half of the picture, mirrored: a seam at x = 0.
        const double along = std::abs(p[0]) / width_m;
        scan.corner_uv.row(3 * f + k) << (middle < 0 ? along : 1 - along), 0.5 - p[1] / height_m;
      }
    }
  }
}

}  // namespace

void add_inner_eye_corners(simulate::Performance& performance) {
  motion::Motion& tracks = performance.landmarks;
  for (const char* side : {"L", "R"}) tracks.names.push_back(std::string("endocanthion_") + side);
  for (Points& frame : tracks.positions) {
    frame.conservativeResize(frame.rows() + 2, 3);
    for (int side = 0; side < 2; ++side)  // exocanthion_L and _R are the first
      frame.row(frame.rows() - 2 + side) =
          frame.row(side).cwiseProduct(Vec3(0.4, 1, 1).transpose());
  }
}

MadeUpFace made_up_face(Surface surface, int side, int frames) {
  MadeUpFace face;
  build_skin(side, face.performance);
  move_skin(side, frames, face.performance);
  add_landmarks(side, face.performance);
  face.scan.mesh.points = face.performance.skin_rest.points.topRows(face.performance.scan_vertices);
  face.scan.mesh.triangles = face.performance.skin_rest.triangles;
  for (auto& v : face.scan.mesh.triangles.reshaped())
    if (v >= face.performance.scan_vertices)
      v = face.performance.appended[v - face.performance.scan_vertices].a;
  dress(surface, face.performance, face.scan);
  face.symmetry.time_s = face.performance.frame_time_s;
  face.symmetry.jitter_m = 2e-5;
  for (const double t : face.symmetry.time_s) {
    const double left = 0.3 * std::sin(3 * t), right = 0.28 * std::sin(3 * t + 0.02 * t);
    face.symmetry.xi_left.push_back(left);
    face.symmetry.xi_right.push_back(right);
    face.symmetry.s.push_back(std::log(std::max(std::abs(left - right), face.symmetry.floor)));
    face.symmetry.noise.push_back(0.002 + 0.002 * t);
  }
  return face;
}

anatomy::Teeth made_up_teeth() {
  anatomy::Teeth teeth = anatomy::dental_arches();
  for (anatomy::JawTeeth* jaw : {&teeth.upper, &teeth.lower})
    for (TriMesh* part : {&jaw->crowns, &jaw->gum})
      part->points.rowwise() += Eigen::RowVector3d(0, -0.037, 0.045);
  teeth.tongue =
      anatomy::tongue_in(teeth, {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()});
  return teeth;
}

std::vector<SkinMap> made_up_tissue(const MadeUpFace& face) {
  return {{.key = "young_kpa",
           .name = "Young's modulus",
           .unit = "kPa",
           .least = 192.4,
           .greatest = 1924,
           .values = Eigen::VectorXd::Constant(face.performance.skin_rest.points.rows(), 192.4)}};
}

SkinMap made_up_uncertainty(const MadeUpFace& face) {
  SkinMap map{.key = "uncertainty", .name = "Expected error", .unit = "mm"};
  map.values = 40 * face.performance.skin_rest.points.col(1).cwiseAbs();  // in mm, by height
  map.greatest = map.values.maxCoeff();
  return map;
}

MadeUpVariant made_up_variant(const MadeUpFace& face, int which) {
  static const char* const names[made_up_variants] = {"stiff right cheek", "stiff left cheek",
                                                      "half the motion", "softer under the skin",
                                                      "the same again"};
  MadeUpVariant variant{names[which], face, made_up_tissue(face)};
  const Points rest = face.performance.skin_rest.points;
  // How much of the motion is left at a place; the subject's right lies at -x.
  const auto share = [&](double x) {
    const double side = 1 / (1 + std::exp(which == 0 ? x / 0.01 : -x / 0.01));
    return which < 2 ? 1 - 0.4 * side : which == 2 ? 0.5 : which == 3 ? 1.15 : 1.0;
  };
  for (auto& frame : variant.face.performance.skin_displacement_m)
    for (Eigen::Index v = 0; v < frame.rows(); ++v) {
      frame.row(v) *= static_cast<float>(share(rest(v, 0)));
      if (which == 2) frame(v, 0) *= 2;
    }
  if (which < 2)
    for (Eigen::Index v = 0; v < rest.rows(); ++v)
      variant.tissue[0].values[v] = 192.4 + 1731.6 * (1 - share(rest(v, 0))) / 0.4;
  motion::Motion& landmarks = variant.face.performance.landmarks;
  const Points first = landmarks.positions.front();
  for (Points& frame : landmarks.positions)
    for (Eigen::Index i = 0; i < frame.rows(); ++i)
      frame.row(i) = first.row(i) + share(first(i, 0)) * (frame.row(i) - first.row(i));
  metrics::SymmetryCurve& s = variant.face.symmetry;
  for (std::size_t k = 0; k < s.s.size(); ++k) {
    (which == 0 ? s.xi_right : s.xi_left)[k] *= share(which == 0 ? -0.03 : 0.03);
    s.s[k] = std::log(std::max(std::abs(s.xi_left[k] - s.xi_right[k]), s.floor));
  }
  return variant;
}

metrics::RestAsymmetry made_up_mirror(const MadeUpFace& face) {
  const auto count = static_cast<std::size_t>(face.performance.skin_rest.points.rows());
  const auto grid = static_cast<std::size_t>(face.performance.scan_vertices);
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(double(grid))));
  metrics::RestAsymmetry mirror;
  mirror.plane.normal = Vec3::UnitX();
  mirror.pairs = {std::vector<std::array<int, 3>>(count, {0, 0, 0}),
                  std::vector<Vec3>(count, Vec3::UnitX()),
                  Eigen::VectorXd::Zero(Eigen::Index(count)), std::vector<char>(count, 0)};
  for (std::size_t i = 0; i < grid; ++i) {
    const auto twin = int(i / side * side + (side - 1 - i % side));
    mirror.pairs.vertices[i] = {twin, twin, twin};
    mirror.pairs.found[i] = 1;
  }
  return mirror;
}

ReportVariant reported(const MadeUpFace& face, const MadeUpVariant& variant) {
  std::vector<PointsF> difference = variant.face.performance.skin_displacement_m;
  for (std::size_t f = 0; f < difference.size(); ++f)
    difference[f] -= face.performance.skin_displacement_m[f];
  return {.name = variant.name,
          .changes = {"tissue.region: name = " + variant.name + ", young_factor = 10"},
          .performance = variant.face.performance,
          .difference = displacement_modes(difference),
          .symmetry = &variant.face.symmetry,
          .tissue = variant.tissue};
}

}  // namespace hyperex::report::testing
