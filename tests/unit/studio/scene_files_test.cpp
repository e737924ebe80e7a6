// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "support/test_file.hpp"

namespace hyperex::studio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST(SceneFiles, TheSceneWithTheSmileIsSound) {
  const TestFolder folder;
  std::ofstream(folder.path() / "smile_arkit.csv") << embedded_smile();
  const scene::Scene scene = scene::read_scene_text(embedded_scene(), folder.path() / "scene.toml");
  EXPECT_EQ(scene.drive.by, simulate::DriveBy::muscles);
  EXPECT_EQ(scene.motion.arkit, folder.path() / "smile_arkit.csv");
}

TEST(SceneFiles, WhatASceneNamesIsFoundFromItsNewPlace) {
  const TestFolder folder;
  const fs::path from = folder.path() / "from", to = folder.path() / "to",
                 own = folder.path() / "own";
  for (const fs::path& one : {from, to, own}) fs::create_directory(one);
  std::ofstream(from / "smile_arkit.csv") << embedded_smile();
  std::ofstream(own / "me.csv") << embedded_smile();
  const std::string text =
      "[scan]\nfile = \"embedded\"\n\n[motion]\narkit = \"smile_arkit.csv\"  # here\n";
  save_scene(text, from / "a.toml", {own}, to / "b.toml");
  const std::string saved = read_file(to / "b.toml");
  EXPECT_THAT(saved, HasSubstr("arkit = \"../from/smile_arkit.csv\"  # here"));
  EXPECT_TRUE(
      fs::equivalent(scene::read_scene(to / "b.toml").motion.arkit, from / "smile_arkit.csv"));
  // What lies in a session's own folder goes along.
  save_scene("[scan]\nfile = \"embedded\"\n[motion]\narkit = '" + (own / "me.csv").string() + "'\n",
             own / "scene.toml", {own}, to / "c.toml");
  fs::remove_all(own);
  EXPECT_EQ(read_file(scene::read_scene(to / "c.toml").motion.arkit), embedded_smile());
}

TEST(MovedBy, NamesTheBandOfARecordingThatHasLandmarksToo) {
  const TestFolder folder;
  motion::Motion m =
      motion::embedded_mouth_opening(anatomy::embedded_face().landmarks, {.head_moves = false});
  const Points rest = m.positions.front();
  for (int head = 0; head < 4; ++head) {
    const Eigen::RowVector3d at = rest.row(m.index_of("ibug68_27")) +
                                  Eigen::RowVector3d(0.03 * head, 0.05 + 0.02 * (head % 2), -0.02);
    m.names.push_back(fmt::format("band_{}", head));
    for (Points& sample : m.positions) {
      sample.conservativeResize(sample.rows() + 1, Eigen::NoChange);
      sample.bottomRows(1) = at;
    }
  }
  motion::write_motion_csv(folder.path() / "own.csv", m);
  const std::string text = moved_by("", folder.path() / "own.csv");
  EXPECT_EQ(scene::parse_toml(text).root["motion"].value("rigid_points", json()),
            json({"band_0", "band_1", "band_2", "band_3"}));
}

TEST(MovedBy, NamesTheStillPointsOfARecordingWithoutTheUsualOnes) {
  const TestFolder folder;
  const auto with_names = [&](const std::vector<std::string>& names) {
    const fs::path file = folder.path() / "own.csv";
    std::ofstream out(file);
    out << "time_s";
    for (const std::string& name : names)
      for (const char axis : {'x', 'y', 'z'}) out << fmt::format(",{}_{}_mm", name, axis);
    // A cross of four and a corner of the mouth, which moves.
    for (int k = 0; k < 3; ++k)
      out << fmt::format("\n{},40,60,0,-40,60,0,0,90,10,0,30,20,25,-30,{}", k, 5 * k);
    out.close();
    return moved_by("", file);
  };
  const auto rigid = [](const std::string& text) {
    return scene::parse_toml(text).root["motion"].value("rigid_points", json());
  };
  EXPECT_EQ(rigid(with_names({"band_1", "band_2", "band_3", "band_4", "cheilion_L"})),
            json({"band_1", "band_2", "band_3", "band_4"}));
  EXPECT_EQ(
      rigid(with_names({"exocanthion_R", "exocanthion_L", "glabella", "nasion", "cheilion_L"})),
      json());
}

}  // namespace
}  // namespace hyperex::studio
