// SPDX-License-Identifier: GPL-3.0-or-later
// The output of `hyperex sample` can be read by the readers of user files, is always the same, and
// replaces no file of the user.
#include "hyperex/sample/sample_data.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "hyperex/capture/tum_folder.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/output_directory.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/sample/second_face.hpp"
#include "support/test_file.hpp"

namespace hyperex::sample {
namespace {
namespace fs = std::filesystem;

class SampleData : public testing::Test {
 protected:
  SampleData() { Progress::silence(true); }
  fs::path in(const std::string& name) const { return folder_ / name; }

 private:
  const TestFolder folder_;
};

TEST_F(SampleData, IsReadBackAndTheSameEveryTime) {
  write_sample_data(in("first"));
  const anatomy::EmbeddedFace face = second_face();
  const io::Scan scan = io::read_scan(in("first/second_face.ply"));
  EXPECT_EQ(scan.unit, io::LengthUnit::millimetre);
  EXPECT_LT((scan.mesh.points - face.mesh.points).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(scan.vertex_colour.rows(), scan.mesh.points.rows());
  const io::Landmarks landmarks = io::read_landmarks(in("first/second_face_landmarks.json"));
  EXPECT_EQ(landmarks.size(), face.landmarks.size());
  EXPECT_LT((landmarks.at("pronasale") - face.landmarks.at("pronasale")).norm(), 1e-6);
  EXPECT_GT(io::read_scan(in("first/flawed_scan.ply")).mesh.points.rows(), 10000);

  const auto recording = capture::open_tum_folder(in("first/recording"), {.read_ahead_frames = 0});
  RenderedFace clip = sample_clip();
  std::size_t frames = 0;
  while (const auto frame = recording->next()) {
    EXPECT_TRUE(frame->valid) << frame->fault;
    ++frames;
  }
  EXPECT_EQ(frames, *clip.frame_count());
  const tracking::Truth truth = tracking::read_truth(in("first/recording")), wanted = clip.truth();
  ASSERT_EQ(truth.time_s.size(), wanted.time_s.size());
  for (std::size_t k = 0; k < frames; ++k) {
    EXPECT_NEAR(truth.time_s[k], wanted.time_s[k], 1e-6);
    EXPECT_LT((truth.landmarks_m[k] - wanted.landmarks_m[k]).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_TRUE(truth.camera_from_face[k].isApprox(wanted.camera_from_face[k], 1e-8));
    EXPECT_NEAR(truth.jaw_open[k], wanted.jaw_open[k], 1e-6);
  }

  write_sample_data(in("second"));
  const auto files = files_below(in("first"));
  EXPECT_EQ(files, files_below(in("second")));
  std::uintmax_t bytes = 0;
  for (const std::string& file : files) {
    EXPECT_EQ(read_file(in("first") / file), read_file(in("second") / file)) << file;
    bytes += fs::file_size(in("first") / file);
  }
  EXPECT_LT(bytes, 6U << 20U);
}

TEST_F(SampleData, ReplacesItsOwnFilesAndNoOthers) {
  fs::create_directories(in("mine"));
  std::ofstream(in("mine/thesis.txt")) << "years of work";
  EXPECT_THROW(write_sample_data(in("mine")), InputError);
  EXPECT_EQ(read_file(in("mine/thesis.txt")), "years of work");
  EXPECT_EQ(files_below(in("mine")).size(), 1U);

  fs::create_directories(in("own/recording"));
  std::ofstream(in("own/recording/old.txt")) << "of an earlier version";
  std::ofstream(in("own/sample.json"))
      << R"({"program": "hyperex sample", "files": ["recording/old.txt", "sample.json"]})";
  write_sample_data(in("own"));
  EXPECT_FALSE(fs::exists(in("own/recording/old.txt")));
  EXPECT_TRUE(fs::exists(in("own/second_face.ply")));
}

}  // namespace
}  // namespace hyperex::sample
