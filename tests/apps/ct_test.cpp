// SPDX-License-Identifier: GPL-3.0-or-later
// `hyperex ct` as a user calls it.
#include <gmock/gmock.h>

#include <fstream>

#include "apps/malformed.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/io/text_table.hpp"
#include "support/made_ct.hpp"
#include "support/sanitizers.hpp"
#include "support/zip_writer.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class Ct : public ProgramTest {
 protected:
  static ct::Volume small_volume() {
    return test::volume_of(test::small_head(), {0, 0, 5}, {120, 130, 126}, {2, 2, 2});
  }
  void write(const std::string& name, const test::DicomTags& tags = {},
             const std::string& prefix = "IM") const {
    test::write_dicom(in(name), small_volume(), tags, prefix);
  }
};

TEST_F(Ct, WritesSurfacesThicknessAndPictures) {
  write("series");
  const Outcome outcome = call("ct series --out out");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("no medical device"));
  EXPECT_THAT(names_in(in("out")),
              testing::ElementsAre("bones_through_skin.png", "landmarks.json", "mandible.ply",
                                   "skin.ply", "skull.ply", "slices.png", "summary.json",
                                   "thickness.csv", "thickness.png"));
  const auto summary = this->summary();
  EXPECT_EQ(summary["series"]["size"], (nlohmann::json{61, 66, 64}));
  EXPECT_NEAR(double(summary["thresholds"]["skin_hu"]), -480, 10);
  EXPECT_TRUE(summary["bones"]["mandible_separated"]);
  EXPECT_GT(double(summary["thickness"]["regions"]["forehead"]["mean_mm"]), 5);
  EXPECT_LT(double(summary["thickness"]["regions"]["forehead"]["mean_mm"]), 11);
  // The program reads what it wrote.
  const io::Scan skin = io::read_scan(in("out/skin.ply"), io::LengthUnit::millimetre);
  const auto scalars = io::read_ply_scalars(in("out/skin.ply"));
  ASSERT_EQ(scalars.size(), 2u);
  EXPECT_EQ(scalars[0].name, "shortest_mm");
  const io::TextTable table = io::read_text_table(in("out/thickness.csv"));
  ASSERT_EQ(table.rows.size(), std::size_t(skin.mesh.points.rows()));
  EXPECT_EQ(table.names[4], "shortest_mm");
  const auto landmarks = io::read_landmarks(in("out/landmarks.json"));
  EXPECT_LT((1e3 * landmarks.at("pronasale") - Vec3(1, -8, 56)).norm(), 2);
  // Again, over its own output, with the same bytes.
  const std::string before = read_file(in("out/summary.json")) + read_file(in("out/skin.ply"));
  EXPECT_EQ(call("ct series --out out").status, 0);
  EXPECT_TRUE(read_file(in("out/summary.json")) + read_file(in("out/skin.ply")) == before);
}

TEST_F(Ct, SaysNothingOfThePatient) {
  test::DicomTags tags;
  tags.patient = "Doeringer^Annabell", tags.patient_id = "HX778812", tags.birth_date = "19610407";
  tags.study_uid = "1.2.826.55.77001", tags.series_uid = "1.2.826.55.77002";
  write("Doeringer_ct", tags, "annabell_HX778812_");
  const Outcome good = call("ct Doeringer_ct --out out", "export XDG_CACHE_HOME=\"$PWD/cache\"");
  ASSERT_EQ(good.status, 0) << good.err;
  ASSERT_EQ(shell("mkdir torn && cp Doeringer_ct/* torn/ && truncate -s 4000 torn/*_0003.dcm"), 0);
  const Outcome torn = call("ct torn --out torn_out");
  EXPECT_EQ(torn.status, 2);
  EXPECT_THAT(torn.err, HasSubstr("file 3 of 64 (in the order of their names) is cut off"));
  EXPECT_FALSE(fs::exists(in("torn_out")));
  // Entries of a zip that cannot be unpacked, too.
  std::ofstream(in("study.zip"), std::ios::binary)
      << test::zip_of({{.name = "annabell:doeringer.dcm", .bytes = "a slice"}});
  const Outcome zip = call("ct study.zip --out zip_out");
  EXPECT_EQ(zip.status, 2);
  EXPECT_THAT(zip.err, HasSubstr("study.zip: cannot be unpacked"));
  std::string all = good.out + good.err + torn.out + torn.err + zip.out + zip.err;
  for (const char* folder : {"out", "cache"})
    if (fs::exists(in(folder)))
      for (const std::string& name : names_in(in(folder)))
        all += name + read_file(in(folder) / name);
  all = lower_case(all);
  for (const char* word : {"doeringer", "annabell", "hx778812", "19610407", "1.2.826.55"})
    EXPECT_EQ(all.find(word), std::string::npos) << word;
}

TEST_F(Ct, RefusesInOneLineAndLeavesNothing) {
  write("series");
  fs::create_directory(in("empty"));
  fs::create_directory(in("pictures"));
  std::ofstream(in("pictures/a.jpg")) << "\xff\xd8\xff";
  ASSERT_EQ(shell("mkdir gap && cp series/* gap/ && rm gap/IM0020.dcm"), 0);
  ASSERT_EQ(shell("mkdir torn && cp series/* torn/ && truncate -s 5000 torn/IM0020.dcm"), 0);
  test::DicomTags mri;
  mri.modality = "MR";
  write("mri", mri);
  ASSERT_EQ(shell("mkdir few && cp series/IM000[1-5].dcm few/"), 0);
  std::ofstream(in("mine.txt")) << "mine";
  fs::create_directory(in("taken"));
  std::ofstream(in("taken/mine.txt")) << "mine";
  for (const auto& [arguments, words] :
       {std::pair{"ct none --out out", "no such file or folder"},
        std::pair{"ct empty --out out", "the folder is empty"},
        std::pair{"ct pictures --out out", "none of its 1 files is DICOM"},
        std::pair{"ct gap --out out", "1 slice is missing between z = "},
        std::pair{"ct torn --out out", "IM0020.dcm is cut off"},
        std::pair{"ct mri --out out", "an MRI, which shows no bone"},
        std::pair{"ct few --out out", "expected at least 8"},
        std::pair{"ct mine.txt --out out", "expected a folder of DICOM files"},
        std::pair{"ct series --out taken", "taken"},
        std::pair{"ct series --out out --seed-skull 1,2,3", "expected both or neither"},
        std::pair{"ct series --out out --seed-skull 1,2 --seed-mandible 1,2,3",
                  "three numbers x,y,z"},
        std::pair{"ct series --out out --labels none.nrrd", "none.nrrd"},
        std::pair{"ct series --out out --labels mine.txt", "expected labels as"},
        std::pair{"ct series --out out --skull a.ply", "--skull alone: expected --mandible too"},
        std::pair{"ct series --out out --skin-hu 300", "--skin-hu = 300: expected -900 to 200"}})
    expect_refused(arguments, words);
}

TEST_F(Ct, MissesItsLibraryInWords) {
  write("series");
  fs::create_directories(in("elsewhere/bin"));
  fs::copy_file(HYPEREX_PROGRAM, in("elsewhere/bin/hyperex"));
  EXPECT_EQ(shell(in("elsewhere/bin/hyperex").string() + " ct series --out out 2>err.txt"), 2);
  EXPECT_THAT(read_file(in("err.txt")),
              HasSubstr("elsewhere/lib/hyperex/hx_itk.so: cannot be loaded"));
  EXPECT_FALSE(fs::exists(in("out")));
}

TEST_F(Ct, TakesSeedsAndOwnSurfaces) {
  write("series");
  const Outcome seeded = call("ct series --out out --seed-skull 0,45,-6 --seed-mandible 0,-34,32");
  ASSERT_EQ(seeded.status, 0) << seeded.err;
  EXPECT_THAT(std::string(summary()["bones"]["from"]), HasSubstr("the user's points"));
  const Outcome own = call(
      "ct series --out own --skull out/skull.ply --mandible out/mandible.ply --bones-frame face");
  ASSERT_EQ(own.status, 0) << own.err;
  // A surface that was written and read again gives the same thickness.
  EXPECT_EQ(read_file(in("own/thickness.csv")).substr(0, 2000),
            read_file(in("out/thickness.csv")).substr(0, 2000));
}

TEST_F(Ct, TooLittleMemoryIsToldInOneLine) {
#if HYPEREX_SANITIZED
  GTEST_SKIP() << "a sanitizer takes more addresses than any limit leaves";
#endif
  write("series");
  int forecasts = 0;
  for (const int kb : {500000, 600000, 700000, 750000, 800000}) {
    const Outcome outcome = call("ct series --out out", "ulimit -v " + std::to_string(kb));
    if (outcome.status == 0) {
      EXPECT_EQ(call("ct series --out out").status, 0);
      fs::remove_all(in("out"));
      continue;
    }
    EXPECT_EQ(outcome.status, 1) << kb << outcome.err;
    const auto reported = problems_in(outcome.err);
    ASSERT_EQ(reported.size(), 1u) << kb << '\n' << outcome.err;
    EXPECT_THAT(reported[0], HasSubstr("memory")) << kb;
    EXPECT_FALSE(fs::exists(in("out"))) << kb;
    forecasts += reported[0].find("B are available") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(forecasts, 0);
  // Here OpenBLAS finds no place for its buffer. A mistake still ends in its line.
  const Outcome refused = call("ct nowhere --out out", "ulimit -v 300000");
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(problems_in(refused.err).size(), 1u) << refused.err;
}

TEST_F(Ct, ARunReplacesNoneOfItsFiles) {
  write("series");
  ASSERT_EQ(call("ct series --out ct").status, 0);
  const auto before = names_in(in("ct"));
  put(in("other.toml"), "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n");
  const Outcome over = call("run other.toml --out ct --no-cache");
  EXPECT_EQ(over.status, 2);
  EXPECT_THAT(over.err, HasSubstr("which no earlier run is known to have written"));
  EXPECT_EQ(names_in(in("ct")), before);
}

TEST_F(Ct, ARunMovesTheSkinThatItWrote) {
  const fs::path zip = fs::path(HYPEREX_SHARED_DIR) / "data/ct/phantom_head.zip";
  if (!fs::exists(zip)) GTEST_SKIP() << "needs " << zip;
  ASSERT_EQ(call("ct " + zip.string() + " --out ct").status, 0);
  const auto scene = [&](const char* landmarks) {
    put(in("next.toml"), "scan = { file = \"ct/skin.ply\", unit = \"mm\"" + std::string(landmarks) +
                             " }\nmotion = { file = \"embedded\" }\nanatomy = { ct = \"ct\" }\n"
                             "mesh = { element_size_mm = 9 }\ntime = { end_s = 0.3 }\n");
  };
  scene(", landmarks = \"ct/landmarks.json\"");
  const Outcome refused = call("run next.toml --out out --no-cache");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, testing::HasSubstr("landmarks all lie in the midline of the face"));
  EXPECT_FALSE(fs::exists(in("out")));
  scene("");
  const Outcome moved = call("run next.toml --out out --no-cache");
  ASSERT_EQ(moved.status, 0) << moved.err;
  EXPECT_GT(double(summary()["max_displacement_mm"]), 0.5);
}

}  // namespace
}  // namespace hyperex
