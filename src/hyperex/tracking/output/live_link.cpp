// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/output/live_link.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cmath>
#include <iterator>
#include <sstream>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/tracking/output/arkit_weights.hpp"

namespace hyperex::tracking {
namespace {

constexpr int kRate_hz = 60;
constexpr std::size_t kBeforeWeights = 2;  // Timecode, BlendShapeCount

/// The names and order used by the app.
constexpr const char* kColumns =
    "Timecode BlendShapeCount EyeBlinkLeft EyeLookDownLeft EyeLookInLeft EyeLookOutLeft "
    "EyeLookUpLeft EyeSquintLeft EyeWideLeft EyeBlinkRight EyeLookDownRight EyeLookInRight "
    "EyeLookOutRight EyeLookUpRight EyeSquintRight EyeWideRight JawForward JawRight JawLeft "
    "JawOpen MouthClose MouthFunnel MouthPucker MouthRight MouthLeft MouthSmileLeft "
    "MouthSmileRight MouthFrownLeft MouthFrownRight MouthDimpleLeft MouthDimpleRight "
    "MouthStretchLeft MouthStretchRight MouthRollLower MouthRollUpper MouthShrugLower "
    "MouthShrugUpper MouthPressLeft MouthPressRight MouthLowerDownLeft MouthLowerDownRight "
    "MouthUpperUpLeft MouthUpperUpRight BrowDownLeft BrowDownRight BrowInnerUp "
    "BrowOuterUpLeft BrowOuterUpRight CheekPuff CheekSquintLeft CheekSquintRight "
    "NoseSneerLeft NoseSneerRight TongueOut HeadYaw HeadPitch HeadRoll LeftEyeYaw "
    "LeftEyePitch LeftEyeRoll RightEyeYaw RightEyePitch RightEyeRoll";

/// HH:MM:SS:FF.fff, rounded to a thousandth of a frame.
std::string timecode(double time_s) {
  const long long thousandths = std::llround(time_s * kRate_hz * 1000);
  const long long second = thousandths / (1000 * kRate_hz);
  const long long within = thousandths % (1000 * kRate_hz);
  return fmt::format("{:02}:{:02}:{:02}:{:02}.{:03}", second / 3600 % 24, second / 60 % 60,
                     second % 60, within / 1000, within % 1000);
}

}  // namespace

const std::vector<std::string>& live_link_columns() {
  static const std::vector<std::string> columns = [] {
    std::istringstream names(kColumns);
    return std::vector<std::string>(std::istream_iterator<std::string>(names), {});
  }();
  return columns;
}

void write_live_link_csv(const std::filesystem::path& file, const expression::FaceModel& model,
                         const Tracking& tracking) {
  std::vector<const TrackedFrame*> rows;
  for (const TrackedFrame& frame : tracking.frames)
    if (frame.valid && (rows.empty() || frame.time_s > rows.back()->time_s)) rows.push_back(&frame);
  if (rows.empty()) throw InputError(file, "not written: no frame of the recording has a face");
  const ArkitWeights weights(model);
  const std::vector<std::string>& columns = live_link_columns();
  write_file_atomically(file, [&](std::ostream& out) {
    fmt::print(out, "{}\n", fmt::join(columns, ","));
    for (const TrackedFrame* frame : rows) {
      const auto of_name = weights.of(*frame);
      fmt::print(out, "{},{}", timecode(frame->time_s - rows.front()->time_s),
                 columns.size() - kBeforeWeights);
      for (std::size_t c = kBeforeWeights; c < columns.size(); ++c) {
        std::string name = columns[c];
        name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
        const auto found = of_name.find(name);
        fmt::print(out, ",{:.10f}", found == of_name.end() ? 0.0 : found->second);
      }
      out << '\n';
    }
  });
}

}  // namespace hyperex::tracking
