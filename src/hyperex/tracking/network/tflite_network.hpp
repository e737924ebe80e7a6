// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <opencv2/dnn.hpp>
#include <span>
#include <string>
#include <vector>

namespace hyperex::tracking {

/// A network as OpenCV's DNN module runs it.
struct Network {
  cv::dnn::Net net;
  int width_px = 0, height_px = 0,
      channels = 0;  ///< of the one input, 1 x channels x height x width
  /// Names to pass to cv::dnn::Net::forward(), in the file's order. An output of rank 4 is 1 x C x
  /// H x W (channels first); one that the file reshapes has the file's own shape and order.
  std::vector<std::string> outputs;
};

/// From one tensor (index in the file; -1: the file's input) to some others (none: its outputs).
struct NetworkPart {
  int input = -1;
  std::vector<int> outputs = {};
};

/// Builds a network from the bytes of a .tflite file (FlatBuffers, format version 3) with one
/// subgraph of one image input: convolutions, plain and depthwise, with SAME or VALID padding;
/// PRELU, RELU, RELU6, LOGISTIC; ADD, MAX_POOL_2D, PAD, RESHAPE, CONCATENATION; weights in single
/// precision or half (DEQUANTIZE). Of a part only what leads to its outputs is looked at. OpenCV
/// reads such files from version 4.8 on; Debian 12 has 4.6. Throws InputError, naming `source`:
/// torn, another format, or an operation outside that list.
Network read_tflite(std::span<const std::uint8_t> bytes, const std::string& source,
                    const NetworkPart& part = {});

}  // namespace hyperex::tracking
