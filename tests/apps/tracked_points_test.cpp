// SPDX-License-Identifier: GPL-3.0-or-later
// A camera recording drives muscles by seven of its points and by all 560 tracked points; the
// errors of both are compared.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"

namespace hyperex {
namespace {

namespace fs = std::filesystem;
const fs::path kData = fs::path(HYPEREX_SHARED_DIR) / "data";

class TrackedPoints : public ProgramTest {
 protected:
  /// Distance from the truth at the peak by regions of the face.
  nlohmann::json regions(const std::string& points) {
    const std::string run = call("run talk.toml --out out_" + points + " --set 'drive.points=" +
                                 (points == "all" ? "\"all\""
                                                  : "[\"ibug68_48\", \"ibug68_54\", "
                                                    "\"ibug68_51\", \"ibug68_57\", "
                                                    "\"ibug68_8\"]") +
                                 "'")
                                .err;
    const std::string ict = (kData / "ict/subject_A_").string();
    const Outcome compared =
        call("compare --corresponding --rest " + ict + "neutral_scan.ply out_" + points +
             "/skin_peak.ply " + ict + "talk_peak_truth.ply --landmarks " + ict +
             "landmarks.json --unit mm --json");
    EXPECT_EQ(compared.status, 0) << run << compared.err;
    return nlohmann::json::parse(compared.out);
  }
};

TEST_F(TrackedPoints, AllOfThemMoveTheCheeksOfATalkingFace) {
  const fs::path recording = kData / "rgbd/subject_A_talk";
  if (!fs::exists(recording)) GTEST_SKIP() << "no " << recording;
  put(in("talk.toml"),
      "scan = { file = '" + (kData / "ict/subject_A_neutral_scan.ply").string() +
          "', unit = \"mm\", landmarks = '" + (kData / "ict/subject_A_landmarks.json").string() +
          "' }\nmotion.recording = '" + recording.string() +
          "'\nmesh = { element_size_mm = 5, layers = 1 }\n"
          // The shapes of real faces were made from this rig and would give its cheeks.
          "drive.by = \"muscles\"\nmuscles.shape_prior = false\n"
          "time.step_s = 0.01\n"
          "output = { peak_time_s = 1.533333, vtu = false, glb = false, report = "
          "false }\n");
  const nlohmann::json few = regions("few"), all = regions("all");
  const auto mean = [](const nlohmann::json& of, const char* region) {
    return of.at(region).at("mean_mm").get<double>();
  };
  EXPECT_LT(mean(all, "cheeks"), 0.8 * mean(few, "cheeks"));
  EXPECT_LT(mean(all, "lips"), mean(few, "lips"));
  EXPECT_LT(mean(all, "face"), 1.1 * mean(few, "face"));
}

}  // namespace
}  // namespace hyperex
