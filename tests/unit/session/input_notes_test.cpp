// SPDX-License-Identifier: GPL-3.0-or-later
// Notes on valid inputs, and how much these may be changed before a warning is given. noted_scenes
// has a scene for each warning.
#include <gmock/gmock.h>

#include <map>
#include <random>

#include "apps/good_inputs.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/baseline.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/plausible.hpp"
#include "support/half_face.hpp"
#include "support/note_matchers.hpp"
#include "support/refusal.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
namespace {
using test::has_id;
using test::is_note;
using test::is_warning;
using test::says;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class InputNotes : public testing::Test {
 protected:
  InputNotes() { write_good_inputs(folder_ / ""); }

  std::vector<Note> notes(const std::vector<std::string>& overrides = {}) const {
    return read_inputs(scene::read_scene(folder_ / "scene.toml", overrides), Extent::quick).notes;
  }
  std::vector<Note> warnings() const { return notes_of(notes(), Severity::warning); }
  void open(std::size_t first, std::size_t count,
            const std::function<void(motion::Motion&)>& change) const {
    write_opening(folder_ / "", first, count, change);
  }

  scene::SceneFolder folder_;
};

TEST_F(InputNotes, OfSoundInputsAreNoWarnings) {
  EXPECT_THAT(warnings(), IsEmpty());
  EXPECT_THAT(notes(), Contains(AllOf(is_note("recording.timing"), says("0.5 s: 16 samples"))));
}

/// Without landmarks, too: then nothing else looks at the scan before a run.
TEST_F(InputNotes, NameAScanWhoseTrianglesAreTurned) {
  io::Scan scan = io::read_scan(folder_ / "face.ply", io::LengthUnit::millimetre);
  for (Eigen::Index f = 0; f < scan.mesh.triangles.rows(); f += 4)
    std::swap(scan.mesh.triangles(f, 0), scan.mesh.triangles(f, 1));
  io::write_ply(folder_ / "turned.ply", scan.mesh, io::LengthUnit::millimetre);
  const std::string text =
      "scan.file = \"turned.ply\"\nscan.unit = \"mm\"\nmotion.file = \"motion.csv\"\n";
  const auto found =
      read_inputs(scene::read_scene(folder_.write("turned.toml", text)), Extent::quick);
  EXPECT_THAT(found.notes,
              Contains(AllOf(is_warning("scan.turned_triangles"), says("turned inside out"))));
}

/// By landmarks of the other half alone, as by those that a search puts on the scan.
TEST_F(InputNotes, AScanOfHalfAFaceIsRefused) {
  write_mm(folder_ / "face.ply", test::half_face(good_face(), false));
  io::Landmarks landmarks = good_landmarks();
  std::erase_if(landmarks, [](const auto& entry) { return entry.second.x() > 1e-3; });
  io::write_landmarks(folder_ / "face_landmarks.json", landmarks, io::LengthUnit::millimetre);
  const auto refused = [&] { return test::refusal([&] { notes({"mesh.element_size_mm=4"}); }); };
  EXPECT_THAT(refused(), AllOf(HasSubstr("face.ply: the left half of the face is missing"),
                               Not(HasSubstr("\n"))));
  // Those of the missing half lie on the border.
  const SurfaceTree tree(test::half_face(good_face(), false));
  landmarks = good_landmarks();
  for (auto& [name, at] : landmarks) at = tree.query(at).point;
  io::write_landmarks(folder_ / "face_landmarks.json", landmarks, io::LengthUnit::millimetre);
  EXPECT_NE(refused(), "");
}

TEST_F(InputNotes, NameAScanWithoutDepth) {
  TriMesh sheet = good_face();
  sheet.points.col(2) *= 0.1;
  write_mm(folder_ / "face.ply", sheet);
  io::Landmarks landmarks;
  for (const char* name : {"exocanthion_R", "endocanthion_R", "endocanthion_L", "exocanthion_L",
                           "pronasale", "cheilion_R", "cheilion_L"})
    landmarks[name] = good_landmarks().at(name).cwiseProduct(Vec3(1, 1, 0.1));
  io::write_landmarks(folder_ / "face_landmarks.json", landmarks, io::LengthUnit::millimetre);
  EXPECT_THAT(notes(), Contains(AllOf(is_warning("scan.flat"), says(" mm before the plane"))));
}

TEST_F(InputNotes, KnowSlowRecordingsFromMilliseconds) {
  open(0, 16, [](motion::Motion& m) {
    for (double& t : m.time_s) t *= 14;
  });
  EXPECT_THAT(warnings(), ElementsAre(is_warning("recording.coarse")));
  open(0, 16, [](motion::Motion& m) {
    for (double& t : m.time_s) t *= 16;
  });
  EXPECT_THAT(warnings(), ElementsAre(is_warning("recording.time_unit_doubtful")));
}

TEST_F(InputNotes, SamplesATenthOfASecondApartAreCloseEnough) {
  open(0, 16, [](motion::Motion& m) {
    for (double& t : m.time_s) t *= 3;
  });
  EXPECT_THAT(warnings(), IsEmpty());
  open(0, 16, [](motion::Motion& m) {
    for (double& t : m.time_s) t *= 3.2;
  });
  EXPECT_THAT(warnings(), ElementsAre(is_warning("recording.coarse")));
}

TEST_F(InputNotes, NameARecordingOfFewerThanFiveSamples) {
  open(0, 5, [](motion::Motion&) {});
  EXPECT_THAT(warnings(), IsEmpty());
  open(0, 4, [](motion::Motion&) {});
  EXPECT_THAT(warnings(),
              ElementsAre(AllOf(is_warning("recording.short"), says("4 samples in 0.1 s"))));
}

TEST_F(InputNotes, TakeTwoTenthsOfAMillimetreForMotion) {
  const auto by = [&](double mm) {
    open(0, 16, [&](motion::Motion& m) {
      for (auto& sample : m.positions) sample = m.positions.front();
      m.positions[8](m.index_of("cheilion_L"), 1) += 1e-3 * mm;
    });
  };
  by(0.03);
  EXPECT_THAT(warnings(), ElementsAre(is_warning("recording.nothing_moves")));
  by(0.2);
  EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(InputNotes, KnowARunThatOutlastsItsRecordingOfHalfASecond) {
  EXPECT_THAT(notes({"time.end_s=1.45"}), Not(Contains(has_id("time.beyond_recording"))));
  EXPECT_THAT(notes({"time.end_s=1.6"}),
              Contains(AllOf(is_warning("time.beyond_recording"),
                             says("time.end_s = 1.6 s is 1.1 s after the end of the recording"))));
  EXPECT_THAT(notes({"time.end_s=1.6", "motion.time_scale=2"}),
              Not(Contains(has_id("time.beyond_recording"))));
}

TEST_F(InputNotes, TellAnEndThatLooksLikeTheRecordingsSeconds) {
  EXPECT_THAT(notes({"time.start_s=0.3", "time.end_s=0.2"}),
              Not(Contains(has_id("time.end_of_run"))));
  EXPECT_THAT(notes({"time.end_s=0.4"}), Not(Contains(has_id("time.end_of_run"))));
  EXPECT_THAT(
      notes({"time.start_s=0.3", "time.end_s=0.4"}),
      Contains(AllOf(is_note("time.end_of_run"), says("counted from the start of the run"))));
  scene::Scene scene;
  scene.motion.start_s = 14;
  scene.time.end_s = 24;
  EXPECT_THAT(end_of_run_note(scene, 0.5)->text,
              AllOf(HasSubstr("stands for 37.5 s of the recording"),
                    HasSubstr("to end at 24 s of the recording, write 10.5")));
  scene.motion.time_scale = 2;
  EXPECT_THAT(end_of_run_note(scene, 0)->text,
              AllOf(HasSubstr("stands for 26 s"), HasSubstr("write 20")));
}

TEST_F(InputNotes, NameThePairThatIsExchanged) {
  for (const auto& [one, other] :
       {std::pair{"cheilion_L", "cheilion_R"}, {"ibug68_48", "ibug68_54"}}) {
    const std::string pair = std::string(one) + " and " + other + " (corner of the mouth";
    open(0, 16, [&, one = std::string(one), other = std::string(other)](motion::Motion& m) {
      std::swap(m.names[std::size_t(m.index_of(one))], m.names[std::size_t(m.index_of(other))]);
    });
    EXPECT_THAT(test::refusal([&] { notes(); }),
                AllOf(HasSubstr("motion.csv: left and right are exchanged in " + pair),
                      HasSubstr("than on the scan")));
    // Wrong by 0.6 of their distance, they lie the other way round by 0.2 of it.
    open(0, 16, [&, one = std::string(one), other = std::string(other)](motion::Motion& m) {
      const int a = m.index_of(one), b = m.index_of(other);
      for (Points& sample : m.positions) {
        const Eigen::RowVector3d way = 0.6 * (sample.row(b) - sample.row(a));
        sample.row(a) += way;
        sample.row(b) -= way;
      }
    });
    EXPECT_THAT(warnings(),
                Contains(AllOf(is_warning("sides.exchanged_pair"), says(pair), says("the scan"))));
  }
}

TEST_F(InputNotes, RefuseAnExchangedPairWithoutLandmarksToo) {
  replace_in(folder_ / "scene.toml", "landmarks = \"face_landmarks.json\"\n", "");
  open(0, 16, [](motion::Motion& m) {
    std::swap(m.names[std::size_t(m.index_of("ibug68_48"))],
              m.names[std::size_t(m.index_of("ibug68_54"))]);
  });
  EXPECT_THAT(test::refusal([&] { notes(); }),
              AllOf(HasSubstr("left and right are exchanged in ibug68_48 and ibug68_54"),
                    HasSubstr("an average face")));
}

TEST_F(InputNotes, JudgeByAnAverageFaceWhereLandmarksAreNotKnown) {
  replace_in(folder_ / "scene.toml", "landmarks = \"face_landmarks.json\"\n", "");
  EXPECT_THAT(warnings(), IsEmpty());
  EXPECT_THAT(notes(), AllOf(Contains(is_note("landmarks.not_searched")),
                             Contains(is_note("recording.checked_by_average_face"))));
  open(40, 41, [](motion::Motion&) {});
  EXPECT_THAT(warnings(), ElementsAre(AllOf(is_warning("recording.starts_in_expression"),
                                            says("an average face"))));
}

TEST_F(InputNotes, WarnOfRigidPointsThatMove) {
  open(0, 81, [](motion::Motion&) {});
  const auto with = [&](const std::string& points) {
    return notes({"motion.rigid_points=[" + points + "]"});
  };
  EXPECT_THAT(test::refusal([&] { with(R"("ibug68_48", "ibug68_57", "ibug68_54")"); }),
              AllOf(testing::HasSubstr("motion.rigid_points names points that move with mouth and "
                                       "chin: ibug68_48 (corner of the mouth, right)"),
                    testing::HasSubstr("forehead")));
  // Distances within the mouth hardly change as it opens: those from the nose do.
  const std::vector<Note> mixed = with(R"("ibug68_27", "ibug68_36", "ibug68_45", "ibug68_57")");
  EXPECT_THAT(mixed, Contains(AllOf(is_warning("head.points_not_rigid"),
                                    says("do not keep still against each other"),
                                    says("ibug68_57 ("), Not(says("ibug68_36")))));
  const std::vector<Note> sound = with(R"("ibug68_27", "ibug68_36", "ibug68_45", "ibug68_30")");
  EXPECT_THAT(notes_of(sound, Severity::warning), IsEmpty());
  open(0, 81, [](motion::Motion& m) {
    for (std::size_t k = 0; k < m.positions.size(); ++k)
      m.positions[k](m.index_of("ibug68_17"), 1) += 0.020 * double(k) / 80;
  });
  const std::vector<Note> of_brow = with(R"("ibug68_17", "ibug68_26", "ibug68_29")");
  EXPECT_THAT(of_brow, Contains(AllOf(is_warning("head.pose_unknown"), says("other points"))));
  EXPECT_THAT(of_brow, Not(Contains(has_id("head.pose_uncertain"))));
  // A tenth of that is between 1 and 3 mm: a note.
  open(0, 81, [](motion::Motion& m) {
    for (std::size_t k = 0; k < m.positions.size(); ++k)
      m.positions[k](m.index_of("ibug68_17"), 1) += 0.0018 * double(k) / 80;
  });
  const std::vector<Note> of_less = with(R"("ibug68_17", "ibug68_26", "ibug68_29")");
  EXPECT_THAT(of_less,
              Contains(AllOf(is_note("head.pose_uncertain"), says("is uncertain by up to "),
                             says("the points of motion.rigid_points jitter or move"),
                             Not(says("names points fixed")))));
  EXPECT_THAT(of_less, Not(Contains(has_id("head.pose_unknown"))));
}

TEST_F(InputNotes, NameTheCornerOfTheMouthThatIsNotRecorded) {
  const auto without = [&](const std::vector<std::string>& names) {
    open(0, 16, [&](motion::Motion& m) { leave_out(m, names); });
    return notes({"drive.points=\"all\""});
  };
  EXPECT_THAT(without({"cheilion_R", "ibug68_48", "ibug68_60"}),
              Contains(AllOf(is_warning("recording.one_sided"),
                             says("the right corner of the mouth is not recorded (ibug68_48"))));
  EXPECT_THAT(without({"cheilion_L", "ibug68_54", "ibug68_64"}),
              Contains(AllOf(is_warning("recording.one_sided"), says("the left corner"))));
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"ibug68_48", "cheilion_L"},
        {"cheilion_R", "ibug68_48", "ibug68_60", "cheilion_L", "ibug68_54", "ibug68_64"}})
    EXPECT_THAT(without(names), Not(Contains(is_warning("recording.one_sided"))));
}

TEST_F(InputNotes, NamePointsOfTheSkullThatAreNotUsed) {
  const auto unused = [](const std::vector<Note>& notes) {
    return std::ranges::count(notes, "head.still_points_unused", &Note::id);
  };
  open(0, 41, [](motion::Motion&) {});
  EXPECT_EQ(unused(notes()), 0);
  open(0, 41, add_headband);
  EXPECT_THAT(notes(), Contains(AllOf(is_note("head.still_points_unused"),
                                      says("head_1, head_2, head_3, head_4, head_5, head_6 keep"),
                                      says("name them in motion.rigid_points"))));
  EXPECT_EQ(unused(notes({R"(motion.rigid_points=["head_1", "head_3", "head_5"])"})), 0);
  // They show no noise: how well they hold the head is not known, unless the points are exact.
  const std::string all =
      R"(motion.rigid_points=["head_1", "head_2", "head_3", "head_4", "head_5", "head_6"])";
  const auto known = [&](const std::vector<std::string>& set) {
    return read_inputs(scene::read_scene(folder_ / "scene.toml", set), Extent::quick)
        .head_uncertainty_known;
  };
  EXPECT_FALSE(known({all}));
  EXPECT_TRUE(known({all, "output.jitter_mm=0"}));
  EXPECT_TRUE(known({})) << "the landmarks of a face may move";
}

/// The columns of motion.csv by other names.
void rename_points(motion::Motion& m, const std::map<std::string, std::string>& names) {
  for (std::string& name : m.names)
    if (const auto found = names.find(name); found != names.end()) name = found->second;
}

TEST_F(InputNotes, ComeAfterNamesThatNoScanHas) {
  const auto rename = [](motion::Motion& m) {
    keep_mouth_and_headband(m);
    rename_points(m, {{"ibug68_48", "right mouth corner"},
                      {"ibug68_54", "left mouth corner"},
                      {"ibug68_51", "upper lip"},
                      {"ibug68_57", "lower lip"},
                      {"ibug68_8", "chin"},
                      {"ibug68_58", "lower lip right"},
                      {"ibug68_56", "lower lip left"}});
  };
  open(0, 16, rename);
  const std::string rigid =
      R"(motion.rigid_points=["head_1", "head_2", "head_3", "head_4", "head_5", "head_6"])";
  const std::string at_the_scan = test::refusal([&] { notes({rigid}); });
  EXPECT_THAT(at_the_scan,
              AllOf(testing::HasSubstr("shares 0 point names with the scan's landmarks"),
                    testing::HasSubstr("its points are right mouth corner, left mouth corner,"),
                    testing::HasSubstr("did you mean ibug68_48 by right mouth corner, ibug68_54 by "
                                       "left mouth corner, ibug68_51 by upper lip, ibug68_57 by "
                                       "lower lip, ibug68_8 by chin?")));
  replace_in(folder_ / "scene.toml", "landmarks = \"face_landmarks.json\"\n", "");
  EXPECT_EQ(test::refusal([&] { notes({rigid}); }), at_the_scan)
      << "landmarks need not be found for that";
}

TEST_F(InputNotes, ComeAfterADefaultPointThatTheRecordingLacks) {
  open(0, 16, [](motion::Motion& m) {
    keep_mouth_and_headband(m);
    rename_points(m, {{"ibug68_48", "mole"}});
  });
  const std::vector<std::string> rigid = {
      R"(motion.rigid_points=["head_1", "head_2", "head_3", "head_4", "head_5", "head_6"])"};
  const std::string said = test::refusal([&] { notes(rigid); });
  EXPECT_THAT(said, testing::EndsWith("motion.csv: expected the point ibug68_48 (corner of the "
                                      "mouth, right), which is missing: record it, or choose other "
                                      "points with drive.points"));
  replace_in(folder_ / "scene.toml", "landmarks = \"face_landmarks.json\"\n", "");
  EXPECT_EQ(test::refusal([&] { notes(rigid); }), said) << "landmarks need not be found for that";
}

TEST_F(InputNotes, ListFiveOfManyPointsThatTheRecordingLacks) {
  open(0, 16, [](motion::Motion& m) {
    for (const int k : metrics::driven_ibug_points())
      rename_points(m, {{"ibug68_" + std::to_string(k), "mole_" + std::to_string(k)}});
  });
  EXPECT_THAT(
      test::refusal([&] { notes({}); }),
      AllOf(HasSubstr("motion.csv: expected the points ibug68_"), HasSubstr(", and 2 more, which "),
            HasSubstr("are missing (it has "), HasSubstr(" more): record them, or choose")));
}

TEST_F(InputNotes, WithoutPointsOfTheHeadSayWhatElseWorks) {
  open(0, 16, [](motion::Motion& m) {
    keep_mouth_and_headband(m);
    for (Points& sample : m.positions) sample.conservativeResize(7, Eigen::NoChange);
    m.names.resize(7);
  });
  EXPECT_THAT(test::refusal([&] { notes(); }),
              AllOf(testing::HasSubstr("motion.rigid_points finds too few others, as the motion's "
                                       "other points move with mouth and chin"),
                    testing::HasSubstr("hyperex symmetry works without them"),
                    Not(testing::HasSubstr("ibug68_8"))));
}

TEST_F(InputNotes, ComeAfterNamesOfRigidPoints) {
  open(0, 16, keep_mouth_and_headband);
  const std::string said = test::refusal(
      [&] { notes({R"(motion.rigid_points=["head_1", "head_2", "hed_3", "head_6"])"}); });
  EXPECT_THAT(said, testing::StartsWith("--set: motion.rigid_points = [\"head_1\", "));
  EXPECT_THAT(said, testing::HasSubstr("(hed_3 is none); did you mean head_3?"));
  EXPECT_THAT(said, testing::HasSubstr("motion.csv"));
}

TEST_F(InputNotes, ComeAfterStillPointsThatAreDriven) {
  const auto said = [&](const std::string& name) {
    return test::refusal([&] { notes({"drive.still_points=[\"" + name + "\"]"}); });
  };
  EXPECT_EQ(said("ibug68_57"),
            "--set: drive.still_points = [\"ibug68_57\"]: expected points that are not driven "
            "(ibug68_57 is); drive.points chooses the driven ones");
  EXPECT_THAT(said("cheilion_L"), testing::HasSubstr("(cheilion_L is, as ibug68_54)"));
  EXPECT_EQ(said("ibug68_33"), "");
}

TEST_F(InputNotes, SayHowBadlyTheRecordingFits) {
  open(0, 16, [](motion::Motion& m) {
    for (auto& sample : m.positions) sample *= 1.5;
  });
  EXPECT_THAT(warnings(), ElementsAre(AllOf(is_warning("recording.fits_badly"), says("0.667"))));
}

TEST_F(InputNotes, SayInWhoseMillimetresResultsAre) {
  open(0, 16, [](motion::Motion& m) {
    for (auto& sample : m.positions) sample /= 1.04;
  });
  EXPECT_THAT(warnings(), IsEmpty());
  EXPECT_THAT(notes(),
              Contains(AllOf(is_note("recording.rescaled"), says("1.040 times as large"))));
  EXPECT_THAT(notes({"alignment.method=\"normalised\""}),
              Not(Contains(has_id("recording.rescaled"))));
  open(0, 16, [](motion::Motion&) {});
  EXPECT_THAT(notes(), Not(Contains(has_id("recording.rescaled"))));
}

TEST_F(InputNotes, NameThePointThatDoesNotFitInPlaceOfAMisfit) {
  open(0, 16, [](motion::Motion& m) {
    for (auto& sample : m.positions) sample(m.index_of("ibug68_54"), 2) += 0.06;
  });
  EXPECT_GT(read_inputs(scene::read_scene(folder_ / "scene.toml"), Extent::quick).motion.rms_mm, 5);
  EXPECT_THAT(warnings(),
              ElementsAre(AllOf(is_warning("recording.point_off"),
                                says("ibug68_54 (corner of the mouth, left) lies 60.0 mm"))));
}

TEST_F(InputNotes, NameAWrongLandmarkOnce) {
  io::Landmarks landmarks = good_landmarks();
  landmarks["cheilion_R"] = landmarks["cheek_R"];
  io::write_landmarks(folder_ / "face_landmarks.json", landmarks, io::LengthUnit::millimetre);
  EXPECT_THAT(warnings(),
              ElementsAre(AllOf(is_warning("landmarks.doubtful"), says("landmark cheilion_R"))));
}

TEST_F(InputNotes, NameTheUnitThatFits) {
  open(0, 16, [](motion::Motion& m) {
    for (auto& sample : m.positions) sample *= 0.1;
  });
  EXPECT_THAT(warnings(),
              ElementsAre(AllOf(is_warning("recording.fits_badly"), says("as if in cm"))));
}

TEST_F(InputNotes, TellAnotherPersonsFaceFromTheOwnAsADepthCameraSeesIt) {
  // A face that is taller than the scan's by `share`, narrower by half of it, and hence as large.
  const auto read_taller = [&](double share) {
    open(0, 16, [&](motion::Motion& m) {
      const double middle = m.positions.front().col(1).mean();
      for (auto& sample : m.positions) {
        sample.col(1).array() += share * (sample.col(1).array() - middle);
        sample.col(0) *= 1 - share / 2;
      }
    });
    return read_inputs(scene::read_scene(folder_ / "scene.toml"), Extent::quick);
  };
  const auto off_by = [&](double rms_mm) {
    double share = 0.1;
    for (int i = 0; i < 4; ++i) share *= rms_mm / read_taller(share).motion.rms_mm;
    Inputs in = read_taller(share);
    EXPECT_NEAR(in.motion.rms_mm, rms_mm, 0.1);
    EXPECT_GE(in.motion.common.size(), 20u);
    return in.notes;
  };
  EXPECT_THAT(off_by(5.5), Contains(AllOf(is_warning("recording.fits_badly"), says("5.5 mm rms"),
                                          says("under 5 mm"))));
  EXPECT_THAT(off_by(3.5), Not(Contains(has_id("recording.fits_badly"))));
}

TEST_F(InputNotes, ComeAfterNamesOfRegionsWhereLandmarksAreNotKnown) {
  replace_in(folder_ / "scene.toml", "landmarks = \"face_landmarks.json\"\n", "");
  const auto refusal = [&](const std::vector<std::string>& overrides) -> std::string {
    try {
      notes(overrides);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal({"tissue.region=[{name=\"cheek_left\", young_factor=5}]"}),
              testing::HasSubstr("tissue.region[0].name = \"cheek_left\": expected the name of a "
                                 "region (hyperex presets lists them); did you mean cheek_L?"));
  EXPECT_EQ(refusal({"tissue.region=[{scar=[\"cheilion_R\", \"alare_R\"], width_mm=8, "
                     "young_factor=5}]"}),
            "")
      << "whether the scan has these landmarks is not known";
  put(folder_ / "scene.toml", read_file(folder_ / "scene.toml") +
                                  "[[variant]]\nname = \"v\"\ntissue.region = [{ name = "
                                  "\"nosse\", young_factor = 5 }]\n");
  EXPECT_THAT(refusal({}), AllOf(testing::HasSubstr("variant[0].tissue.region[0].name = "),
                                 testing::HasSubstr("did you mean nose?")));
}

TEST_F(InputNotes, NameMisspeltAndOwnLandmarks) {
  io::Landmarks landmarks = good_landmarks();
  landmarks["cheilon_L"] = landmarks["cheilion_L"];
  landmarks.erase("cheilion_L");
  landmarks["my_own_mark"] = landmarks["nasion"];
  io::write_landmarks(folder_ / "face_landmarks.json", landmarks, io::LengthUnit::millimetre);
  EXPECT_THAT(notes(), AllOf(Contains(AllOf(is_warning("landmarks.misspelt"), says("cheilon_L"),
                                            says("cheilion_L?"))),
                             Contains(AllOf(is_note("landmarks.unknown"), says("my_own_mark")))));
}

TEST_F(InputNotes, SayWhereTheJitterIsFrom) {
  open(0, 81, [](motion::Motion&) {});
  const auto inputs = [&](const std::vector<std::string>& set) {
    return read_inputs(scene::read_scene(folder_ / "scene.toml", set), Extent::quick);
  };
  EXPECT_THAT(notes(), Contains(is_note("recording.no_jitter")));
  EXPECT_FALSE(inputs({}).jitter_known) << "the points may be smoothed";
  EXPECT_TRUE(inputs({"output.jitter_mm=0"}).jitter_known);
  open(0, 81, [](motion::Motion& m) {
    std::mt19937 generator(1);
    std::normal_distribution<double> noise(0, 0.2e-3);
    for (auto& sample : m.positions)
      for (double& x : sample.reshaped()) x += noise(generator);
  });
  const Inputs noisy = inputs({});
  EXPECT_TRUE(noisy.jitter_known);
  EXPECT_THAT(noisy.notes, Contains(is_note("recording.jitter")));
  EXPECT_NEAR(1e3 * noisy.jitter_m, 0.2, 0.03);
  EXPECT_THAT(notes({"output.jitter_mm=0.1"}),
              AllOf(Contains(AllOf(is_note("recording.jitter_stated"), says("0.10 mm"))),
                    Not(Contains(has_id("recording.jitter")))));
}

}  // namespace
}  // namespace hyperex::session
