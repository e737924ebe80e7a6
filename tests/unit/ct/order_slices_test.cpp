// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/order_slices.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/refusal.hpp"

namespace hyperex::ct {
namespace {
using testing::HasSubstr;

/// Twelve slices of 40 x 50 pixels, 2 mm apart, in the order 1, 8, 3, 10 ...
std::vector<SlicePlace> slices(const Vec3& step_mm = {0, 0, 2}) {
  std::vector<SlicePlace> out;
  for (int i = 0; i < 12; ++i) {
    SlicePlace one;
    one.first_mm = Vec3(-10, -20, 100) + ((7 * i) % 12) * step_mm;
    one.row_step_mm = 0.5, one.column_step_mm = 0.75;
    one.columns = 40, one.rows = 50;
    out.push_back(one);
  }
  return out;
}

std::string refused(const std::vector<SlicePlace>& some) {
  return test::refusal([&] { order_slices(some, "series"); });
}

TEST(OrderSlices, PutsThemInPlaceOfTheFace) {
  const SliceStack stack = order_slices(slices(), "series");
  for (int i = 0; i < 12; ++i) EXPECT_EQ((7 * stack.order[std::size_t(i)]) % 12, std::size_t(i));
  EXPECT_NEAR(stack.tilt_deg, 0, 1e-6);
  EXPECT_EQ(stack.grid.size, (std::array{40, 50, 12}));
  // The patient's z is the face's y, and the patient's back is behind the face.
  const Vec3 place = 1e3 * stack.grid.place(2, 4, 3);
  EXPECT_TRUE(place.isApprox(Vec3(-10 + 1, 100 + 6, 20 - 3), 1e-9)) << place.transpose();
}

TEST(OrderSlices, TakesATiltedGantryAsItStood) {
  const double tilt = 15 * std::numbers::pi / 180;
  std::vector<SlicePlace> tilted = slices();
  for (SlicePlace& one : tilted) one.along_column = {0, std::cos(tilt), -std::sin(tilt)};
  const SliceStack stack = order_slices(tilted, "series");
  EXPECT_NEAR(stack.tilt_deg, 15, 1e-6);
  const Vec3 place = stack.grid.place(0, 10, 5);
  const Vec3 patient(-10, -20 + 7.5 * std::cos(tilt), 100 + 10 - 7.5 * std::sin(tilt));
  EXPECT_TRUE(place.isApprox(1e-3 * face_from_patient() * patient, 1e-9));
}

TEST(OrderSlices, OfFeetFirstStacksRunTheOtherWay) {
  std::vector<SlicePlace> turned = slices();
  for (SlicePlace& one : turned) one.along_row = {-1, 0, 0};
  const SliceStack stack = order_slices(turned, "series");
  EXPECT_NEAR(stack.grid.place(0, 0, 0).y(), 0.122, 1e-9);
  EXPECT_NEAR(stack.grid.place(0, 0, 11).y(), 0.1, 1e-9);
}

TEST(OrderSlices, SayWhereOneIsMissing) {
  std::vector<SlicePlace> some = slices();
  std::erase_if(some, [](const SlicePlace& one) { return one.first_mm.z() == 110; });
  EXPECT_THAT(refused(some),
              HasSubstr("series: 1 slice is missing between z = 108.0 and z = 112.0 mm"));
  std::erase_if(some, [](const SlicePlace& one) { return one.first_mm.z() == 112; });
  EXPECT_THAT(refused(some), HasSubstr("2 slices are missing between z = 108.0 and z = 114.0 mm"));
}

TEST(OrderSlices, RefuseWhatIsNoStack) {
  std::vector<SlicePlace> some = slices();
  some[3].first_mm = some[4].first_mm;
  EXPECT_THAT(refused(some), HasSubstr("two slices at one place"));
  some = slices();
  some[3].first_mm.z() += 0.5;
  EXPECT_THAT(refused(some), HasSubstr("unevenly spaced"));
  some = slices();
  some[3].first_mm.x() += 1.5;
  EXPECT_THAT(refused(some), HasSubstr("beside the line"));
  some = slices();
  some[3].rows = 60;
  EXPECT_THAT(refused(some), HasSubstr("60 x 40 pixels"));
  some = slices();
  some[3].along_row = Vec3(1, 0.1, 0).normalized();
  EXPECT_THAT(refused(some), HasSubstr("turned against each other"));
  some.resize(3);
  EXPECT_THAT(refused(some), HasSubstr("3 slices of a CT; expected at least 8"));
}

}  // namespace
}  // namespace hyperex::ct
