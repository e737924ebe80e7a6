// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings in which readings of one point are wild, as `hyperex check` reads them. None of them
// passes in silence: each is refused, repaired or warned of.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "apps/good_inputs.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/inputs.hpp"
#include "support/note_matchers.hpp"
#include "support/refusal.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
namespace {
using test::is_warning;
using test::says;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

struct WildFile {
  double off_mm;
  std::size_t first, count;  ///< samples, of 16 at 30 Hz
  std::string point;
};

/// Each size at the start, in the middle and at the end, for one, two and five samples. Five in the
/// middle last for 0.2 s from the last right one to the first right one. The points take turns: a
/// corner of the mouth, a driven one, and two that hold the head's pose.
std::vector<WildFile> wild_files() {
  const std::string points[] = {"cheilion_L", "ibug68_8", "ibug68_36", "ibug68_27"};
  std::vector<WildFile> all;
  for (const double off_mm : {30.0, 100.0, 300.0, 1e6})
    for (const std::size_t count : {1, 2, 5})
      for (const std::size_t first : {std::size_t(0), std::size_t(6), 16 - count})
        all.push_back({off_mm, first, count, points[all.size() % std::size(points)]});
  return all;
}

class WildFiles : public testing::TestWithParam<WildFile> {
 protected:
  WildFiles() { write_good_inputs(folder_ / ""); }

  /// The recording; with `wild`, the file's readings are off.
  Inputs read(bool wild) const {
    const WildFile& file = GetParam();
    write_opening(folder_ / "", 0, 16, [&](motion::Motion& m) {
      for (std::size_t k = file.first; wild && k < file.first + file.count; ++k)
        m.positions[k](m.index_of(file.point), 2) += 1e-3 * file.off_mm;
    });
    return read_inputs(scene::read_scene(folder_ / "scene.toml"), Extent::quick);
  }
  std::string place(std::size_t sample) const {
    return fmt::format("motion.csv:{}, point {} at", sample + 2, GetParam().point);
  }

  scene::SceneFolder folder_;
};

double farthest_mm(const motion::Motion& a, const motion::Motion& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.positions.size(); ++k)
    most = std::max(most, 1e3 * (a.positions[k] - b.positions[k]).rowwise().norm().maxCoeff());
  return most;
}

TEST_P(WildFiles, AreRefusedRepairedOrWarnedOf) {
  const WildFile& file = GetParam();
  if (file.count <= 2 || file.first == 6) {
    const Inputs in = read(true);
    EXPECT_THAT(in.notes,
                Contains(AllOf(is_warning("recording.wild_samples"), says(place(file.first)))));
    EXPECT_LT(farthest_mm(in.motion.motion, read(false).motion.motion), 6);
    return;
  }
  // Where the first reading is wild, it is the way back that no face goes.
  const std::string reported = place(file.first > 0 ? file.first : file.count);
  if (file.off_mm >= 300) {
    const std::string said = test::refusal([&] { read(true); });
    EXPECT_THAT(said, HasSubstr(reported));
    EXPECT_EQ(std::ranges::count(said, '\n'), 0) << said;
  } else {
    EXPECT_THAT(read(true).notes, Contains(AllOf(is_warning("recording.jumps"), says(reported))));
  }
}

TEST(HeldPoints, AreNamedWithTheirLineAndTimes) {
  const scene::SceneFolder folder;
  write_good_inputs(folder / "");
  write_opening(folder / "", 0, 41, [](motion::Motion& m) {
    const int chin = m.index_of("ibug68_8");
    for (std::size_t k = 16; k <= 30; ++k) m.positions[k].row(chin) = m.positions[15].row(chin);
  });
  const Inputs in = read_inputs(scene::read_scene(folder / "scene.toml"), Extent::quick);
  EXPECT_THAT(in.notes,
              Contains(AllOf(is_warning("recording.held_points"),
                             says("motion.csv:17, point ibug68_8 at 0.500 s to 1.000 s"))));
}

/// One reading in the middle is off, in a recording of this rate.
struct LoneReading {
  double rate_hz, off_mm;
  const char* id;  ///< of the warning
};

class LoneReadings : public testing::TestWithParam<LoneReading> {};

TEST_P(LoneReadings, AreRepairedOrWarnedOfAtEachRate) {
  const scene::SceneFolder folder;
  write_good_inputs(folder / "");
  write_opening(folder / "", 0, 16, [](motion::Motion& m) {
    for (double& time_s : m.time_s) time_s *= 30 / GetParam().rate_hz;
    m.positions[7](m.index_of("cheilion_L"), 2) += 1e-3 * GetParam().off_mm;
  });
  const Inputs in = read_inputs(scene::read_scene(folder / "scene.toml"), Extent::quick);
  EXPECT_THAT(in.notes, Contains(AllOf(is_warning(GetParam().id),
                                       says("motion.csv:9, point cheilion_L at"))));
}

INSTANTIATE_TEST_SUITE_P(Of, LoneReadings,
                         testing::Values(LoneReading{120, 10, "recording.wild_samples"},
                                         LoneReading{60, 15, "recording.wild_samples"},
                                         LoneReading{30, 15, "recording.wild_samples"},
                                         LoneReading{10, 25, "recording.lone_samples"},
                                         LoneReading{10, 50, "recording.lone_samples"},
                                         LoneReading{10, 80, "recording.wild_samples"}),
                         [](const auto& of) {
                           return fmt::format("{}_mm_at_{}_Hz", of.param.off_mm, of.param.rate_hz);
                         });

INSTANTIATE_TEST_SUITE_P(Of, WildFiles, testing::ValuesIn(wild_files()), [](const auto& of) {
  const WildFile& file = of.param;
  return fmt::format("{:.0f}_mm_from_{}_for_{}_{}", file.off_mm, file.first, file.count,
                     file.point);
});

}  // namespace
}  // namespace hyperex::session
