// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/case_hash.hpp"

#include "hyperex/study/plan_cases.hpp"
#include "unit/study/study_files.hpp"

namespace hyperex::study {
namespace {
namespace fs = std::filesystem;

class CaseHash : public StudyFiles {
 protected:
  std::string hash(const std::vector<std::string>& overrides = {}) const {
    ContentHashes contents;
    return hash_of(scene::read_scene(*this / "scene.toml", overrides), contents);
  }
};

TEST_F(CaseHash, IsOfWhatTheScenesOptionsComeTo) {
  const std::string before = hash();
  EXPECT_EQ(before.size(), 64u);
  EXPECT_EQ(hash(), before);
  EXPECT_NE(hash({"tissue.young_kpa=30"}), before);
  EXPECT_NE(hash({"output.vtu=false"}), before);
  EXPECT_EQ(hash({"tissue.young_kpa=30"}), hash({"tissue.young_kpa=30.0"}));
  write("scene.toml", "# the same\nscan = { file = 'embedded' }\nmotion.file = \"embedded\"\n");
  EXPECT_EQ(hash(), before);
  write("scene.toml",
        "scan = { file = 'embedded' }\nmotion.file = \"embedded\"\n"
        "[[variant]]\nname = \"x\"\ntissue.young_kpa = 400\n");
  const std::string varied = hash();
  EXPECT_NE(varied, before);
  write("scene.toml",
        "scan = { file = 'embedded' }\nmotion.file = \"embedded\"\n"
        "[[variant]]\nname = \"x\"\ntissue.young_kpa = 401\n");
  EXPECT_NE(hash(), varied);
}

TEST_F(CaseHash, FollowsTheContentOfInputsAndNotTheirPlace) {
  const std::string motion = "time_s,ibug68_8_x\n0,1\n";
  write("one.csv", motion);
  write("sub/two.csv", motion);
  const std::string first = hash({"motion.file=" + (*this / "one.csv").string()});
  EXPECT_EQ(hash({"motion.file=" + (*this / "sub/two.csv").string()}), first);
  write("one.csv", motion + "1,2\n");
  EXPECT_NE(hash({"motion.file=" + (*this / "one.csv").string()}), first);
}

TEST_F(CaseHash, FollowsAllFilesOfAFolder) {
  write("rec/rgb.txt", "0 a.png\n");
  write("rec/rgb/a.png", "picture");
  ContentHashes before, after, renamed;
  const std::string first = before.of(*this / "rec");
  write("rec/rgb/a.png", "Picture");
  const std::string second = after.of(*this / "rec");
  EXPECT_NE(first, second);
  fs::rename(*this / "rec/rgb/a.png", *this / "rec/rgb/b.png");
  EXPECT_NE(renamed.of(*this / "rec"), second);
}

/// An OBJ file names its materials, which name the texture.
TEST_F(CaseHash, FollowsWhatAScanNamesInTurn) {
  write("a.obj",
        "mtllib a.mtl\nv 0 0 0\nv 200 0 0\nv 0 200 0\nv 0 0 200\nvt 0 0\nusemtl skin\n"
        "f 1/1 2/1 3/1\nf 1/1 2/1 4/1\n");
  write("a.mtl", "newmtl skin\nmap_Kd a.png\n");
  write("a.png", "one");
  const auto of = [&] {
    ContentHashes contents;
    return contents.of_companions(*this / "a.obj");
  };
  const std::string first = of();
  EXPECT_EQ(of(), first);
  write("a.png", "two");
  const std::string second = of();
  EXPECT_NE(second, first);
  fs::remove(*this / "a.png");
  const std::string third = of();
  EXPECT_NE(third, second);
  write("a.mtl", "newmtl skin\nmap_Kd a.png\nKd 1 0 0\n");
  EXPECT_NE(of(), third);
}

TEST_F(CaseHash, OneChangedValueChangesItsCasesAlone) {
  const auto hashes = [&](const std::string& values) {
    std::vector<std::string> all;
    for (const PlannedCase& one : plan_cases(study("[grid]\ntissue.young_kpa = " + values + "\n")))
      all.push_back(one.hash);
    return all;
  };
  const auto before = hashes("[30, 60]"), after = hashes("[30, 61, 60]");
  EXPECT_EQ(after[0], before[0]);
  EXPECT_EQ(after[2], before[1]);
  EXPECT_NE(after[1], before[1]);
}

TEST_F(CaseHash, FoldersAreReadableAndSafe) {
  const std::string hash(64, 'a');
  EXPECT_EQ(files_of_case("out", "young_kpa=30 A&B", hash).folder,
            fs::path("out/cases/young_kpa_30_A_B-aaaaaaaaaa"));
  EXPECT_EQ(files_of_case("out", ".hidden/..", hash).log,
            fs::path("out/logs/_hidden_..-aaaaaaaaaa.log"));
  EXPECT_EQ(files_of_case("out", std::string(99, 'x'), hash).folder.filename().string().size(),
            71u);
}

}  // namespace
}  // namespace hyperex::study
