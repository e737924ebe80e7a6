// SPDX-License-Identifier: GPL-3.0-or-later
#include "live.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "hyperex/core/error.hpp"
#include "open_face.hpp"
#include "support/rendered_clip.hpp"
#include "support/test_file.hpp"

namespace hyperex::studio {
namespace {

using nlohmann::json;

struct Shape {
  json head;
  std::vector<std::int16_t> values;
  double greatest_mm() const {
    double most = 0;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      most = std::max(most,
                      std::hypot(double(values[i]), double(values[i + 1]), double(values[i + 2])));
    return 1e3 * most * head["step_m"].get<double>();
  }
};

/// The messages that a page would get of a live face. If `draws`, the page draws each shape at
/// once.
class LiveFace : public testing::Test {
 protected:
  LiveFace()
      : face_("[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n",
              folder_.path() / "scene.toml", {}, [](const std::string&) {}) {}
  ~LiveFace() override { live_.reset(); }

  void start(bool draws = true) {
    live_.reset();
    LiveSetup setup;
    setup.source = std::make_unique<hyperex::test::RenderedClip>();
    setup.mesh = face_.session().shared_mesh();
    setup.landmarks = face_.inputs().landmarks;
    setup.options = face_.options_live(0, live_points());
    const std::lock_guard lock(mutex_);  // before the first message
    live_ = std::make_unique<Live>(
        std::move(setup), [this, draws](const std::string& message, bool binary,
                                        const std::string&) { take(message, binary, draws); });
  }
  void take(const std::string& message, bool binary, bool draws) {
    const std::lock_guard lock(mutex_);
    if (!binary) {
      messages_.push_back(json::parse(message));
      return;
    }
    std::uint32_t length = 0;
    std::memcpy(&length, message.data(), 4);
    Shape shape{json::parse(message.substr(4, length)), {}};
    const std::string block = message.substr((4 + length + 7) / 8 * 8);
    shape.values.resize(shape.head["values"]["count"].get<std::size_t>());
    std::memcpy(shape.values.data(), block.data(), 2 * shape.values.size());
    if (draws) live_->drawn(shape.head["frame"]);
    shapes_.push_back(std::move(shape));
  }
  json last(const std::string& event) {
    const std::lock_guard lock(mutex_);
    for (auto one = messages_.rbegin(); one != messages_.rend(); ++one)
      if ((*one)["event"] == event) return *one;
    return nullptr;
  }

  const TestFolder folder_;
  OpenFace face_;
  std::mutex mutex_;
  std::vector<json> messages_;
  std::vector<Shape> shapes_;
  std::unique_ptr<Live> live_;
};

TEST_F(LiveFace, FollowsTheOneBeforeTheCameraAndKeepsATake) {
  start();
  live_->record(true);
  live_->wait();
  const json live = last("live");
  EXPECT_EQ(live["state"], "ended");
  EXPECT_EQ(live["problem"], "");
  EXPECT_EQ(live["frames"], hyperex::test::RenderedClip::kFrames);
  EXPECT_EQ(live["drawn"], shapes_.size());
  ASSERT_FALSE(shapes_.empty());
  std::int64_t frame = 0;
  for (const Shape& shape : shapes_) {
    EXPECT_EQ(shape.values.size(), 3 * std::size_t(face_.session().mesh().skin.points.rows()));
    EXPECT_GT(shape.head["frame"].get<std::int64_t>(), frame);
    frame = shape.head["frame"];
    // The chin goes some 20 mm; of how many frames that is seen, a busy machine decides.
    EXPECT_LT(shape.greatest_mm(), 45);
  }
  EXPECT_GT(live["delay_ms"].get<double>(), 0);

  const json take = last("take");
  EXPECT_GE(take["time_s"].size(), hyperex::test::RenderedClip::kFrames - 1);
  const motion::Motion motion = live_->take(0, 10);
  EXPECT_EQ(motion.names, live_points());
  double opens_m = 0;
  for (const Points& positions : motion.positions)
    opens_m = std::max(opens_m, (positions - motion.positions.front()).rowwise().norm().maxCoeff());
  EXPECT_GT(opens_m, 8e-3);
  EXPECT_THROW(live_->take(9, 10), InputError);
}

TEST_F(LiveFace, SendsNoMoreThanAPageDrawsAndEndsWhenItIsTold) {
  start(false);
  live_->wait();
  EXPECT_EQ(last("live")["drawn"], 0);
  EXPECT_TRUE(last("live")["delay_ms"].is_null());
  EXPECT_THROW(live_->take(0, 1), InputError) << "none was recorded";
  start();
  live_->set_neutral();
  live_->set_options(face_.options_live(0, live_points()), 0);
  live_->stop();
  live_->wait();
  EXPECT_TRUE(live_->ended());
  live_->record(true);
  EXPECT_EQ(last("live")["recording"], false);
}

TEST_F(LiveFace, WhatDrivesMustBeTracked) {
  EXPECT_THROW(face_.options_live(0, {"ibug68_8"}), InputError);
  EXPECT_THROW(face_.options_live(7, live_points()), InputError);
  const simulate::SimulationOptions options = face_.options_live(0, live_points());
  EXPECT_EQ(options.drive.by, simulate::DriveBy::displacement);
  EXPECT_FALSE(options.drive.points.empty());
}

}  // namespace
}  // namespace hyperex::studio
