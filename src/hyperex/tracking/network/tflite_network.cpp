// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/tflite_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/tracking/network/tflite_constants.hpp"
#include "tflite_generated.h"

namespace hyperex::tracking {
namespace {

using cv::dnn::DictValue;
using cv::dnn::LayerParams;

/// Traverses the operators in the order of the file, which is a valid order of computation, and
/// adds one or more layers for each. TFLite stores channels last, OpenCV first.
class Builder {
 public:
  Builder(const tflite::SubGraph& graph, const TfliteConstants& constants)
      : graph_(graph), constants_(constants) {}

  Network build(const NetworkPart& part) {
    if (part.input < 0 && (!graph_.inputs() || graph_.inputs()->size() != 1))
      fail("has not one input");
    const int input = part.input < 0 ? graph_.inputs()->Get(0) : part.input;
    std::vector<int> outputs = part.outputs;
    if (outputs.empty() && graph_.outputs())
      outputs.assign(graph_.outputs()->begin(), graph_.outputs()->end());
    if (outputs.empty()) fail("has no output");
    const auto shape = constants_.shape(input);
    if (shape.size() != 4 || shape[0] != 1) fail("has an input that is no single picture");
    Network network;
    network.height_px = shape[1];
    network.width_px = shape[2];
    network.channels = shape[3];
    place_[input] = {0, 0};
    net_.setInputsNames({"input"});
    for (const auto* op : path(input, outputs)) add(*op);
    for (const int output : outputs)
      network.outputs.push_back(net_.getLayer(place_of(output).layer)->name);
    network.net = net_;
    network.net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    return network;
  }

 private:
  struct Place {
    int layer = -1, output = 0;
  };

  /// The operators that lead from the input to the outputs, in the file's order.
  std::vector<const tflite::Operator*> path(int input, const std::vector<int>& outputs) const {
    std::set<int> needed(outputs.begin(), outputs.end());
    std::vector<const tflite::Operator*> path;
    for (unsigned k = graph_.operators() ? graph_.operators()->size() : 0; k-- > 0;) {
      const auto* op = graph_.operators()->Get(k);
      if (!op->outputs() || !op->inputs()) fail("has an operator that lacks a tensor");
      const auto makes = [&](int tensor) { return tensor != input && needed.contains(tensor); };
      if (!std::any_of(op->outputs()->begin(), op->outputs()->end(), makes)) continue;
      needed.insert(op->inputs()->begin(), op->inputs()->end());
      path.push_back(op);
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  [[noreturn]] void fail(const std::string& what) const { constants_.fail(what); }

  Place place_of(int tensor) const {
    const auto found = place_.find(tensor);
    if (found == place_.end()) fail(fmt::format("uses tensor {} before it is computed", tensor));
    return found->second;
  }

  int tensor_at(const flatbuffers::Vector<int>* list, unsigned k) const {
    if (!list || k >= list->size()) fail("has an operator that lacks a tensor");
    const int tensor = list->Get(k);
    constants_.shape(tensor);  // checks the index
    return tensor;
  }
  int in(const tflite::Operator& op, unsigned k) const { return tensor_at(op.inputs(), k); }
  int out(const tflite::Operator& op) const { return tensor_at(op.outputs(), 0); }

  Place add_layer(const std::string& type, LayerParams params, const std::vector<Place>& inputs) {
    const std::string name = fmt::format("{}_{}", type, ++layers_);
    const int id = net_.addLayer(name, type, params);
    for (std::size_t k = 0; k < inputs.size(); ++k)
      net_.connect(inputs[k].layer, inputs[k].output, id, int(k));
    return {id, 0};
  }

  Place activated(Place place, tflite::Activation activation) {
    switch (activation) {
      case tflite::Activation_NONE:
        return place;
      case tflite::Activation_RELU:
        return add_layer("ReLU", {}, {place});
      case tflite::Activation_RELU6:
        return add_layer("ReLU6", {}, {place});
      default:
        fail(fmt::format("has a fused activation of kind {}", int(activation)));
    }
  }

  struct Pads {
    int begin[2] = {0, 0}, end[2] = {0, 0};  // height, width
    bool even() const { return begin[0] == end[0] && begin[1] == end[1]; }
  };

  /// SAME: the output has ceil(input / stride) positions; an odd pixel of padding is added at the
  /// end.
  Pads pads(int input, tflite::Padding padding, const int (&size)[2],
            const int (&stride)[2]) const {
    Pads p;
    const auto shape = constants_.shape(input);
    if (shape.size() != 4) fail("has a convolution or a pool of something that is no picture");
    for (int k = 0; k < 2; ++k) {
      if (stride[k] < 1 || size[k] < 1) fail("has a stride or a size below 1");
      if (padding == tflite::Padding_VALID) continue;
      const int length = shape[std::size_t(k) + 1];
      const int places = (length + stride[k] - 1) / stride[k];
      const int total = std::max(0, (places - 1) * stride[k] + size[k] - length);
      p.begin[k] = total / 2;
      p.end[k] = total - total / 2;
    }
    return p;
  }

  Place padded(Place place, const std::array<int, 8>& paddings) {
    LayerParams params;
    params.set("paddings", DictValue::arrayInt(paddings.data(), 8));
    return add_layer("Padding", params, {place});
  }

  /// Adds a convolution of either kind. `weights` in OpenCV's order: outputs x inputs per group x
  /// height x width.
  void convolve(const tflite::Operator& op, const cv::Mat& weights, int groups,
                tflite::Padding padding, const int (&stride)[2], const int (&dilation)[2],
                tflite::Activation activation) {
    const int size[2] = {(weights.size[2] - 1) * dilation[0] + 1,
                         (weights.size[3] - 1) * dilation[1] + 1};
    Place from = place_of(in(op, 0));
    Pads p = pads(in(op, 0), padding, size, stride);
    if (!p.even()) {  // OpenCV's convolution requires equal padding on both sides
      from = padded(from, {0, 0, 0, 0, p.begin[0], p.end[0], p.begin[1], p.end[1]});
      p = {};
    }
    LayerParams params;
    params.set("kernel_h", weights.size[2]), params.set("kernel_w", weights.size[3]);
    params.set("stride_h", stride[0]), params.set("stride_w", stride[1]);
    params.set("dilation_h", dilation[0]), params.set("dilation_w", dilation[1]);
    params.set("pad_h", p.begin[0]), params.set("pad_w", p.begin[1]);
    params.set("num_output", weights.size[0]), params.set("group", groups);
    params.blobs.push_back(weights);
    const bool bias = op.inputs()->size() > 2;
    params.set("bias_term", bias);
    if (bias) {
      const cv::Mat values = constants_.values(in(op, 2));
      if (int(values.total()) != weights.size[0])
        fail("has a bias of another size than its filter");
      params.blobs.push_back(values.reshape(1, 1));
    }
    place_[out(op)] = activated(add_layer("Convolution", params, {from}), activation);
  }

  void add_convolution(const tflite::Operator& op) {
    const auto* o = op.options_as_Convolution();
    if (!o) fail("has a convolution without options");
    const cv::Mat filter = constants_.values(in(op, 1));  // outputs, height, width, inputs
    const auto shape = constants_.shape(in(op, 0));
    if (filter.dims != 4 || shape.size() != 4 || filter.size[3] != shape[3])
      fail("has a filter that does not fit its input");
    cv::Mat weights;
    cv::transposeND(filter, {0, 3, 1, 2}, weights);
    convolve(op, weights, 1, o->padding(), {o->stride_h(), o->stride_w()},
             {o->dilation_h(), o->dilation_w()}, o->activation());
  }

  void add_depthwise(const tflite::Operator& op) {
    const auto* o = op.options_as_DepthwiseConvolution();
    if (!o) fail("has a depthwise convolution without options");
    const cv::Mat filter = constants_.values(in(op, 1));  // 1, height, width, outputs
    const auto shape = constants_.shape(in(op, 0));
    if (filter.dims != 4 || filter.size[0] != 1 || shape.size() != 4 || shape[3] < 1 ||
        filter.size[3] % shape[3] != 0)
      fail("has a depthwise filter that does not fit its input");
    cv::Mat weights;
    cv::transposeND(filter, {3, 0, 1, 2}, weights);
    convolve(op, weights, shape[3], o->padding(), {o->stride_h(), o->stride_w()},
             {o->dilation_h(), o->dilation_w()}, o->activation());
  }

  void add_pool(const tflite::Operator& op) {
    const auto* o = op.options_as_Pool();
    if (!o) fail("has a pool without options");
    const int size[2] = {o->filter_height(), o->filter_width()};
    const int stride[2] = {o->stride_h(), o->stride_w()};
    const Pads p = pads(in(op, 0), o->padding(), size, stride);
    LayerParams params;
    params.set("pool", "MAX"), params.set("ceil_mode", false);
    params.set("kernel_h", size[0]), params.set("kernel_w", size[1]);
    params.set("stride_h", stride[0]), params.set("stride_w", stride[1]);
    params.set("pad_t", p.begin[0]), params.set("pad_b", p.end[0]);
    params.set("pad_l", p.begin[1]), params.set("pad_r", p.end[1]);
    place_[out(op)] =
        activated(add_layer("Pooling", params, {place_of(in(op, 0))}), o->activation());
  }

  void add_prelu(const tflite::Operator& op) {
    const cv::Mat slopes = constants_.values(in(op, 1));
    if (int(slopes.total()) != constants_.shape(in(op, 0)).back())
      fail("has a PRELU whose slopes are not one a channel");
    LayerParams params;
    params.blobs.push_back(slopes.reshape(1, 1));
    place_[out(op)] = add_layer("PReLU", params, {place_of(in(op, 0))});
  }

  void add_sum(const tflite::Operator& op) {
    if (constants_.shape(in(op, 0)) != constants_.shape(in(op, 1)))
      fail("adds tensors of two shapes");
    LayerParams params;
    params.set("operation", "sum");
    const auto* o = op.options_as_Addition();
    place_[out(op)] =
        activated(add_layer("Eltwise", params, {place_of(in(op, 0)), place_of(in(op, 1))}),
                  o ? o->activation() : tflite::Activation_NONE);
  }

  void add_pad(const tflite::Operator& op) {
    // batch, height, width, channel, each with begin and end.
    const cv::Mat p = constants_.integers(in(op, 1));
    if (p.total() != 8) fail("pads something that is no picture");
    const auto at = [&](int k) { return p.ptr<int>()[k]; };
    place_[out(op)] =
        padded(place_of(in(op, 0)), {at(0), at(1), at(6), at(7), at(2), at(3), at(4), at(5)});
  }

  Place permuted(Place place, const std::array<int, 4>& order) {
    LayerParams params;
    params.set("order", DictValue::arrayInt(order.data(), 4));
    return add_layer("Permute", params, {place});
  }

  /// The file's order is channels last, so an input of rank 4 is first permuted back to it.
  void add_reshape(const tflite::Operator& op) {
    Place place = place_of(in(op, 0));
    if (constants_.shape(in(op, 0)).size() == 4) place = permuted(place, {0, 2, 3, 1});
    const auto shape = constants_.shape(out(op));
    LayerParams params;
    params.set("dim", DictValue::arrayInt(shape.data(), int(shape.size())));
    place = add_layer("Reshape", params, {place});
    place_[out(op)] = shape.size() == 4 ? permuted(place, {0, 3, 1, 2}) : place;
  }

  void add_concatenation(const tflite::Operator& op) {
    const auto* o = op.options_as_Concatenation();
    if (!o || !op.inputs()) fail("has a concatenation without options");
    const int rank = int(constants_.shape(out(op)).size());
    int axis = o->axis() < 0 ? o->axis() + rank : o->axis();
    if (axis < 0 || axis >= rank) fail("joins tensors along an axis that they lack");
    constexpr int channels_first[] = {0, 2, 3, 1};
    if (rank == 4) axis = channels_first[axis];
    std::vector<Place> parts;
    for (unsigned k = 0; k < op.inputs()->size(); ++k) parts.push_back(place_of(in(op, k)));
    LayerParams params;
    params.set("axis", axis);
    place_[out(op)] = activated(add_layer("Concat", params, parts), o->activation());
  }

  void add_plain(const tflite::Operator& op, const std::string& type) {
    place_[out(op)] = add_layer(type, {}, {place_of(in(op, 0))});
  }

  void add(const tflite::Operator& op) {
    switch (constants_.operation(op)) {
      case tflite::Operation_CONV_2D:
        return add_convolution(op);
      case tflite::Operation_DEPTHWISE_CONV_2D:
        return add_depthwise(op);
      case tflite::Operation_MAX_POOL_2D:
        return add_pool(op);
      case tflite::Operation_PRELU:
        return add_prelu(op);
      case tflite::Operation_RELU:
        return add_plain(op, "ReLU");
      case tflite::Operation_LOGISTIC:
        return add_plain(op, "Sigmoid");
      case tflite::Operation_ADD:
        return add_sum(op);
      case tflite::Operation_PAD:
        return add_pad(op);
      case tflite::Operation_RESHAPE:
        return add_reshape(op);
      case tflite::Operation_CONCATENATION:
        return add_concatenation(op);
      case tflite::Operation_DEQUANTIZE:
        return;  // applied to constants only; done by TfliteConstants
      default:
        fail(fmt::format("has an operation that is not known here (number {})",
                         int(constants_.operation(op))));
    }
  }

  const tflite::SubGraph& graph_;
  const TfliteConstants& constants_;
  cv::dnn::Net net_;
  std::map<int, Place> place_;  // of computed tensors
  int layers_ = 0;
};

}  // namespace

Network read_tflite(std::span<const std::uint8_t> bytes, const std::string& source,
                    const NetworkPart& part) {
  const TfliteConstants constants(bytes, source);
  try {
    return Builder(constants.graph(), constants).build(part);
  } catch (const cv::Exception& error) {
    constants.fail("has a layer that OpenCV refuses: " + error.err);
  }
}

}  // namespace hyperex::tracking
