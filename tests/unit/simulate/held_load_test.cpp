// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/held_load.hpp"

#include <gmock/gmock.h>

#include <map>
#include <random>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/static_solve.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {
using testing::HasSubstr;

const std::vector<std::string> kNames = {"zyg_major_L", "zyg_major_R", "malaris_L",
                                         "malaris_R",   "mentalis_L",  "mentalis_R"};

Eigen::VectorXd gains(const std::vector<MuscleGain>& of) {
  return muscle_gains(kNames, of);
}

TEST(MuscleGains, NameAMuscleABranchOrASide) {
  using V = Eigen::Matrix<double, 6, 1>;
  EXPECT_EQ(gains({}), V::Ones());
  EXPECT_EQ(gains({{"zyg_major_R", 0.5}}), (V() << 1, 0.5, 1, 1, 1, 1).finished());
  EXPECT_EQ(gains({{"zygomatic_L", 0.2}}), (V() << 0.2, 1, 0.2, 1, 1, 1).finished());
  EXPECT_EQ(gains({{"mandibular_R", 0}}), (V() << 1, 1, 1, 1, 1, 0).finished());
  EXPECT_EQ(gains({{"side_R", 0.25}}), (V() << 1, 0.25, 1, 0.25, 1, 0.25).finished());
  EXPECT_EQ(gains({{"side_R", 0.5}, {"zygomatic_R", 0.5}, {"malaris_R", 2}}),
            (V() << 1, 0.25, 1, 0.5, 1, 0.5).finished())
      << "several multiply";
}

TEST(MuscleGains, AnUnknownNameIsToldWithThoseThereAre) {
  const std::map<std::string, std::string> reported = {
      {"zyg_major", "did you mean zyg_major_R or zyg_major_L?"},
      {"zygomatic", "did you mean zygomatic_R or zygomatic_L?"},
      {"zyg_major_l", "did you mean zyg_major_L?"},
      {"side", "did you mean side_R or side_L?"},
      {"", "one of side_R, side_L, zygomatic_R"},
      {"temporal_L", "is no muscle"}};
  for (const auto& [name, expected] : reported)
    EXPECT_THAT(hyperex::test::refusal([&, name = name] {
                  gains({{name, 1}});
                }),
                testing::AllOf(HasSubstr("muscles.gain"), HasSubstr(name + " is no muscle"),
                               HasSubstr(expected)));
}

TEST(MuscleGains, EveryNameIsListed) {
  const std::vector<std::string> names = muscles::gain_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ(names.size(), 2 * (muscles::muscle_template().size() + 5 + 1));
  std::vector<std::string> all;
  for (const auto& muscle : muscles::muscle_template())
    for (const char* side : {"_L", "_R"}) all.push_back(muscle.name + side);
  for (const std::string& name : names) EXPECT_NO_THROW(muscle_gains(all, {{name, 0.5}})) << name;
}

TEST(CommonChange, IsTheSmallestOfOneSign) {
  const Eigen::Vector4d change(-1, -0.4, 0.5, 0);
  EXPECT_EQ(common_change(change, {0, 1}), -0.4);
  EXPECT_EQ(common_change(change, {1, 0}), -0.4);
  EXPECT_EQ(common_change(change, {2}), 0.5);
  EXPECT_EQ(common_change(change, {0, 2}), 0) << "one is weaker, one stronger";
  EXPECT_EQ(common_change(change, {0, 1, 3}), 0) << "one is as it was";
  EXPECT_EQ(common_change(change, {}), 0);
  EXPECT_EQ(common_change(-2 * change, {0, 1}), 0.8) << "multiples of a change";
}

TEST(GroupSums, AddMusclesOfAGroupAndASide) {
  MuscleCourse course;
  course.names = kNames;
  course.activation = Eigen::MatrixXd::Random(6, 3);
  const auto group = [](const char* muscle) { return muscles::find_muscle(muscle)->group; };
  ASSERT_NE(group("zyg_major"), group("mentalis"));
  muscles::MuscleTable table = muscles::muscle_template();
  for (muscles::TemplateMuscle& muscle : table)
    if (muscle.name == "malaris") muscle.group = group("zyg_major");
  const Eigen::MatrixXd sums =
      group_sums(course, {group("mentalis") + "_R", group("zyg_major") + "_L", "none_L"}, table);
  ASSERT_EQ(sums.rows(), 3);
  EXPECT_EQ(sums.row(0), course.activation.row(5));
  EXPECT_EQ(sums.row(1), course.activation.row(0) + course.activation.row(2));
  EXPECT_EQ(sums.row(2).norm(), 0);
  EXPECT_EQ(group_sums(MuscleCourse{}, {"none_L"}, table).cols(), 0);
}

TEST(ChangedMuscles, AreMirroredAndThenScaled) {
  MuscleCourse course;
  course.names = kNames;
  course.time_s = {0, 1};
  course.activation.resize(6, 2);
  course.activation << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12;
  course.sigma = 0.1 * course.activation;
  course.prior_sigma = 0.3 * course.activation;
  MuscleOptions options;
  options.mirrored = true;
  options.gains = {{"zyg_major_L", 0.5}};
  const MuscleCourse out = changed_muscles(course, options);
  Eigen::MatrixXd wanted(6, 2);
  wanted << 1.5, 2, 1, 2, 7, 8, 5, 6, 11, 12, 9, 10;
  EXPECT_LT((out.activation - wanted).norm(), 1e-15);
  EXPECT_LT((out.sigma - 0.1 * wanted).norm(), 1e-15);
  EXPECT_LT((out.prior_sigma - 0.3 * wanted).norm(), 1e-14);
  EXPECT_EQ(out.names, kNames);
  options.gains.clear();
  EXPECT_EQ(changed_muscles(changed_muscles(course, options), options).activation,
            course.activation)
      << "twice mirrored";
}

class LoadOfMuscles : public testing::Test {
 protected:
  static constexpr int kUnknowns = 60, kOthers = 4, kSamples = 9, kStepsBetween = 5;
  static constexpr double kDt = 0.01;

  LoadOfMuscles() {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const auto matrix = [&](Eigen::Index rows, Eigen::Index cols) {
      return Eigen::MatrixXd(
          Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); }));
    };
    load_.muscles.names = kNames;
    load_.wide_bands = true;
    const Eigen::Index columns = 12 + kOthers;
    load_.force = matrix(kUnknowns, columns);
    load_.force.rightCols(kOthers) *= 1e4;  // the jaw's are far greater than a muscle's
    load_.course = matrix(columns, kSamples);
    load_.course.bottomRows(kOthers) *= 1e-4;
    load_.course.col(0).setZero();
    for (int k = 0; k < kSamples; ++k) load_.time_s.push_back(k * kStepsBetween * kDt);
    load_.muscles.time_s = load_.time_s;
  }
  fem::Drive drive() const {
    return drive_of(load_, options_, kDt, (kSamples + 2) * kStepsBetween, 1e-9, 7);
  }
  /// The drive's forces at the samples are `wanted` (a column each).
  void expect_at_samples(const Eigen::MatrixXd& wanted) const {
    const fem::Drive drive = this->drive();
    ASSERT_EQ(drive.force.rows(), kUnknowns);
    ASSERT_EQ(drive.prescribed.rows(), 7);
    EXPECT_EQ(drive.prescribed.cwiseAbs().maxCoeff(), 0) << "nothing prescribed moves";
    for (int k = 0; k < kSamples + 2; ++k)
      EXPECT_LT((drive.force_at(k * kStepsBetween) - wanted.col(std::min(k, kSamples - 1))).norm(),
                1e-6 * wanted.norm())
          << k;
  }

  HeldLoad load_;
  MuscleOptions options_;
};

TEST_F(LoadOfMuscles, IsTheSamplesAndHeldAfterTheLast) {
  expect_at_samples(load_.force * load_.course);
  const fem::Drive drive = this->drive();
  EXPECT_LT((drive.force * drive.rate.col(0)).norm(), 1e-6 * load_.force.norm())
      << "begins at rest";
}

TEST_F(LoadOfMuscles, OfGainNothingLeavesTheJawAndTheLeftOver) {
  options_.gains = {{"side_L", 0}, {"side_R", 0}};
  expect_at_samples(load_.force.rightCols(kOthers) * load_.course.bottomRows(kOthers));
}

TEST_F(LoadOfMuscles, ScalesBothBandsOfAMuscle) {
  options_.gains = {{"zyg_major_R", 0.3}, {"mentalis_L", 2}};
  Eigen::MatrixXd course = load_.course;
  for (const int row : {1, 6 + 1}) course.row(row) *= 0.3;
  for (const int row : {4, 6 + 4}) course.row(row) *= 2;
  expect_at_samples(load_.force * course);
}

TEST_F(LoadOfMuscles, AsRecordedAndWhatGainsAddAreTheLoadWithGains) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(6);
  change[1] = -0.7, change[4] = 1;
  const HeldLoad added = added_by_gains(load_, change);
  EXPECT_EQ(added.force.cols(), 4) << "two bands each of the two that change";
  EXPECT_EQ(added.time_s, load_.time_s);
  EXPECT_TRUE(added.muscles.names.empty());
  Eigen::MatrixXd course = load_.course;
  for (const int row : {1, 6 + 1}) course.row(row) *= 0.3;
  for (const int row : {4, 6 + 4}) course.row(row) *= 2;
  const Eigen::MatrixXd wanted = load_.force * course;
  EXPECT_LT((load_.force * load_.course + added.force * added.course - wanted).norm(),
            1e-12 * wanted.norm());
}

/// Motion that the fit leaves unexplained fades as far as all muscles do that may make it.
TEST_F(LoadOfMuscles, UnexplainedMotionFadesWithItsMakers) {
  load_.force.conservativeResize(Eigen::NoChange, 12 + 12 + 3);
  load_.course.conservativeResize(12 + 12 + 3, Eigen::NoChange);
  load_.force.rightCols(27 - 16).setRandom();
  load_.course.bottomRows(27 - 16).setRandom();
  load_.course.col(0).setZero();
  load_.parts = {0, 1, 2};
  load_.part_makers = {{0, 2}, {1}, {}};
  options_.gains = {{"zyg_major_L", 0.2}, {"malaris_L", 0.5}, {"zyg_major_R", 0}};
  Eigen::MatrixXd course = load_.course;
  for (const int band : {0, 6}) {
    course.row(band) *= 0.2;
    course.row(band + 1).setZero();
    course.row(band + 2) *= 0.5;
  }
  course.row(24) *= 0.5;
  course.row(25).setZero();
  const Eigen::MatrixXd wanted = load_.force * course;
  expect_at_samples(wanted);
  const HeldLoad added =
      added_by_gains(load_, muscle_gains(load_.muscles.names, options_.gains).array() - 1);
  EXPECT_EQ(added.force.cols(), 2 * 3 + 2);
  EXPECT_LT((load_.force * load_.course + added.force * added.course - wanted).norm(),
            1e-12 * wanted.norm());
  options_.gains = {{"zyg_major_L", 0.2}};
  course = load_.course;
  for (const int row : {0, 6}) course.row(row) *= 0.2;
  expect_at_samples(load_.force * course);
}

TEST_F(LoadOfMuscles, ForcesOfFiniteStrainFadeWithTheMakersOfTheirParts) {
  NodalCourse forces;
  forces.nodes = {4, 9};
  forces.take(0, Eigen::VectorXd::Zero(6));
  forces.take(1, Eigen::VectorXd::Ones(6));
  options_.gains = {{"zyg_major_L", 0}, {"malaris_L", 0.5}};
  EXPECT_EQ(patch_forces_with(load_, options_), nullptr);
  load_.patch_forces = std::make_shared<const NodalCourse>(forces);
  EXPECT_EQ(patch_forces_with(load_, options_), load_.patch_forces) << "of no part";
  load_.part_makers = {{0, 2}, {1}, {}};
  load_.patch_shares = Eigen::MatrixXd{{0.8, 0.1, 0.1}, {0, 1, 0}};
  const auto weak = patch_forces_with(load_, options_);
  EXPECT_EQ(weak->nodes, forces.nodes);
  EXPECT_LT((weak->value[1] - (Eigen::VectorXd(6) << 0.6, 0.6, 0.6, 1, 1, 1).finished()).norm(),
            1e-12);
  options_.gains.clear();
  EXPECT_EQ(patch_forces_with(load_, options_), load_.patch_forces);
}

TEST_F(LoadOfMuscles, MirroredEachTakesItsCounterpartsCourse) {
  options_.mirrored = true;
  options_.gains = {{"malaris_L", 0.5}};  // of the muscle that acts, after mirroring
  Eigen::MatrixXd course = load_.course;
  for (int row = 0; row < 12; row += 2) course.row(row).swap(course.row(row + 1));
  for (const int row : {2, 6 + 2}) course.row(row) *= 0.5;
  expect_at_samples(load_.force * course);
}

TEST_F(LoadOfMuscles, WithoutMuscleNamesIsAsItStands) {
  load_.muscles = {};
  options_.mirrored = true;
  expect_at_samples(load_.force * load_.course);
}

/// Between samples the course is the C2 cubic spline at rest at both ends. A cubic that is at rest
/// at both ends is its own spline.
TEST_F(LoadOfMuscles, BetweenSamplesIsTheSpline) {
  const double end = load_.time_s.back();
  const auto smooth = [&](double t) {
    return t >= end ? 1 : t * t * (3 * end - 2 * t) / std::pow(end, 3);
  };
  for (int k = 0; k < kSamples; ++k) load_.course.col(k).setConstant(smooth(load_.time_s[k]));
  const Eigen::VectorXd whole = load_.force.rowwise().sum();
  const fem::Drive drive = this->drive();
  for (int k = 0; k <= drive.steps(); ++k)
    EXPECT_LT((drive.force_at(k) - smooth(k * kDt) * whole).norm(), 1e-6 * whole.norm()) << k;
}

TEST_F(LoadOfMuscles, OfWeightsStaysBetweenItsSamples) {
  load_.smooth_up_to_s = 0;
  for (int k = 0; k < kSamples; ++k) load_.course.col(k).setConstant(k >= 3 && k < 6 ? 1 : 0);
  const Eigen::VectorXd whole = load_.force.rowwise().sum();
  const fem::Drive drive = this->drive();
  for (int k = 3 * kStepsBetween; k <= 5 * kStepsBetween; ++k)
    EXPECT_LT((drive.force_at(k) - whole).norm(), 1e-6 * whole.norm()) << k;
  EXPECT_EQ(added_by_gains(load_, Eigen::VectorXd::Ones(6)).smooth_up_to_s, 0);
}

/// The stiffness of a chain with some cross-links; symmetric positive definite.
fem::SparseMatrix stiffness(int n) {
  Eigen::MatrixXd k = 0.3 * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i)
    for (const int far : {1, 5})
      if (i + far < n) {
        const double s = 1 + 0.1 * i + far;
        k(i, i) += s, k(i + far, i + far) += s;
        k(i, i + far) -= s, k(i + far, i) -= s;
      }
  return k.sparseView();
}

TEST(ReactionsOf, MoveItAsWhatWasPrescribed) {
  constexpr int n = 30;
  const fem::SparseMatrix k = stiffness(n);
  const std::vector<int> prescribed = {0, 4, 5, 17, 29};
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  const auto matrix = [&](Eigen::Index rows, Eigen::Index cols) {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); }));
  };
  for (const bool forces : {true, false}) {
    fem::Drive drive;
    drive.prescribed = matrix(5, 3);
    drive.prescribed.row(0).setZero();  // held
    if (forces) drive.force = matrix(n, 3);
    drive.s = matrix(3, 11);
    drive.rate = drive.second = Eigen::MatrixXd::Zero(3, 11);
    const HeldLoad load = reactions_of(drive, k, prescribed, 0.02);
    EXPECT_TRUE(load.muscles.names.empty());
    EXPECT_EQ(load.course, drive.s);
    ASSERT_EQ(load.time_s.size(), 11u);
    EXPECT_DOUBLE_EQ(load.time_s[10], 0.2);
    const fem::StaticSolver whole(k, prescribed), released(k, {0});
    for (int step = 0; step < 11; ++step) {
      const Eigen::VectorXd wanted = whole.solve(drive.prescribed_at(step).d, drive.force_at(step));
      const Eigen::VectorXd got =
          released.solve(Eigen::VectorXd::Zero(1), load.force * load.course.col(step));
      EXPECT_LT((got - wanted).norm(), 1e-10 * wanted.norm()) << step;
    }
  }
}

TEST(MusclesUntil, EndWithTheRun) {
  MuscleCourse whole;
  whole.names = {"zyg_major_L"};
  whole.time_s = {0, 0.4, 0.8};
  whole.activation = Eigen::MatrixXd{{0, 0.2, 0.9}};
  whole.sigma = Eigen::MatrixXd{{0.1, 0.2, 0.3}};
  whole.group_activation = Eigen::MatrixXd{{0, 1, 2}, {0, 3, 6}};
  whole.jaw_opening_deg = Eigen::Vector3d(0, 4, 28);
  const MuscleCourse at_a_sample = muscles_until(whole, 0.4);
  EXPECT_EQ(at_a_sample.time_s, (std::vector<double>{0, 0.4}));
  EXPECT_EQ(at_a_sample.activation, (Eigen::MatrixXd{{0, 0.2}}));
  const MuscleCourse between = muscles_until(whole, 0.5);
  ASSERT_EQ(between.time_s, (std::vector<double>{0, 0.4, 0.5}));
  EXPECT_NEAR(between.activation(0, 2), 0.2 + 0.25 * 0.7, 1e-12);
  EXPECT_NEAR(between.sigma(0, 2), 0.225, 1e-12);
  EXPECT_NEAR(between.group_activation(1, 2), 3.75, 1e-12);
  EXPECT_NEAR(between.jaw_opening_deg[2], 10, 1e-12);
  EXPECT_EQ(between.prior_sigma.size(), 0) << "not known";
  for (const double end_s : {0.8, 3.0}) {
    EXPECT_EQ(muscles_until(whole, end_s).time_s, whole.time_s);
    EXPECT_EQ(muscles_until(whole, end_s).activation, whole.activation);
  }
  HeldLoad load;
  load.muscles = whole;
  EXPECT_NEAR(greatest_opening_deg(load, 0.5), 10, 1e-12);
  EXPECT_EQ(greatest_opening_deg(load, 0.8), 28);
  load.muscles = {};
  load.greatest_opening_deg = 7;
  EXPECT_EQ(greatest_opening_deg(load, 0.5), 7) << "no muscles drive";
}

TEST(HardlyUsedText, NamesAMuscleThatTheRecordingUsesLessThanItIsKnown) {
  MuscleCourse recorded;
  recorded.names = {"zyg_major_L", "zyg_major_R"};
  recorded.activation = Eigen::MatrixXd{{0, 0.9}, {0.1, 0.2}};
  recorded.sigma = Eigen::MatrixXd{{0.3, 0.3}, {0.4, 0.42}};
  const auto text = [&](const std::vector<MuscleGain>& gains) {
    MuscleOptions options;
    options.gains = gains;
    return hardly_used_text(recorded, options);
  };
  EXPECT_THAT(text({{"zyg_major_R", 0.3}}), testing::AllOf(testing::HasSubstr("zyg_major_R is"),
                                                           testing::HasSubstr("0.20 +- 0.42")));
  EXPECT_EQ(text({{"zyg_major_L", 0.3}}), "") << "it is known";
  EXPECT_EQ(text({{"zyg_major_L", 0.3}, {"zyg_major_R", 0.3}}), "") << "one of them is known";
  EXPECT_EQ(text({{"zyg_major_R", 1}}), "") << "nothing changes";
  EXPECT_EQ(text({}), "");
  recorded = {};
  EXPECT_EQ(text({{"zyg_major_R", 0.3}}), "") << "no muscles drive";
}

TEST(HardlyUsedText, AdvisesNoGainOnABranchThatAllHave) {
  MuscleCourse recorded;
  recorded.names = {"zyg_major_R", "zyg_minor_R", "zyg_minor_L", "frontal_med_R"};
  recorded.activation = Eigen::MatrixXd::Constant(4, 2, 0.1);
  recorded.sigma = Eigen::MatrixXd::Constant(4, 2, 0.4);
  const auto advises_branch = [&](const std::vector<MuscleGain>& gains) {
    MuscleOptions options;
    options.gains = gains;
    const std::string text = hardly_used_text(recorded, options);
    EXPECT_THAT(text, testing::HasSubstr("a broad smile,")) << "it hardly uses any";
    return text.find("smile, or a gain on the whole branch of the nerve shows more") !=
           std::string::npos;
  };
  EXPECT_TRUE(advises_branch({{"zyg_major_R", 0.3}}));
  EXPECT_FALSE(advises_branch({{"zygomatic_R", 0.3}}));
  EXPECT_FALSE(advises_branch({{"side_R", 0.7}}));
  EXPECT_FALSE(advises_branch({{"zyg_major_R", 0.3}, {"zyg_minor_R", 0.3}})) << "all of it";
  EXPECT_FALSE(advises_branch({{"frontal_med_R", 0.3}})) << "alone on its branch";
}

}  // namespace
}  // namespace hyperex::simulate
