// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/keyframes.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "hyperex/session/inputs.hpp"
#include "hyperex/session/plausible.hpp"
#include "support/note_matchers.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
namespace {
using testing::AllOf;
using testing::Contains;
using testing::Not;

using Times = std::vector<double>;

TEST(Keyframes, AreAtTimesThatNoDeviceSamplesAt) {
  for (const Times& times :
       {Times{0, 0.2, 0.5, 0.8, 1.1, 1.5, 1.8, 2}, {0, 0.2, 0.6, 1, 1.4}, {0, 0.3, 1}, {0, 2, 4}})
    EXPECT_TRUE(are_keyframes(times)) << testing::PrintToString(times);
  Times of_slow_webcam = {0}, frame_numbers = {0};
  for (int k = 1; k < 100; ++k)
    of_slow_webcam.push_back(of_slow_webcam.back() + 0.12 + 0.18 * std::fmod(0.618 * k, 1));
  for (int k = 1; k < 20; ++k) frame_numbers.push_back(k);
  for (const Times& times : {Times{0, 0.25, 0.5, 0.75, 1},
                             {0, 0.2, 0.4, 0.8, 1, 1.2},
                             {0, 0.5},
                             {0, 0.03, 0.08, 0.1},
                             {0, 33, 67, 100},
                             of_slow_webcam,
                             frame_numbers,
                             {0}})
    EXPECT_FALSE(are_keyframes(times)) << testing::PrintToString(times);
}

TEST(Keyframes, AreThoseOfWeightsAlone) {
  motion::Motion motion;
  motion.time_s = {0, 0.2, 0.5, 0.8, 1.1, 1.5, 1.8, 2};
  EXPECT_FALSE(coarse_warning(motion, Readings::of_weights));
  EXPECT_TRUE(keyframes_note(motion, Readings::of_weights));
  EXPECT_TRUE(coarse_warning(motion));
  EXPECT_FALSE(keyframes_note(motion, Readings::measured));
  motion.time_s = {0, 0.6, 1.4, 3};
  EXPECT_FALSE(timing_warning(motion, Readings::of_weights));
  EXPECT_FALSE(short_warning(motion.time_s, Readings::of_weights));
  EXPECT_TRUE(timing_warning(motion));
  EXPECT_TRUE(short_warning(motion.time_s));
  motion.time_s = {0, 33, 67, 100};
  EXPECT_TRUE(timing_warning(motion, Readings::of_weights)) << "milliseconds";
  motion.time_s = {0, 33, 107, 700};
  EXPECT_TRUE(timing_warning(motion, Readings::of_weights)) << "more than ten minutes";
  motion.time_s = {0, 1, 2, 3, 4, 5};
  EXPECT_TRUE(timing_warning(motion, Readings::of_weights)) << "frame numbers";
}

TEST(Keyframes, RaiseANoteAndNoWarning) {
  const Inputs in =
      read_inputs(scene::read_scene(HYPEREX_SOURCE_DIR "/examples/one_sided_smile.toml"));
  EXPECT_THAT(in.notes, Contains(AllOf(test::is_note("recording.keyframes"),
                                       test::is_about("motion.arkit"), test::says("8 rows"))));
  for (const char* id : {"recording.coarse", "recording.time_unit_doubtful", "recording.short"})
    EXPECT_THAT(in.notes, Not(Contains(test::has_id(id))));
}

}  // namespace
}  // namespace hyperex::session
