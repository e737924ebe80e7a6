// SPDX-License-Identifier: GPL-3.0-or-later
// What a run refuses, a check refuses before it and in the same sentence, and nothing else.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>

#include "apps/good_inputs.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/run_cost.hpp"
#include "support/note_matchers.hpp"
#include "support/refusal.hpp"
#include "unit/scene/other_values.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
namespace {
using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A face of 200 nodes: a run takes less than a second.
constexpr const char* kTwoHundredNodes =
    "scan = { file = \"embedded\" }\nmotion = { file = \"motion.csv\" }\n"
    "mesh = { element_size_mm = 14, layers = 1 }\n"
    "time = { step_s = 0.01, end_s = 0.2, frame_rate_hz = 10 }\n"
    "drive = { by = \"muscles\" }\n";

struct AgreeCase {
  std::string name;
  std::vector<std::string> overrides;
  std::string words = {};       ///< of the refusal
  std::string more = {};        ///< of the scene file
  std::string points_say = {};  ///< "knob": a point far off the face; "no chin"
};

std::string name_of_case(const testing::TestParamInfo<AgreeCase>& of) {
  std::string name = of.param.name;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

void spoil_points(const std::string& how, motion::Motion& m) {
  if (how == "knob") {
    const auto row = Eigen::Index(m.names.size());
    m.names.push_back("knob");
    for (Points& sample : m.positions) {
      sample.conservativeResize(row + 1, Eigen::NoChange);
      sample.row(row) << 0, 0, 0.2;
    }
  }
  if (how == "no chin")
    for (std::string& name : m.names)
      for (int k = 0; k <= 16; ++k)
        if (name == "pogonion" || name == fmt::format("ibug68_{}", k)) name = "left_out_" + name;
}

class Agreement : public testing::TestWithParam<AgreeCase> {
 protected:
  Agreement() {
    write_opening(folder_ / "", 0, 16,
                  [](motion::Motion& m) { spoil_points(GetParam().points_say, m); });
    folder_.write("scene.toml", kTwoHundredNodes + GetParam().more);
    folder_.write("own.toml",
                  "[[muscle]]\nname = \"one\"\npath = [\"45 d1\", \"54 d0.4\"]\n"
                  "together = { two = 0.9, three = 0.9 }\n"
                  "[[muscle]]\nname = \"two\"\npath = [\"45 (2, 0) d1\", \"54 d0.4\"]\n"
                  "together = { three = -0.9 }\n"
                  "[[muscle]]\nname = \"three\"\npath = [\"45 (4, 0) d1\", \"54 d0.4\"]\n");
  }

  scene::Scene scene() const {
    std::vector<std::string> overrides = GetParam().overrides;
    for (std::string& one : overrides)
      if (const auto at = one.find("own.toml"); at != std::string::npos)
        one.replace(at, std::string::npos, (folder_ / "own.toml").string());
    return scene::read_scene(folder_ / "scene.toml", overrides);
  }
  std::string by_check() const {
    return test::refusal([&] { check(scene()); });
  }
  /// Without its files. A model that cannot be solved is nothing that a check could foresee.
  std::string by_run() const {
    return test::refusal([&] {
      const scene::Scene given = scene();
      try {
        FaceSession session(
            given, {.certainty = Certainty::on_request, .inputs = [&](const Inputs& inputs) {
                      checked_cost(given, inputs, Extent::full);
                    }});
        checked_cost(given, session.inputs(), Extent::full, &session.mesh().volume);
        session.run_base();
        session.run_variants();
      } catch (const NumericalError&) {
      }
    });
  }

  scene::SceneFolder folder_;
};

// ---- what is known to be refused after the inputs are read

class AgreementOnRefusals : public Agreement {};

TEST_P(AgreementOnRefusals, InOneSentence) {
  const std::string checked = by_check();
  EXPECT_THAT(checked, HasSubstr(GetParam().words));
  EXPECT_EQ(checked, by_run());
}

TEST_P(AgreementOnRefusals, BeforeAnythingIsAssembled) {
  std::vector<std::string> stages;
  const auto begun = [&](const std::string& stage) { stages.push_back(stage); };
  EXPECT_THROW(FaceSession(scene(), {.certainty = Certainty::on_request, .stage = begun}),
               InputError);
  EXPECT_THAT(stages, Not(Contains("assembling and factoring")));
}

const AgreeCase kRefused[] = {
    {"Factor",
     {"tissue.region=[{ name = \"cheek_R\", poisson_factor = 2 }]"},
     "tissue.region[0].poisson_factor = 2.0: expected Poisson's ratio to stay from -0.99"},
    {"FactorOfAVariant",
     {},
     "variant[0].tissue.region[0].poisson_factor",
     "[[variant]]\nname = \"v\"\ntissue.region = [{ name = \"lips\", poisson_factor = -3 }]\n"},
    {"LayerBeneathTheTissue",
     {"tissue.layer=[{ name = \"skin\", thickness_mm = 40, young_factor = 2 }]"},
     "tissue.layer[0].thickness_mm = 40.0: expected a layer within the tissue: it ends 40.0 mm"},
    {"LayersWithoutThickness",
     {"tissue.layer=[{ name = \"skin\", young_factor = 2 }, { name = \"deep\" }]"},
     "tissue.layer[0].thickness_mm: expected a thickness, as only the last and deepest layer"},
    {"LayerOfAVariant",
     {},
     "variant[0].tissue.layer[0].poisson_factor = 2.0: expected Poisson's ratio to stay from -0.99",
     "[[variant]]\nname = \"v\"\ntissue.layer = [{ thickness_mm = 2, poisson_factor = 2 }]\n"},
    {"ScarOffTheSkin",
     {"tissue.region=[{ scar_points_mm = [[0, 0, 150], [10, 0, 150]], young_factor = 2 }]"},
     "points within 15 mm of the scan's surface"},
    {"TooMuchVolume",
     {"tissue.region=[{ name = \"cheek_R\", volume_ml = 30 }]"},
     "this region alone takes up to"},
    {"TooLittleTissue",
     {"tissue.region=[{ name = \"cheek_R\", volume_ml = -30 }]"},
     "this region alone takes down to"},
    {"PointsAtOnePlace",
     {"tissue.point=[{ landmark = \"ibug68_48\", young_kpa = 300 }, { landmark = \"cheilion_R\", "
      "young_kpa = 400 }]"},
     "points apart on this scan"},
    {"PointsAtOnePlaceInFront",
     {"tissue.interpolation=linear",
      "tissue.point=[{ landmark = \"ibug68_48\", young_kpa = 300 }, { landmark = \"cheilion_R\", "
      "young_kpa = 400 }]"},
     "points apart as seen from in front"},
    {"Cut",
     {"surgery.bone=[{ part = \"maxilla\", cut = \"bsso\" }]"},
     "surgery.bone[0].cut = \"bsso\""},
    {"Fold",
     {"mesh.element_size_mm=5", "mesh.thickness_mm=40"},
     "no layer of tissue with positive volume fits"},
    {"PointOffTheSkinByMuscles",
     {"drive.points=[\"ibug68_48\", \"ibug68_54\", \"knob\"]"},
     "driven point knob lies",
     "",
     "knob"},
    {"PointOffTheSkinByDisplacement",
     {"drive.by=displacement", "drive.points=[\"ibug68_48\", \"ibug68_54\", \"knob\"]"},
     "driven point knob lies",
     "",
     "knob"},
    {"PointOffTheSkinOfAVariant",
     {},
     "driven point knob lies",
     "[[variant]]\nname = \"v\"\ndrive.points = [\"ibug68_48\", \"knob\"]\n",
     "knob"},
    {"NoChin",
     {"drive.by=displacement", "drive.points=[\"ibug68_48\", \"ibug68_54\"]"},
     "has no point over the chin",
     "",
     "no chin"},
    {"Correlations", {"muscles.file=own.toml"}, "correlations that can hold at the same time"},
    {"Steps",
     {"motion.file=embedded", "time.end_s=0", "time.step_s=1e-6"},
     "are 2666667 steps; expected at most 2000000"},
};

INSTANTIATE_TEST_SUITE_P(Of, AgreementOnRefusals, testing::ValuesIn(kRefused), name_of_case);

// ---- the ends of every column and of the mesh, as they are described

class AgreementOnBounds : public Agreement {};

TEST_P(AgreementOnBounds, RefusedByBothOrByNeither) {
  EXPECT_EQ(by_check(), by_run());
}

double end_of(const Bounds& range, bool most) {
  if (most) return range.most;
  return range.above_least ? range.least + 1e-3 : range.least;
}

/// Whether both ends may lead to a refusal on this face; of all else only the upper one is tried.
bool both_ends(const std::string& column) {
  return column.ends_with("_factor") || column == "volume_ml" || column == "move_mm" ||
         column == "turn_deg" || column == "cut_shift_mm";
}

void add_column(const std::string& key, json row, const scene::KeyInfo& column,
                std::vector<AgreeCase>& cases) {
  const bool list = column.kind == scene::Kind::numbers;
  if (!list && column.kind != scene::Kind::number) return;
  if (key == "tissue.region" && !column.name.starts_with("density"))
    row["density_factor"] = 1.5;  // each region has an effect
  for (const bool most : {false, true}) {
    if (!most && !both_ends(column.name)) continue;
    const double end = end_of(column.range, most);
    row[column.name] = list ? json{end, end, end} : json(end);
    cases.push_back({fmt::format("{}_{}_{}", key, column.name, most ? "most" : "least"),
                     {key + "=" + scene::toml(json::array({row}))}});
  }
}

std::vector<AgreeCase> ends() {
  std::vector<AgreeCase> cases;
  for (const scene::Key& key : scene::keys()) {
    const bool number = key.kind == scene::Kind::number || key.kind == scene::Kind::integer;
    if (number && key.name.starts_with("mesh."))
      cases.push_back({key.name, {key.name + "=" + fmt::format("{:g}", end_of(key.range, true))}});
    const bool regions = key.name == "tissue.region", bones = key.name == "surgery.bone";
    for (const scene::KeyInfo& column : key.columns)
      if (regions || bones)
        add_column(key.name, regions ? json{{"name", "cheek_R"}} : json{{"part", "mandible"}},
                   column, cases);
  }
  return cases;
}

TEST(AgreementOfBounds, GoesOverEveryColumn) {
  EXPECT_GE(ends().size(), 24u);
}

INSTANTIATE_TEST_SUITE_P(Of, AgreementOnBounds, testing::ValuesIn(ends()), name_of_case);

// ---- what takes long

std::vector<Note> checked_smallest(const std::vector<std::string>& overrides) {
  const scene::SceneFolder folder;
  return check(scene::read_scene(folder.write("scene.toml", scene::smallest), overrides));
}

TEST(CheckOfAFineMesh, SaysThatItMakesNone) {
  EXPECT_THAT(checked_smallest({"mesh.element_size_mm=1"}),
              Contains(test::is_note("mesh.unchecked")));
  EXPECT_THAT(checked_smallest({}), Not(Contains(test::has_id("mesh.unchecked"))));
}

/// Not only when it runs.
TEST(CheckOfACoarseMesh, SaysWhereTheSkinIsOffTheScan) {
  EXPECT_THAT(checked_smallest({"mesh.element_size_mm=15"}),
              Contains(test::is_warning("skin.far_from_scan")));
  EXPECT_THAT(checked_smallest({}), Not(Contains(test::has_id("skin.far_from_scan"))));
}

TEST(CheckOfInputs, MakesNoMesh) {
  const scene::SceneFolder folder;
  const auto scene =
      scene::read_scene(folder.write("scene.toml", scene::smallest),
                        {"tissue.region=[{ name = \"cheek_R\", poisson_factor = 2 }]"});
  EXPECT_NO_THROW(check(scene, nullptr, CheckDepth::inputs));
  EXPECT_THROW(check(scene), InputError);
}

}  // namespace
}  // namespace hyperex::session
