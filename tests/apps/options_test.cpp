// SPDX-License-Identifier: GPL-3.0-or-later
// Options from a scene file through the whole program: finite strain, its law and its solver, and
// each contact, on the embedded face with a small, coarse mesh.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/program.hpp"
#include "hyperex/anatomy/embedded_face.hpp"

namespace hyperex {
namespace {
using nlohmann::json;

const char* const kCoarse =
    "[mesh]\nlayers = 1\n"
    "[time]\nend_s = 0.2\n"
    "[output]\nvtu = false\nglb = false\nreport = false\npicture_times_s = [0]\n";

class Options : public ProgramTest {
 protected:
  json summary(const std::string& scene, const std::string& sets) {
    std::ofstream(in("scene.toml")) << "drive.by = \"displacement\"\n" << scene << kCoarse;
    const Outcome run = call("run scene.toml --out out " + sets);
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(read_file(in("out/summary.json")));
  }

  json opening(const std::string& sets) {
    return summary(
        "[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n",
        "--set mesh.element_size_mm=10 --set motion.time_scale=0.1 --set tissue.strain=finite " +
            sets);
  }

  /// The lips are closed by more than their gap and pushed back, and the lids are pushed back.
  json pressed(const std::string& sets) {
    write_pressed();
    std::string points;
    for (const std::string& name : moved_) points += (points.empty() ? "\"" : ", \"") + name + '"';
    return summary(
        "drive.points = [" + points +
            "]\n[scan]\nfile = \"embedded\"\n[motion]\nfile = \"pressed.csv\"\n"
            "rigid_points = [\"ibug68_27\", \"ibug68_36\", \"ibug68_39\", \"ibug68_42\", "
            "\"ibug68_45\"]\n",
        "--set mesh.element_size_mm=5 " + sets);
  }

 private:
  static Vec3 push_mm(int k) {
    const bool upper = (k >= 48 && k <= 54) || (k >= 60 && k <= 64);
    const bool lid = k >= 36 && k <= 47 && k != 36 && k != 39 && k != 42 && k != 45;
    if (k >= 48) return {0, upper ? -3.0 : 3.0, -5};
    return lid ? Vec3(0, 0, -4) : Vec3(0, 0, 0);
  }
  void write_pressed() {
    const io::Landmarks landmarks = anatomy::embedded_face().landmarks;
    std::ofstream csv(in("pressed.csv"));
    csv << "time_s";
    for (int k = 0; k < 68; ++k)
      for (const char axis : {'x', 'y', 'z'}) csv << fmt::format(",ibug68_{}_{}_mm", k, axis);
    for (int frame = 0; frame <= 6; ++frame) {
      csv << fmt::format("\n{:.6f}", frame / 30.0);
      for (int k = 0; k < 68; ++k) {
        const Vec3 at = 1e3 * landmarks.at(fmt::format("ibug68_{}", k)) + frame / 6.0 * push_mm(k);
        csv << fmt::format(",{:.4f},{:.4f},{:.4f}", at.x(), at.y(), at.z());
      }
    }
    csv << "\n";
    for (int k = 0; k < 68; ++k)
      if (push_mm(k).norm() > 0) moved_.insert(fmt::format("ibug68_{}", k));
  }
  std::set<std::string> moved_;
};

TEST_F(Options, FiniteStrainItsLawAndItsSolver) {
  const json plain = opening("");
  EXPECT_EQ(plain.at("strain"), "finite");
  EXPECT_EQ(plain.at("solver"), "finite");
  EXPECT_EQ(plain.at("law"), "neo-hookean");
  EXPECT_EQ(opening("--set tissue.law=yeoh").at("law"), "yeoh");
  const auto more = [&](const char* figure, const std::string& set) {
    EXPECT_GT(opening("--set " + set).at(figure).get<int>(), plain.at(figure).get<int>()) << set;
  };
  more("iterations", "solver.finite_step_s=0.01");
  more("iterations", "solver.finite_tolerance=1e-7");
  more("factorisations", "solver.full_newton=true");
}

TEST_F(Options, EachContactHasItsOwnFigure) {
  EXPECT_FALSE(pressed("--set contact.lips=false").contains("contact"));
  const std::map<std::string, std::string> figures = {
      {"lips", "lip_overlap"}, {"teeth", "in_teeth"}, {"eyes", "in_eyes"}};
  for (const auto& [key, figure] : figures) {
    SCOPED_TRACE(key);
    const std::string lips = key == "lips" ? "" : "--set contact.lips=false ";
    const json contact = pressed(lips + "--set contact." + key + "=true").at("contact");
    EXPECT_GT(contact.at("frames").get<int>(), 0);
    for (const auto& [other, name] : figures)
      EXPECT_EQ(contact.contains(name + "_mm"), other == key) << other;
    const double without = contact.at(figure + "_without_mm"), with = contact.at(figure + "_mm");
    EXPECT_GT(without, 0.1);
    EXPECT_LT(with, 0.3 * without);
  }
  EXPECT_TRUE(pressed("").at("contact").contains("lip_overlap_mm")) << "by default";
}

}  // namespace
}  // namespace hyperex
