// SPDX-License-Identifier: GPL-3.0-or-later
// Whether driven points are few: the fit, the summary and the report go by one count.
#include <gtest/gtest.h>

#include <memory>

#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/load/muscle_load.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

/// iBUG points `first` to `last`, and of the mouth the seven that usually drive where `seven`.
std::vector<std::string> driving_names(int first, int last, bool seven = false) {
  std::vector<std::string> names;
  if (seven) names = test::seven_points();
  for (int k = first; k <= last; ++k) names.push_back(face::ibug(k));
  return names;
}

bool are_few(const std::vector<std::string>& names, const io::Landmarks& landmarks) {
  Points rest(Eigen::Index(names.size()), 3);
  for (std::size_t i = 0; i < names.size(); ++i)
    rest.row(Eigen::Index(i)) = landmarks.at(names[i]).transpose();
  return few_points(rest, landmarks);
}

TEST(FewPoints, AreCountedBelowTheNoseAlone) {
  const io::Landmarks landmarks = test::small_face().landmarks;
  EXPECT_TRUE(are_few(test::seven_points(), landmarks));
  EXPECT_TRUE(are_few(driving_names(48, 67), landmarks)) << "20 of the mouth";
  EXPECT_TRUE(are_few(driving_names(17, 67), landmarks)) << "with 31 of brows, nose and lids";
  std::vector<std::string> with_chin = driving_names(48, 67);
  with_chin.push_back("ibug68_8");
  EXPECT_FALSE(are_few(with_chin, landmarks)) << "21";
  EXPECT_FALSE(are_few(face::all_ibug(), landmarks));
}

TEST(FewPoints, ARunSaysForWhatItsFitTookThem) {
  const test::SmallFace face = test::small_face();
  const auto mesh = std::make_shared<const tissue::TissueMesh>(face.mesh);
  const AlignedMotion motion =
      test::motion_of(face.landmarks, 3, 30, [](const std::string& name, const Vec3&, int k) {
        return Vec3(0, name == "ibug68_54" ? 0.001 * k : 0, 0);
      });
  SimulationOptions options;
  options.time.step_s = 0.01;
  options.drive.by = DriveBy::muscles;
  options.muscles.shape_prior = false;
  const auto few = [&](const std::vector<std::string>& names) {
    options.drive.points = names;
    return Simulator(mesh, face.landmarks, motion, options).run().performance.muscles.few_points;
  };
  const std::vector<std::string> with_brows_and_lids = driving_names(17, 47, true);
  ASSERT_GT(with_brows_and_lids.size(), std::size_t(kFewPoints));
  EXPECT_TRUE(few(with_brows_and_lids));
  EXPECT_FALSE(few(face::all_ibug()));
}

}  // namespace
}  // namespace hyperex::simulate
