// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_template.hpp"

#include <gmock/gmock.h>

#include <set>

#include "hyperex/core/error.hpp"
#include "support/refusal.hpp"

namespace hyperex::muscles {
namespace {
using testing::AllOf;
using testing::HasSubstr;

std::vector<TemplateMuscle> read(const std::string& text) {
  return read_muscles(text, "own.toml");
}

/// One muscle whose path and other keys are given.
TemplateMuscle muscle(const std::string& path, const std::string& more = {}) {
  const auto all = read("[[muscle]]\nname = \"own\"\npath = " + path + "\n" + more);
  EXPECT_EQ(all.size(), 1u);
  return all.at(0);
}

const std::string two = R"(["45 d1", "54 d0.4"])";

TEST(MuscleTemplate, ReadsPlaces) {
  const TemplateMuscle m =
      muscle(R"(["0.35*45 + 0.65*54 (2, -8.5) d0.25", "27", " 1.5*45+-0.5*42(-3,4)  d1 "])");
  ASSERT_EQ(m.path.size(), 3u);
  using Weights = std::vector<std::pair<int, double>>;
  EXPECT_EQ(m.path[0].ibug, (Weights{{45, 0.35}, {54, 0.65}}));
  EXPECT_EQ(m.path[0].out_mm, 2);
  EXPECT_EQ(m.path[0].up_mm, -8.5);
  EXPECT_EQ(m.path[0].depth, 0.25);
  EXPECT_EQ(m.path[1].ibug, (Weights{{27, 1}}));
  EXPECT_EQ(m.path[1].out_mm, 0);
  EXPECT_LT(m.path[1].depth, 0) << "to be interpolated";
  EXPECT_EQ(m.path[2].ibug, (Weights{{45, 1.5}, {42, -0.5}}));
  EXPECT_EQ(m.path[2].out_mm, -3);
  EXPECT_EQ(m.path[2].up_mm, 4);
  EXPECT_EQ(m.path[2].depth, 1);
}

TEST(MuscleTemplate, ReadsTheOtherKeysAndHasDefaults) {
  const TemplateMuscle plain = muscle(two);
  EXPECT_EQ(plain.latin, "own");
  EXPECT_EQ(plain.group, "own");
  EXPECT_EQ(plain.branch, "");
  EXPECT_EQ(plain.width_mm, 5);
  EXPECT_EQ(plain.band, 0);
  EXPECT_EQ(plain.kind, MuscleKind::pull);
  EXPECT_EQ(plain.lip, MuscleLip::both);
  EXPECT_FALSE(plain.straight);
  EXPECT_FALSE(plain.jaw);
  EXPECT_FALSE(plain.tone);
  EXPECT_FALSE(plain.cheek);
  EXPECT_EQ(plain.readiness, 1);
  EXPECT_EQ(plain.ramp, 0);
  EXPECT_EQ(plain.yields, 0);
  EXPECT_LT(plain.few_share, 0);
  EXPECT_LT(plain.many_share, 0);
  EXPECT_TRUE(plain.together.empty());
  EXPECT_EQ(plain.fold_from, 0);
  EXPECT_EQ(plain.fold_to, 0);
  const TemplateMuscle full =
      muscle(two,
             "latin = \"l\"\ngroup = \"g\"\nbranch = \"b\"\nwidth_mm = 7\nband = 2.5\n"
             "kind = \"ring\"\nlip = \"lower\"\nstraight = true\njaw = true\ntone = true\n"
             "cheek = true\nreadiness = 1.5\nramp = 0.5\nyields = 8\n"
             "few_share = 0\nmany_share = 0.4\nfold = [0.25, 1]\nfold_strength = 0.3\n"
             "together = { graft = 0.4, other = -0.2 }\n");
  EXPECT_EQ(full.ramp, 0.5);
  EXPECT_EQ(full.yields, 8);
  EXPECT_EQ(full.fold_from, 0.25);
  EXPECT_EQ(full.fold_to, 1);
  EXPECT_EQ(full.fold_strength, 0.3);
  EXPECT_EQ(full.few_share, 0);
  EXPECT_EQ(full.many_share, 0.4);
  const std::vector<std::pair<std::string, double>> together = {{"graft", 0.4}, {"other", -0.2}};
  EXPECT_EQ(full.together, together);
  EXPECT_EQ(full.readiness, 1.5);
  EXPECT_EQ(full.latin + full.group + full.branch, "lgb");
  EXPECT_EQ(full.width_mm, 7);
  EXPECT_EQ(full.band, 2.5);
  EXPECT_EQ(full.kind, MuscleKind::ring);
  EXPECT_EQ(full.lip, MuscleLip::lower);
  EXPECT_TRUE(full.straight);
  EXPECT_TRUE(full.jaw);
  EXPECT_TRUE(full.tone);
  EXPECT_TRUE(full.cheek);
  EXPECT_EQ(muscle(two, "lip = \"upper\"\n").lip, MuscleLip::upper);
}

TEST(MuscleTemplate, ActsTogetherWithMusclesThatThereAre) {
  const MuscleTable own = {muscle(two, "together = { zyg_major = 0.4 }\n")};
  EXPECT_EQ(changed_table(muscle_template(), own, {}).back(), own[0]);
  const MuscleTable unknown = {muscle(two, "together = { zyg_mayor = 0.4 }\n")};
  EXPECT_THAT(hyperex::test::refusal([&] { changed_table(muscle_template(), unknown, {}); }),
              AllOf(HasSubstr("muscle own: together"), HasSubstr("zyg_mayor")));
}

TEST(MuscleTemplate, EachBadTextNamesTheMuscleAndTheKey) {
  struct Bad {
    const char *key, *text;
  };
  const std::string path = "path = " + two + "\n";
  const std::vector<Bad> bad = {
      {"path", R"(path = [])"},
      {"path", R"(path = "45 d1")"},
      {"path", R"(path = ["45 d1"])"},
      {"path", R"(path = [45, 54])"},
      {"path", R"(path = ["45 d1", ""])"},
      {"path", R"(path = ["45", "54 d0.4"])"},
      {"path", R"(path = ["45 d1", "54"])"},
      {"path", R"(path = ["45 d1", "68 d1"])"},
      {"path", R"(path = ["45 d1", "-1 d1"])"},
      {"path", R"(path = ["45 d1", "5.5 d1"])"},
      {"path", R"(path = ["45 d1", "0.5*45 d1"])"},
      {"path", R"(path = ["45 d1", "0.5*45 + 0.4*54 d1"])"},
      {"path", R"(path = ["45 d1", "0.5*45 + d1"])"},
      {"path", R"(path = ["45 d1", "0.5* d1"])"},
      {"path", R"(path = ["45 d1", "54 (2) d1"])"},
      {"path", R"(path = ["45 d1", "54 (2, ) d1"])"},
      {"path", R"(path = ["45 d1", "54 (, 2) d1"])"},
      {"path", R"(path = ["45 d1", "54 (2, 3 d1"])"},
      {"path", R"(path = ["45 d1", "54 d1.1"])"},
      {"path", R"(path = ["45 d1", "54 d-0.1"])"},
      {"path", R"(path = ["45 d1", "54 d"])"},
      {"path", R"(path = ["45 d1", "54 d1 d1"])"},
      {"path", R"(path = ["45 d1", "54 d0.4.2"])"},
      {"path", R"x(path = ["45 d1", "54 d1 (2, 3)"])x"},
      {"path", R"(path = ["45 d1", "corner d1"])"},
      {"path", "latin = \"without a path\""},
      {"width_mm", "width_mm = 0"},
      {"width_mm", "width_mm = -3"},
      {"width_mm", "width_mm = 101"},
      {"width_mm", "width_mm = nan"},
      {"width_mm", "width_mm = \"wide\""},
      {"readiness", "readiness = 0"},
      {"ramp", "ramp = 0"},
      {"ramp", "ramp = \"steep\""},
      {"yields", "yields = -1"},
      {"few_share", "few_share = 1.5"},
      {"many_share", "many_share = \"all\""},
      {"fold", "fold = 0.4"},
      {"fold", "fold = [0.4]"},
      {"fold", "fold = [0.4, 0.4]"},
      {"fold", "fold = [0.7, 0.4]"},
      {"fold", "fold = [0.4, 1.1]"},
      {"fold", "fold = [0.4, \"mouth\"]"},
      {"fold_strength", "fold_strength = 0"},
      {"together", "together = 0.4"},
      {"together", "together = { malaris = 1 }"},
      {"together", "together = { malaris = \"often\" }"},
      {"together", "together = { own = 0.4 }"},
      {"band", "band = 0"},
      {"band", "band = inf"},
      {"band", "band = [2]"},
      {"kind", "kind = \"push\""},
      {"kind", "kind = 1"},
      {"lip", "lip = \"left\""},
      {"lip", "lip = true"},
      {"straight", "straight = 1"},
      {"jaw", "jaw = \"yes\""},
      {"tone", "tone = 1"},
      {"cheek", "cheek = 1"},
      {"branch", "branch = 7"},
      {"latin", "latin = 7"},
      {"group", "group = [1]"},
  };
  for (const Bad& b : bad) {
    const std::string own = b.text;
    const bool has_path = std::string(b.key) == "path";
    EXPECT_THAT(hyperex::test::refusal([&] {
                  read("[[muscle]]\nname = \"good\"\n" + path + "[[muscle]]\nname = \"own\"\n" +
                       (has_path ? "" : path) + own + "\n");
                }),
                AllOf(HasSubstr("own.toml"), HasSubstr("muscle own: "),
                      HasSubstr(std::string(b.key) + ": expected ")))
        << own;
  }
}

TEST(MuscleTemplate, AMuscleNeedsANameOfItsOwn) {
  const std::string path = "path = " + two + "\n";
  const auto message = [](const std::string& text) {
    return hyperex::test::refusal([&] { read(text); });
  };
  EXPECT_THAT(message("[[muscle]]\n" + path), HasSubstr("muscle without name: name: expected"));
  EXPECT_THAT(message("[[muscle]]\nname = \"\"\n" + path), HasSubstr("name: expected"));
  EXPECT_THAT(message("[[muscle]]\nname = 3\n" + path), HasSubstr("name: expected"));
  EXPECT_THAT(message("[[muscle]]\nname = \"a\"\n" + path + "[[muscle]]\nname = \"a\"\n" + path),
              HasSubstr("muscle a: name: expected"));
  EXPECT_THAT(message("[[muscle]\n"), HasSubstr("own.toml"));
  EXPECT_THAT(message("muscle = 3\n"), HasSubstr("muscle: expected"));
  EXPECT_THAT(message("muscle = [3]\n"), HasSubstr("muscle: expected"));
  EXPECT_TRUE(read("").empty());
}

TEST(MuscleTemplate, TheCarriedOneIsWhole) {
  const std::set<std::string> branches = {"temporal", "zygomatic", "buccal", "mandibular",
                                          "cervical"};
  std::set<std::string> names, seen, groups;
  int rings = 0, jaw = 0;
  for (const TemplateMuscle& m : muscle_template()) {
    EXPECT_TRUE(names.insert(m.name).second) << m.name;
    EXPECT_EQ(find_muscle(m.name), &m);
    EXPECT_TRUE(branches.contains(m.branch)) << m.name;
    seen.insert(m.branch);
    groups.insert(m.group);
    EXPECT_FALSE(m.latin.empty());
    rings += m.kind == MuscleKind::ring;
    jaw += m.jaw;
    if (m.tone) {
      EXPECT_EQ(m.kind, MuscleKind::ring) << m.name;
    }
    if (m.kind == MuscleKind::pull) {
      EXPECT_GT(m.path.front().depth, m.path.back().depth) << m.name << " begins at the bone";
    }
    // Only points of the left side and of the midline.
    for (const TemplatePlace& place : m.path)
      for (const auto& [k, weight] : place.ibug)
        EXPECT_FALSE(k < 8 || (k >= 17 && k <= 21) || k == 31 || k == 32 || (k >= 36 && k <= 41) ||
                     (k >= 48 && k <= 50) || (k >= 58 && k <= 61) || k == 67)
            << m.name << " " << k;
  }
  EXPECT_EQ(seen, branches);
  EXPECT_EQ(names.size(), 26u);
  EXPECT_EQ(rings, 7);
  EXPECT_EQ(jaw, 4);
  EXPECT_LT(groups.size(), names.size());
  for (const char* name : {"zyg_major", "dep_anguli", "oo_up_marg", "frontal_med"})
    EXPECT_NE(find_muscle(name), nullptr) << name;
  EXPECT_EQ(find_muscle("zyg_major_L"), nullptr) << "without its side";
  EXPECT_EQ(find_muscle("masseter"), nullptr);
}

}  // namespace
}  // namespace hyperex::muscles
