// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A session without a network: tests send requests and get the messages that a page would get.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "session.hpp"
#include "support/test_file.hpp"

namespace hyperex::studio {

namespace fs = std::filesystem;
using nlohmann::json;

struct Message {
  json head;
  std::string block;
};

class StudioSession : public testing::Test {
 protected:
  /// By default without error bands, which take time; one test has them.
  explicit StudioSession(bool bands = false) {
    SessionOptions options;
    options.save_into = folder_.path() / "mine";
    options.folder = folder_.path() / "own";
    options.program = "Hyperex test";
    options.bands = bands;
    options.ending = [this] { return ending_; };
    fs::create_directory(options.save_into);
    fs::create_directories(options.folder / "uploads");
    session_ = std::make_unique<Session>(
        options, [this](const std::string& message, bool binary, const std::string&) {
          if (!binary) return messages_.push_back({json::parse(message), ""});
          std::uint32_t length = 0;
          std::memcpy(&length, message.data(), 4);
          messages_.push_back(
              {json::parse(message.substr(4, length)), message.substr((4 + length + 7) / 8 * 8)});
        });
  }
  json ask(const std::string& name, json fields = json::object()) {
    messages_.clear();
    session_->answer({++id_, name, std::move(fields)});
    for (const Message& message : messages_)
      if (message.head.value("answer", 0) == id_) {
        check_answer(name, message.head);
        return message.head;
      }
    return nullptr;
  }
  /// Checks that an answer has the fields of protocol.json, and no others.
  static void check_answer(const std::string& name, const json& answer) {
    if (answer.contains("error")) return;
    std::vector<std::string> expected{"answer"}, present;
    for (const auto& [key, field] : protocol().at("requests").at(name).at("answer").items())
      expected.push_back(key);
    for (const auto& [key, value] : answer.items()) present.push_back(key);
    EXPECT_THAT(present, testing::UnorderedElementsAreArray(expected)) << name;
  }
  void work() {
    while (session_->has_work()) session_->work([] { return false; });
  }
  const Message* event(const std::string& name) const {
    for (auto message = messages_.rbegin(); message != messages_.rend(); ++message)
      if (message->head.value("event", "") == name) return &*message;
    return nullptr;
  }
  json set(const json& changes, int face, bool live = false) {
    return ask("set", {{"changes", changes}, {"face", face}, {"live", live}, {"time_s", peak_s_}});
  }
  void open() {
    EXPECT_FALSE(ask("open", {{"what", "embedded"}}).contains("error"));
    work();
    ASSERT_NE(event("face"), nullptr);
    const json& motion = event("face")->head["replay"]["motion"];
    peak_s_ = motion["time_s"][motion["peak_frame"].get<std::size_t>()];
  }
  /// Excursion of the right corner of the mouth of a face in the last motion, mm.
  double right_mm(std::size_t face) const {
    return event("motion")->head["table"][face]["commissure_R_mm"];
  }
  double greatest_mm(const Message& shape) const {
    const json& at = shape.head["values"];
    std::vector<std::int16_t> values(at["count"].get<std::size_t>());
    std::memcpy(values.data(), shape.block.data() + at["offset"].get<std::size_t>(),
                2 * values.size());
    double most = 0;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      most = std::max(most,
                      std::hypot(double(values[i]), double(values[i + 1]), double(values[i + 2])));
    return 1e3 * most * shape.head["step_m"].get<double>();
  }

  const TestFolder folder_;
  std::vector<Message> messages_;
  bool ending_ = false;
  std::unique_ptr<Session> session_;
  std::int64_t id_ = 0;
  double peak_s_ = 0;
};

}  // namespace hyperex::studio
