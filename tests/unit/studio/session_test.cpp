// SPDX-License-Identifier: GPL-3.0-or-later
// What a user does, without a network: the messages that a page would get.
#include "session.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "hyperex/core/files.hpp"
#include "hyperex/run/pipeline.hpp"
#include "support/zip_writer.hpp"
#include "unit/studio/own_folder.hpp"

namespace hyperex::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

struct Message {
  json head;
  std::string block;
};

class StudioSession : public testing::Test {
 protected:
  /// Error bands take time: a test of their own has them.
  explicit StudioSession(bool bands = false) {
    SessionOptions options;
    options.save_into = folder_.path() / "mine";
    options.folder = folder_.path() / "own";
    options.program = "Hyperex test";
    options.bands = bands;
    fs::create_directory(options.save_into);
    fs::create_directories(options.folder / "uploads");
    session_ = std::make_unique<Session>(
        options, [this](const std::string& message, bool binary, const std::string&) {
          if (!binary) return messages_.push_back({json::parse(message), ""});
          std::uint32_t length = 0;
          std::memcpy(&length, message.data(), 4);
          messages_.push_back(
              {json::parse(message.substr(4, length)), message.substr((4 + length + 7) / 8 * 8)});
        });
  }
  json ask(const std::string& name, json fields = json::object()) {
    messages_.clear();
    session_->answer({++id_, name, std::move(fields)});
    for (const Message& message : messages_)
      if (message.head.value("answer", 0) == id_) return message.head;
    return nullptr;
  }
  void work() {
    while (session_->has_work()) session_->work([] { return false; });
  }
  const Message* event(const std::string& name) const {
    for (auto message = messages_.rbegin(); message != messages_.rend(); ++message)
      if (message->head.value("event", "") == name) return &*message;
    return nullptr;
  }
  json set(const json& changes, int face, bool live = false) {
    return ask("set", {{"changes", changes}, {"face", face}, {"live", live}, {"time_s", peak_s_}});
  }
  void open() {
    EXPECT_FALSE(ask("open", {{"what", "embedded"}}).contains("error"));
    work();
    ASSERT_NE(event("face"), nullptr);
    const json& motion = event("face")->head["replay"]["motion"];
    peak_s_ = motion["time_s"][motion["peak_frame"].get<std::size_t>()];
  }
  /// The right corner's way in a face, of the last motion, mm.
  double right_mm(std::size_t face) const {
    return event("motion")->head["table"][face]["commissure_R_mm"];
  }
  double greatest_mm(const Message& shape) const {
    const json& at = shape.head["values"];
    std::vector<std::int16_t> values(at["count"].get<std::size_t>());
    std::memcpy(values.data(), shape.block.data() + at["offset"].get<std::size_t>(),
                2 * values.size());
    double most = 0;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      most = std::max(most,
                      std::hypot(double(values[i]), double(values[i + 1]), double(values[i + 2])));
    return 1e3 * most * shape.head["step_m"].get<double>();
  }

  const test::OwnFolder folder_;
  std::vector<Message> messages_;
  std::unique_ptr<Session> session_;
  std::int64_t id_ = 0;
  double peak_s_ = 0;
};

class StudioSessionWithBands : public StudioSession {
 protected:
  StudioSessionWithBands() : StudioSession(true) {}
};

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

TEST_F(StudioSession, PaintedPatchesAreRunAgainFromTheSavedScene) {
  open();
  ask("add_variant", {{"name", "painted"}, {"like", 0}});
  // What is painted: the right cheek, and a spot of the left one.
  const auto shares_of = [&](const json& region) {
    const json answer = ask("region_shares", {{"region", region}, {"key", "k"}});
    EXPECT_FALSE(answer.contains("error")) << answer;
    const json& at = event("shares")->head["values"];
    EXPECT_EQ(event("shares")->head["key"], "k");
    std::vector<float> values(at["count"].get<std::size_t>());
    std::memcpy(values.data(), event("shares")->block.data() + at["offset"].get<std::size_t>(),
                4 * values.size());
    return values;
  };
  const auto paint = [&](const std::vector<float>& shares) {
    json vertices = json::array(), some = json::array();
    for (std::size_t v = 0; v < shares.size(); ++v)
      if (shares[v] > 0) {
        vertices.push_back(v);
        some.push_back(shares[v]);
      }
    return ask("paint", {{"vertices", vertices}, {"shares", some}});
  };
  const std::vector<float> cheek = shares_of({{"name", "cheek_R"}});
  const std::string stiff = paint(cheek)["file"];
  EXPECT_EQ(paint(cheek)["file"], stiff) << "the same paint is the same file";
  const std::vector<float> back = shares_of({{"painted", stiff}});
  ASSERT_EQ(back.size(), cheek.size());
  for (std::size_t v = 0; v < back.size(); ++v) ASSERT_NEAR(back[v], cheek[v], 1e-5);
  const std::string soft = paint(shares_of({{"name", "cheek_L"}}))["file"];
  EXPECT_NE(soft, stiff);
  const json rows = {{{"painted", stiff}, {"young_factor", 6}},
                     {{"painted", soft}, {"young_factor", 0.5}, {"viscosity_factor", 2}}};
  set({{"tissue.region", rows}}, 1, true);
  EXPECT_NE(event("shape"), nullptr);
  EXPECT_FALSE(set({{"tissue.region", rows}}, 1).contains("error"));
  // Rows that are there already go back as the scene has them.
  const json known = event("scene")->head["values"][1]["tissue.region"];
  EXPECT_FALSE(shares_of(known[0]).empty());
  EXPECT_FALSE(set({{"tissue.region", known}}, 1).contains("error"));
  work();
  EXPECT_LT(right_mm(1), right_mm(0) - 0.2) << "the stiff side";
  const json table = event("motion")->head["table"];

  const json saved = ask("save", {{"what", "scene"}, {"name", "painted"}});
  const scene::Scene scene =
      scene::read_scene(saved["path"].get<std::string>(), {"output.vtu=false", "output.glb=false"});
  EXPECT_EQ(scene.variants[0].scene.tissue.regions[0].painted.parent_path(),
            folder_.path() / "mine" / "painted_files");
  const auto summary = run::run_scene(scene, folder_.path() / "run");
  for (const char* corner : {"commissure_L_mm", "commissure_R_mm"})
    EXPECT_NEAR(summary["variants"]["table"][1][corner].get<double>(),
                table[1][corner].get<double>(), 1e-6);
}

TEST_F(StudioSession, PaintedThicknessMakesTheMeshAnewAndRunsAgainFromTheSavedScene) {
  open();
  const json& thickness = event("face")->head["thickness"];
  std::vector<float> mm(thickness["count"].get<std::size_t>());
  std::memcpy(mm.data(), event("face")->block.data() + thickness["offset"].get<std::size_t>(),
              4 * mm.size());
  EXPECT_GT(*std::ranges::min_element(mm), 2);
  EXPECT_LT(*std::ranges::max_element(mm), 13);
  ask("add_variant", {{"name", "weak"}, {"like", 0}});
  set({{"muscles.gain", {{"side_R", 0.7}}}}, 1);
  work();
  ASSERT_NE(event("motion"), nullptr);
  // At the peak, all of the skin, mm.
  const auto shape = [&] {
    set({{"tissue.young_kpa", 192.4}}, 0, true);
    const Message& came = *event("shape");
    const json& values = came.head["values"];
    std::vector<std::int16_t> steps(values["count"].get<std::size_t>());
    std::memcpy(steps.data(), came.block.data() + values["offset"].get<std::size_t>(),
                2 * steps.size());
    std::vector<double> out;
    for (const std::int16_t step : steps)
      out.push_back(1e3 * step * came.head["step_m"].get<double>());
    return out;
  };
  const auto farthest_mm = [](const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
  };
  const std::vector<double> plain = shape();
  const json answer = ask("region_shares", {{"region", {{"name", "cheek_R"}}}, {"key", "k"}});
  const json& at = event("shares")->head["values"];
  ASSERT_EQ(at["count"], mm.size());
  std::vector<float> shares(mm.size());
  std::memcpy(shares.data(), event("shares")->block.data() + at["offset"].get<std::size_t>(),
              4 * shares.size());
  json vertices = json::array(), some = json::array();
  for (std::size_t v = 0; v < shares.size(); ++v)
    if (shares[v] > 0) {
      vertices.push_back(v);
      some.push_back(shares[v]);
    }
  const std::string file = ask("paint", {{"vertices", vertices}, {"shares", some}})["file"];
  const json rows = {{{"painted", file}, {"thickness_mm", 20}}};
  // Not while one drags: another mesh takes a second.
  EXPECT_FALSE(set({{"mesh.thickness_region", rows}}, 0, true).contains("error"));
  EXPECT_EQ(event("shape"), nullptr);
  EXPECT_EQ(event("progress"), nullptr);
  EXPECT_FALSE(set({{"mesh.thickness_region", rows}}, 0).contains("error"));
  EXPECT_NE(event("progress"), nullptr);
  messages_.clear();
  work();
  EXPECT_EQ(event("face"), nullptr) << "the skin is the same";
  ASSERT_NE(event("motion"), nullptr);
  const json table = event("motion")->head["table"];
  const std::vector<double> thick = shape();
  ASSERT_EQ(thick.size(), plain.size());
  EXPECT_GT(farthest_mm(thick, plain), 0.1);

  const json saved = ask("save", {{"what", "scene"}, {"name", "thick"}});
  const scene::Scene scene =
      scene::read_scene(saved["path"].get<std::string>(), {"output.vtu=false", "output.glb=false"});
  ASSERT_EQ(scene.mesh.depth_regions.size(), 1U);
  EXPECT_EQ(scene.mesh.depth_regions[0].painted.parent_path(),
            folder_.path() / "mine" / "thick_files");
  const auto summary = run::run_scene(scene, folder_.path() / "run");
  for (const std::size_t face : {0, 1})
    for (const char* corner : {"commissure_L_mm", "commissure_R_mm"})
      EXPECT_NEAR(summary["variants"]["table"][face][corner].get<double>(),
                  table[face][corner].get<double>(), 1e-6)
          << face;
  // What is wrong is said in one sentence, and nothing is changed.
  for (const json& wrong : {json{{{"painted", file}, {"thickness_mm", 0.5}}},
                            json{{{"painted", file}}}, json{{{"painted", "/etc/passwd"}}}}) {
    const std::string error = set({{"mesh.thickness_region", wrong}}, 0).value("error", "");
    EXPECT_NE(error, "") << wrong;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  EXPECT_TRUE(set({{"mesh.thickness_region", rows}}, 1).contains("error"))
      << "all faces have one mesh";
  ask("undo");
  messages_.clear();
  work();
  EXPECT_EQ(event("face"), nullptr);
  ASSERT_NE(event("motion"), nullptr);
  EXPECT_EQ(farthest_mm(shape(), plain), 0);
}

TEST_F(StudioSession, PaintThatIsNoneIsRefused) {
  EXPECT_TRUE(ask("paint", {{"vertices", {1}}, {"shares", {1}}}).contains("error"));
  open();
  const std::vector<std::pair<json, json>> wrong = {{json::array(), json::array()},
                                                    {{1, 2}, {1}},
                                                    {{-1}, {1}},
                                                    {{1000000000}, {1}},
                                                    {{1.5}, {1}},
                                                    {{1}, {0}},
                                                    {{1}, {1.5}},
                                                    {{1}, {"x"}},
                                                    {"x", "x"}};
  for (const auto& [vertices, shares] : wrong)
    EXPECT_TRUE(ask("paint", {{"vertices", vertices}, {"shares", shares}}).contains("error"))
        << vertices;
  for (const json& region :
       {json{{"painted", "/etc/passwd"}}, json{{"name", "nose ring"}}, json("x"), json::object()})
    EXPECT_TRUE(ask("region_shares", {{"region", region}, {"key", ""}}).contains("error"))
        << region;
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

TEST_F(StudioSession, WhatAFirstVariantNeedsIsMadeAheadAndChangesNoNumber) {
  // Points drive base here, muscles both once there is a variant.
  std::ofstream(folder_.path() / "own" / "uploads" / "mouth.toml")
      << "[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n";
  const auto first_shape = [&](bool ahead) {
    EXPECT_FALSE(ask("open", {{"what", "mouth.toml"}}).contains("error"));
    EXPECT_EQ(event("scene")->head["drive"], "displacement");
    session_->work([] { return false; });  // the motion
    EXPECT_TRUE(session_->has_work()) << "what a variant needs";
    if (ahead) work();
    EXPECT_NE(session_->has_work(), ahead);
    EXPECT_EQ(ask("add_variant", {{"name", "other"}, {"like", 0}})["face"], 1);
    EXPECT_EQ(event("scene")->head["drive"], "muscles");
    peak_s_ = 0.5;
    set({{"tissue.young_kpa", 300}}, 1, true);
    const bool told = event("progress") && event("shape");
    EXPECT_NE(told, ahead) << "said only where it takes long";
    return event("shape") ? event("shape")->block : "";
  };
  const std::string made_then = first_shape(false);
  EXPECT_FALSE(made_then.empty());
  EXPECT_EQ(first_shape(true), made_then);
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
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply", "rec.zip"));
  EXPECT_THAT(opened({{"../../scene.toml", "1"}, {"rgb.txt", ""}}), HasSubstr("leads elsewhere"));
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply", "rec.zip"));
  EXPECT_FALSE(fs::exists(folder_.path() / "own" / "scene.toml"));
  EXPECT_THAT(opened({{"talk/rgb.txt", ""}}), HasSubstr("me.ply")) << "the scan is no scan";
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply", "talk"));
  EXPECT_THAT(opened({{"rgb.txt", ""}}), HasSubstr("me.ply"));
  EXPECT_THAT(names(), testing::UnorderedElementsAre("me.ply", "rec"));
}

TEST_F(StudioSession, AVariantThatCannotBeRunIsNotShownAsBase) {
  open();
  ask("add_variant", {{"name", "finite"}, {"like", 0}});
  set({{"tissue.strain", "finite"}}, 1);
  for (int i = 0; i < 2; ++i) {
    messages_.clear();
    work();
    ASSERT_NE(event("said"), nullptr);
    EXPECT_EQ(event("motion"), nullptr);
    ask("hello");
  }
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

TEST(StudioSessionLeftovers, AreDeletedWhenAskedButNotWhileTheyAreOpen) {
  const test::OwnFolder folder;
  SessionOptions options;
  options.save_into = options.folder = folder.path();
  options.rescued = folder.path() / "left";
  fs::create_directories(options.rescued);
  fs::create_directories(options.folder / "uploads");
  std::ofstream(options.rescued / "scene.toml")
      << "scan.file = \"embedded\"\nmotion.file = \"embedded\"\n";
  std::vector<json> answers;
  Session session(options, [&](const std::string& message, bool binary, const std::string&) {
    if (!binary && json::parse(message).contains("answer")) answers.push_back(json::parse(message));
  });
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

TEST_F(StudioSession, AMotionIsBrokenOffForARequestAndBegunAgain) {
  open();
  set({{"tissue.young_kpa", 150}}, 0);
  session_->work([] { return true; });
  EXPECT_EQ(event("motion"), nullptr);
  EXPECT_TRUE(session_->has_work());
  work();
  EXPECT_NE(event("motion"), nullptr);
}

TEST_F(StudioSession, WhatIsDoneLiesInItsFolderAtOnce) {
  open();
  set({{"tissue.young_kpa", 151}}, 0);
  EXPECT_THAT(read_file(folder_.path() / "own" / "scene.toml"), HasSubstr("young_kpa = 151"));
}

}  // namespace
}  // namespace hyperex::studio
