// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/face_session.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/metrics/peak_tissue.hpp"
#include "hyperex/metrics/skin_uncertainty.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/scene/given_text.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/same_face.hpp"
#include "hyperex/session/scene_source.hpp"
#include "hyperex/session/variants.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::session {
namespace {

const std::string kCoarse = R"(
[scan]
file = "embedded"
[motion]
file = "embedded"
[mesh]
element_size_mm = 10
layers = 1
[time]
frame_rate_hz = 5
[tissue]
young_kpa = 100
[[tissue.region]]
name = "cheek_R"
young_factor = 2
)";
const std::string kMuscles = "[drive]\nby = \"muscles\"\n";

scene::Scene scene_of(const std::string& text) {
  return scene::read_scene_text(text, "coarse.toml");
}

FaceSession session_of(const std::string& text, Certainty certainty = Certainty::on_request) {
  return FaceSession(scene_of(text), {.certainty = certainty});
}

void expect_equal(const FaceResult& a, const FaceResult& b) {
  const auto &one = a.performance().skin_displacement_m,
             &other = b.performance().skin_displacement_m;
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t f = 0; f < one.size(); ++f) EXPECT_EQ(one[f], other[f]) << "frame " << f;
}

double apart_mm(const FaceResult& a, const FaceResult& b) {
  double most = 0;
  for (std::size_t f = 0; f < a.performance().skin_displacement_m.size(); ++f)
    most = std::max(most, double((a.performance().skin_displacement_m[f] -
                                  b.performance().skin_displacement_m[f])
                                     .cwiseAbs()
                                     .maxCoeff()));
  return 1e3 * most;
}

std::vector<double> mesh_floors(const FaceResult& result) {
  std::vector<double> out;
  for (const auto& pair : result.measures().excursions.pairs) out.push_back(pair.mesh_floor_mm);
  return out;
}

TEST(FaceSession, AsksWhatTheSameForcesDoInOtherTissue) {
  FaceSession face = session_of(kCoarse + kMuscles);
  const FaceResult before = face.run();
  EXPECT_EQ(before.name, "base");
  const auto mesh = face.shared_mesh();
  face.set("tissue.young_kpa", 300);
  EXPECT_FALSE(face.up_to_date());
  const FaceResult after = face.run();
  EXPECT_EQ(face.shared_mesh(), mesh) << "other tissue needs no other mesh";
  EXPECT_GT(apart_mm(before, after), 0.1);
  expect_equal(face.result(0), before);
  expect_equal(face.variant("stiff", {{"tissue.young_kpa", 300}}), after);
  EXPECT_EQ(&face.performance(), &face.variants()[0].simulation.performance) << "that of set()";
  face.set("tissue.young_kpa", 100);
  EXPECT_LT(apart_mm(face.run(), before), 0.05) << "the forces make the recorded motion";
}

/// Mean displacement at the peak of the skin 25 to 40 mm from the corners of the mouth, where no
/// point drives.
double beside_the_corners_mm(const FaceSession& face, const FaceResult& result) {
  const simulate::Performance& p = result.performance();
  const io::Landmarks& at = face.inputs().landmarks;
  double sum = 0, count = 0;
  for (Eigen::Index v = 0; v < p.skin_rest.points.rows(); ++v) {
    const Vec3 place = p.skin_rest.points.row(v);
    const double away_m =
        std::min((place - at.at("cheilion_L")).norm(), (place - at.at("cheilion_R")).norm());
    if (away_m < 0.025 || away_m > 0.04) continue;
    sum += p.skin_displacement_m[std::size_t(p.peak_frame)].row(v).norm();
    ++count;
  }
  return 1e3 * sum / count;
}

TEST(FaceSession, UnderAStifferSkinTheSameForcesMoveTheFaceLess) {
  FaceSession face =
      session_of("scan.file = \"embedded\"\nmotion.arkit = '" HYPEREX_SOURCE_DIR
                 "/examples/smile_arkit.csv'\nmesh = { element_size_mm = 10, layers = 1 }\n"
                 "time.frame_rate_hz = 5\ndrive.by = \"muscles\"\n");
  const FaceResult before = face.run();
  const double plain_mm = beside_the_corners_mm(face, before);
  EXPECT_GT(plain_mm, 1);
  const Value skin = Value::from_json(
      R"([{"name": "skin", "thickness_mm": 2, "young_factor": 10}, {"name": "deep"}])");
  face.set("tissue.layer", skin);
  const FaceResult after = face.run();
  EXPECT_LT(beside_the_corners_mm(face, after), 0.8 * plain_mm);
  expect_equal(face.variant("skin", {{"tissue.layer", skin}}), after);
  face.set("tissue.layer[0].young_factor", 1);
  EXPECT_LT(apart_mm(face.run(), before), 0.05) << "a layer like the rest changes nothing";
}

/// A layer that ends within the thinnest tissue is not noted.
TEST(FaceSession, NotesWhereTheTissueIsTooThinForItsLayers) {
  std::vector<Note> heard;
  const auto times_heard = [](const std::vector<Note>& notes) {
    return std::ranges::count(notes, std::string("tissue.layers_end"), &Note::id);
  };
  const auto noted = [&](const std::string& more) {
    heard.clear();
    const FaceSession face(scene_of(kCoarse + more),
                           {.certainty = Certainty::on_request,
                            .note = [&](const Note& note) { heard.push_back(note); }});
    std::vector<std::string> of;
    for (const Note& note : face.notes())
      if (note.id == "tissue.layers_end") of.push_back(note.variant + ":" + note.key);
    EXPECT_EQ(times_heard(heard), long(of.size()));
    return of;
  };
  const std::string thick = "layer = [{ name = \"fat\", thickness_mm = 7, young_factor = 0.5 }]\n";
  EXPECT_THAT(noted(""), testing::IsEmpty());
  EXPECT_THAT(noted("[[tissue.layer]]\nthickness_mm = 1\nyoung_factor = 2\n"), testing::IsEmpty());
  EXPECT_THAT(noted("[[variant]]\nname = \"v\"\ntissue." + thick),
              testing::ElementsAre("v:tissue.layer"));
  EXPECT_THAT(noted("[[tissue.layer]]\nthickness_mm = 7\nyoung_factor = 0.5\n"),
              testing::ElementsAre(":tissue.layer"));
  heard.clear();
  FaceSession face(scene_of(kCoarse), {.certainty = Certainty::on_request,
                                       .note = [&](const Note& note) { heard.push_back(note); }});
  EXPECT_EQ(times_heard(heard), 0);
  face.set("tissue.layer", Value::from_json(R"([{"thickness_mm": 7, "young_factor": 0.5}])"));
  EXPECT_EQ(times_heard(heard), 1);
  face.set("tissue.layer[0].young_factor", 0.6);
  EXPECT_EQ(times_heard(heard), 1) << "once";
}

TEST(FaceSession, ChangesPartsOfLists) {
  FaceSession face =
      session_of(kCoarse + "[[tissue.region]]\nname = \"chin\"\nyoung_factor = 3\n" + kMuscles);
  const FaceResult before = face.run();
  face.set("tissue.region[1].young_factor", 20);
  const FaceResult part = face.run();
  EXPECT_GT(apart_mm(before, part), 0.01);
  expect_equal(face.variant("whole", {{"tissue.region",
                                       Value::from_json(R"([{"name": "cheek_R", "young_factor": 2},
                                                       {"name": "chin", "young_factor": 20}])")}}),
               part);
  EXPECT_THROW(face.set("tissue.region[3].young_factor", 2), InputError);
  EXPECT_THROW(face.set("tissue.region[0]young_factor", 2), InputError);
}

TEST(FaceSession, RefusedChangesChangeNothing) {
  FaceSession face = session_of(kCoarse);
  face.run();
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, Value>>{{"tissue.young_kpa", -3},
                                                  {"tissue.young", 3},
                                                  {"mesh.layers", 0},
                                                  {"drive.by", "magic"}}) {
    EXPECT_THROW(face.set(key, value), InputError) << key;
    EXPECT_TRUE(face.up_to_date()) << key;
    EXPECT_EQ(face.faces(), 1U) << key;
  }
}

TEST(FaceSession, OpensTheFaceAnewForAnotherMeshOnly) {
  FaceSession face = session_of(kCoarse);
  const auto mesh = face.shared_mesh();
  face.set("time.end_s", 0.5);
  EXPECT_EQ(face.shared_mesh(), mesh);
  face.set("mesh.element_size_mm", 12);
  EXPECT_NE(face.shared_mesh(), mesh);
  EXPECT_LT(face.mesh().volume.nodes.rows(), mesh->volume.nodes.rows());
  EXPECT_EQ(face.scene().time.end_s, 0.5) << "earlier changes stay";
}

TEST(FaceSession, OtherScenesOfTheFaceGiveWhatAFreshSessionGives) {
  const std::string variants =
      "[[variant]]\nname = \"soft\"\ntissue.young_kpa = 60\n[[variant]]\nname = \"weak\"\n"
      "muscles.gain = { side_R = 0.5 }\n";
  FaceSession face = session_of(kCoarse + kMuscles + variants);
  face.run();
  face.find_certainty();
  face.skin_uncertainty();
  const std::string stiffer = kCoarse + "viscosity_factor = 2\n" + kMuscles + variants +
                              "[[variant]]\nname = \"third\"\nmotion.gain = 0.5\n";
  ASSERT_TRUE(face.set_scene(scene_of(stiffer)));
  EXPECT_FALSE(face.base_up_to_date()) << "the tissue of base has changed";
  face.run();
  FaceSession fresh = session_of(stiffer);
  fresh.run();
  for (FaceSession* each : {&face, &fresh}) {
    EXPECT_FALSE(each->certainty_known());
    each->find_certainty();
  }
  EXPECT_EQ(face.options(0), face.simulator().options())
      << "the tissue's field is that of the scene";
  ASSERT_EQ(face.faces(), fresh.faces());
  for (std::size_t f = 0; f < face.faces(); ++f) {
    expect_equal(face.result(f), fresh.result(f));
    EXPECT_EQ(mesh_floors(face.result(f)), mesh_floors(fresh.result(f)));
  }
  EXPECT_EQ(metrics::json_of(face.tissue_at_peak()), metrics::json_of(fresh.tissue_at_peak()));
  EXPECT_EQ(face.skin_uncertainty()->distance_mm, fresh.skin_uncertainty()->distance_mm);
  std::vector<Note> notes = face.notes();
  EXPECT_EQ(std::erase_if(notes, [](const Note& note) { return note.id == "forces.found_anew"; }),
            1u);
  EXPECT_EQ(notes, fresh.notes());
  // A variant alone changes: base and the others stay.
  ASSERT_TRUE(
      face.set_scene(scene_of(kCoarse + "viscosity_factor = 2\n" + kMuscles +
                              "[[variant]]\nname = \"weak\"\nmuscles.gain = { side_R = 0.2 }\n")));
  EXPECT_TRUE(face.base_up_to_date());
  EXPECT_FALSE(face.up_to_date());
  EXPECT_FALSE(face.set_scene(scene_of(stiffer + "\n[alignment]\nmethod = \"similarity\"\n")));
}

TEST(FaceSession, ASceneThatIsRefusedChangesNothing) {
  FaceSession face = session_of(kCoarse + kMuscles);
  const FaceResult before = face.run();
  scene::Scene wrong =
      scene_of(kCoarse + kMuscles + "[[variant]]\nname = \"softer\"\ntissue.young_kpa = 60\n");
  wrong.variants[0].scene.solver.tolerance = -1;
  EXPECT_THROW(face.set_scene(wrong), InputError);
  EXPECT_TRUE(face.scene().variants.empty());
  expect_equal(face.run(), before);
  face.set("tissue.young_kpa", 90);
  ASSERT_EQ(face.scene().variants.size(), 1u) << "the change, and no variant of the refused scene";
  EXPECT_NE(face.scene().variants[0].name, "softer");
}

TEST(FaceSession, ErrorsOfChangesNameKeysAndNoMadeUpPlaces) {
  const std::string weak =
      kCoarse + kMuscles + "[[variant]]\nname = \"weak\"\nmuscles.gain = { side_R = 0.2 }\n";
  FaceSession face = session_of(weak);
  const auto said = [](const auto& act) { return test::refusal(act); };
  EXPECT_THAT(said([&] { face.set("tissue.young_kpa", -3); }),
              testing::StartsWith("tissue.young_kpa = -3: expected a number"));
  EXPECT_THAT(said([&] { face.set("mesh.layers", -1); }),
              testing::StartsWith("mesh.layers = -1: expected"));
  EXPECT_THAT(said([&] {
                face.variant("odd", {{"muscles.gain", Value::from_json("{\"zyg_R\": 0.3}")}});
              }),
              testing::StartsWith("variant odd: muscles.gain.zyg_R = 0.3: expected"));
  EXPECT_THAT(said([&] {
                FaceSession(Face{face.scan(), face.inputs().landmarks}, face.inputs().motion.motion,
                            {{"tissue.young_kpa", -3}});
              }),
              testing::StartsWith("tissue.young_kpa = -3: expected"));
}

TEST(SceneSource, KeepsThePlacesOfKeysThatStay) {
  const SceneSource first(
      scene_of(kCoarse + kMuscles + "[[variant]]\nname = \"weak\"\ntissue.poisson = 0.4\n"));
  const scene::Scene now = first.with_value("mesh.layers", 2).scene();
  const auto place = [](const scene::Scene& scene, const char* key) {
    const scene::Origin& at = scene.origins.at(key);
    return at.file.string() + ":" + std::to_string(at.line);
  };
  EXPECT_EQ(place(now, "tissue.young_kpa"), place(first.scene(), "tissue.young_kpa"));
  EXPECT_EQ(place(now, "mesh.layers"), ":0") << "no place in the file";
  ASSERT_EQ(now.variants.size(), 1u);
  EXPECT_EQ(place(now.variants[0].scene, "tissue.poisson"),
            place(first.scene().variants[0].scene, "tissue.poisson"));
  const scene::Scene other = first.with_change("weak", "tissue.poisson", 0.3).scene();
  EXPECT_EQ(place(other.variants[0].scene, "tissue.poisson"), ":0");
  EXPECT_EQ(place(other, "mesh.layers"), place(first.scene(), "mesh.layers"));
}

const std::string kScar =
    "[[variant]]\nname = \"scar\"\n"
    "tissue.region = [{ scar = [\"cheilion_R\", \"nowhere\"], width_mm = 8, young_factor = 5 }]\n";

TEST(FaceSession, LeavesOutVariantsThatCannotBeRunWhereItMay) {
  const scene::Scene scene = scene_of(kCoarse + kMuscles + kScar +
                                      "[[variant]]\nname = \"stiff\"\ntissue.young_kpa = 400\n"
                                      "[[variant]]\nname = \"full\"\n"
                                      "tissue.region = [{ name = \"cheek_R\", volume_ml = 30 }]\n");
  EXPECT_THROW(FaceSession(scene, {.certainty = Certainty::on_request}), InputError);
  FaceSession face(scene, {.certainty = Certainty::on_request, .leave_out_variants = true});
  ASSERT_EQ(face.left_out().size(), 2u);
  EXPECT_EQ(face.left_out()[0].name, "scar");
  EXPECT_THAT(face.left_out()[0].why,
              testing::AllOf(testing::HasSubstr("variant[0].tissue.region[0].scar"),
                             testing::HasSubstr("nowhere is none")));
  EXPECT_EQ(face.left_out()[1].number, 2u) << "found on the mesh, and named by its place";
  EXPECT_THAT(face.left_out()[1].why,
              testing::AllOf(testing::HasSubstr("variant[2].tissue.region[0].volume_ml"),
                             testing::HasSubstr("this region alone takes up to")));
  ASSERT_EQ(face.faces(), 2u);
  EXPECT_EQ(face.variants()[0].scene.title, "stiff");
  const FaceResult base = face.run();
  EXPECT_GT(apart_mm(base, face.result(1)), 0.01);
  const scene::Scene sound =
      scene_of(kCoarse + kMuscles + "[[variant]]\nname = \"stiff\"\n" + "tissue.young_kpa = 400\n");
  const FaceSession strict(sound, {.certainty = Certainty::on_request, .leave_out_variants = true});
  EXPECT_TRUE(strict.left_out().empty());
  EXPECT_EQ(strict.faces(), 2u);
}

TEST(FaceSession, LeavesOutVariantsWhoseFilesAreOfAnotherScan) {
  const TestFolder folder;
  std::ofstream(folder.path() / "young.csv") << "young_kpa\n100\n200\n";
  const scene::Scene scene =
      scene_of(kCoarse + kMuscles + "[[variant]]\nname = \"other\"\ntissue.per_vertex = \"" +
               (folder.path() / "young.csv").string() + "\"\n");
  EXPECT_THROW(FaceSession(scene, {.certainty = Certainty::on_request}), InputError);
  const FaceSession face(scene, {.certainty = Certainty::on_request, .leave_out_variants = true});
  ASSERT_EQ(face.left_out().size(), 1u);
  EXPECT_EQ(face.left_out()[0].name, "other");
}

TEST(FaceSession, LeavesOutNothingOfASceneThatIsWrongItself) {
  const std::string lips = "[[tissue.region]]\nname = \"lips\"\npoisson_factor = -3\n";
  const std::string said = test::refusal([&] {
    FaceSession(scene_of(kCoarse + lips + kMuscles + kScar),
                {.certainty = Certainty::on_request, .leave_out_variants = true});
  });
  EXPECT_EQ(said, test::refusal([&] { session_of(kCoarse + lips + kMuscles); }));
  EXPECT_THAT(said, testing::HasSubstr("tissue.region[1].poisson_factor"));
}

TEST(FaceSession, ShapesMayBeSwitchedOffByKey) {
  FaceSession face = session_of(kCoarse + kMuscles);
  ASSERT_TRUE(face.scene().muscles.shape_prior);
  face.set("muscles.shape_prior", false);
  EXPECT_FALSE(face.scene().muscles.shape_prior);
  EXPECT_TRUE(face.scene().variants.empty());
}

/// Keys of the rows "inputs" and "mesh" in the header's table are those that make the face.
TEST(FaceSession, TheHeadersTableNamesTheKeysThatMakeTheFace) {
  std::ifstream file(std::string(HYPEREX_SOURCE_DIR) + "/src/hyperex/session/face_session.hpp");
  std::string rows;
  bool within = false;
  for (std::string line; std::getline(file, line);) {
    within = (within || line.starts_with("///   inputs ")) && !line.starts_with("///   teeth ");
    if (within) rows += line;
  }
  ASSERT_NE(rows.find("[motion] but its gain"), std::string::npos) << rows;
  for (const scene::Key& key : scene::keys()) {
    const bool named = rows.find(key.name) != std::string::npos ||
                       rows.find("[" + scene::section_of(key.name) + "]") != std::string::npos;
    EXPECT_EQ(makes_the_face(key.name), named && key.name != "motion.gain") << key.name;
  }
}

TEST(FaceSession, ContactSwitchedOnLaterIsThatOfAFreshSession) {
  const anatomy::EmbeddedFace embedded = anatomy::embedded_face();
  Face given;
  given.scan.mesh = embedded.mesh;
  given.landmarks = embedded.landmarks;
  motion::Motion pressed = motion::embedded_mouth_opening(embedded.landmarks);
  const Eigen::RowVector3d back = -face::face_frame(embedded.landmarks).z.transpose();
  for (std::size_t k = 0; k < pressed.positions.size(); ++k) {
    pressed.positions[k] = pressed.positions[0];
    for (int lips = 48; lips < 68; ++lips)
      if (const auto at = std::ranges::find(pressed.names, face::ibug(lips));
          at != pressed.names.end())
        pressed.positions[k].row(at - pressed.names.begin()) +=
            5e-3 * std::min(1.0, double(k) / 20) * back;
  }
  const Changes coarse = {
      {"mesh.element_size_mm", 10}, {"mesh.layers", 1}, {"time.frame_rate_hz", 5}};
  FaceSession face(given, pressed, coarse, {.certainty = Certainty::on_request});
  face.run();
  EXPECT_EQ(face.obstacles(), nullptr);
  face.set("contact.teeth", true);
  ASSERT_NE(face.obstacles(), nullptr);
  const FaceResult after = face.run();
  EXPECT_GT(after.report().contact.frames, 0);
  Changes all = coarse;
  all.emplace("contact.teeth", true);
  FaceSession fresh(given, pressed, all, {.certainty = Certainty::on_request});
  expect_equal(after, fresh.run());
}

TEST(FaceSession, VariantsRespondToTheForcesOfAChangedBase) {
  const std::string variant = kMuscles + "[[variant]]\nname = \"soft\"\ntissue.young_kpa = 60\n";
  std::string stiffer = kCoarse;
  stiffer.replace(stiffer.find("100"), 3, "150");
  FaceSession face = session_of(kCoarse + variant);
  face.run();
  ASSERT_TRUE(face.set_scene(scene_of(stiffer + variant)));
  face.run();
  FaceSession fresh = session_of(stiffer + variant);
  fresh.run();
  expect_equal(face.result(1), fresh.result(1));
}

TEST(FaceSession, AtFiniteStrainVariantsHaveTheForcesOfTheRunOfBase) {
  std::string finite = kCoarse + kMuscles + "[[variant]]\nname = \"soft\"\n";
  finite.insert(finite.find("young_kpa"), "strain = \"finite\"\n");
  const std::string now = finite + "tissue.young_kpa = 60\n";
  FaceSession face = session_of(finite + "tissue.young_kpa = 80\n");
  face.still(1, 0.1);  // makes the variant's simulator
  ASSERT_TRUE(face.set_scene(scene_of(now)));
  face.run();
  FaceSession fresh = session_of(now);
  fresh.run();
  expect_equal(face.result(1), fresh.result(1));
}

TEST(FaceSession, ForgetsTheWarningsOfAVariantThatIsGone) {
  const auto idle = [](const FaceSession& face) {
    return std::ranges::count(face.warnings(), "variant.no_effect", &Note::id);
  };
  FaceSession face =
      session_of(kCoarse + kMuscles + "[[variant]]\nname = \"same\"\ntissue.young_kpa = 100\n");
  face.run();
  EXPECT_EQ(idle(face), 1);
  ASSERT_TRUE(face.set_scene(scene_of(kCoarse + kMuscles)));
  face.run();
  EXPECT_EQ(idle(face), 0);
}

TEST(FaceSession, KnowsWhatThePointsDoNotTellWhereShapesTakePart) {
  FaceSession session = session_of(kCoarse + kMuscles);
  session.run();
  const metrics::SkinUncertainty* known = session.skin_uncertainty();
  ASSERT_NE(known, nullptr);
  ASSERT_EQ(known->distance_mm.size(), session.mesh().skin.points.rows());
  EXPECT_TRUE(known->distance_mm.allFinite());
  const auto regions = metrics::json_of(*known, session.mesh().skin, session.inputs().landmarks);
  const auto value = [&](const char* region, const char* what) {
    return regions.at(region).at(what).get<double>();
  };
  // Seven points of mouth and chin determine the lips and hardly the eyes.
  EXPECT_GT(value("lips", "determined"), 0.8);
  EXPECT_LT(value("eyes", "determined"), 0.2);
  EXPECT_LT(value("lips", "distance_rms_mm"), value("cheeks", "distance_rms_mm") + 1);
  for (const std::string& other : {kMuscles + "[muscles]\nshape_prior = false\n",
                                   std::string("[drive]\nby = \"displacement\"\n")}) {
    FaceSession without = session_of(kCoarse + other);
    without.run();
    EXPECT_EQ(without.skin_uncertainty(), nullptr) << other;
  }
}

TEST(FaceSession, KnowsItsBandsWithTheRunOrOnRequest) {
  const std::string variant = "[[variant]]\nname = \"soft\"\ntissue.young_kpa = 60\n";
  FaceSession at_once = session_of(kCoarse + kMuscles + variant, Certainty::with_runs);
  FaceSession later = session_of(kCoarse + kMuscles + variant);
  at_once.run();
  later.run();
  EXPECT_FALSE(later.certainty_known());
  later.find_certainty();
  EXPECT_TRUE(later.certainty_known());
  at_once.find_certainty();  // the search for landmarks
  EXPECT_TRUE(at_once.certainty_known());
  for (std::size_t f = 0; f < 2; ++f) {
    ASSERT_THAT(mesh_floors(at_once.result(f)), testing::Not(testing::IsEmpty()));
    EXPECT_EQ(mesh_floors(at_once.result(f)), mesh_floors(later.result(f)));
  }
}

TEST(FaceSession, TakesAFaceAndAMotionFromMemory) {
  const anatomy::EmbeddedFace embedded = anatomy::embedded_face();
  Face face;
  face.scan.mesh = embedded.mesh;
  face.landmarks = embedded.landmarks;
  FaceSession session(face, motion::embedded_mouth_opening(embedded.landmarks),
                      {{"mesh.element_size_mm", 10}, {"mesh.layers", 1}, {"time.frame_rate_hz", 5}},
                      {.certainty = Certainty::on_request});
  const FaceResult result = session.run();
  EXPECT_GT(result.report().lip_gap_mm, 5) << "the mouth opens";
  session.set("tissue.young_kpa", 500);
  EXPECT_NO_THROW(session.run());
  EXPECT_THROW(
      FaceSession(face, motion::embedded_mouth_opening(embedded.landmarks), {{"mesh.size", 10}}),
      InputError);
}

TEST(GivenText, MakesTheSameScene) {
  for (const char* name : {"demo", "variants", "stiff_cheek", "mouth_open"}) {
    const scene::Scene scene = scene::read_scene(
        std::string(HYPEREX_SOURCE_DIR "/examples/") + name + ".toml", {"tissue.poisson=0.4"});
    const scene::Scene again = scene::read_scene_text(scene::given_text(scene), scene.file);
    const auto absolute = [](nlohmann::json options) {
      for (auto& [section, keys] : options.items())
        if (keys.is_object())
          for (auto& [key, value] : keys.items())
            if (value.is_string() && std::filesystem::exists(value.get<std::string>()))
              value = std::filesystem::absolute(value.get<std::string>()).generic_string();
      return options;
    };
    EXPECT_EQ(absolute(options_json(again)), absolute(options_json(scene))) << name;
    ASSERT_EQ(again.variants.size(), scene.variants.size()) << name;
    for (std::size_t i = 0; i < again.variants.size(); ++i)
      EXPECT_EQ(options_json(again.variants[i].scene)["tissue"],
                options_json(scene.variants[i].scene)["tissue"]);
  }
}

}  // namespace
}  // namespace hyperex::session
