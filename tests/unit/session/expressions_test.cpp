// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded expressions move a face model whose head is still: no part of their motion may be
// attributed to the head.
#include <gtest/gtest.h>

#include "hyperex/session/inputs.hpp"

namespace hyperex::session {
using namespace scene;
namespace {

TEST(Expressions, LeaveTheHeadWhereItIs) {
  const Inputs in = read_inputs(read_scene(HYPEREX_SOURCE_DIR "/examples/one_sided_smile.toml"));
  EXPECT_EQ(in.head_shift_uncertainty_mm, 0);
  EXPECT_EQ(in.head_turn_uncertainty_deg, 0);
  const auto& motion = in.motion.motion;
  const auto travel_m = [&](const char* name) {
    const int row = motion.index_of(name);
    double most = 0;
    for (const Points& at : motion.positions)
      most = std::max(most, (at.row(row) - motion.positions.front().row(row)).norm());
    return most;
  };
  // The smile is on the right: the left eye's corners and the bridge of the nose do not move.
  for (const char* name : {"ibug68_42", "ibug68_45", "ibug68_27"})
    EXPECT_LT(travel_m(name), 2e-4) << name;
  EXPECT_GT(travel_m("ibug68_48"), 0.01);
}

}  // namespace
}  // namespace hyperex::session
