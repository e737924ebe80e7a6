// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/run_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/report/face_backing.hpp"
#include "support/note_matchers.hpp"

namespace hyperex::session {
namespace {
using test::is_note;
using test::says;
using testing::AllOf;
using testing::ElementsAre;

auto is_warning(const char* id, const char* key) {
  return AllOf(test::is_warning(id), test::is_about(key));
}

simulate::Performance skin_moving(float first_m, float second_m) {
  simulate::Performance p;
  p.skin_displacement_m = {PointsF::Zero(2, 3), PointsF::Zero(2, 3)};
  p.skin_displacement_m[1](0, 0) = first_m;
  p.skin_displacement_m[1](1, 2) = second_m;
  return p;
}

TEST(RunWarnings, LipsThatPassByMoreThanHalfAMillimetre) {
  simulate::SimulationReport report;
  report.lip_overlap_mm = 0.5;
  EXPECT_THAT(run_warnings(report, {}, {}), ElementsAre());
  report.lip_overlap_mm = 0.52;
  EXPECT_THAT(run_warnings(report, {}, {}),
              ElementsAre(is_warning("lips.pass_through", "contact.lips")));
  EXPECT_THAT(run_warnings(report, {}, {}),
              ElementsAre(AllOf(says("0.5 mm"), says("off by at most that much"),
                                says("contact.lips = true"))));
}

TEST(RunWarnings, SayInWhichFrameAndAdviseNothingThatIsOn) {
  simulate::SimulationReport report;
  report.lip_overlap_mm = 3.2;
  report.lip_overlap_frame = 1;
  report.inverted_tets = 100;
  report.inverted_frame = 2;
  simulate::Performance p;
  p.frame_time_s = {0, 0.2, 0.4};
  p.tets.resize(3000, 4);
  simulate::ContactOptions contact;
  contact.lips = true;
  const auto of = [&](const FrameWords& words) { return run_warnings(report, p, contact, words); };
  EXPECT_THAT(of({}), ElementsAre(AllOf(says("3.2 mm, at 0.20 s."),
                                        testing::Not(says("contact.lips = true"))),
                                  says("inside out at 0.40 s:")));
  const FrameWords shape = [](int frame) { return "in the shape " + std::to_string(frame); };
  EXPECT_THAT(of(shape), ElementsAre(says("by up to 3.2 mm, in the shape 1."),
                                     says("inside out in the shape 2:")));
  report.inverted_tets = 2;
  EXPECT_THAT(notes_on_contact_and_elements(report, p, {}, shape),
              ElementsAre(says("2 of 3000 tetrahedra turned inside out in the shape 2, too few")));
}

TEST(RunWarnings, InvertedElementsCountFromOneInAThousand) {
  simulate::SimulationReport report;
  simulate::Performance p;
  p.tets.resize(3000, 4);
  report.inverted_tets = 3;
  EXPECT_THAT(run_warnings(report, p, {}), ElementsAre());
  EXPECT_THAT(notes_on_contact_and_elements(report, p, {}),
              ElementsAre(is_note("tissue.few_inverted")));
  report.inverted_tets = 4;
  EXPECT_THAT(run_warnings(report, p, {}),
              ElementsAre(is_warning("tissue.inverted", "tissue.strain")));
  EXPECT_THAT(run_warnings(report, p, {}), ElementsAre(says("4 of 3000")));
  EXPECT_THAT(run_warnings(report, p, {}), ElementsAre(says("linear strain")));
  EXPECT_THAT(notes_on_contact_and_elements(report, p, {}), ElementsAre());
  p.model.strain = simulate::Strain::finite;
  EXPECT_THAT(run_warnings(report, p, {}), ElementsAre(says("these elements")));
}

TEST(GazeNotes, SayWhichEyesOfTheScanAreClosed) {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  simulate::Performance p;
  p.skin_rest = face.mesh;
  p.landmarks.time_s = {0};
  for (const auto& [name, at] : face.landmarks) p.landmarks.names.push_back(name);
  p.landmarks.positions = {Points(Eigen::Index(face.landmarks.size()), 3)};
  Eigen::Index row = 0;
  for (const auto& [name, at] : face.landmarks) p.landmarks.positions[0].row(row++) = at;
  EXPECT_THAT(gaze_notes(p, nullptr), ElementsAre()) << "without a gaze";
  const report::FaceBacking backing = report::face_backing(p);
  EXPECT_THAT(gaze_notes(p, &backing), ElementsAre()) << "its eyes are open";
  report::FaceBacking other = backing;
  std::erase_if(other.openings, [&](const report::Opening& opening) {
    const Vec3 middle = p.skin_rest.points(opening.loop, Eigen::all).colwise().mean();
    return (middle - face.landmarks.at("ibug68_45")).norm() < 0.03;  // the left eye's outer corner
  });
  EXPECT_THAT(gaze_notes(p, &other),
              ElementsAre(AllOf(is_note("eyes.closed"), says("at the left eye"),
                                says("this eye is not seen"))))
      << "the openings are those handed over";
  p.landmarks.names.clear();
  p.landmarks.positions.clear();
  EXPECT_THAT(gaze_notes(p, &backing),
              ElementsAre(AllOf(is_note("eyes.closed"), says("at either eye"), says("gaze.csv"))));
}

TEST(RunWarnings, TheReportsOwnNotesComeFirst) {
  simulate::SimulationReport report;
  report.notes = {{"forces.found_anew", Severity::warning, simulate::kForcesFoundAnew, ""}};
  report.lip_overlap_mm = 2;
  EXPECT_THAT(run_warnings(report, {}, {}),
              ElementsAre(is_warning("forces.found_anew", ""),
                          is_warning("lips.pass_through", "contact.lips")));
}

TEST(SymmetryNotes, SayWhyThePlaneIsTheLandmarks) {
  metrics::SymmetryMeasures symmetry;
  EXPECT_THAT(symmetry_notes(symmetry, ""), ElementsAre());
  symmetry.map.emplace();
  EXPECT_THAT(symmetry_notes(symmetry, ""), ElementsAre()) << "the surface has refined it";
  symmetry.map->plane.note = "too little of the reflected face lies near the face";
  EXPECT_THAT(
      symmetry_notes(symmetry, ""),
      ElementsAre(AllOf(test::is_warning("symmetry.plane_of_landmarks"), says("too little"))));
}

TEST(NotesOnContact, SayThatNothingTouchesOnlyWhereContactIsOn) {
  simulate::SimulationReport report;
  simulate::ContactOptions contact;
  EXPECT_THAT(notes_on_contact_and_elements(report, {}, contact), ElementsAre());
  contact.eyes = true;
  EXPECT_THAT(notes_on_contact_and_elements(report, {}, contact),
              ElementsAre(is_note("contact.none")));
  report.contact.frames = 1;
  EXPECT_THAT(notes_on_contact_and_elements(report, {}, contact), ElementsAre());
}

TEST(GainsHardlyKnown, AreTheVariantsUnlessBaseHasThem) {
  const Note note = make_warning("muscles.gain_hardly_used", "zyg_major_R is hardly active");
  std::vector<VariantRun> runs(2);
  runs[0].scene.title = "tissue alone";
  runs[1].scene.title = "weak right";
  runs[1].simulation.report.notes = {make_warning("drive.points_off", "off"), note};
  const std::vector<Note> notes = gains_hardly_known({}, runs);
  EXPECT_THAT(notes, ElementsAre(is_warning("variant.muscle_hardly_used", "muscles.gain")));
  EXPECT_THAT(notes, ElementsAre(AllOf(says("weak right: "), says("zyg_major_R"))));
  EXPECT_THAT(gains_hardly_known({note}, runs), ElementsAre());
}

TEST(VolumeWarning, IsGivenFromAThreefoldChangeOn) {
  const auto warnings = [](double least, double greatest) {
    metrics::PeakTissue tissue;
    tissue.volume_ratio = metrics::TetSpread{.min = least, .p99 = 1.2, .max = greatest};
    return volume_warnings(tissue);
  };
  EXPECT_THAT(warnings(0.34, 3), ElementsAre());
  EXPECT_THAT(volume_warnings({}), ElementsAre()) << "small strain";
  for (const auto& [least, greatest] : {std::pair{0.33, 1.0}, {0.5, 3.01}})
    EXPECT_THAT(warnings(least, greatest),
                ElementsAre(AllOf(test::is_warning("tissue.volume_changed"), says("1.20"))));
}

TEST(StrainNotes, AreOfSmallStrainAboveOneHalf) {
  const auto notes = [](double greatest, bool finite) {
    metrics::PeakTissue tissue;
    tissue.finite = finite;
    // An inverted element, which has a note of its own, does not count.
    tissue.principal_strain =
        metrics::TetSpread{.p99 = 0.31, .max = 5, .max_not_inverted = greatest};
    return strain_notes(tissue);
  };
  EXPECT_THAT(notes(0.5, false), ElementsAre());
  EXPECT_THAT(notes(0.99, true), ElementsAre());
  EXPECT_THAT(strain_notes({}), ElementsAre());
  EXPECT_THAT(notes(0.99, false),
              ElementsAre(AllOf(test::is_note("tissue.large_strain"), says("0.99"), says("0.31"),
                                says("tissue.strain = \"finite\""))));
}

TEST(LipsThatPass, AreThoseOfVariantsThatPassFartherThanBase) {
  std::vector<VariantRun> runs(4);
  const double overlap_mm[] = {0.4, 0.6, 1.4, 2};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].scene.title = "v" + std::to_string(i);
    runs[i].simulation.report.lip_overlap_mm = overlap_mm[i];
  }
  EXPECT_THAT(
      lips_that_pass(runs, 0),
      ElementsAre(says("v1"), says("v2"), AllOf(says("v3"), says("2.0 mm (0.0 mm in base)"))));
  EXPECT_THAT(lips_that_pass(runs, 1.35), ElementsAre(says("v3"))) << "base's own is reported once";
  EXPECT_THAT(lips_that_pass({}, 3), ElementsAre());
  EXPECT_THAT(lips_that_pass(runs, 1.35), ElementsAre(says("contact.lips = true")));
  runs[3].scene.contact.lips = true;
  EXPECT_THAT(lips_that_pass(runs, 1.35), ElementsAre(testing::Not(says("contact.lips"))));
}

TEST(IdleVariants, MoveAsBaseDoesToAThousandthOfAMillimetre) {
  std::vector<VariantRun> runs(4);
  const simulate::Performance base = skin_moving(0.01F, 0.002F);
  runs[0].simulation.performance = base;
  runs[1].simulation.performance = skin_moving(0.01F, 0.0020005F);
  runs[2].simulation.performance = skin_moving(0.01F, 0.002002F);
  runs[3].simulation.performance = base;
  runs[3].simulation.performance.skin_displacement_m.pop_back();
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].scene.title = "v" + std::to_string(i);
  EXPECT_THAT(
      idle_variants(base, runs),
      ElementsAre(AllOf(is_warning("variant.no_effect", "variant"), says("v0 ")), says("v1 ")));
}

TEST(VariantWarnings, HoldEachKind) {
  simulate::SimulationResult base;
  base.performance = skin_moving(0, 0);
  std::vector<VariantRun> runs(1);
  runs[0].simulation = base;
  runs[0].simulation.report.notes = {make_warning("muscles.gain_hardly_used", "hardly active")};
  runs[0].simulation.report.lip_overlap_mm = 1;
  EXPECT_THAT(variant_warnings(base, runs),
              ElementsAre(is_warning("variant.no_effect", "variant"),
                          is_warning("variant.lips_pass_through", "contact.lips"),
                          is_warning("variant.muscle_hardly_used", "muscles.gain")));
}

}  // namespace
}  // namespace hyperex::session
