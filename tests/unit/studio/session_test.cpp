// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of a scene and their history, live and committed.
#include <algorithm>
#include <fstream>

#include "hyperex/core/files.hpp"
#include "hyperex/run/run_scene.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "support/resident_memory.hpp"
#include "unit/studio/session_fixture.hpp"

namespace hyperex::studio {
namespace {

using testing::HasSubstr;

class StudioSessionWithBands : public StudioSession {
 protected:
  StudioSessionWithBands() : StudioSession(true) {}
};

TEST(SessionHandlers, HandleEachRequestOfTheProtocol) {
  std::vector<std::string> described, handled;
  for (const auto& [name, request] : protocol().at("requests").items()) described.push_back(name);
  for (const auto& [name, handler] : Session::handlers()) {
    handled.emplace_back(name);
    EXPECT_NE(handler, nullptr) << name;
  }
  EXPECT_THAT(handled, testing::UnorderedElementsAreArray(described));
}

/// Figures of the event budget.
const json& figures_of(const Message& budget) {
  return budget.head.at("figures");
}

TEST_F(StudioSession, StatesTheErrorBudgetWhenAskedAndOnlyOfThatScene) {
  open();
  set({{"mesh.element_size_mm", 7}}, 0);
  ask("add_variant", {{"name", "weak"}, {"like", 0}});
  set({{"muscles.gain", {{"side_R", 0.5}}}}, 1);
  work();
  ask("error_budget");
  ASSERT_TRUE(session_->has_work());
  set({{"muscles.gain", {{"side_R", 0.6}}}}, 1);
  work();
  EXPECT_EQ(event("budget"), nullptr) << "the scene was changed before";

  ask("error_budget");
  session_->work([] { return true; });
  EXPECT_EQ(event("budget"), nullptr);
  EXPECT_TRUE(session_->has_work()) << "another request waits";
  work();
  const Message* budget = event("budget");
  ASSERT_NE(budget, nullptr);
  ASSERT_EQ(figures_of(*budget).size(), 5);  // two sides, their difference, two changes
  const json& change = figures_of(*budget)[3];
  EXPECT_EQ(change["variant"], "weak");
  EXPECT_EQ(change["side"], "R");
  EXPECT_LT(change["value_mm"], -1);
  EXPECT_GT(change["half_width_95_mm"], 0.2);
  EXPECT_EQ(change["decided"], true);
  EXPECT_EQ(event("progress")->head["stage"], "") << "done";
  EXPECT_FALSE(session_->has_work());
}

TEST_F(StudioSession, ARequestWithoutAHandlerIsAnError) {
  session_->answer({7, "dance", json::object()});
  ASSERT_FALSE(messages_.empty());
  EXPECT_EQ(messages_.back().head, json({{"answer", 7}, {"error", "dance: no such request"}}));
}

TEST_F(StudioSessionWithBands, FindsErrorBandsAsTheCommandDoesWhenNothingElseIsToDo) {
  open();
  ask("add_variant", {{"name", "weak"}, {"like", 0}});
  set({{"muscles.gain", {{"side_R", 0.7}}}}, 1);
  session_->work([] { return false; });
  ASSERT_NE(event("motion"), nullptr);
  EXPECT_EQ(event("motion")->head["bands"], false);
  EXPECT_TRUE(event("motion")->head["table"][1]["commissure_R_band_mm"].is_null());
  ASSERT_TRUE(session_->has_work());
  messages_.clear();
  session_->work([] { return true; });
  EXPECT_EQ(event("motion"), nullptr) << "broken off by a request";
  work();
  ASSERT_NE(event("motion"), nullptr);
  EXPECT_EQ(event("motion")->head["bands"], true);
  const json table = event("motion")->head["table"];

  ASSERT_FALSE(ask("save", {{"what", "scene"}, {"name", "weak"}}).contains("error"));
  const fs::path saved = folder_.path() / "mine" / "weak.toml", out = folder_.path() / "out";
  scene::Scene scene = scene::read_scene_text(read_file(saved), saved);
  scene.output.vtu = scene.output.glb = scene.output.report = false;
  run::run_scene(scene, out);
  const json rows = json::parse(read_file(out / "summary.json"))["variants"]["table"];
  for (const char* key : {"commissure_R_band_mm", "commissure_L_band_mm", "added_xi_floor"}) {
    const double here = table[1][key], there = rows[1][key];
    EXPECT_GT(here, 0);
    EXPECT_NEAR(here, there, 1e-6 * there) << key;
  }
  // A slider that is held makes them old; what is at rest is not done again.
  EXPECT_FALSE(session_->has_work());
  set({{"muscles.gain", {{"side_R", 0.5}}}}, 1, true);
  EXPECT_FALSE(session_->has_work());
}

TEST_F(StudioSession, TellsWhatThereIsToSetBeforeAFaceIsOpen) {
  const json hello = ask("hello");
  EXPECT_GT(hello["keys"].size(), 80U);
  EXPECT_EQ(hello["places"]["open"], false);
  for (const char* request : {"undo", "redo"}) EXPECT_FALSE(ask(request).contains("error"));
  EXPECT_THAT(set({{"tissue.young_kpa", 100}}, 0)["error"].get<std::string>(),
              HasSubstr("no face is open"));
  EXPECT_THAT(ask("open", {{"what", "../x"}})["error"].get<std::string>(),
              HasSubstr("no such upload"));
  EXPECT_THAT(ask("open", {{"what", "started"}})["error"].get<std::string>(),
              HasSubstr("no such upload"));
}

TEST_F(StudioSession, WeakensAMuscleLiveAndRunsItAgainFromTheSavedScene) {
  open();
  const json& activations = event("face")->head["activations"];
  const json &notes = activations["notes"], &names = activations["names"];
  ASSERT_EQ(notes.size(), names.size());
  EXPECT_GT(std::count(notes.begin(), notes.end(), "mostly the prior's choice"), 0);
  const auto smiling = std::find(names.begin(), names.end(), "zyg_major_L") - names.begin();
  EXPECT_EQ(notes.at(std::size_t(smiling)), "") << "the corner of the mouth shows it";
  EXPECT_EQ(ask("add_variant", {{"name", "weak"}, {"like", 0}})["face"], 1);
  work();
  const double whole_mm = right_mm(1);
  EXPECT_NEAR(whole_mm, right_mm(0), 1e-9);
  set({{"muscles.gain", {{"side_R", 0.7}}}}, 1, true);
  ASSERT_NE(event("shape"), nullptr);
  EXPECT_EQ(event("shape")->head["face"], 1);
  const double live_mm = greatest_mm(*event("shape"));
  EXPECT_EQ(event("scene"), nullptr) << "nothing is done while one drags";
  set({{"muscles.gain", {{"side_R", 0.7}}}}, 1);
  ASSERT_NE(event("scene"), nullptr);
  EXPECT_EQ(event("scene")->head["values"][1]["muscles.gain"], json({{"side_R", 0.7}}));
  work();
  EXPECT_LT(right_mm(1), 0.85 * whole_mm);
  EXPECT_NEAR(live_mm,
              event("motion")->head["replay"]["variants"][0]["max_displacement_mm"].get<double>(),
              0.1);

  const json saved = ask("save", {{"what", "scene"}, {"name", "my scene"}});
  const fs::path file = saved["path"].get<std::string>();
  EXPECT_EQ(file, folder_.path() / "mine" / "my scene.toml");
  EXPECT_EQ(event("scene")->head["saved"], true);
  const scene::Scene scene = scene::read_scene(file, {"output.vtu=false", "output.glb=false"});
  const auto summary = run::run_scene(scene, folder_.path() / "run");
  set({{"muscles.gain", {{"side_R", 0.7}}}}, 1);
  work();
  ASSERT_NE(event("motion"), nullptr);
  for (const char* corner : {"commissure_L_mm", "commissure_R_mm"})
    for (const std::size_t face : {0, 1})
      EXPECT_NEAR(summary["variants"]["table"][face][corner].get<double>(),
                  event("motion")->head["table"][face][corner].get<double>(), 1e-6);
}

TEST_F(StudioSession, UndoesAndRedoesEachStep) {
  open();
  ask("add_variant", {{"name", "a"}, {"like", 0}, {"preset", "palsy_complete_R"}});
  work();
  EXPECT_LT(right_mm(1), 0.5 * right_mm(0));
  set({{"tissue.young_kpa", 300}}, 1);
  ask("rename_variant", {{"face", 1}, {"name", "b"}});
  EXPECT_EQ(event("scene")->head["faces"][1]["name"], "b");
  ask("undo");
  EXPECT_EQ(event("scene")->head["faces"][1]["name"], "a");
  ask("undo");
  EXPECT_NE(event("scene")->head["values"][1]["tissue.young_kpa"], 300);
  ask("undo");
  EXPECT_EQ(event("scene")->head["faces"].size(), 1U);
  EXPECT_EQ(event("scene")->head["can_undo"], false);
  work();
  for (int i = 0; i < 3; ++i) ask("redo");
  EXPECT_EQ(event("scene")->head["faces"][1]["name"], "b");
  EXPECT_EQ(event("scene")->head["values"][1]["tissue.young_kpa"], 300);
  EXPECT_EQ(event("scene")->head["can_redo"], false);
  ask("remove_variant", {{"face", 1}});
  EXPECT_EQ(event("scene")->head["faces"].size(), 1U);
  work();
}

TEST_F(StudioSession, UndoGivesTheMemoryOfItsFacesBackToTheSystem) {
  if (!test::keep_freed_memory()) GTEST_SKIP() << "another allocator";
  open();
  const auto add = [&](int number) {
    ask("add_variant", {{"name", std::to_string(number)}, {"like", 0}});
    EXPECT_FALSE(set({{"tissue.young_kpa", 120 + 20 * number}}, number).contains("error"));
    work();
  };
  const auto undo = [&] {
    ask("undo");
    ask("undo");
  };
  add(1);  // what libraries keep from their first use stays
  undo();
  const double before = test::resident_mib();
  for (const int number : {1, 2, 3}) add(number);
  const double grown = test::resident_mib() - before;
  EXPECT_GT(grown, 15);
  for (int k = 0; k < 3; ++k) undo();
  EXPECT_EQ(event("scene")->head["faces"].size(), 1U);
  EXPECT_LT(test::resident_mib() - before, 0.5 * grown);
}

TEST_F(StudioSession, AFacesNameIsRefusedInWordsAndNotByAPlaceInTheFile) {
  open();
  ask("add_variant", {{"name", "weak"}, {"like", 0}});
  ask("add_variant", {{"name", "stiff"}, {"like", 0}});
  const auto refusal = [&](const std::string& name) {
    const std::string renamed =
        ask("rename_variant", {{"face", 2}, {"name", name}}).value("error", "");
    EXPECT_EQ(ask("add_variant", {{"name", name}, {"like", 0}}).value("error", ""), renamed);
    EXPECT_EQ(renamed.find("variant["), std::string::npos) << renamed;
    return renamed;
  };
  EXPECT_THAT(refusal("weak"), HasSubstr("another face is called \"weak\""));
  EXPECT_THAT(refusal("base"), HasSubstr("expected another"));
  EXPECT_THAT(refusal("M\xc3\xbcller"), HasSubstr("expected letters"));
  EXPECT_FALSE(ask("rename_variant", {{"face", 2}, {"name", "stiff"}}).contains("error"))
      << "its own name is not taken";
}

TEST_F(StudioSession, AWrongValueChangesNothingAndSaysOneSentence) {
  open();
  const json before = ask("hello");
  const std::string text = event("scene")->head["text"];
  const std::vector<std::pair<json, int>> wrong = {
      {{{"tissue.young_kpa", -3}}, 0},     {{{"tissue.young_kpa", "soft"}}, 0},
      {{{"tissue.yung_kpa", 3}}, 0},       {{{"muscles.gain", {{"nose_R", 1}}}}, 0},
      {{{"scan.file", "/etc/passwd"}}, 0}, {{{"tissue.young_kpa", 100}}, 3}};
  for (const auto& [changes, face] : wrong)
    for (const bool live : {true, false}) {
      const json answer = set(changes, face, live);
      ASSERT_TRUE(answer.contains("error")) << changes;
      EXPECT_EQ(answer["error"].get<std::string>().find('\n'), std::string::npos);
    }
  ask("hello");
  EXPECT_EQ(event("scene")->head["text"], text);
  work();
  EXPECT_NE(event("face"), nullptr);
}

TEST_F(StudioSession, WhatIsTornOrCannotBeWrittenIsSaidAndHarmsNothing) {
  std::ofstream(folder_.path() / "own" / "uploads" / "torn.toml") << "[scan\n";
  EXPECT_THAT(ask("open", {{"what", "torn.toml"}})["error"].get<std::string>(),
              HasSubstr("sound TOML"));
  open();
  EXPECT_TRUE(set({{"muscles.gain", {{"zyg_major_R", nullptr}}}, {"tissue.young_kpa", 100}}, 0)
                  .contains("error"));
  ask("add_variant", {{"name", "v"}, {"like", 0}});
  EXPECT_FALSE(set({{"support.skull", nullptr}}, 1).contains("error"))
      << "it has none to take away";
  EXPECT_TRUE(set({{"tissue.strain", "odd"}}, 1).contains("error"));
  work();
  EXPECT_NE(event("motion"), nullptr);
}

TEST_F(StudioSession, MusclesMoveASceneThatSaysDisplacementAgainAndAgain) {
  open();
  set({{"drive.by", "displacement"}}, 0);
  for (const double gain : {0.9, 0.8, 0.7})
    EXPECT_FALSE(set({{"muscles.gain", {{"side_R", gain}}}}, 0, true).contains("error"));
  EXPECT_FALSE(set({{"muscles.gain", {{"side_R", 0.7}}}}, 0).contains("error"));
  EXPECT_EQ(event("scene")->head["drive"], "muscles");
}

TEST_F(StudioSession, MusclesMoveASceneToWhichVolumeIsAdded) {
  open();
  set({{"drive.by", "displacement"}}, 0);
  const json soft = {{{"name", "cheek_L"}, {"young_factor", 2}}};
  EXPECT_FALSE(set({{"tissue.region", soft}}, 0).contains("error"));
  EXPECT_EQ(event("scene")->head["drive"], "displacement");
  EXPECT_EQ(event("scene")->head["drive_why"], "driven by displacement: the scene says so");
  const json filled = {{{"name", "cheek_L"}, {"volume_ml", 2}}};
  EXPECT_FALSE(set({{"tissue.region", filled}}, 0).contains("error"));
  EXPECT_EQ(event("scene")->head["drive"], "muscles");
}

TEST_F(StudioSession, WhatAFirstVariantNeedsIsMadeAheadAndChangesNoNumber) {
  std::ofstream(folder_.path() / "own" / "uploads" / "mouth.toml")
      << "[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n";
  const auto first_shape = [&](bool ahead) {
    EXPECT_FALSE(ask("open", {{"what", "mouth.toml"}}).contains("error"));
    EXPECT_EQ(event("scene")->head["drive"], "muscles");
    session_->work([] { return false; });  // the motion
    EXPECT_TRUE(session_->has_work()) << "what a variant needs";
    if (ahead) work();
    EXPECT_NE(session_->has_work(), ahead);
    EXPECT_EQ(ask("add_variant", {{"name", "other"}, {"like", 0}})["face"], 1);
    EXPECT_EQ(event("scene")->head["drive"], "muscles");
    peak_s_ = 0.5;
    set({{"tissue.young_kpa", 300}}, 1, true);
    const bool reported = event("progress") && event("shape");
    EXPECT_NE(reported, ahead) << "said only where it takes long";
    return event("shape") ? event("shape")->block : "";
  };
  const std::string made_then = first_shape(false);
  EXPECT_FALSE(made_then.empty());
  EXPECT_EQ(first_shape(true), made_then);
}

TEST_F(StudioSession, AVariantThatCannotBeRunIsNotShownAsBase) {
  open();
  ask("add_variant", {{"name", "finite"}, {"like", 0}});
  set({{"tissue.strain", "finite"}}, 1);
  for (int i = 0; i < 2; ++i) {
    messages_.clear();
    work();
    ASSERT_NE(event("log"), nullptr);
    EXPECT_EQ(event("motion"), nullptr);
    ask("hello");
  }
}

TEST_F(StudioSession, MovesLandmarksOnTheSkinAndMakesTheFaceAnew) {
  open();
  const json& marks = event("face")->head["landmarks"];
  const auto mark = std::find_if(marks.begin(), marks.end(),
                                 [](const json& one) { return one["name"] == "ibug68_54"; });
  ASSERT_NE(mark, marks.end());
  std::vector<double> at = (*mark)["position"];
  const std::vector<double> before = at;
  at[0] += 0.002;
  at[2] += 0.01;  // in the air before the face
  json answer = ask("move_landmark", {{"name", "ibug68_54"}, {"position", at}});
  EXPECT_EQ(answer["warnings"], json::array());
  EXPECT_LT(std::abs(answer["position"][2].get<double>() - before[2]), 0.03) << "on the skin";
  answer = ask("move_landmark",
               {{"name", "ibug68_54"}, {"position", {before[0] - 0.04, before[1], before[2]}}});
  ASSERT_FALSE(answer["warnings"].empty());
  EXPECT_THAT(answer["warnings"][0].get<std::string>(), HasSubstr("ibug68_54"));
  answer = ask("move_landmark", {{"name", "ibug68_54"}});
  EXPECT_EQ(answer["position"].get<std::vector<double>>(), before);
  EXPECT_THAT(ask("move_landmark", {{"name", "nose"}})["error"].get<std::string>(),
              HasSubstr("no landmark"));
  EXPECT_TRUE(
      ask("move_landmark", {{"name", "ibug68_54"}, {"position", {1, 2}}}).contains("error"));
  at[2] = before[2];
  const std::vector<double> moved =
      ask("move_landmark", {{"name", "ibug68_54"}, {"position", at}})["position"];
  EXPECT_FALSE(ask("landmarks_done").contains("error"));
  work();
  ASSERT_NE(event("face"), nullptr);
  const auto position = [&] {
    for (const json& one : event("face")->head["landmarks"])
      if (one["name"] == "ibug68_54") return one["position"].get<std::vector<double>>();
    return std::vector<double>();
  };
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(position()[k], moved[k], 1e-6);
  ask("undo");
  work();
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(position()[k], before[k], 1e-6);
}

/// The place of a landmark that the page was sent; empty where it has none of that name.
std::vector<double> place_in(const Message* face, const std::string& landmark) {
  for (const json& one : face->head["landmarks"])
    if (one["name"] == landmark) return one["position"].get<std::vector<double>>();
  return {};
}

TEST_F(StudioSession, OffersTheLandmarksOfTheFoldWhereTheRulePutsThem) {
  open();
  const std::string name = "nasolabial_fold_middle_L";
  std::vector<double> at = place_in(event("face"), name);
  ASSERT_EQ(at.size(), 3u);
  EXPECT_THAT(event("face")->head["replay"]["point_words"][name].get<std::string>(),
              HasSubstr("fold from nose to mouth"));
  json answer = ask("move_landmark", {{"name", name}, {"position", {-at[0], at[1], at[2]}}});
  ASSERT_FALSE(answer["warnings"].empty());
  EXPECT_THAT(answer["warnings"][0].get<std::string>(), HasSubstr("beyond the middle of the face"));
  answer = ask("move_landmark", {{"name", name}});
  EXPECT_EQ(answer["warnings"], json::array());
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(answer["position"][std::size_t(k)].get<double>(), at[std::size_t(k)], 1e-9);
  at[0] += 0.003;
  answer = ask("move_landmark", {{"name", name}, {"position", at}});
  EXPECT_EQ(answer["warnings"], json::array());
  const std::vector<double> moved = answer["position"];
  EXPECT_FALSE(ask("landmarks_done").contains("error"));
  work();
  const std::vector<double> now = place_in(event("face"), name);
  ASSERT_EQ(now.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(now[k], moved[k], 1e-6);
  const std::string kept = read_file(folder_.path() / "own" / "landmarks-1.mrk.json");
  EXPECT_THAT(kept, HasSubstr(name));
  EXPECT_THAT(kept, testing::Not(HasSubstr("nasolabial_fold_upper_L"))) << "the rule's stay a rule";
}

/// The ids of the remarks in the last event of a name.
std::vector<std::string> remark_ids(const Message* event) {
  std::vector<std::string> ids;
  if (event)
    for (const json& remark : event->head["replay"]["summary"]["remarks"])
      ids.push_back(remark["id"]);
  return ids;
}

// A reloaded page has only the data that hello brings.
TEST_F(StudioSessionWithBands, ADoubtfulLandmarkIsToldAgainToAPageThatIsLoadedAgain) {
  open();
  const json& marks = event("face")->head["landmarks"];
  const auto mark = std::find_if(marks.begin(), marks.end(),
                                 [](const json& one) { return one["name"] == "ibug68_54"; });
  ASSERT_NE(mark, marks.end());
  const std::vector<double> at = (*mark)["position"];
  ask("move_landmark", {{"name", "ibug68_54"}, {"position", {at[0] + 0.015, at[1], at[2]}}});
  EXPECT_FALSE(ask("landmarks_done").contains("error"));
  work();
  EXPECT_THAT(remark_ids(event("motion") ? event("motion") : event("face")),
              testing::Contains("landmarks.doubtful"));
  ask("hello");
  work();
  ASSERT_NE(event("face"), nullptr);
  EXPECT_THAT(remark_ids(event("face")), testing::Contains("landmarks.doubtful"));
  EXPECT_TRUE(event("face")->head["replay"]["summary"]["head_shift_uncertainty_mm"].is_number());
}

TEST_F(StudioSession, SaysHowMuchOfTheMotionTheRecordingShows) {
  open();
  const json& parts = event("face")->head["replay"]["summary"].at("uncertainty");
  for (const char* part : {"lips", "cheeks", "eyes", "forehead"})
    EXPECT_GT(parts.at(part).at("distance_rms_mm").get<double>(), 0) << part;
  const auto share = [&](const char* part) {
    return parts.at(part).at("determined").get<double>();
  };
  EXPECT_GT(share("lips"), share("eyes"));
}

TEST_F(StudioSession, AChangeMayNameItsFaceInTheSameStep) {
  open();
  ask("add_variant", {{"name", "What if"}, {"like", 0}});
  const json change = {{"changes", {{"muscles.gain", {{"side_R", 0.4}}}}},
                       {"face", 1},
                       {"live", false},
                       {"time_s", 0},
                       {"name", "right side 40 %"}};
  EXPECT_FALSE(ask("set", change).contains("error"));
  EXPECT_EQ(event("scene")->head["faces"][1]["name"], "right side 40 %");
  ask("undo");
  EXPECT_EQ(event("scene")->head["faces"][1]["name"], "What if");
  EXPECT_EQ(event("scene")->head["values"][1]["muscles.gain"], json::object());
}

TEST_F(StudioSession, AMotionIsBrokenOffForARequestAndBegunAgain) {
  open();
  set({{"tissue.young_kpa", 150}}, 0);
  session_->work([] { return true; });
  EXPECT_EQ(event("motion"), nullptr);
  EXPECT_TRUE(session_->has_work());
  work();
  EXPECT_NE(event("motion"), nullptr);
}

}  // namespace
}  // namespace hyperex::studio
