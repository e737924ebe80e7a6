// SPDX-License-Identifier: GPL-3.0-or-later
// Hostile inputs: extremely deep nesting, device files, names that act on terminals or tables, and
// numbers at the limits of their types.
#include <gmock/gmock.h>

#include <algorithm>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"
#include "hyperex/motion/read_motion.hpp"

namespace hyperex {
namespace {
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

const std::string kEmbedded = "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n";

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int k = 0; k < times; ++k) text += part;
  return text;
}

class Hostile : public ProgramTest {
 protected:
  void expect_refused(const std::string& arguments, const std::string& part) const {
    const Outcome outcome = call(arguments, "ulimit -t 30");
    EXPECT_EQ(outcome.status, 2) << arguments << ": " << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_THAT(outcome.err, Not(HasSubstr("\x1b"))) << arguments;
  }
};

TEST_F(Hostile, NestingWithoutEndIsRefused) {
  constexpr int deep = 100000;
  put(in("key.toml"), kEmbedded + "a" + repeated(".a", deep) + " = 1\n");
  put(in("header.toml"), "[a" + repeated(".a", deep) + "]\nb = 1\n");
  put(in("array.toml"), "scan = " + repeated("[", deep) + repeated("]", deep));
  for (const char* scene : {"key.toml", "header.toml", "array.toml"})
    expect_refused("check " + std::string(scene), "nested deeper than");
  put(in("good.toml"), kEmbedded);
  put(in("deep.json"),
      R"({"units":"mm","points":{"a":)" + repeated("[", deep) + repeated("]", deep) + "}}");
  expect_refused("check good.toml --set scan.landmarks=deep.json", "nested deeper than");
}

TEST_F(Hostile, ADeviceIsNoInput) {
  put(in("good.toml"), kEmbedded);
  expect_refused("check /dev/zero", "");
  expect_refused("check good.toml --set scan.landmarks=/dev/zero", "is a device");
  expect_refused("check good.toml --set scan.file=/dev/zero", "");
  fs::create_symlink("/dev/zero", in("motion.csv"));
  expect_refused("symmetry motion.csv --out out.csv", "is a device");
  expect_refused("track /dev/zero --out out.csv", "is a device");
}

TEST_F(Hostile, NumbersAtTheEdgeEndInAResultOrARefusal) {
  write_good_inputs(in(""));
  const Outcome run = call("run scene.toml --out o --set motion.gain=1e-310");
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* key : {"tissue.young_kpa=1e-300", "tissue.density_kg_m3=1e-300"})
    expect_refused("check scene.toml --set " + std::string(key), "from 0.001 to");
}

TEST_F(Hostile, NamesOfLandmarksMayHoldCommasAndQuotes) {
  write_good_inputs(in(""));
  replace_in(in("face_landmarks.json"), "\"points\": {",
             "\"points\": {\n  \"mole, \\\"left\\\"\": [30, -20, 40],");
  const Outcome run = call("run scene.toml --out o");
  EXPECT_EQ(run.status, 0) << run.err;
  const auto names = motion::read_motion(in("o/motion.csv")).names;
  EXPECT_NE(std::find(names.begin(), names.end(), "mole, \"left\""), names.end());
}

TEST_F(Hostile, ControlCharactersInNamesAreRefused) {
  write_good_inputs(in(""));
  replace_in(in("face_landmarks.json"), "\"points\": {",
             "\"points\": {\n  \"\\u001b[31mred\": [30, -20, 40],");
  expect_refused("check scene.toml", "?[31mred: expected a name in UTF-8");
  put(in("named.csv"), "time_s,\x1b[31mred_x_mm\n0,1\n");
  expect_refused("symmetry named.csv --out out.csv", "named.csv");
}

TEST_F(Hostile, MessagesStayShort) {
  std::string keys = kEmbedded;
  for (int k = 0; k < 20000; ++k) keys += "unknown_" + std::to_string(k) + " = 1\n";
  put(in("keys.toml"), keys);
  const Outcome many = call("check keys.toml");
  EXPECT_EQ(many.status, 2);
  EXPECT_LE(std::count(many.err.begin(), many.err.end(), '\n'), 21);
  put(in("wide.csv"), "time_s," + std::string(10'000'000, 'a') + "_x_mm\n0,1\n");
  const Outcome wide = call("symmetry wide.csv --out out.csv");
  EXPECT_EQ(wide.status, 2);
  EXPECT_LT(wide.err.size(), 1000u);
}

TEST_F(Hostile, CandideIsDrivenByThoseOfTheDefaultPointsThatItHas) {
  const fs::path model = fs::path(HYPEREX_SHARED_DIR) / "data/candide/candide3.wfm";
  if (!fs::exists(model)) GTEST_SKIP() << "no " << model;
  const fs::path smile = fs::path(HYPEREX_SOURCE_DIR) / "examples/one_sided_smile.csv";
  put(in("scene.toml"), "scan = { file = \"embedded\" }\nmotion = { arkit = \"" + smile.string() +
                            "\", candide = \"" + model.string() + "\" }\n");
  const Outcome check = call("check scene.toml");
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("has no ibug68_58, ibug68_56; the other 5 of the default"));
  expect_refused("check scene.toml --set 'drive.points=[\"ibug68_58\"]'", "ibug68_58 is none");
}

}  // namespace
}  // namespace hyperex
