// SPDX-License-Identifier: GPL-3.0-or-later
// Painted patches.
#include <algorithm>

#include "hyperex/run/run_scene.hpp"
#include "hyperex/scene/scene_text.hpp"
#include "unit/studio/session_fixture.hpp"

namespace hyperex::studio {
namespace {

using testing::HasSubstr;

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

}  // namespace
}  // namespace hyperex::studio
