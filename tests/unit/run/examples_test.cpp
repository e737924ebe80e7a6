// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of the source's experiments agree with the source, and those whose data are not part
// of the project can be run where the data are available. tests/examples runs all of examples/.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "hyperex/core/files.hpp"
#include "hyperex/run/run_scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::run {
using namespace scene;
using namespace session;
namespace {
namespace fs = std::filesystem;

const fs::path kExamples = fs::path(HYPEREX_SOURCE_DIR) / "examples",
               kScenes = fs::path(HYPEREX_SOURCE_DIR) / "bench/scenes";

std::vector<fs::path> all_scenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kScenes)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Whether the file needs data that are not part of the project and are missing.
bool data_is_missing(const fs::path& file) {
  return read_file(file).find("../shared/") != std::string::npos &&
         !fs::exists(kExamples / "../../shared/data");
}

class SharedScene : public testing::TestWithParam<fs::path> {};

TEST_P(SharedScene, IsSound) {
  if (data_is_missing(GetParam())) GTEST_SKIP() << "no ../shared/data";
  EXPECT_NO_THROW(session::check(read_scene(GetParam())));
}

std::string name_of(const testing::TestParamInfo<fs::path>& info) {
  std::string name = info.param.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, SharedScene, testing::ValuesIn(all_scenes()), name_of);

class Experiment : public testing::TestWithParam<const char*> {
 protected:
  fs::path file(int experiment) const {
    const std::string face = GetParam();
    return (face == "embedded" ? kExamples : kScenes) /
           ("experiment_" + std::to_string(experiment) + "_" + face + ".toml");
  }
};

TEST_P(Experiment, OneIsMeasuredThroughout) {
  if (data_is_missing(file(1))) GTEST_SKIP() << "no ../shared/data";
  EXPECT_EQ(read_scene(file(1)).region.measured, simulate::Measured::all);
}

TEST_P(Experiment, TwoHasTheSourcesParameters) {
  if (data_is_missing(file(2))) GTEST_SKIP() << "no ../shared/data";
  const Scene scene = read_scene(file(2));
  const auto tissue = tissue::uniform_parameters(scene.tissue);
  EXPECT_DOUBLE_EQ(tissue[tissue::young], 192.4e3);
  EXPECT_DOUBLE_EQ(tissue[tissue::viscosity], 476.8);
  EXPECT_DOUBLE_EQ(tissue[tissue::poisson], 0.495);
  EXPECT_DOUBLE_EQ(tissue[tissue::density], 1100);
  EXPECT_FALSE(tissue::is_graded(scene.tissue));
  EXPECT_DOUBLE_EQ(scene.time.step_s, 0.002);
  EXPECT_DOUBLE_EQ(scene.time.end_s, 2.7);
  EXPECT_EQ(scene.time.still_times_s, (std::vector<double>{0, 0.7, 1.3, 2, 2.7}));
}

TEST_P(Experiment, ThreeHasThreeModelsThatDifferAtOnePoint) {
  if (data_is_missing(file(3))) GTEST_SKIP() << "no ../shared/data";
  const Scene scene = read_scene(file(3));
  EXPECT_DOUBLE_EQ(scene.time.step_s, 0.001);
  EXPECT_DOUBLE_EQ(scene.time.end_s, 1.3);
  EXPECT_EQ(scene.tissue.preset, "source_model_1");
  EXPECT_TRUE(scene.tissue.points.empty());
  ASSERT_EQ(scene.variants.size(), 2U);
  // By 56.7 kPa and 19.2 Pa s about model 1.
  for (const int model : {2, 3}) {
    const Scene& variant = scene.variants[std::size_t(model - 2)].scene;
    EXPECT_EQ(variant.tissue.preset, scene.tissue.preset);
    ASSERT_EQ(variant.tissue.points.size(), 1U);
    const tissue::TissuePoint& point = variant.tissue.points.front();
    EXPECT_EQ(point.landmark, "crista_philtri_superior_R");
    const double sign = model == 2 ? 1 : -1;
    EXPECT_NEAR(*point.value[tissue::young], 148.9e3 + sign * 56.7e3, 1e-6);
    EXPECT_NEAR(*point.value[tissue::viscosity], 408.6 + sign * 19.2, 1e-9);
    EXPECT_FALSE(point.value[tissue::poisson] || point.value[tissue::density]);
  }
}

INSTANTIATE_TEST_SUITE_P(OnFaces, Experiment, testing::Values("embedded", "subject_a"));

}  // namespace
}  // namespace hyperex::run
