// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <opencv2/dnn.hpp>
#include <span>
#include <string>
#include <vector>

namespace hyperex::tracking {

/// A network in the form that OpenCV's DNN module runs.
struct Network {
  cv::dnn::Net net;
  int width_px = 0, height_px = 0,
      channels = 0;  ///< of its single input, 1 x channels x height x width
  /// Names to pass to cv::dnn::Net::forward(), in the order of the file. An output of rank 4 is 1 x
  /// C x H x W (channels first). An output that the file reshapes has the shape and order of the
  /// file.
  std::vector<std::string> outputs;
};

/// The part of a network from one tensor to some others. The tensors are indices in the file;
/// `input` -1: the input of the file; no `outputs`: the outputs of the file.
struct NetworkPart {
  int input = -1;
  std::vector<int> outputs = {};
};

/// Builds a network from the bytes of a .tflite file (FlatBuffers, format version 3) with one
/// subgraph and one image input. Supported are convolutions, plain and depthwise, with SAME or
/// VALID padding; PRELU, RELU, RELU6, LOGISTIC; ADD, MAX_POOL_2D, PAD, RESHAPE, CONCATENATION;
/// weights in single or half precision (DEQUANTIZE). For a part, only the operators that lead to
/// its outputs are read. OpenCV itself reads such files from version 4.8 on, but Debian 12 has 4.6.
/// Throws InputError naming `source` if the file is damaged, has another format, or contains an
/// unsupported operation.
Network read_tflite(std::span<const std::uint8_t> bytes, const std::string& source,
                    const NetworkPart& part = {});

}  // namespace hyperex::tracking
