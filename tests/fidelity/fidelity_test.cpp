// SPDX-License-Identifier: GPL-3.0-or-later
// How near re-enacted faces come to true ones, by the program itself: each case below is simulated,
// compared vertex by vertex with the truth and held against a bound. The bounds lie 5 % above what
// was measured when they were set: a change that makes a face worse than that must be meant.
// HYPEREX_FIDELITY_PAGE=docs/fidelity.md makes `TableIsWritten` write the page's table (make
// fidelity). The data are not part of the repository; where they are absent the tests are skipped.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/program.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/mouth_outline.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "support/estimated_bones.hpp"
#include "support/smile_muscles.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;

struct Case {
  const char *name, *title;
  const char* scene;   ///< below the source folder, or below the data where it begins with "real/"
  const char* peak_s;  ///< when the truth was taken; "" where the scene says it
  const char *rest, *truth, *landmarks;  ///< below the data
  const char* warp;                      ///< of compare's baselines, by the same points
  double face_mm, lips_mm;               ///< bounds on the mean error
  const char* more = "";                 ///< further options of hyperex run
};
constexpr const char* kDisplacement = " --set drive.by=displacement";
/// For the rig: the shapes of real faces were made from it, and would know the answer.
constexpr const char* kTissueAlone = " --set muscles.shape_prior=false";

constexpr const char* kRest = "ict/subject_A_neutral_scan.ply";
constexpr const char* kOpen = "ict/subject_A_mouth_open_truth.ply";
constexpr const char* kTalk = "ict/subject_A_talk_peak_truth.ply";
constexpr const char* kMarks = "ict/subject_A_landmarks.json";
constexpr const char *kSmileRest = "real/spacetime/neutral.ply",
                     *kSmile = "real/spacetime/smile.ply",
                     *kSmileMarks = "real/spacetime/landmarks.json";

/// Without a word on what drives: as the program chooses by itself; on the rig by the tissue alone.
const Case kCases[] = {
    {"MouthOpenSeven", "mouth open, 7 points", "bench/scenes/subject_a_mouth_open.toml", "", kRest,
     kOpen, kMarks, "warp_7", 1.10, 1.88, kTissueAlone},
    {"MouthOpenAll", "mouth open, all 68", "bench/scenes/subject_a_mouth_open_all.toml", "", kRest,
     kOpen, kMarks, "warp_68", 0.78, 1.06, kTissueAlone},
    {"TalkSeven", "talking, frame 46, 7 points", "bench/scenes/subject_a_talk.toml", "1.533333",
     kRest, kTalk, kMarks, "warp_7", 2.17, 2.82, kTissueAlone},
    {"TalkAll", "talking, frame 46, all 68", "bench/scenes/subject_a_talk_all.toml", "1.533333",
     kRest, kTalk, kMarks, "warp_68", 1.40, 1.58, kTissueAlone},
    {"RealSmileSeven", "real smile, 7 points", "real/spacetime/smile_7.toml", "", kSmileRest,
     kSmile, kSmileMarks, "warp_7", 1.97, 1.60},
    {"RealSmileAll", "real smile, all 68", "real/spacetime/smile_all.toml", "", kSmileRest, kSmile,
     kSmileMarks, "warp_68", 1.15, 1.02},
    {"MouthOpenSevenDisplacement", "mouth open, 7 points, by displacement",
     "bench/scenes/subject_a_mouth_open.toml", "", kRest, kOpen, kMarks, "warp_7", 0.99, 1.84,
     kDisplacement},
    {"MouthOpenAllDisplacement", "mouth open, all 68, by displacement",
     "bench/scenes/subject_a_mouth_open_all.toml", "", kRest, kOpen, kMarks, "warp_68", 0.79, 1.05,
     kDisplacement},
    {"TalkSevenDisplacement", "talking, frame 46, 7 points, by displacement",
     "bench/scenes/subject_a_talk.toml", "1.533333", kRest, kTalk, kMarks, "warp_7", 2.27, 3.21,
     kDisplacement},
    {"TalkAllDisplacement", "talking, frame 46, all 68, by displacement",
     "bench/scenes/subject_a_talk_all.toml", "1.533333", kRest, kTalk, kMarks, "warp_68", 1.51,
     1.68, kDisplacement},
    {"RealSmileSevenDisplacement", "real smile, 7 points, by displacement",
     "real/spacetime/smile_7.toml", "", kSmileRest, kSmile, kSmileMarks, "warp_7", 3.05, 3.16,
     kDisplacement},
    {"RealSmileAllDisplacement", "real smile, all 68, by displacement",
     "real/spacetime/smile_all.toml", "", kSmileRest, kSmile, kSmileMarks, "warp_68", 1.62, 1.29,
     kDisplacement},
};

fs::path data(const char* file) {
  return fs::path(HYPEREX_SHARED_DIR) / "data" / file;
}

struct Errors {
  double still[2], warp[2], shapes[2], simulated[2];  ///< mm, over the face and over the lips
};

class Fidelity : public ProgramTest {
 protected:
  /// Runs and scores one case.
  Errors errors_of(const Case& c, const std::string& more) {
    const bool real = std::string(c.scene).starts_with("real/");
    const fs::path scene = real ? data(c.scene) : fs::path(HYPEREX_SOURCE_DIR) / c.scene;
    const std::string peak =
        *c.peak_s ? std::string(" --set output.peak_time_s=") + c.peak_s : std::string();
    fs::remove_all(in("out"));
    const Outcome run =
        call(fmt::format("run '{}' --out out --set output.vtu=false --set output.glb=false --set "
                         "output.report=false --set 'output.picture_times_s=[0]'{}{}",
                         scene.string(), peak, more));
    if (run.status != 0) throw std::runtime_error(run.err);
    const Outcome compared = call(fmt::format(
        "compare --corresponding --rest '{}' out/skin_peak.ply '{}' --landmarks '{}' --unit mm "
        "--baseline --json",
        data(c.rest).string(), data(c.truth).string(), data(c.landmarks).string()));
    if (compared.status != 0) throw std::runtime_error(compared.err);
    const auto table = nlohmann::json::parse(compared.out);
    Errors e;
    const char* regions[2] = {"face", "lips"};
    for (int i = 0; i < 2; ++i) {
      const auto mean = [&](const nlohmann::json& of) {
        return of.at(regions[i]).at("mean_mm").get<double>();
      };
      e.simulated[i] = mean(table);
      e.still[i] = mean(table.at("baseline").at("standing_still"));
      e.warp[i] = mean(table.at("baseline").at(c.warp));
      e.shapes[i] =
          mean(table.at("baseline").at(std::string(c.warp) == "warp_7" ? "shapes_7" : "shapes_68"));
    }
    return e;
  }
};

class FidelityOf : public Fidelity, public testing::WithParamInterface<Case> {
 protected:
  /// Opened, the mouth's rim is as smooth as the true one, without steps between neighbours.
  void expect_smooth_rim(const Case& c) {
    const io::Landmarks landmarks = io::read_landmarks(data(kMarks), io::LengthUnit::millimetre);
    const TriMesh rest = io::read_scan(data(kRest), io::LengthUnit::millimetre).mesh;
    const std::vector<int> rim = metrics::mouth_rim(rest, landmarks);
    const TriMesh truth = io::read_scan(data(c.truth), io::LengthUnit::millimetre).mesh;
    const auto wanted =
        metrics::mouth_outline(rest, rim, (truth.points - rest.points).cast<float>());
    ASSERT_TRUE(wanted);
    const auto found =
        nlohmann::json::parse(read_file(in("out/summary.json"))).at("mouth_outline_at_peak");
    EXPECT_NEAR(found.at("turning_deg").get<double>() / wanted->turning_deg, 1, 0.15);
    EXPECT_LT(found.at("largest_jump_mm").get<double>(), 1.6);
    fmt::print("turning {:.0f} of {:.0f} degrees, largest jump {:.2f} of {:.2f} mm\n",
               found.at("turning_deg").get<double>(), wanted->turning_deg,
               found.at("largest_jump_mm").get<double>(), wanted->largest_jump_mm);
  }
};

TEST_P(FidelityOf, IsAsGoodAsItWas) {
  const Case& c = GetParam();
  if (!fs::exists(data(c.truth))) GTEST_SKIP() << "no " << data(c.truth);
  const Errors e = errors_of(c, c.more);
  RecordProperty("lips_mm", std::to_string(e.simulated[1]));
  RecordProperty("face_mm", std::to_string(e.simulated[0]));
  EXPECT_LT(e.simulated[0], c.face_mm) << "face, mm";
  EXPECT_LT(e.simulated[1], c.lips_mm) << "lips, mm";
  EXPECT_LT(e.simulated[0], e.still[0]);
  if (std::string(c.rest) == kRest) expect_smooth_rim(c);
  if (std::string(c.name) == "RealSmileSeven")
    test::expect_zygomaticus_smiles(in("out/activations.csv"));
}

INSTANTIATE_TEST_SUITE_P(Case, FidelityOf, testing::ValuesIn(kCases),
                         [](const auto& c) { return std::string(c.param.name); });

/// Seven points, of both persons; docs/ct.md has the other cases. Given bones differ from estimated
/// ones in one thing: no springs hold the tissue over cavities. Forces feel this, prescribed points
/// do not.
class FidelityOnBones : public FidelityOf {};

TEST_P(FidelityOnBones, ThatAreTheEstimatedOnesStaysTheSame) {
  const Case& c = GetParam();
  if (!fs::exists(data(c.truth))) GTEST_SKIP() << "no " << data(c.truth);
  const bool real = std::string(c.scene).starts_with("real/");
  std::string bones = " --set anatomy.unit=mm";
  {
    session::FaceSession face(
        scene::read_scene(real ? data(c.scene) : fs::path(HYPEREX_SOURCE_DIR) / c.scene),
        {.certainty = session::Certainty::on_request});
    for (const auto& [name, bone] : {std::pair{"skull", anatomy::Bone::skull},
                                     std::pair{"mandible", anatomy::Bone::mandible}}) {
      const fs::path file = in(std::string(name) + ".ply");
      io::write_ply(file, test::estimated_bone(face.mesh(), face.inputs().landmarks, bone),
                    io::LengthUnit::millimetre);
      bones += fmt::format(" --set 'anatomy.{}=\"{}\"'", name, file.string());
    }
  }
  const Errors plain = errors_of(c, c.more), own = errors_of(c, c.more + bones);
  fmt::print("face {:.3f} and {:.3f} mm, lips {:.3f} and {:.3f} mm\n", plain.simulated[0],
             own.simulated[0], plain.simulated[1], own.simulated[1]);
  const double allowed = !real && std::string(c.more) != kDisplacement ? 0.05 : 0.02;
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(own.simulated[i] / plain.simulated[i], 1, allowed) << i;
}

INSTANTIATE_TEST_SUITE_P(Case, FidelityOnBones,
                         testing::Values(kCases[0], kCases[2], kCases[4], kCases[6]),
                         [](const auto& c) { return std::string(c.param.name); });

TEST_F(Fidelity, TableIsWritten) {
  const char* page = std::getenv("HYPEREX_FIDELITY_PAGE");
  if (page == nullptr) GTEST_SKIP() << "set HYPEREX_FIDELITY_PAGE to write the table";
  std::string rows =
      "| case | standing still | warp | blend shapes | simulated | share of the warp's error | at "
      "finite strain | "
      "share | with `tissue.element = \"tet4\"` |\n|---|---|---|---|---|---|---|---|---|\n";
  const auto pair = [](const double(&v)[2]) { return fmt::format("{:.2f} / {:.2f}", v[0], v[1]); };
  for (const Case& c : kCases) {
    ASSERT_TRUE(fs::exists(data(c.truth))) << data(c.truth) << " is needed";
    const std::string more = c.more;
    // What follows the compared frame does not reach it.
    const char* end = *c.peak_s ? " --set time.end_s=1.6" : "";
    const Errors e = errors_of(c, more),
                 finite = errors_of(c, more + " --set 'tissue.strain=\"finite\"'" + end),
                 locking = errors_of(c, more + " --set tissue.element=tet4");
    const auto share = [&](const Errors& of) {
      const double shares[2] = {of.simulated[0] / e.warp[0], of.simulated[1] / e.warp[1]};
      return pair(shares);
    };
    rows += fmt::format("| {} | {} | {} | {} | **{}** | {} | **{}** | {} | {} |\n", c.title,
                        pair(e.still), pair(e.warp), pair(e.shapes), pair(e.simulated), share(e),
                        pair(finite.simulated), share(finite), pair(locking.simulated));
  }
  const std::string begin = "<!-- table of make fidelity -->\n", end = "<!-- end of table -->";
  std::string text = read_file(page);
  const auto from = text.find(begin), to = text.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos && from < to) << page;
  text.replace(from + begin.size(), to - from - begin.size(), rows);
  std::ofstream(page) << text;
}

}  // namespace
}  // namespace hyperex
