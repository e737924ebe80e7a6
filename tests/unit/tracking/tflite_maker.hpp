// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small .tflite files for tests, made operator by operator.
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tflite_generated.h"

namespace hyperex::tracking {

class TfliteMaker {
 public:
  using Shape = std::vector<int>;

  // By convention buffer 0 is empty.
  TfliteMaker() { buffers_.push_back(tflite::CreateBuffer(fb_)); }

  int tensor(const Shape& shape) { return add(shape, tflite::TensorType_FLOAT32, 0); }
  int constant(const Shape& shape, const std::vector<float>& values) {
    return add(shape, tflite::TensorType_FLOAT32, buffer(values));
  }
  int integers(const Shape& shape, const std::vector<std::int32_t>& values) {
    return add(shape, tflite::TensorType_INT32, buffer(values));
  }
  /// A constant in half precision, followed by a DEQUANTIZE.
  int half(const Shape& shape, const std::vector<float>& values) {
    cv::Mat numbers;
    cv::Mat(values).convertTo(numbers, CV_16F);
    const auto* bytes = numbers.ptr<std::uint8_t>();
    const int packed = add(shape, tflite::TensorType_FLOAT16,
                           buffer(std::vector<std::uint8_t>(bytes, bytes + 2 * values.size())));
    const int wide = tensor(shape);
    op(tflite::Operation_DEQUANTIZE, {packed}, wide);
    return wide;
  }

  void op(tflite::Operation operation, const std::vector<int>& inputs, int output,
          tflite::Options kind = tflite::Options_NONE, flatbuffers::Offset<void> options = 0) {
    codes_.push_back(tflite::CreateOperatorCode(fb_, std::int8_t(operation), 0, 1, operation));
    const std::vector<int> outputs = {output};
    operators_.push_back(tflite::CreateOperatorDirect(fb_, unsigned(codes_.size() - 1), &inputs,
                                                      &outputs, kind, options));
  }
  void convolution(int input, int filter, int bias, int output, tflite::Padding padding, int stride,
                   tflite::Activation activation = tflite::Activation_NONE) {
    op(tflite::Operation_CONV_2D, {input, filter, bias}, output, tflite::Options_Convolution,
       tflite::CreateConvolution(fb_, padding, stride, stride, activation).Union());
  }
  void depthwise(int input, int filter, int bias, int output, tflite::Padding padding, int stride) {
    op(tflite::Operation_DEPTHWISE_CONV_2D, {input, filter, bias}, output,
       tflite::Options_DepthwiseConvolution,
       tflite::CreateDepthwiseConvolution(fb_, padding, stride, stride, 1).Union());
  }
  void pool(int input, int output, int size, int stride, tflite::Padding padding) {
    op(tflite::Operation_MAX_POOL_2D, {input}, output, tflite::Options_Pool,
       tflite::CreatePool(fb_, padding, stride, stride, size, size).Union());
  }
  void concatenation(const std::vector<int>& inputs, int output, int axis) {
    op(tflite::Operation_CONCATENATION, inputs, output, tflite::Options_Concatenation,
       tflite::CreateConcatenation(fb_, axis).Union());
  }

  std::vector<std::uint8_t> file(int input, const std::vector<int>& outputs, unsigned version = 3) {
    const std::vector<int> inputs = {input};
    const auto graph =
        tflite::CreateSubGraphDirect(fb_, &tensors_, &inputs, &outputs, &operators_, "main");
    const std::vector<flatbuffers::Offset<tflite::SubGraph>> graphs = {graph};
    fb_.Finish(
        tflite::CreateModelDirect(fb_, version, &codes_, &graphs, "made by a test", &buffers_),
        tflite::ModelIdentifier());
    return {fb_.GetBufferPointer(), fb_.GetBufferPointer() + fb_.GetSize()};
  }

 private:
  template <class T>
  unsigned buffer(const std::vector<T>& values) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
    const std::vector<std::uint8_t> data(bytes, bytes + values.size() * sizeof(T));
    buffers_.push_back(tflite::CreateBufferDirect(fb_, &data));
    return unsigned(buffers_.size() - 1);
  }
  int add(const Shape& shape, tflite::TensorType type, unsigned buffer) {
    tensors_.push_back(tflite::CreateTensorDirect(fb_, &shape, type, buffer, "t"));
    return int(tensors_.size()) - 1;
  }

  flatbuffers::FlatBufferBuilder fb_;
  std::vector<flatbuffers::Offset<tflite::Buffer>> buffers_;
  std::vector<flatbuffers::Offset<tflite::Tensor>> tensors_;
  std::vector<flatbuffers::Offset<tflite::OperatorCode>> codes_;
  std::vector<flatbuffers::Offset<tflite::Operator>> operators_;
};

}  // namespace hyperex::tracking
