// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/options.hpp"

#include <gmock/gmock.h>

#include "hyperex/core/error.hpp"

namespace hyperex::simulate {
namespace {
using testing::AllOf;
using testing::HasSubstr;

std::string said_of(const SimulationOptions& options) {
  try {
    check(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SimulationOptions, DefaultsAreWhatTheProgramRuns) {
  const SimulationOptions options;
  EXPECT_EQ(said_of(options), "");
  EXPECT_EQ(options.model.element, fem::ElementKind::tet4_star) << "tet4 locks";
  EXPECT_EQ(options.drive.points.size(), 7u);
  EXPECT_EQ(options.drive.patch_radius_m, 0.008);
}

TEST(SimulationOptions, NamesEachValueOutOfRange) {
  SimulationOptions options;
  options.drive.patch_radius_m = 0.05;
  options.time.step_s = 0;
  options.tissue.uniform[tissue::poisson] = 0.5;
  EXPECT_THAT(said_of(options),
              AllOf(HasSubstr("drive.patch_radius_m = 0.05: expected a number from 0 to 0.03"),
                    HasSubstr("time.step_s = 0: expected"),
                    HasSubstr("tissue.poisson = 0.5: expected a number from -0.99 to 0.4999")));
}

TEST(SimulationOptions, NewmarksGammaIsAtMostTwiceBeta) {
  SimulationOptions options;
  options.solver.newmark_gamma = 0.6;
  EXPECT_THAT(said_of(options), HasSubstr("solver.newmark_gamma = 0.6: expected"));
  options.solver.newmark_beta = 0.3;
  EXPECT_EQ(said_of(options), "");
}

TEST(SimulationOptions, AllPointsAreThoseOfTheMotion) {
  motion::Motion motion;
  motion.names = {"a", "b"};
  DriveOptions drive;
  EXPECT_EQ(drive.names_in(motion).size(), 7u);
  drive.all_points = true;
  EXPECT_EQ(drive.names_in(motion), motion.names);
}

}  // namespace
}  // namespace hyperex::simulate
