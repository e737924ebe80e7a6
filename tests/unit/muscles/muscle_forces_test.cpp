// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_forces.hpp"

#include <gtest/gtest.h>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/fem/element/tet4.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "muscles/a_face.hpp"

namespace hyperex::muscles {
namespace {

class MuscleForces : public testing::Test {
 protected:
  MuscleForces() {
    plain_.tangential = 0;
    plain_.midline_m = 0;
    for (const MuscleLine& line : lines_) index_[line.name] = &line;
  }
  const MuscleLine& line(const std::string& name) const { return *index_.at(name); }
  const TemplateMuscle& muscle(const std::string& name) const {
    return muscle_template()[std::size_t(line(name).row)];
  }
  /// |nodes| x 3.
  Points force(const std::string& name, const ForceShape& shape) const {
    return force(name, muscle(name), shape);
  }
  Points force(const std::string& name, const TemplateMuscle& muscle,
               const ForceShape& shape) const {
    const Eigen::VectorXd f = muscle_force(line(name), muscle, face_.mesh, face_.landmarks, shape);
    EXPECT_EQ(f.size(), 3 * face_.mesh.volume.nodes.rows());
    return Eigen::Map<const Points>(f.data(), f.size() / 3, 3);
  }
  Vec3 centre(Eigen::Index t) const {
    // To the last bit as the room has it: beside a corner of a line two pieces are equally near.
    return fem::corners_of(face_.mesh.volume.nodes, face_.mesh.volume.tets, t).colwise().mean();
  }
  double volume(Eigen::Index t) const {
    const auto& v = face_.mesh.volume;
    const auto edge = [&](int a) {
      return Vec3((v.nodes.row(v.tets(t, a)) - v.nodes.row(v.tets(t, 0))).transpose());
    };
    return edge(1).cross(edge(2)).dot(edge(3)) / 6;
  }
  /// Nodes of which every tetrahedron is such.
  template <class Such>
  std::vector<char> only_in(Such such) const {
    const auto& v = face_.mesh.volume;
    std::vector<char> nodes(std::size_t(v.nodes.rows()), 1);
    for (Eigen::Index t = 0; t < v.tets.rows(); ++t)
      if (!such(t))
        for (int a = 0; a < 4; ++a) nodes[std::size_t(v.tets(t, a))] = 0;
    return nodes;
  }
  double mean_margin(Eigen::Index t) const {
    const auto& v = face_.mesh.volume;
    double sum = 0;
    for (int a = 0; a < 4; ++a)
      sum += face_.mesh.upper_margin[std::size_t(v.tets(t, a) % v.surface_nodes())];
    return sum;
  }

  const test::AFace& face_ = test::a_face();
  const std::vector<MuscleLine> lines_ =
      muscle_lines(muscle_template(), face_.mesh, face_.landmarks);
  std::map<std::string, const MuscleLine*> index_;
  ForceShape plain_;  ///< nothing taken away
};

TEST_F(MuscleForces, OfAPullSumToItsIntegral) {
  for (const std::string name : {"zyg_major_L", "zyg_major_R", "frontal_med_L", "platysma_R"}) {
    const TemplateMuscle& m = muscle(name);
    const double reach_m =
        1e-3 * m.width_mm * (m.band > 0 ? m.band : plain_.band) * line(name).scale;
    Vec3 integral = Vec3::Zero();
    for (Eigen::Index t = 0; t < face_.mesh.volume.tets.rows(); ++t) {
      const OnLine on = nearest_on_line(line(name), centre(t));
      const double r = on.distance_m / reach_m, weight = std::exp(-r * r);
      const double ramp = m.ramp > 0 ? m.ramp : 6;
      if (weight >= 1e-3) integral -= weight * std::pow(on.share, ramp) * volume(t) * on.tangent;
    }
    const Vec3 sum = force(name, plain_).colwise().sum();
    EXPECT_LT((sum - integral).norm(), 1e-9 * integral.norm()) << name;
  }
}

TEST_F(MuscleForces, OfAPullPointToItsOrigin) {
  for (const MuscleLine& l : lines_) {
    if (muscle(l.name).kind != MuscleKind::pull) continue;
    const Eigen::Index last = l.line.rows() - 1;
    const Vec3 sum = force(l.name, plain_).colwise().sum();
    const Vec3 at_end =
        (l.line.row(std::max<Eigen::Index>(0, last - 3)) - l.line.row(last)).transpose();
    EXPECT_GT(sum.dot(at_end.normalized()), 0.8 * sum.norm()) << l.name;
    EXPECT_GT(sum.dot((l.line.row(0) - l.line.row(last)).transpose()), 0) << l.name;
  }
}

TEST_F(MuscleForces, GrowTowardsTheInsertion) {
  ForceShape even = plain_, late = plain_;
  even.ramp = 0, late.ramp = 12;
  TemplateMuscle own = muscle("risorius_L");
  own.ramp = 0;
  const auto share = [&](const ForceShape& shape) {
    const Points f = force("risorius_L", own, shape);
    double of = 0, all = 0;
    for (Eigen::Index n = 0; n < f.rows(); ++n) {
      const double size = f.row(n).norm();
      all += size;
      of += size * nearest_on_line(line("risorius_L"), face_.mesh.volume.nodes.row(n)).share;
    }
    return of / all;
  };
  EXPECT_LT(share(even), share(plain_));
  EXPECT_LT(share(plain_), share(late));
  own.ramp = 12;
  EXPECT_EQ(share(plain_), share(late)) << "a muscle's own goes before all muscles'";
}

TEST_F(MuscleForces, OfARingSumToNothingAndTurnNothing) {
  ForceShape cut = plain_;
  cut.midline_m = 0.005;
  for (const MuscleLine& l : lines_) {
    if (muscle(l.name).kind != MuscleKind::ring) continue;
    for (const ForceShape& shape : {plain_, cut}) {
      const Points f = force(l.name, shape);
      const double size = f.rowwise().norm().sum();
      ASSERT_GT(size, 0);
      EXPECT_LT(f.colwise().sum().norm(), 1e-9 * size) << l.name;
      Vec3 moment = Vec3::Zero();
      for (Eigen::Index n = 0; n < f.rows(); ++n)
        moment += Vec3(face_.mesh.volume.nodes.row(n)).cross(Vec3(f.row(n)));
      EXPECT_LT(moment.norm(), 1e-9 * size * 0.1) << l.name;
    }
  }
}

/// The forces of the stress do positive work in a motion u along the line's own direction that
/// shortens it.
TEST_F(MuscleForces, OfARingShortenItsLine) {
  for (const std::string name : {"oo_up_marg_L", "orb_oculi_lo_R", "oo_lo_per_L"}) {
    const Points f = force(name, plain_);
    const MuscleLine& l = line(name);
    const Vec3 middle = l.line.row(l.line.rows() / 2);
    double work = 0;  // of u = middle - x, which shortens every line by the same share
    for (Eigen::Index n = 0; n < f.rows(); ++n)
      work += f.row(n).dot(middle.transpose() - face_.mesh.volume.nodes.row(n));
    double wanted = 0;  // stress . strain = w (t . t)
    const TemplateMuscle& m = muscle(name);
    const double reach_m = 1e-3 * m.width_mm * m.band * l.scale;
    for (Eigen::Index t = 0; t < face_.mesh.volume.tets.rows(); ++t) {
      const double r = nearest_on_line(l, centre(t)).distance_m / reach_m;
      const bool upper = mean_margin(t) > 0;
      if (m.lip != MuscleLip::both && upper != (m.lip == MuscleLip::upper)) continue;
      if (std::exp(-r * r) >= 1e-3) wanted += std::exp(-r * r) * volume(t);
    }
    EXPECT_NEAR(work, wanted, 1e-9 * wanted) << name;
  }
}

TEST_F(MuscleForces, OfOneLipLeaveTheOtherAlone) {
  const auto of_lower = only_in([&](Eigen::Index t) { return mean_margin(t) <= 0; });
  const auto of_upper = only_in([&](Eigen::Index t) { return mean_margin(t) > 0; });
  for (const MuscleLine& l : lines_) {
    TemplateMuscle m = muscle(l.name);
    if (m.lip == MuscleLip::both) continue;
    const auto& other = m.lip == MuscleLip::upper ? of_lower : of_upper;
    const Points own = force(l.name, m, plain_);
    m.lip = MuscleLip::both;
    const Points both = force(l.name, m, plain_);
    int reached = 0;
    for (Eigen::Index n = 0; n < own.rows(); ++n) {
      if (!other[std::size_t(n)]) continue;
      EXPECT_EQ(own.row(n).norm(), 0) << l.name;
      reached += both.row(n).norm() > 0;
    }
    if (m.name.starts_with("oo_")) {
      EXPECT_GT(reached, 10) << l.name;
    }
  }
}

TEST_F(MuscleForces, EndAtTheMidline) {
  const face::FaceFrame frame = face::face_frame(face_.landmarks);
  ForceShape cut = plain_;
  cut.midline_m = 0.005;
  for (const MuscleLine& l : lines_) {
    const double side = l.left ? 1 : -1;
    const auto beyond =
        only_in([&](Eigen::Index t) { return side * frame.local(centre(t)).x() < -cut.midline_m; });
    const auto own =
        only_in([&](Eigen::Index t) { return side * frame.local(centre(t)).x() > cut.midline_m; });
    const Points f = force(l.name, cut), uncut = force(l.name, plain_);
    int reached = 0;
    for (Eigen::Index n = 0; n < f.rows(); ++n) {
      if (beyond[std::size_t(n)]) {
        EXPECT_EQ(f.row(n).norm(), 0) << l.name;
        reached += uncut.row(n).norm() > 0;
      }
      if (own[std::size_t(n)]) {
        EXPECT_EQ(f.row(n), uncut.row(n)) << l.name;
      }
    }
    if (muscle(l.name).name.starts_with("oo_")) {
      EXPECT_GT(reached, 5) << l.name;
    }
  }
}

/// On the midline itself the force is halved.
TEST_F(MuscleForces, FadeEvenlyAcrossTheMidline) {
  ForceShape cut = plain_;
  cut.midline_m = 0.005;
  const face::FaceFrame frame = face::face_frame(face_.landmarks);
  const Points f = force("procerus_L", cut);
  Vec3 wanted = Vec3::Zero();
  const MuscleLine& l = line("procerus_L");
  const double reach_m = 1e-3 * muscle(l.name).width_mm * cut.band * l.scale;
  for (Eigen::Index t = 0; t < face_.mesh.volume.tets.rows(); ++t) {
    const OnLine on = nearest_on_line(l, centre(t));
    const double x = frame.local(centre(t)).x() / cut.midline_m, r = on.distance_m / reach_m;
    const double u = std::clamp(0.5 + 0.5 * x, 0.0, 1.0);
    const double weight = std::exp(-r * r) * (3 - 2 * u) * u * u;
    if (weight >= 1e-3) wanted -= weight * std::pow(on.share, 6) * volume(t) * on.tangent;
  }
  EXPECT_LT((f.colwise().sum().transpose() - wanted).norm(), 1e-9 * wanted.norm());
}

TEST_F(MuscleForces, LoseAShareAcrossTheSkin) {
  const Points normals = vertex_normals(face_.mesh.volume.outer);
  ForceShape part = plain_, along = plain_;
  part.tangential = 0.54, along.tangential = 1;
  const std::string name = "lev_anguli_L";
  const Points whole = force(name, plain_), some = force(name, part), none = force(name, along);
  double across = 0;
  for (Eigen::Index n = 0; n < whole.rows(); ++n) {
    const Vec3 normal = normals.row(n % face_.mesh.volume.surface_nodes());
    const Vec3 f = whole.row(n);
    across = std::max(across, std::abs(f.dot(normal)) / std::max(f.norm(), 1e-30));
    EXPECT_LT((some.row(n).transpose() - (f - 0.54 * f.dot(normal) * normal)).norm(),
              1e-9 * f.norm() + 1e-30);
    EXPECT_LT(std::abs(none.row(n).dot(normal)), 1e-9 * f.norm() + 1e-30);
  }
  EXPECT_GT(across, 0.3) << "it pulls across the skin too";
}

}  // namespace
}  // namespace hyperex::muscles
