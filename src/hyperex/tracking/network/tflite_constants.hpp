// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inside the room: the checked view of a .tflite file, its shapes and its constant tensors.
#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "tflite_generated.h"

namespace hyperex::tracking {

/// Refers to the bytes, which must outlive it. Every method throws InputError, naming the source,
/// where the file is at odds with itself.
class TfliteConstants {
 public:
  TfliteConstants(std::span<const std::uint8_t> bytes, std::string source);

  const tflite::SubGraph& graph() const { return *graph_; }
  tflite::Operation operation(const tflite::Operator& op) const;
  /// The name of an operator of kind CUSTOM; else empty.
  std::string custom_name(const tflite::Operator& op) const;
  /// The operator that computes a tensor.
  const tflite::Operator& maker(int tensor) const;
  /// Of a tensor: sizes, each at least 1, at most 2^26 numbers in all.
  std::vector<int> shape(int tensor) const;
  /// A constant tensor in single precision, its own or what a DEQUANTIZE makes of another.
  cv::Mat values(int tensor) const;
  /// A constant tensor of 32-bit integers.
  cv::Mat integers(int tensor) const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  const tflite::Tensor& tensor(int index) const;
  /// With this many bytes per number.
  const std::uint8_t* data(int index, std::size_t width) const;

  std::string source_;
  const tflite::Model* model_ = nullptr;
  const tflite::SubGraph* graph_ = nullptr;
  std::map<int, int> dequantized_from_;
};

}  // namespace hyperex::tracking
