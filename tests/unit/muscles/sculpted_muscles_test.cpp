// SPDX-License-Identifier: GPL-3.0-or-later
// The template's lines on the embedded face beside the muscles of a sculpted head
// (BodyParts3D 3.0).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/io/text_table.hpp"
#include "hyperex/muscles/muscle_lines.hpp"
#include "muscles/a_face.hpp"

namespace hyperex::muscles {
namespace {
namespace fs = std::filesystem;

/// The files' frame, m (x to the left, y backwards, z up, the midline at x = -0.65 mm), turned into
/// that of a face: x to the left, y up, z forward.
Vec3 upright(const Vec3& sculpted) {
  return {sculpted.x() + 0.65e-3, sculpted.z(), -sculpted.y()};
}

/// Muscles and points of the sculpted head.
class SculptedHead {
 public:
  explicit SculptedHead(fs::path folder)
      : folder_(std::move(folder)), table_(io::read_text_table(folder_ / "muscle_lines.csv")) {
    for (const auto& [name, at] : io::read_landmarks(folder_ / "landmarks.json"))
      points_[name] = upright(at);
  }
  const Vec3& point(const std::string& name) const { return points_.at(name); }
  /// "origin" or "insertion" of a muscle.
  Vec3 attachment(const std::string& muscle, const std::string& which) const {
    for (const auto& row : table_.rows) {
      if (row.front() != muscle) continue;
      const auto cell = [&](const char* axis) {
        const auto column = std::ranges::find(table_.names, which + axis) - table_.names.begin();
        return 1e-3 * std::stod(row[std::size_t(column)]);
      };
      return upright({cell("_x"), cell("_y"), cell("_z")});
    }
    throw std::out_of_range(muscle);
  }
  TriMesh mesh(const std::string& muscle) const {
    TriMesh out = io::read_mesh(folder_ / (muscle + ".stl"), io::LengthUnit::millimetre);
    for (auto point : out.points.rowwise()) point = upright(point.transpose()).transpose();
    return out;
  }

 private:
  fs::path folder_;
  io::TextTable table_;
  io::Landmarks points_;
};

/// The sculpted head has no skin. Places of the skin that its bones and rings give, by assumed
/// distances (mm), are laid on a face's landmarks; radial basis functions take the rest along.
class FaceFromSculpted {
 public:
  FaceFromSculpted(const SculptedHead& head, const io::Landmarks& face) {
    const std::string lids = "orbicularis_oculi_palpebral_L";
    const auto put = [&](const char* landmark, const Vec3& at, const Vec3& off_mm) {
      from_.push_back(at + 1e-3 * off_mm);
      to_.push_back(face.at(landmark));
    };
    put("nasion", head.point("nasion"), {0, 0, 6});
    put("subnasale", head.point("anterior_nasal_spine"), {0, -1, 10});
    put("pronasale", head.point("nasal_cartilage_tip"), {0, 0, 3});
    put("stomion", head.point("upper_incisor_edge"), {0, 2.5, 9});
    put("ibug68_8", head.point("menton_bone"), {0, -6, 3});
    for (const double side : {1., -1.}) {
      const auto both = [&](const std::string& landmark, const Vec3& at, const Vec3& off_mm) {
        const Vec3 mirror(side, 1, 1);
        put((landmark + (side > 0 ? "_L" : "_R")).c_str(), at.cwiseProduct(mirror),
            off_mm.cwiseProduct(mirror));
      };
      both("exocanthion", head.attachment(lids, "insertion"), {1, 0, 2});
      both("endocanthion", head.attachment(lids, "origin"), {2, 0, 1});
      // Where the opening of orbicularis oris ends.
      both("cheilion", 1e-3 * Vec3(23.5, 1468, 182), {0, 0, 0});
    }
    const Points from = rows_of(from_), to = rows_of(to_);
    similar_ = fit_similarity(from, to);
    const Points laid = similar_.apply(from);
    smooth_.emplace(laid, to - laid, RbfOptions{.polynomial = RbfPolynomial::affine});
  }
  Vec3 operator*(const Vec3& p) const {
    const Vec3 laid = similar_ * p;
    return laid + smooth_->at(laid);
  }
  TriMesh operator*(TriMesh mesh) const {
    for (auto point : mesh.points.rowwise()) point = (*this * Vec3(point.transpose())).transpose();
    return mesh;
  }
  double scale() const { return similar_.scale; }

 private:
  static Points rows_of(const std::vector<Vec3>& points) {
    Points out(Eigen::Index(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
      out.row(Eigen::Index(i)) = points[i].transpose();
    return out;
  }
  std::vector<Vec3> from_, to_;
  Similarity similar_;
  std::optional<Rbf> smooth_;
};

/// A muscle of the template and the sculpted one; what they may differ by, seen from in front.
struct TwoMuscles {
  const char *ours, *theirs;
  double most_mm;
  double most_deg;  ///< between the ways from origin to insertion; 0: a ring, which has none
};

// Beside what a trial in Python measured with the canonical face, up to 3 mm and 10 degrees of room
// (buccinator, which is short: 30 degrees): errors of 2 mm in the places above move them so far.
constexpr TwoMuscles kPairs[] = {
    {"zyg_major", "zygomaticus_major_L", 2.5, 12},
    {"zyg_minor", "zygomaticus_minor_L", 2.5, 16},
    {"lev_lab_sup", "levator_labii_superioris_L", 2.5, 8},
    {"lev_alaeque", "levator_labii_superioris_alaeque_nasi_L", 7.5, 28},
    {"lev_anguli", "levator_anguli_oris_L", 7, 35},
    {"risorius", "risorius_L", 9, 56},
    {"buccinator", "buccinator_L", 2.5, 40},
    {"dep_anguli", "depressor_anguli_oris_L", 3, 38},
    {"dep_lab_inf", "depressor_labii_inferioris_L", 2, 8},
    {"mentalis", "mentalis_L", 4, 60},
    {"frontal_med", "frontalis_L", 1.5, 14},
    {"frontal_lat", "frontalis_L", 1.5, 24},
    {"corrugator", "corrugator_supercilii_L", 4, 14},
    {"procerus", "procerus_L", 4, 8},
    {"nasalis", "nasalis_L", 8, 8},
    {"platysma", "platysma_L", 3.5, 32},
    {"malaris", "orbicularis_oculi_orbital_L", 5, 0},
    {"orb_oculi_lo", "orbicularis_oculi_orbital_L", 1.5, 0},
    {"orb_oculi_up", "orbicularis_oculi_orbital_L", 2, 0},
    {"orb_palpebral", "orbicularis_oculi_palpebral_L", 2, 0},
    {"oo_up_marg", "orbicularis_oris", 4, 0},
    {"oo_lo_marg", "orbicularis_oris", 4.5, 0},
    {"oo_up_per", "orbicularis_oris", 1.5, 0},
    {"oo_lo_per", "orbicularis_oris", 1.5, 0},
};

/// Seen from in front.
Vec3 flat(const Vec3& p) {
  return {p.x(), p.y(), 0};
}

/// Mean distance of the line's points, equally spaced, from a surface, mm.
double mean_distance_mm(const MuscleLine& line, const TriMesh& surface, bool from_in_front) {
  constexpr int count = 40;
  TriMesh seen = surface;
  if (from_in_front) seen.points.col(2).setZero();
  const SurfaceTree tree(seen);
  double sum_mm = 0;
  Eigen::Index piece = 0;
  for (int k = 0; k < count; ++k) {
    const double arc = line.arc.back() * k / (count - 1);
    while (piece + 2 < line.line.rows() && line.arc[std::size_t(piece) + 1] < arc) ++piece;
    const double from = line.arc[std::size_t(piece)], to = line.arc[std::size_t(piece) + 1];
    const double t = to > from ? std::clamp((arc - from) / (to - from), 0., 1.) : 0;
    const Vec3 p = (1 - t) * line.line.row(piece) + t * line.line.row(piece + 1);
    sum_mm += 1e3 * std::sqrt(tree.query(from_in_front ? flat(p) : p).squared_distance);
  }
  return sum_mm / count;
}

double angle_from_in_front_deg(const Vec3& a, const Vec3& b) {
  const double cosine = flat(a).normalized().dot(flat(b).normalized());
  return std::acos(std::clamp(cosine, -1., 1.)) * 180 / std::numbers::pi;
}

TEST(SculptedMuscles, LieWhereTheTemplateHasThem) {
  const fs::path folder = fs::path(HYPEREX_SHARED_DIR) / "data/bodyparts3d";
  if (!fs::exists(folder)) GTEST_SKIP() << "needs " << folder;
  const SculptedHead head(folder);
  const test::AFace& face = test::a_face();
  const FaceFromSculpted to_face(head, face.landmarks);
  EXPECT_GT(to_face.scale(), 1.0);
  EXPECT_LT(to_face.scale(), 1.2);
  std::map<std::string, MuscleLine> lines;
  for (MuscleLine& line : muscle_lines(muscle_template(), face.mesh, face.landmarks))
    lines[line.name] = std::move(line);
  for (const TwoMuscles& pair : kPairs) {
    const MuscleLine& line = lines.at(pair.ours + std::string("_L"));
    const TriMesh theirs = to_face * head.mesh(pair.theirs);
    const double front_mm = mean_distance_mm(line, theirs, true),
                 space_mm = mean_distance_mm(line, theirs, false);
    std::cout << fmt::format("  {:14} {:40} {:4.1f} mm from in front, {:4.1f} in space", pair.ours,
                             pair.theirs, front_mm, space_mm);
    EXPECT_LT(front_mm, pair.most_mm) << pair.ours;
    EXPECT_LT(space_mm, 20) << pair.ours;
    if (pair.most_deg > 0) {
      const Vec3 way = to_face * head.attachment(pair.theirs, "insertion") -
                       to_face * head.attachment(pair.theirs, "origin");
      const double angle_deg =
          angle_from_in_front_deg(line.line.row(line.line.rows() - 1) - line.line.row(0), way);
      std::cout << fmt::format(", {:3.0f} degrees", angle_deg);
      EXPECT_LT(angle_deg, pair.most_deg) << pair.ours;
    }
    std::cout << '\n';
  }
}

}  // namespace
}  // namespace hyperex::muscles
