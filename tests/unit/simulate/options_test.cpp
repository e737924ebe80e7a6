// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/options.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "hyperex/core/error.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string said_of(const SimulationOptions& options) {
  return hyperex::test::refusal([&] { check(options); });
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
  options.tissue.uniform[tissue::young] = -5;
  EXPECT_THAT(said_of(options),
              AllOf(HasSubstr("drive.patch_radius_m = 0.05: expected a number from 0 to 0.03"),
                    HasSubstr("time.step_s = 0: expected"),
                    HasSubstr("tissue.poisson = 0.5: expected a number from -0.99 to 0.4999"),
                    HasSubstr("tissue.young_pa = -5: expected a number from 1 to 1e+09 Pa")));
}

/// Calls `visit(name, at, details)` for each described number, also in rows; to each list of rows
/// one row is added.
template <class Outer, class Visit>
struct Numbers {
  Outer outer;
  std::string prefix;
  const Visit& visit;

  template <class At>
  void option(const char* name, At at, const char*, const OptionDetails& details = {}) {
    const auto through = [ *this, at ](SimulationOptions & o) -> auto& {
      return at(outer(o));
    };
    using Value = std::remove_cvref_t<decltype(through(std::declval<SimulationOptions&>()))>;
    if constexpr (Described<Value>) {
      Numbers<decltype(through), Visit> inner{through, prefix + name + ".", visit};
      Value::describe(inner);
    } else if constexpr (std::is_same_v<Value, double>) {
      visit(prefix + name, through, details);
    } else if constexpr (requires { typename Value::value_type; }) {
      using Row = typename Value::value_type;
      const auto first = [through](SimulationOptions & o) -> auto& {
        if (through(o).empty()) through(o).push_back(Row{});
        return through(o).front();
      };
      if constexpr (Described<Row>) {
        Numbers<decltype(first), Visit> inner{first, prefix + name + "[0].", visit};
        Row::describe(inner);
      } else if constexpr (std::is_same_v<Row, double>) {
        visit(prefix + name + "[0]", first, details);
      }
    }
  }
  template <class At, class AllAt>
  void one_or_all(const char*, At, const char*, AllAt, const char*) {}
  template <class At, class Words>
  void factors(const char* name, At at, const Words&, const char*, const OptionDetails& details) {
    option(name, at, "", details);
  }
};

TEST(SimulationOptions, BoundsOfEveryNumberHold) {
  int count = 0;
  const auto visit = [&](const std::string& name, const auto& at, const OptionDetails& details) {
    const auto said_with = [&](double value) {
      SimulationOptions options;
      options.solver.newmark_beta = 1;      // below it newmark_gamma has less room
      options.drive.by = DriveBy::muscles;  // else without gains
      at(options) = value;
      return said_of(options);
    };
    SCOPED_TRACE(name);
    const Bounds& bounds = details.bounds;
    ASSERT_TRUE(bounds.limited());
    for (const double wrong : {std::nextafter(bounds.least, -1e300),
                               std::nextafter(bounds.most, 1e300), std::nan(""), HUGE_VAL})
      EXPECT_THAT(said_with(wrong), HasSubstr(name + " = ")) << wrong;
    for (const double right : {bounds.least, bounds.most})
      EXPECT_THAT(said_with(right), Not(HasSubstr(name + " = "))) << right;
    ++count;
  };
  const auto itself = [](SimulationOptions & options) -> auto& {
    return options;
  };
  Numbers<decltype(itself), decltype(visit)> numbers{itself, "", visit};
  SimulationOptions::describe(numbers);
  EXPECT_GE(count, 25);
}

TEST(SimulationOptions, ListsHaveTheLengthsThatAreDescribed) {
  SimulationOptions options;
  options.drive.by = DriveBy::muscles;
  options.surgery.bones = {{.part = BonePart::mandible, .move_m = {0, 0.001}}};
  EXPECT_THAT(said_of(options), HasSubstr("move_m = 2 of them: expected 3"));
  options.surgery.bones[0].move_m = {0, 0.001, 0, 0};
  EXPECT_THAT(said_of(options), HasSubstr("move_m = 4 of them: expected 3"));
  options.surgery.bones[0].move_m = {};
  EXPECT_THAT(said_of(options), HasSubstr("move_m = 0 of them: expected 3"));
  options.surgery.bones[0].move_m = {0, 0.001, 0};
  EXPECT_EQ(said_of(options), "");
}

TEST(SimulationOptions, RatiosOfALawAreRefusedTogether) {
  SimulationOptions options;
  options.model.law.c20 = -1;
  EXPECT_EQ(said_of(options), "") << "small strain has no law";
  options.model.strain = Strain::finite;
  EXPECT_THAT(said_of(options), HasSubstr("model.law.c20 = -1: expected at least 0"));
  options.model.law.c30 = 1 / 3.0;
  EXPECT_EQ(said_of(options), "");
}

TEST(SimulationOptions, NewmarksGammaIsAtMostTwiceBeta) {
  SimulationOptions options;
  options.solver.newmark_gamma = 0.6;
  EXPECT_THAT(said_of(options), HasSubstr("solver.newmark_gamma = 0.6: expected"));
  options.solver.newmark_beta = 0.3;
  EXPECT_EQ(said_of(options), "");
}

TEST(SimulationOptions, AllPointsAreThoseThatSkinCanFollow) {
  motion::Motion motion;
  motion.names = {"a", "head_1", "b", "stomion"};
  DriveOptions drive;
  EXPECT_EQ(drive.names_in(motion).size(), 7u);
  drive.all_points = true;
  EXPECT_EQ(drive.names_in(motion), (std::vector<std::string>{"a", "head_1", "b"}));
  motion.skull_points = {"head_1"};
  EXPECT_EQ(drive.names_in(motion), (std::vector<std::string>{"a", "b"}));
  drive.all_points = false;
  drive.points = {"stomion", "head_1"};
  EXPECT_EQ(drive.names_in(motion), drive.points) << "what is named is taken";
}

}  // namespace
}  // namespace hyperex::simulate
