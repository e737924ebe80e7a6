// SPDX-License-Identifier: GPL-3.0-or-later
// The person's own bones: how they are laid on the scan, and what the tissue does on them.
#include <gmock/gmock.h>

#include <fstream>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/read_bones.hpp"
#include "support/estimated_bones.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::session {
namespace {
namespace fs = std::filesystem;

const std::string kScene = R"(
[scan]
file = "embedded"
[motion]
file = "embedded"
[mesh]
element_size_mm = 7
[drive]
by = "muscles"
[time]
frame_rate_hz = 5
)";

class OwnBones : public testing::Test {
 protected:
  static FaceSession session(const std::string& more) {
    return FaceSession(scene::read_scene_text(kScene + more, "scene.toml"),
                       {.certainty = Certainty::on_request});
  }
  /// Writes the estimated bones of the embedded face as a CT's folder, in another frame.
  void write_ct(const Eigen::Isometry3d& ct_from_scan, double skin_off_mm = 0) const {
    FaceSession plain = session("");
    const auto moved = [&](TriMesh mesh) {
      mesh.points = ((mesh.points * ct_from_scan.linear().transpose()).rowwise() +
                     ct_from_scan.translation().transpose())
                        .eval();
      return mesh;
    };
    for (const auto& [name, bone] : {std::pair{"skull.ply", anatomy::Bone::skull},
                                     std::pair{"mandible.ply", anatomy::Bone::mandible}})
      io::write_ply(folder_ / name,
                    moved(test::estimated_bone(plain.mesh(), plain.inputs().landmarks, bone)),
                    io::LengthUnit::millimetre);
    TriMesh skin = anatomy::embedded_face().mesh;
    skin.points.array() *= 1 + 0.01 * skin_off_mm;
    io::write_ply(folder_ / "skin.ply", moved(skin), io::LengthUnit::millimetre);
    io::Landmarks some;
    for (const char* name : {"pronasale", "subnasale", "nasion", "pogonion"})
      some[name] = ct_from_scan * plain.inputs().landmarks.at(name);
    io::write_landmarks(folder_ / "landmarks.json", some, io::LengthUnit::millimetre);
  }
  std::string ct() const { return "[anatomy]\nct = \"" + folder_.path().string() + "\"\n"; }
  static double greatest_apart(const simulate::Performance& a, const simulate::Performance& b) {
    double most = 0, far = 0;
    for (std::size_t f = 0; f < a.skin_displacement_m.size(); ++f) {
      most = std::max(most, double(a.skin_displacement_m[f].rowwise().norm().maxCoeff()));
      far = std::max(
          far,
          double(
              (a.skin_displacement_m[f] - b.skin_displacement_m[f]).rowwise().norm().maxCoeff()));
    }
    return far / most;
  }

  const TestFolder folder_;
};

TEST_F(OwnBones, ThatAreTheEstimatedOnesGiveTheSameMotion) {
  write_ct(Eigen::Isometry3d::Identity());
  FaceSession plain = session(""), own = session(ct());
  ASSERT_TRUE(own.mesh().bones);
  EXPECT_EQ(own.mesh().volume.tets, plain.mesh().volume.tets);
  EXPECT_LT((own.mesh().volume.nodes - plain.mesh().volume.nodes).rowwise().norm().maxCoeff(),
            5e-4);
  const double apart = greatest_apart(plain.run().performance(), own.run().performance());
  std::cout << "  greatest difference: " << 100 * apart << " % of the greatest displacement\n";
  EXPECT_LT(apart, 0.05) << "over cavities no springs hold the tissue";
}

TEST_F(OwnBones, OfACtAreLaidOnTheScan) {
  Eigen::Isometry3d ct_from_scan = Eigen::Isometry3d::Identity();
  ct_from_scan.linear() =
      Eigen::AngleAxisd(0.4, Vec3(0.3, 1, -0.2).normalized()).toRotationMatrix();
  ct_from_scan.translation() = Vec3(0.05, 1.5, -0.2);
  write_ct(ct_from_scan);
  FaceSession moved = session(ct());
  bool noted = false;
  for (const Note& note : moved.notes()) noted = noted || note.id == "anatomy.ct_aligned";
  EXPECT_TRUE(noted);
  write_ct(Eigen::Isometry3d::Identity());
  FaceSession still = session(ct());
  const Points &a = moved.mesh().bones->skull().points, &b = still.mesh().bones->skull().points;
  ASSERT_EQ(a.rows(), b.rows());
  EXPECT_LT((a - b).rowwise().norm().maxCoeff(), 2e-4);
}

TEST_F(OwnBones, AreRefusedWhereTheyDoNotLieUnderTheSkin) {
  write_ct(Eigen::Isometry3d::Identity());
  const auto refusal_of = [&](const std::string& more) {
    return hyperex::test::refusal([&] { session(more); });
  };
  const std::string skull = "[anatomy]\nskull = \"" + (folder_ / "skull.ply").string() + "\"\n";
  EXPECT_EQ(refusal_of(skull + "unit = \"mm\"\n"), "");
  EXPECT_THAT(refusal_of(skull + "unit = \"cm\"\n"),
              testing::AllOf(testing::HasSubstr("anatomy.skull"),
                             testing::HasSubstr("under the skin of the scan")));
  EXPECT_THAT(refusal_of("[anatomy]\nct = \"/\"\n"),
              testing::HasSubstr("a folder that hyperex ct wrote, with skin.ply"));
  EXPECT_THAT(refusal_of("[anatomy]\nskull = \"" + (folder_ / "none.ply").string() + "\"\n"),
              testing::HasSubstr("none.ply"));
  fs::remove(folder_ / "landmarks.json");
  Eigen::Isometry3d elsewhere = Eigen::Isometry3d::Identity();
  elsewhere.translation() = Vec3(0, 1, 0);
  write_ct(elsewhere);
  fs::remove(folder_ / "landmarks.json");
  EXPECT_THAT(refusal_of(ct()), testing::HasSubstr("three or more landmarks"));
}

TEST_F(OwnBones, WarnWhereAMandibleOrItsHeadsAreMissing) {
  write_ct(Eigen::Isometry3d::Identity());
  const auto warns = [](const FaceSession& of, const std::string& id) {
    for (const Note& note : of.warnings())
      if (note.id == id) return true;
    return false;
  };
  EXPECT_TRUE(warns(session(ct()), "anatomy.no_condyles")) << "a chin alone";
  fs::remove(folder_ / "mandible.ply");
  EXPECT_TRUE(warns(session(ct()), "anatomy.no_mandible"));
}

}  // namespace
}  // namespace hyperex::session
