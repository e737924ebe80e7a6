// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/scan_measures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/visits/read_visits.hpp"
#include "smiling_face.hpp"

namespace hyperex::visits {
namespace {

const ScanMeasure& named(const std::string& key, const std::string& side) {
  for (const ScanMeasure& measure : scan_measures())
    if (measure.key == key && measure.side == side) return measure;
  throw std::invalid_argument(key);
}

MeasuredScan embedded() {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  return {face.mesh, face.landmarks};
}

TEST(ScanMeasures, AnAsymmetricRestIsMeasured) {
  MeasuredScan scan = embedded();
  const ScanMeasure& asymmetry = named("rest_asymmetry", "");
  const Estimate even = estimate(asymmetry, scan, 1.5e-3);
  EXPECT_LT(even.value, 0.2);
  // The left cheek and jaw are swollen by 4 mm.
  const face::FaceFrame frame = face::face_frame(scan.landmarks);
  for (auto point : scan.skin.points.rowwise())
    if (frame.local(point.transpose()).x() > 0.02) point += 0.004 * frame.z.transpose();
  EXPECT_GT(estimate(asymmetry, scan, 1.5e-3).value, even.value + 1);
}

TEST(ScanMeasures, TheFoldOfARealSmileDeepens) {
  const std::filesystem::path data =
      std::filesystem::path(HYPEREX_SHARED_DIR) / "data/real/spacetime";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "the real smile is not here";
  Comparison two;
  two.repetition_m = 1.5e-3;
  two.file = visits_of(2);
  two.file.visits[0].peak_scan = VisitScan{data / "neutral.ply", data / "landmarks.json"};
  two.file.visits[1].peak_scan = VisitScan{data / "smile.ply", {}};  // landmarks are found
  add_scan_measures(two);
  EXPECT_THAT(two.scan_remarks, testing::Contains(testing::StartsWith("smile.ply: ")));
  ASSERT_EQ(two.measures.size(), 4U) << "nothing at rest";
  for (const MeasureOverVisits& one : two.measures) {
    const Change& change = *one.changes.back();
    if (one.measure.key != "fold_depth") continue;
    EXPECT_NEAR(one.values.back()->value, 3.8, 0.6) << one.measure.side;
    EXPECT_GT(change.all->low, 0);
    EXPECT_EQ(change.beyond, Beyond::yes);
    const double half_mm = change.measured->high - change.value;
    EXPECT_GT(half_mm, 0.1) << "landmarks";
    EXPECT_LT(half_mm, 1);
    EXPECT_EQ(change.largest, "repetition");
  }
}

}  // namespace
}  // namespace hyperex::visits
