// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Private to this library: checked access to a .tflite file, its shapes and its constant tensors.
#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "tflite_generated.h"

namespace hyperex::tracking {

/// Refers to the bytes, which must outlive this object. Every method throws InputError, naming the
/// source, if the file is inconsistent.
class TfliteConstants {
 public:
  TfliteConstants(std::span<const std::uint8_t> bytes, std::string source);

  const tflite::SubGraph& graph() const { return *graph_; }
  tflite::Operation operation(const tflite::Operator& op) const;
  /// The name of an operator of kind CUSTOM; empty for other kinds.
  std::string custom_name(const tflite::Operator& op) const;
  /// The operator that computes a tensor.
  const tflite::Operator& maker(int tensor) const;
  /// The shape of a tensor. Each size is at least 1; there are at most 2^26 numbers in all.
  std::vector<int> shape(int tensor) const;
  /// A constant tensor in single precision, stored directly or converted from another by
  /// DEQUANTIZE.
  cv::Mat values(int tensor) const;
  /// A constant tensor of 32-bit integers.
  cv::Mat integers(int tensor) const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  const tflite::Tensor& tensor(int index) const;
  /// `width`: bytes per number.
  const std::uint8_t* data(int index, std::size_t width) const;

  std::string source_;
  const tflite::Model* model_ = nullptr;
  const tflite::SubGraph* graph_ = nullptr;
  std::map<int, int> dequantized_from_;
};

}  // namespace hyperex::tracking
