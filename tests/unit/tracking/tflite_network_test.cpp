// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/tflite_network.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "hyperex/core/error.hpp"
#include "hyperex/tracking/network/face_mesh_network.hpp"
#include "hyperex/tracking/network/model_bytes.hpp"
#include "support/refusal.hpp"
#include "tflite_maker.hpp"

namespace hyperex::tracking {
namespace {

using testing::HasSubstr;

/// A picture with channels last, as in the file.
struct Picture {
  int height, width, channels;
  std::vector<float> values;
  float at(int y, int x, int c) const {
    return values[std::size_t((y * width + x) * channels + c)];
  }
};

std::vector<float> noise(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> eighths(-16, 16);  // exact in half precision
  std::vector<float> values;
  for (int i = 0; i < count; ++i) values.push_back(float(eighths(random)) / 8);
  return values;
}

/// The first output for a picture.
std::vector<float> run(const std::vector<std::uint8_t>& file, const Picture& picture) {
  Network network = read_tflite(file, "made.tflite");
  EXPECT_EQ(network.width_px, picture.width);
  EXPECT_EQ(network.channels, picture.channels);
  const int sizes[] = {1, picture.channels, picture.height, picture.width};
  cv::Mat input(4, sizes, CV_32F);
  for (int c = 0; c < picture.channels; ++c)
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const int at[] = {0, c, y, x};
        input.at<float>(at) = picture.at(y, x, c);
      }
  network.net.setInput(input);
  const cv::Mat output = network.net.forward(network.outputs.front());
  return {output.ptr<float>(), output.ptr<float>() + output.total()};
}

struct Same {
  int places, before;
};
Same same(int length, int size, int stride) {
  const int places = (length + stride - 1) / stride;
  return {places, std::max(0, (places - 1) * stride + size - length) / 2};
}

/// Convolution by its definition, channels first. `depthwise`: output c depends on input c alone.
std::vector<float> convolved(const Picture& in, const std::vector<float>& filter,
                             const std::vector<float>& bias, int outputs, int size, int stride,
                             bool depthwise) {
  const Same down = same(in.height, size, stride), across = same(in.width, size, stride);
  std::vector<float> result;
  for (int o = 0; o < outputs; ++o)
    for (int y = 0; y < down.places; ++y)
      for (int x = 0; x < across.places; ++x) {
        float sum = bias[std::size_t(o)];
        for (int j = 0; j < size; ++j)
          for (int i = 0; i < size; ++i) {
            const int v = y * stride + j - down.before, u = x * stride + i - across.before;
            if (v < 0 || u < 0 || v >= in.height || u >= in.width) continue;
            for (int c = 0; c < in.channels; ++c)
              if (depthwise && c == o)
                sum += in.at(v, u, c) * filter[std::size_t((j * size + i) * outputs + o)];
              else if (!depthwise)
                sum += in.at(v, u, c) *
                       filter[std::size_t(((o * size + j) * size + i) * in.channels + c)];
          }
        result.push_back(sum);
      }
  return result;
}

void expect_near(const std::vector<float>& a, const std::vector<float>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-4) << i;
}

TEST(TfliteNetwork, ConvolutionsAreThoseOfTheDefinition) {
  for (const bool depthwise : {false, true})
    for (const int length : {4, 5, 8})
      for (const int size : {1, 2, 3, 5})
        for (const int stride : {1, 2, 3}) {
          SCOPED_TRACE(testing::Message()
                       << depthwise << ' ' << length << ' ' << size << ' ' << stride);
          const int inputs = 3, outputs = depthwise ? inputs : 2;
          const Picture in{length, length + 1, inputs,
                           noise(length * (length + 1) * inputs, unsigned(length))};
          const auto filter = noise(size * size * outputs * (depthwise ? 1 : inputs), 7);
          const auto bias = noise(outputs, 8);
          TfliteMaker make;
          const int input = make.tensor({1, in.height, in.width, inputs});
          const int weights = make.half(depthwise ? TfliteMaker::Shape{1, size, size, outputs}
                                                  : TfliteMaker::Shape{outputs, size, size, inputs},
                                        filter);
          const int offsets = make.constant({outputs}, bias);
          const int output = make.tensor({1, same(in.height, size, stride).places,
                                          same(in.width, size, stride).places, outputs});
          if (depthwise)
            make.depthwise(input, weights, offsets, output, tflite::Padding_SAME, stride);
          else
            make.convolution(input, weights, offsets, output, tflite::Padding_SAME, stride);
          expect_near(run(make.file(input, {output}), in),
                      convolved(in, filter, bias, outputs, size, stride, depthwise));
        }
}

/// A net with one operator from a 1 x 2 x 2 x 2 input.
const Picture small{2, 2, 2, {-1, 2, 3, -4, 5, 6, -7, 8}};
std::vector<float> through(const TfliteMaker::Shape& shape,
                           const std::function<void(TfliteMaker&, int, int)>& add) {
  TfliteMaker make;
  const int input = make.tensor({1, 2, 2, 2}), output = make.tensor(shape);
  add(make, input, output);
  return run(make.file(input, {output}), small);
}

TEST(TfliteNetwork, OtherOperators) {
  using Maker = TfliteMaker;
  const auto plain = [](tflite::Operation operation) {
    return [operation](Maker& m, int in, int out) { m.op(operation, {in}, out); };
  };
  expect_near(through({1, 2, 2, 2}, plain(tflite::Operation_RELU)), {0, 3, 5, 0, 2, 0, 6, 8});
  const auto prelu = [](Maker& m, int in, int out) {
    m.op(tflite::Operation_PRELU, {in, m.constant({1, 1, 2}, {0.5F, 0.25F})}, out);
  };
  expect_near(through({1, 2, 2, 2}, prelu), {-0.5F, 3, 5, -3.5F, 2, -1, 6, 8});
  const auto sum = [](Maker& m, int in, int out) { m.op(tflite::Operation_ADD, {in, in}, out); };
  expect_near(through({1, 2, 2, 2}, sum), {-2, 6, 10, -14, 4, -8, 12, 16});
  const auto pad = [](Maker& m, int in, int out) {
    m.op(tflite::Operation_PAD, {in, m.integers({4, 2}, {0, 0, 0, 0, 0, 0, 0, 1})}, out);
  };
  expect_near(through({1, 2, 2, 3}, pad), {-1, 3, 5, -7, 2, -4, 6, 8, 0, 0, 0, 0});
  const auto pool = [](Maker& m, int in, int out) { m.pool(in, out, 2, 2, tflite::Padding_VALID); };
  expect_near(through({1, 1, 1, 2}, pool), {5, 8});
  // Reshaped values stand in the file's order: channels last.
  const auto reshape = plain(tflite::Operation_RESHAPE);
  expect_near(through({1, 4, 2}, reshape), small.values);
  const auto join = [](Maker& m, int in, int out) {
    const int flat = m.tensor({1, 4, 2});
    m.op(tflite::Operation_RESHAPE, {in}, flat);
    m.concatenation({flat, flat}, out, 1);
  };
  auto twice = small.values;
  twice.insert(twice.end(), small.values.begin(), small.values.end());
  expect_near(through({1, 8, 2}, join), twice);
  const auto logistic = through({1, 2, 2, 2}, plain(tflite::Operation_LOGISTIC));
  EXPECT_NEAR(logistic[0], 1 / (1 + std::exp(1.0)), 1e-6);
}

std::vector<std::uint8_t> sound_file() {
  TfliteMaker make;
  const int input = make.tensor({1, 4, 4, 1}), output = make.tensor({1, 2, 2, 1});
  make.convolution(input, make.half({1, 3, 3, 1}, noise(9, 1)), make.constant({1}, {0.5F}), output,
                   tflite::Padding_SAME, 2, tflite::Activation_RELU);
  return make.file(input, {output});
}

std::string refusal(const std::vector<std::uint8_t>& file) {
  return test::refusal([&] { read_tflite(file, "made.tflite"); });
}

TEST(TfliteNetwork, TornFilesAreRefused) {
  const auto file = sound_file();
  EXPECT_EQ(refusal(file), "");
  for (std::size_t length = 0; length < file.size(); ++length) {
    // What the end of a file holds is not always looked at; what is must be there.
    const std::string said = refusal({file.begin(), file.begin() + std::ptrdiff_t(length)});
    if (length < file.size() / 2) {
      EXPECT_THAT(said, HasSubstr("made.tflite")) << length;
    }
  }
}

TEST(TfliteNetwork, WrongBytesAreRefusedOrHarmless) {
  const auto sound = sound_file();
  for (std::size_t at = 0; at < sound.size(); ++at)
    for (const std::uint8_t value : {0x00, 0x01, 0x7f, 0xff}) {
      auto file = sound;
      file[at] = value;
      const std::string said = refusal(file);  // must come back, whatever it says
      if (!said.empty()) {
        EXPECT_THAT(said, HasSubstr("made.tflite")) << at;
      }
    }
}

TEST(TfliteNetwork, SaysWhatIsWrong) {
  EXPECT_THAT(refusal({1, 2, 3}), HasSubstr("no .tflite file"));
  TfliteMaker old;
  const int input = old.tensor({1, 2, 2, 2});
  EXPECT_THAT(refusal(old.file(input, {input}, 2)), HasSubstr("format version 2"));
  TfliteMaker custom;
  const int from = custom.tensor({1, 2, 2, 2}), to = custom.tensor({1, 2, 2, 2});
  custom.op(tflite::Operation_CUSTOM, {from}, to);
  EXPECT_THAT(refusal(custom.file(from, {to})), HasSubstr("operation that is not known"));
  TfliteMaker unplugged;
  const int a = unplugged.tensor({1, 2, 2, 2}), b = unplugged.tensor({1, 2, 2, 2});
  unplugged.op(tflite::Operation_RELU, {b}, a);
  EXPECT_THAT(refusal(unplugged.file(b, {7})), HasSubstr("tensor 7"));
}

TEST(TfliteNetwork, ReadsTheNetworksThatAreCarried) {
  const Network detection = read_tflite(face_detection_bytes(), "detection");
  EXPECT_EQ(detection.width_px, 128);
  EXPECT_EQ(detection.outputs.size(), 2u);
  EXPECT_EQ(FaceMeshNetwork(true, true).size_px(), 192);
}

}  // namespace
}  // namespace hyperex::tracking
