// SPDX-License-Identifier: GPL-3.0-or-later
// Opening, saving, and the files that a crashed session leaves.
#include <fstream>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/visits/compare_visits.hpp"
#include "hyperex/visits/summary.hpp"
#include "studio.hpp"
#include "support/zip_writer.hpp"
#include "unit/studio/session_fixture.hpp"

namespace hyperex::studio {
namespace {

using testing::HasSubstr;

TEST_F(StudioSession, TheFaultOfTheFileOnTheCommandLineIsToldInTheTerminalToo) {
  std::vector<std::string> told;
  SessionOptions options;
  options.save_into = folder_.path() / "mine";
  options.folder = folder_.path() / "own";
  options.started = folder_.path() / "empty.toml";
  options.tell = [&](const std::string& text) { told.push_back(text); };
  std::ofstream(options.started).close();
  Session session(options, [](const std::string&, bool, const std::string&) {});
  session.answer({1, "open", {{"what", "started"}}});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], HasSubstr("empty.toml"));
  std::ofstream(options.started) << "scan.file = [\n";
  session.answer({2, "open", {{"what", "started"}}});
  ASSERT_EQ(told.size(), 2u);
  EXPECT_THAT(told[1], HasSubstr("empty.toml"));
  session.answer({3, "open", {{"what", "not_there.ply"}}});
  EXPECT_EQ(told.size(), 2u) << "the page asked for that";
}

TEST(RunStudio, AFolderIsNoMissingFile) {
  const TestFolder folder;
  const auto refusal = [](const fs::path& started) {
    StudioOptions options;
    options.started = started;
    options.open_browser = false;
    try {
      run_studio(options);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal(folder.path()), HasSubstr("is a folder; expected a scene (.toml) or a scan"));
  EXPECT_THAT(refusal(folder / "none.toml"), HasSubstr("no such file"));
}

TEST(StudioFolder, ForSavedFilesIsMade) {
  const TestFolder folder;
  make_folder_for_saved_files(folder / "new" / "deep");
  EXPECT_TRUE(fs::is_directory(folder / "new" / "deep"));
  EXPECT_NO_THROW(make_folder_for_saved_files(folder / "new")) << "there already";
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(make_folder_for_saved_files(folder / "file"), InputError);
  EXPECT_THROW(make_folder_for_saved_files(folder / "file" / "below"), InputError);
}

TEST_F(StudioSession, OpensTheRecordingInAZipAndNothingElse) {
  const fs::path uploads = folder_.path() / "own" / "uploads";
  const auto opened = [&](const std::vector<hyperex::test::Zipped>& files) {
    fs::remove_all(uploads);
    fs::create_directory(uploads);
    std::ofstream(uploads / "me.ply") << "ply\n";
    std::ofstream(uploads / "rec.zip", std::ios::binary) << hyperex::test::zip_of(files);
    return ask("open", {{"what", "me.ply"}, {"recording", "rec.zip"}}).value("error", "");
  };
  const auto names = [&] {
    std::vector<std::string> out;
    for (const auto& one : fs::directory_iterator(uploads))
      out.push_back(one.path().filename().string());
    return out;
  };
  EXPECT_THAT(opened({{"a.txt", "1"}}), HasSubstr("holds no recording"));
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply")) << "what is of no use is gone";
  EXPECT_THAT(opened({{"talk/rgb.txt", "0 rgb/0.png\n"}}), HasSubstr("camera.toml: missing"));
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply"));
  EXPECT_THAT(opened({{"../../scene.toml", "1"}, {"rgb.txt", ""}}), HasSubstr("leads elsewhere"));
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply"));
  EXPECT_FALSE(fs::exists(folder_.path() / "own" / "scene.toml"));
  // The contents of these archives are damaged. A message about them can only come from the
  // directory of the zip.
  hyperex::test::Zipped bomb{"talk/rgb.txt", "0 rgb/0.png\n"},
      beside{"talk/camera.toml", "width = 1\n"};
  bomb.method = 77;
  bomb.size = std::int64_t(1) << 30U;
  EXPECT_THAT(opened({bomb, beside}), HasSubstr("unpacks to more than 16 MB"));
  bomb.size = -1;
  EXPECT_THAT(opened({bomb}), HasSubstr("rec.zip/talk/camera.toml: missing"));
  bomb.name = "talk/pictures.bin";
  EXPECT_THAT(opened({bomb, beside}), HasSubstr("holds no recording"));
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply"));
  const std::string lists = "0 rgb/0.png\n",
                    camera = "width = 64\nheight = 48\nfx = 60\nfy = 60\ncx = 31.5\ncy = 23.5\n";
  EXPECT_THAT(opened({{"talk/rgb.txt", lists}, {"talk/camera.toml", camera}}), HasSubstr("me.ply"))
      << "the scan is no scan";
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply", "talk"));
  EXPECT_THAT(opened({{"rgb.txt", lists}, {"camera.toml", camera}}), HasSubstr("me.ply"));
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply", "rec"));
}

TEST_F(StudioSession, ASavedSceneOpensAgainFromItsFiles) {
  open();
  ask("save", {{"what", "scene"}, {"name", "mine"}});
  const fs::path mine = folder_.path() / "mine", uploads = folder_.path() / "own" / "uploads";
  fs::copy(mine / "mine.toml", uploads / "mine.toml");
  EXPECT_THAT(ask("open", {{"what", "mine.toml"}})["error"].get<std::string>(),
              HasSubstr("open that file together with it"));
  fs::copy(mine / "mine_files" / "smile_arkit.csv", uploads / "smile_arkit.csv");
  EXPECT_FALSE(ask("open", {{"what", "mine.toml"}}).contains("error"));
}

const std::string kCoarseFace =
    "# One face.\n[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n"
    "[mesh]\nelement_size_mm = 10\nlayers = 1\n";
const std::string kScarThroughNowhere =
    "\n[[variant]]\nname = \"scar\"\n# Across the cheek.\n"
    "tissue.region = [{ scar = [\"cheilion_R\", \"nowhere\"], width_mm = 8, young_factor = 5 }]\n";

class StudioSessionWithWrongVariants : public StudioSession {
 protected:
  json open_scene(const std::string& text) {
    std::ofstream(folder_.path() / "own" / "uploads" / "mixed.toml") << text;
    return ask("open", {{"what", "mixed.toml"}});
  }
  std::string saved_scene() {
    EXPECT_FALSE(ask("save", {{"what", "scene"}, {"name", "mine"}}).contains("error"));
    return read_file(folder_.path() / "mine" / "mine.toml");
  }
  /// The names of the variants that the last event "face" says are left out.
  std::vector<std::string> left_out() const {
    std::vector<std::string> names;
    for (const json& remark : event("face")->head["replay"]["summary"]["remarks"])
      if (remark["id"] == "variant.left_out") {
        EXPECT_FALSE(remark.contains("variant")) << "it would be hidden on every face";
        const std::string text = remark["text"];
        const auto from = text.find('"') + 1;
        names.push_back(text.substr(from, text.find('"', from) - from));
      }
    return names;
  }
  std::string logged() const {
    std::string all;
    for (const Message& message : messages_)
      if (message.head.value("event", "") == "log")
        all += message.head["text"].get<std::string>() + "\n";
    return all;
  }

  const std::string text_ =
      kCoarseFace + kScarThroughNowhere +
      "\n[[variant]]\nname = \"stiff\"\ntissue.young_kpa = 400\n"
      "\n# A muscle that is none.\n[[variant]]\nname = \"weak\"\nmuscles.gain = { zyg_R = 0.3 }\n";
};

TEST_F(StudioSessionWithWrongVariants, OpensAllElseAndSaysWhatIsLeftOut) {
  ASSERT_FALSE(open_scene(text_).contains("error"));
  EXPECT_THAT(
      logged(),
      testing::AllOf(HasSubstr("variant \"scar\" cannot be run and is left out here; a saved scene "
                               "keeps it: mixed.toml:"),
                     HasSubstr("variant[0].tissue.region[0].scar = [\"cheilion_R\", \"nowhere\"]: "
                               "expected names of landmarks of the scan (nowhere is none)"),
                     HasSubstr("variant \"weak\" cannot be run"),
                     HasSubstr("variant[2].muscles.gain.zyg_R = 0.3: expected")));
  const json faces = event("scene")->head["faces"];
  ASSERT_EQ(faces.size(), 2U);
  EXPECT_EQ(faces[1]["name"], "stiff");
  work();
  ASSERT_NE(event("face"), nullptr);
  EXPECT_THAT(left_out(), testing::ElementsAre("scar", "weak"));
  ask("hello");
  work();
  EXPECT_THAT(left_out(), testing::ElementsAre("scar", "weak")) << "also to a page loaded again";
  ask("open", {{"what", "embedded"}});
  work();
  EXPECT_THAT(left_out(), testing::IsEmpty()) << "another scene";
}

TEST_F(StudioSessionWithWrongVariants, KeepsThemInWhatIsSaved) {
  ASSERT_FALSE(open_scene(text_).contains("error"));
  EXPECT_EQ(event("scene")->head["text"], text_);
  EXPECT_EQ(saved_scene(), text_);
  EXPECT_THAT(logged(), HasSubstr("the saved scene keeps 2 variants that cannot be run: "
                                  "hyperex run refuses it"));
  ASSERT_FALSE(set({{"tissue.young_kpa", 300}}, 1).contains("error"));
  const std::string shown = event("scene")->head["text"], saved = saved_scene();
  EXPECT_EQ(saved, shown);
  EXPECT_EQ(saved, read_file(folder_.path() / "own" / "scene.toml")) << "kept after a crash, too";
  EXPECT_THAT(saved, testing::AllOf(HasSubstr("young_kpa = 300"), HasSubstr(kScarThroughNowhere),
                                    HasSubstr("gain = { zyg_R = 0.3 }")));
  ASSERT_FALSE(open_scene(saved).contains("error"));
  EXPECT_EQ(event("scene")->head["values"][1]["tissue.young_kpa"], 300);
  work();
  EXPECT_THAT(left_out(), testing::ElementsAre("scar", "weak"));
}

TEST_F(StudioSessionWithWrongVariants, RefusesWhatIsWrongInTheSceneItself) {
  const std::string scar =
                        "[[tissue.region]]\nscar = [\"cheilion_R\", \"nowhere\"]\n"
                        "width_mm = 8\nyoung_factor = 5\n",
                    lips = "[[tissue.region]]\nname = \"lips\"\npoisson_factor = -3\n";
  for (const std::string& wrong : {std::string("[tissue]\nyoung_kpa = -3\n"), scar, lips}) {
    const std::string error =
        open_scene(kCoarseFace + wrong + kScarThroughNowhere).value("error", "");
    EXPECT_THAT(error, HasSubstr(": tissue.")) << wrong;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    EXPECT_EQ(event("scene"), nullptr);
  }
  EXPECT_THAT(
      open_scene("variant = [{ name = \"a\", tissue = { young_kpa = -4 } }]\n" + kCoarseFace)
          .value("error", ""),
      HasSubstr("variant[0].tissue.young_kpa"))
      << "its text could not be kept";
}

TEST_F(StudioSession, WritesOverNothingThatItDidNotWrite) {
  open();
  std::ofstream(folder_.path() / "mine" / "theirs.toml") << "mine";
  EXPECT_THAT(ask("save", {{"what", "scene"}, {"name", "theirs"}})["error"].get<std::string>(),
              HasSubstr("is there already"));
  EXPECT_EQ(read_file(folder_.path() / "mine" / "theirs.toml"), "mine");
  fs::create_directory(folder_.path() / "mine" / "theirs-2");
  EXPECT_EQ(ask("free_name", {{"name", "theirs"}})["name"], "theirs-3");
  EXPECT_EQ(ask("free_name", {{"name", "nobody's"}}).contains("error"), true);
  EXPECT_EQ(ask("free_name", {{"name", "ours"}})["name"], "ours");
  for (const char* name : {"../x", "a/b", ".x", ""})
    EXPECT_TRUE(ask("save", {{"what", "scene"}, {"name", name}}).contains("error")) << name;
  for (int i = 0; i < 2; ++i)
    EXPECT_FALSE(ask("save", {{"what", "scene"}, {"name", "ours"}}).contains("error"));
  EXPECT_EQ(ask("free_name", {{"name", "ours"}})["name"], "ours") << "which may be written again";
  EXPECT_FALSE(ask("save", {{"what", "landmarks"}, {"name", "marks"}}).contains("error"));
  EXPECT_TRUE(fs::exists(folder_.path() / "mine" / "marks.mrk.json"));
}

TEST_F(StudioSession, ALinkInThePlaceOfWhatItWroteIsNotFollowed) {
  open();
  const fs::path ours = folder_.path() / "mine" / "ours.toml", other = folder_.path() / "other";
  ASSERT_FALSE(ask("save", {{"what", "scene"}, {"name", "ours"}}).contains("error"));
  fs::remove(ours);
  std::ofstream(other) << "somebody's";
  fs::create_symlink(other, ours);
  EXPECT_TRUE(ask("save", {{"what", "scene"}, {"name", "ours"}}).contains("error"));
  EXPECT_EQ(read_file(other), "somebody's");
}

TEST_F(StudioSession, ARunThatIsSavedIsGivenUpWhereTheStudioEnds) {
  open();
  ending_ = true;
  EXPECT_TRUE(ask("save", {{"what", "run"}, {"name", "whole"}}).contains("error"));
  EXPECT_TRUE(fs::is_empty(folder_.path() / "mine"));
}

/// A session next to a folder that an earlier session has left.
class StudioSessionLeftovers : public testing::Test {
 protected:
  SessionOptions with_leftovers() const {
    SessionOptions made;
    made.save_into = made.folder = folder_.path();
    made.rescued = folder_.path() / "left";
    fs::create_directories(made.rescued);
    fs::create_directories(made.folder / "uploads");
    std::ofstream(made.rescued / "scene.toml")
        << "scan.file = \"embedded\"\nmotion.file = \"embedded\"\n";
    return made;
  }

  const TestFolder folder_;
  std::vector<json> answers;
  const SessionOptions options = with_leftovers();
  Session session{options, [this](const std::string& message, bool binary, const std::string&) {
                    if (!binary && json::parse(message).contains("answer"))
                      answers.push_back(json::parse(message));
                  }};
};

TEST_F(StudioSessionLeftovers, AreDeletedWhenAskedButNotWhileTheyAreOpen) {
  session.answer({1, "open", {{"what", "autosave"}}});
  session.answer({2, "discard_autosave", json::object()});
  EXPECT_THAT(answers.back().value("error", ""), HasSubstr("is open"));
  session.answer({3, "open", {{"what", "embedded"}}});
  session.answer({4, "discard_autosave", json::object()});
  EXPECT_FALSE(answers.back().contains("error")) << answers.back();
  EXPECT_FALSE(fs::exists(options.rescued));
  EXPECT_FALSE(session.keeps_rescued());
  session.answer({5, "discard_autosave", json::object()});
  EXPECT_TRUE(answers.back().contains("error"));
  session.answer({6, "hello", {{"token", ""}, {"version", 1}}});
  EXPECT_TRUE(answers.back()["places"]["autosave"].is_null());
}

TEST_F(StudioSessionLeftovers, AreNamedByTheirScanAndNotOfferedWhileTheyAreOpen) {
  const auto offered = [&] {
    session.answer({1, "hello", {{"token", ""}, {"version", 1}}});
    return answers.back()["places"]["autosave"];
  };
  EXPECT_EQ(offered()["title"], "embedded");
  session.answer({2, "open", {{"what", "autosave"}}});
  EXPECT_TRUE(offered().is_null());
  session.answer({3, "open", {{"what", "embedded"}}});
  EXPECT_FALSE(offered().is_null()) << "it is still there, and no file holds it";
}

// The open scan, its landmarks and options stay; undo restores the other motion.
TEST_F(StudioSession, ASecondRecordingMovesTheFaceThatIsOpen) {
  open();
  ask("add_variant", {{"name", "weak"}, {"like", 0}});
  set({{"muscles.gain", {{"side_R", 0.4}}}}, 1);
  const double smile_mm = [&] {
    work();
    return right_mm(0);
  }();
  std::ofstream(folder_.path() / "own" / "uploads" / "visit2.csv")
      << "time_s,mouthSmileLeft,mouthSmileRight\n0,0,0\n0.5,0.3,0.3\n1,0,0\n";
  ASSERT_FALSE(ask("open", {{"what", "current"}, {"recording", "visit2.csv"}}).contains("error"));
  const json scene = event("scene")->head;
  EXPECT_THAT(scene["values"][0]["motion.arkit"].get<std::string>(),
              testing::EndsWith("visit2.csv"));
  EXPECT_EQ(scene["title"], "") << "it was that of the built-in smile";
  EXPECT_EQ(scene["faces"][1]["name"], "weak");
  work();
  const json& table = event("face") ? event("face")->head["replay"]["summary"]["variants"]["table"]
                                    : event("motion")->head["table"];
  EXPECT_LT(table[0]["commissure_R_mm"].get<double>(), 0.6 * smile_mm);
  ask("undo");
  EXPECT_THAT(event("scene")->head["values"][0]["motion.arkit"].get<std::string>(),
              testing::EndsWith("smile_arkit.csv"));
  // One that is none changes nothing, and is named without the studio's own folder.
  std::ofstream(folder_.path() / "own" / "uploads" / "notes.csv") << "shopping\nmilk\n";
  const std::string error =
      ask("open", {{"what", "current"}, {"recording", "notes.csv"}}).value("error", "");
  EXPECT_THAT(error, HasSubstr("notes.csv"));
  EXPECT_EQ(error.find("uploads"), std::string::npos) << error;
}

TEST_F(StudioSession, ComparesARecordingWithTheOneBefore) {
  open();
  EXPECT_EQ(event("scene")->head["earlier"], "");
  const auto compared = [&](const std::string& name) {
    return ask("compare_visits", {{"expression", "smile"}, {"name", name}});
  };
  EXPECT_THAT(compared("change").value("error", ""), HasSubstr("there is one recording"));
  const auto drop = [&](const std::string& name, double left, double right) {
    std::ofstream file(folder_.path() / "own" / "uploads" / name);
    file << "time_s,mouthSmileLeft,mouthSmileRight\n";
    for (int k = 0; k <= 30; ++k) {
      const double course = std::min(1.0, k / 15.0);
      file << k / 30.0 << ',' << left * course << ',' << right * course << '\n';
    }
    file.close();
    EXPECT_FALSE(ask("open", {{"what", "current"}, {"recording", name}}).contains("error"));
  };
  drop("visit1.csv", 0.8, 0.8);
  EXPECT_EQ(event("scene")->head["earlier"], "") << "the studio's own smile is no patient's";
  drop("visit2.csv", 0.8, 0.3);
  EXPECT_EQ(event("scene")->head["earlier"], "visit1.csv");
  std::ofstream(folder_.path() / "mine" / "taken.html") << "not of the studio";
  EXPECT_THAT(compared("taken").value("error", ""), HasSubstr("expected another name"));
  const json answer = compared("change");
  ASSERT_FALSE(answer.contains("error")) << answer;
  EXPECT_THAT(
      answer["sentences"][0].get<std::string>(),
      testing::AllOf(HasSubstr("Right corner of the mouth"), HasSubstr("6.2 mm less; whether")));
  const std::string page = read_file(folder_.path() / "mine" / "change.html");
  EXPECT_THAT(page, HasSubstr("visit2.csv"));
  EXPECT_EQ(page.find("uploads"), std::string::npos) << "the studio's own folder means nothing";
  std::ofstream(folder_.path() / "mine" / "change.html") << "of the comparison before";
  std::ofstream(folder_.path() / "mine" / "change-2.html") << "not of the studio";
  EXPECT_THAT(compared("change")["path"].get<std::string>(), testing::EndsWith("/change-3.html"));
  EXPECT_EQ(read_file(folder_.path() / "mine" / "change.html"), "of the comparison before");
  EXPECT_EQ(read_file(folder_.path() / "mine" / "change-2.html"), "not of the studio");
  EXPECT_THAT(read_file(folder_.path() / "mine" / "change-3.html"), HasSubstr("visit2.csv"));
  ask("undo");
  EXPECT_EQ(event("scene")->head["earlier"], "") << "it is the present one again";
  ask("undo");
  EXPECT_EQ(event("scene")->head["earlier"], "") << "the present one is the studio's own";
}

/// The face at rest is that of each recording, not the scan's.
TEST_F(StudioSession, VisitsKeepTheFaceAtRest) {
  open();
  const auto drop = [&](const std::string& name, double droop_m) {
    motion::Motion smile = motion::embedded_mouth_opening(anatomy::embedded_face().landmarks);
    const Points rest = smile.positions.front();
    for (Eigen::Index p = 0; p < rest.rows(); ++p)
      if ((rest.row(p) - rest.row(smile.index_of(face::ibug(48)))).norm() < 1e-3)
        for (Points& at : smile.positions) at(p, 1) -= droop_m;
    motion::write_motion_csv(folder_.path() / "own" / "uploads" / name, smile);
    EXPECT_FALSE(ask("open", {{"what", "current"}, {"recording", name}}).contains("error"));
  };
  drop("visit1.csv", 0);
  drop("visit2.csv", 0.004);
  const json answer = ask("compare_visits", {{"expression", "mouth open"}, {"name", "change"}});
  ASSERT_FALSE(answer.contains("error")) << answer;
  const std::string page = read_file(folder_.path() / "mine" / "change.html");
  const auto at = page.find("\"corner_height\"");
  ASSERT_NE(at, std::string::npos);
  // The measure of the page's data: {"changes":[null,{..."value":-4.0}],"key":"corner_height",...
  const auto begins = page.rfind("\"changes\"", at);
  EXPECT_THAT(page.substr(begins, at - begins), testing::ContainsRegex("\"value\":-[34]\\."));
}

/// A head pose that is taken out before the comparison takes it out makes other figures.
TEST_F(StudioSession, VisitsSayWhatTheCommandSaysOfTheSameFiles) {
  open();
  visits::VisitsFile file;
  file.expression = *visits::expression_named("mouth open");
  for (const auto& [name, opening_deg] : {std::pair{"visit1.csv", 12.0}, {"visit2.csv", 8.0}}) {
    motion::MouthOpeningOptions options;
    options.peak_deg = opening_deg;
    visits::VisitEntry visit;
    visit.label = name;
    visit.recordings = {folder_.path() / "own" / "uploads" / name};
    motion::write_motion_csv(
        visit.recordings.front(),
        motion::embedded_mouth_opening(anatomy::embedded_face().landmarks, options));
    EXPECT_FALSE(ask("open", {{"what", "current"}, {"recording", name}}).contains("error"));
    file.visits.push_back(visit);
  }
  const json answer = ask("compare_visits", {{"expression", "mouth open"}, {"name", "change"}});
  ASSERT_FALSE(answer.contains("error")) << answer;
  EXPECT_EQ(answer["sentences"].get<std::vector<std::string>>(),
            visits::summary(visits::compare_visits(file)));
  const motion::Motion recorded = motion::read_motion(file.visits[0].recordings[0]),
                       compared = motion::read_motion(folder_.path() / "own" / "visit_1.csv");
  ASSERT_EQ(compared.positions.size(), recorded.positions.size());
  for (std::size_t k = 0; k < recorded.positions.size(); ++k)
    EXPECT_LT((compared.positions[k] - recorded.positions[k]).cwiseAbs().maxCoeff(), 1e-9) << k;
}

TEST_F(StudioSession, WhatIsDoneLiesInItsFolderAtOnce) {
  open();
  set({{"tissue.young_kpa", 151}}, 0);
  EXPECT_THAT(read_file(folder_.path() / "own" / "scene.toml"), HasSubstr("young_kpa = 151"));
}

}  // namespace
}  // namespace hyperex::studio
