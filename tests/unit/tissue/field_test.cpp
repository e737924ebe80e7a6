// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolation of tissue parameters between points.
#include <gmock/gmock.h>

#include <random>
#include <set>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/tissue/field/frontal.hpp"
#include "hyperex/tissue/field/harmonic.hpp"
#include "hyperex/tissue/field/points.hpp"
#include "hyperex/tissue/field/presets.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::tissue {
using namespace anatomy;
namespace {
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> no_margin(const TriMesh& mesh) {
  return std::vector<double>(std::size_t(mesh.points.rows()), 0);
}

std::vector<PlaceOnMesh> places(const TriMesh& mesh, const std::vector<Vec3>& at) {
  const SideTree tree(mesh, no_margin(mesh), Vec3::Zero(), 0);
  std::vector<PlaceOnMesh> list;
  for (const Vec3& p : at) list.push_back(tree.query(p, 0));
  return list;
}

Eigen::VectorXd harmonic(const TriMesh& mesh, const std::vector<Vec3>& at,
                         const Eigen::VectorXd& values) {
  return HarmonicField(mesh, joined_vertices(mesh.points, no_margin(mesh)), places(mesh, at))
      .solve(values);
}

/// The mesh with each triangle cut into four.
TriMesh refined(const TriMesh& mesh) {
  std::map<std::pair<int, int>, int> middle;
  TriMesh out{mesh.points, Triangles(4 * mesh.triangles.rows(), 3)};
  std::vector<Vec3> added;
  const auto between = [&](int a, int b) {
    const auto [entry, fresh] =
        middle.try_emplace(std::minmax(a, b), int(mesh.points.rows()) + int(added.size()));
    if (fresh) added.push_back((mesh.points.row(a) + mesh.points.row(b)).transpose() / 2);
    return entry->second;
  };
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
    const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
    out.triangles.row(4 * f) << a, ab, ca;
    out.triangles.row(4 * f + 1) << ab, b, bc;
    out.triangles.row(4 * f + 2) << ca, bc, c;
    out.triangles.row(4 * f + 3) << ab, bc, ca;
  }
  out.points.conservativeResize(mesh.points.rows() + Eigen::Index(added.size()), 3);
  for (std::size_t i = 0; i < added.size(); ++i)
    out.points.row(mesh.points.rows() + Eigen::Index(i)) = added[i].transpose();
  return out;
}

TEST(HarmonicField, LiesBetweenLeastAndGreatestOnSliversAndMeetsItsPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 5; ++trial) {
    // Nine times as long as wide, corners moved about: most triangles are obtuse.
    TriMesh mesh = test::sheet_mesh({20, 20}, {0.18, 0.02}).mesh;
    for (Eigen::Index v = 0; v < mesh.points.rows(); ++v)
      mesh.points.row(v) += Eigen::RowVector3d(3e-3 * share(random), 3e-4 * share(random), 0);
    std::vector<Vec3> at;
    Eigen::VectorXd values(4);
    for (int i = 0; i < 4; ++i) {
      at.push_back({0.02 + 0.045 * i + 0.01 * share(random), 0.002 + 0.016 * share(random), 0});
      values[i] = 100 + 400 * share(random);
    }
    const Eigen::VectorXd u = harmonic(mesh, at, values);
    EXPECT_GE(u.minCoeff(), values.minCoeff());
    EXPECT_LE(u.maxCoeff(), values.maxCoeff());
    const auto on = places(mesh, at);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(on[std::size_t(i)].value(u), values[i], 1e-9);
    EXPECT_GT(u.maxCoeff() - u.minCoeff(), 0.9 * (values.maxCoeff() - values.minCoeff()));
  }
}

TEST(HarmonicField, DoesNotDependOnTheDensityOfTheMesh) {
  const EmbeddedFace face = embedded_face();
  std::vector<Vec3> at;
  for (const char* name :
       {"cheek_L", "cheek_R", "crista_philtri_superior_L", "crista_philtri_superior_R",
        "cheilion_L", "cheilion_R", "alare_L", "alare_R", "pogonion"})
    at.push_back(face.landmarks.at(name));
  Eigen::VectorXd values(9);
  values << 162.7, 162.7, 148.9, 205.6, 116.5, 116.5, 216.9, 216.9, 120;
  const double range = values.maxCoeff() - values.minCoeff();
  const TriMesh fine = refined(face.mesh);
  const Eigen::VectorXd coarse_u = harmonic(face.mesh, at, values),
                        fine_u = harmonic(fine, at, values),
                        finest_u = harmonic(refined(fine), at, values);
  const Eigen::Index count = face.mesh.points.rows();
  const Eigen::VectorXd first = (coarse_u - fine_u.head(count)).cwiseAbs() / range,
                        second = (fine_u - finest_u.head(fine_u.size())).cwiseAbs() / range;
  RecordProperty("coarse_max", std::to_string(first.maxCoeff()));
  RecordProperty("fine_max", std::to_string(second.maxCoeff()));
  EXPECT_LT(first.maxCoeff(), 0.015);
  EXPECT_LT(first.mean(), 0.003);
  EXPECT_LT(second.maxCoeff(), 0.75 * first.maxCoeff());
  EXPECT_LT(second.mean(), 0.75 * first.mean());
}

TEST(HarmonicField, IsLinearAlongAStripFarFromItsPoints) {
  const TriMesh strip = test::sheet_mesh({100, 6}, {0.1, 0.006}).mesh;
  const Eigen::VectorXd u =
      harmonic(strip, {Vec3(0.002, 0.003, 0), Vec3(0.098, 0.003, 0)}, Eigen::Vector2d(10, 20));
  const auto at = [&](int i, int j) { return u[j * 101 + i]; };
  const double slope = at(60, 3) - at(50, 3);
  EXPECT_GT(slope, 1);
  EXPECT_NEAR(at(50, 3), 15, 1e-2);
  for (int j = 0; j <= 6; ++j) {
    EXPECT_NEAR(at(40, j) - at(30, j), slope, 1e-3 * slope);
    EXPECT_NEAR(at(70, j), at(70, 3), 1e-3 * slope);
  }
}

TEST(HarmonicField, PiecesThatNoPointReachesTakeTheNearestValue) {
  TriMesh mesh = test::sheet_mesh({4, 4}, {0.02, 0.02}).mesh;
  const Eigen::Index count = mesh.points.rows();
  mesh.points.conservativeResize(count + 3, 3);
  mesh.points.bottomRows(3) << 0.02, 0.03, 0, 0.03, 0.03, 0, 0.02, 0.04, 0;
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
  mesh.triangles.bottomRows(1) << int(count), int(count) + 1, int(count) + 2;
  const Eigen::VectorXd u =
      harmonic(mesh, {Vec3(0, 0, 0), Vec3(0.02, 0.02, 0)}, Eigen::Vector2d(1, 2));
  EXPECT_EQ(u[count], 2);
}

TEST(JoinedVertices, AreThoseAtOnePlaceSaveAcrossTheLips) {
  Points points(4, 3);
  points << 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0;
  EXPECT_THAT(joined_vertices(points, {0.01, 0.01, 0.01, -0.01}), ElementsAre(0, 0, 2, 3));
}

TEST(FrontalField, IsLinearOverTrianglesAndHeldBeyondTheirHull) {
  Eigen::MatrixX2d points(6, 2), places(4, 2);
  points << -3, 0, 3, 0.2, 0, 4, 0.3, -4, 1, 1, -1, 0.7;
  places << 0, 0, 0.4, 1.3, -1, 0.7, 0.2, -2;
  const auto value = [](const auto& p) { return 20 + 3 * p.x() - 2 * p.y(); };
  Eigen::VectorXd values(6);
  for (int i = 0; i < 6; ++i) values[i] = value(Eigen::Vector2d(points.row(i)));
  const FrontalField field(points);
  const Eigen::VectorXd u = field.at(places, values);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(u[i], value(Eigen::Vector2d(places.row(i))), 1e-12);
  EXPECT_NEAR(field.at(Eigen::RowVector2d(9, 0.2), values)[0], values[1], 1e-12);
}

TEST(FrontalField, OfPairsOnBothSidesIsAlikeOnBoth) {
  Eigen::MatrixX2d points(4, 2), places(2, 2);
  points << -2, 0, 2, 0, -1, 3, 1, 3;  // on one circle: either diagonal is Delaunay
  places << -0.6, 1.1, 0.6, 1.1;
  const Eigen::VectorXd u = FrontalField(points).at(places, Eigen::Vector4d(1, 1, 5, 5));
  EXPECT_NEAR(u[0], u[1], 1e-12);
  const Eigen::VectorXd left = FrontalField(points).at(places, Eigen::Vector4d(1, 2, 3, 7)),
                        right = FrontalField(points).at(places, Eigen::Vector4d(2, 1, 7, 3));
  EXPECT_NEAR(left[0], right[1], 1e-12);
}

TEST(FrontalField, OfFewPointsIsConstantOrAlongTheirLine) {
  Eigen::MatrixX2d points(3, 2), places(3, 2);
  points << 0, 0, 1, 1, 3, 3;
  places << 2, 2, 2.5, 1.5, -4, -4;
  EXPECT_THAT(FrontalField(points).at(places, Eigen::Vector3d(1, 2, 4)),
              testing::Pointwise(testing::DoubleNear(1e-12), {3.0, 3.0, 1.0}));
  EXPECT_THAT(FrontalField(points.topRows(1)).at(places, Eigen::Matrix<double, 1, 1>(7)),
              testing::Each(7.0));
}

class TissuePoints : public testing::Test {
 protected:
  std::vector<std::string> names(const std::vector<TissuePoint>& points, bool mirror = false) {
    options_.points = points;
    options_.mirror = mirror;
    problems_.clear();
    std::vector<std::string> list;
    for (const auto& p : resolve_points(options_, landmarks_, problems_))
      list.push_back(p.landmark);
    return list;
  }
  std::string problem(const std::vector<TissuePoint>& points, bool mirror = false) {
    names(points, mirror);
    return problems_.size() == 1 ? problems_[0].key + ": " + problems_[0].expected
                                 : std::to_string(problems_.size()) + " problems";
  }
  static TissuePoint at(const std::string& landmark, const std::string& side = "",
                        double young_pa = 1e5) {
    return {landmark, side, {young_pa}};
  }

  io::Landmarks landmarks_ = embedded_face().landmarks;
  TissueFieldOptions options_;
  std::vector<FieldProblem> problems_;
};

TEST_F(TissuePoints, WithoutASideAreBoth) {
  EXPECT_THAT(names({at("cheek")}), ElementsAre("cheek_L", "cheek_R"));
  EXPECT_THAT(names({at("cheek", "R")}), ElementsAre("cheek_R"));
  EXPECT_THAT(names({at("cheek_R")}), ElementsAre("cheek_R"));
  EXPECT_THAT(names({at("cheek_R", "R"), at("glabella")}), ElementsAre("cheek_R", "glabella"));
  EXPECT_THAT(names({at("ibug68_48", "R")}), ElementsAre("ibug68_48"));
  EXPECT_TRUE(problems_.empty());
}

TEST_F(TissuePoints, AreMirrored) {
  EXPECT_THAT(names({at("cheek_R"), at("ibug68_54"), at("pogonion")}, true),
              ElementsAre("cheek_R", "cheek_L", "ibug68_54", "ibug68_48", "pogonion"));
  EXPECT_THAT(names({at("cheek_R"), at("cheek_L")}, true), ElementsAre("cheek_R", "cheek_L"));
  EXPECT_TRUE(problems_.empty());
  EXPECT_THAT(problem({at("cheek_R"), at("cheek_L", "", 2e5)}, true),
              HasSubstr("point[1].landmark: one set of values"));
}

TEST_F(TissuePoints, OnTheWrongSideOrUnknownAreRefused) {
  EXPECT_EQ(problem({at("cheek_R", "L")}),
            "point[0].side: \"R\" or none, as cheek_R lies on the subject's right");
  EXPECT_THAT(problem({at("ibug68_48", "L")}), HasSubstr("\"R\" or none"));
  EXPECT_THAT(problem({at("glabella", "L")}), HasSubstr("no side, as glabella"));
  EXPECT_THAT(problem({at("antenna")}), HasSubstr("point[0].landmark: the name of a landmark"));
  EXPECT_THAT(problem({{"cheek", "", {}}}), HasSubstr("at least one of young_kpa"));
  std::swap(landmarks_["cheek_R"], landmarks_["cheek_L"]);
  EXPECT_THAT(problem({at("cheek", "R")}), HasSubstr("a landmark on the subject's right"));
}

TEST_F(TissuePoints, TakeThePlaceOfThePresets) {
  options_.preset = "source_model_2";
  const auto own = names({at("cheilion", "", 5e4)});
  EXPECT_EQ(own.size(), 10u);
  EXPECT_TRUE(problems_.empty());
  for (const auto& p : resolve_points(options_, landmarks_, problems_))
    if (p.landmark.starts_with("cheilion")) {
      EXPECT_EQ(p.value[young], 5e4);
      EXPECT_FALSE(p.value[viscosity]);
    }
}

TEST(TissuePresets, NameTheirSourcesAndKnownLandmarks) {
  std::set<std::string> names;
  const io::Landmarks landmarks = embedded_face().landmarks;
  for (const TissuePreset& preset : tissue_presets()) {
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    EXPECT_GT(preset.source.size(), 20u);
    TissueFieldOptions options;
    options.preset = preset.name;
    EXPECT_TRUE(problems_of(options, landmarks).empty()) << preset.name;
    for (int p = 0; p < parameter_count; ++p)
      EXPECT_TRUE(is_allowed(p, uniform_parameters(options)[p])) << preset.name;
  }
  const auto value = [](const char* preset, const char* landmark, Parameter p) {
    for (const TissuePoint& point : find_preset(preset)->points)
      if (point.landmark == landmark) return *point.value[p];
    return 0.0;
  };
  const char* right = "crista_philtri_superior_R";
  for (const Parameter p : {young, viscosity})
    EXPECT_NEAR(value("source_model_2", right, p) + value("source_model_3", right, p),
                2 * value("source_model_1", right, p), 1e-6);
  EXPECT_EQ(value("source_model_1", "alare", young), 216.9e3);
  TissueFieldOptions aged;
  aged.preset = "aged_skin";
  EXPECT_DOUBLE_EQ(uniform_parameters(aged)[young], 2 * default_parameters[young]);
}

}  // namespace
}  // namespace hyperex::tissue
