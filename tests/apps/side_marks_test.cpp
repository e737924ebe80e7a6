// SPDX-License-Identifier: GPL-3.0-or-later
// Every picture of a face says which side is which: R at its left, L at its right.
#include <string>
#include <utility>

#include "apps/malformed.hpp"
#include "support/side_letters.hpp"

namespace hyperex {
namespace {

class SideMarks : public GoodInputs {
 protected:
  void expect_marks(const std::string& picture, int pictures) const {
    const cv::Mat sheet = test::grey_picture(in(picture));
    ASSERT_FALSE(sheet.empty()) << picture;
    EXPECT_EQ(test::letters_in(sheet, "R"), pictures) << picture;
    EXPECT_EQ(test::letters_in(sheet, "L"), pictures) << picture;
  }
};

TEST_F(SideMarks, StandInEachPictureOfARun) {
  put(in("x.toml"),
      "scan = { file = \"embedded\" }\nmotion = { file = \"embedded\" }\n"
      "mesh = { element_size_mm = 9 }\ntime = { end_s = 1.4, frame_rate_hz = 10 }\n"
      "output = { report = false, glb = false, vtu = false }\n"
      "[[tissue.region]]\nname = \"cheek_R\"\nyoung_factor = 5\n"
      "[[variant]]\nname = \"stiff\"\ntissue.young_kpa = 300\n");
  const Outcome run = call("run x.toml --out out");
  ASSERT_EQ(run.status, 0) << run.err;
  for (const auto& [picture, pictures] :
       {std::pair{"contact_sheet.png", 12}, std::pair{"muscles.png", 3},
        std::pair{"variants.png", 6}, std::pair{"asymmetry.png", 3},
        std::pair{"tissue_map.png", 3}})
    expect_marks(std::string("out/") + picture, pictures);
}

TEST_F(SideMarks, StandInPicturesOfScans) {
  const Outcome found = call("landmarks face.ply --out l.json --picture l.png");
  ASSERT_EQ(found.status, 0) << found.err;
  expect_marks("l.png", 3);
  const Outcome compared = call("compare face.ply face.ply --unit mm --picture c.png");
  ASSERT_EQ(compared.status, 0) << compared.err;
  expect_marks("c.png", 2);
}

}  // namespace
}  // namespace hyperex
