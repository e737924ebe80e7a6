// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/network/tflite_constants.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "hyperex/core/error.hpp"

namespace hyperex::tracking {

static_assert(std::endian::native == std::endian::little, "FlatBuffers keeps numbers that way");

TfliteConstants::TfliteConstants(std::span<const std::uint8_t> bytes, std::string source)
    : source_(std::move(source)) {
  if (bytes.size() < 8 || !tflite::ModelBufferHasIdentifier(bytes.data()))
    fail("is no .tflite file (no TFL3 at its start)");
  flatbuffers::Verifier verifier(bytes.data(), bytes.size());
  if (!tflite::VerifyModelBuffer(verifier)) fail("is torn: an offset leads out of the file");
  model_ = tflite::GetModel(bytes.data());
  if (model_->version() != 3)
    fail(fmt::format("has format version {}, 3 was expected", model_->version()));
  if (!model_->subgraphs() || model_->subgraphs()->size() != 1 || !model_->buffers() ||
      !model_->operator_codes())
    fail("has not one graph with its buffers");
  graph_ = model_->subgraphs()->Get(0);
  if (!graph_->tensors()) fail("has no tensors");
  if (!graph_->operators()) return;
  for (const auto* op : *graph_->operators())
    if (operation(*op) == tflite::Operation_DEQUANTIZE && op->inputs() && op->outputs() &&
        op->inputs()->size() == 1 && op->outputs()->size() == 1)
      dequantized_from_[op->outputs()->Get(0)] = op->inputs()->Get(0);
}

void TfliteConstants::fail(const std::string& what) const {
  throw InputError(source_, what);
}

tflite::Operation TfliteConstants::operation(const tflite::Operator& op) const {
  if (op.opcode_index() >= model_->operator_codes()->size()) fail("names an operation it lacks");
  const auto* code = model_->operator_codes()->Get(op.opcode_index());
  // Codes up to 127 were formerly stored in another field; a file may use either.
  return tflite::Operation(std::max(int(code->old_code()), int(code->code())));
}

std::string TfliteConstants::custom_name(const tflite::Operator& op) const {
  if (operation(op) != tflite::Operation_CUSTOM) return "";
  const auto* name = model_->operator_codes()->Get(op.opcode_index())->custom_code();
  return name ? name->str() : "";
}

const tflite::Operator& TfliteConstants::maker(int tensor) const {
  if (graph_->operators())
    for (const auto* op : *graph_->operators())
      if (op->outputs() && op->inputs() && op->inputs()->size() > 0)
        for (const int output : *op->outputs())
          if (output == tensor) return *op;
  fail(fmt::format("has no operator that computes tensor {}", tensor));
}

const tflite::Tensor& TfliteConstants::tensor(int index) const {
  if (index < 0 || unsigned(index) >= graph_->tensors()->size())
    fail(fmt::format("names tensor {} of {}", index, graph_->tensors()->size()));
  return *graph_->tensors()->Get(unsigned(index));
}

std::vector<int> TfliteConstants::shape(int index) const {
  const auto* sizes = tensor(index).shape();
  std::vector<int> shape;
  if (sizes) shape.assign(sizes->begin(), sizes->end());
  constexpr double most = 1 << 26;
  double count = 1;
  for (const int size : shape) count *= size < 1 ? 2 * most : size;
  if (shape.empty() || shape.size() > 4 || count > most)
    fail(fmt::format("has tensor {} of an impossible shape", index));
  return shape;
}

const std::uint8_t* TfliteConstants::data(int index, std::size_t width) const {
  const unsigned buffer = tensor(index).buffer();
  std::size_t wanted = width;
  for (const int size : shape(index)) wanted *= std::size_t(size);
  const auto* bytes =
      buffer < model_->buffers()->size() ? model_->buffers()->Get(buffer)->data() : nullptr;
  if (!bytes || bytes->size() != wanted)
    fail(fmt::format("has {} bytes for tensor {}, {} were expected", bytes ? bytes->size() : 0,
                     index, wanted));
  return bytes->data();
}

cv::Mat TfliteConstants::values(int index) const {
  if (const auto half = dequantized_from_.find(index); half != dequantized_from_.end())
    index = half->second;
  const auto sizes = shape(index);
  cv::Mat values;
  if (tensor(index).type() == tflite::TensorType_FLOAT32) {
    values.create(int(sizes.size()), sizes.data(), CV_32F);
    std::memcpy(values.data, data(index, 4), values.total() * 4);
  } else if (tensor(index).type() == tflite::TensorType_FLOAT16) {
    cv::Mat half(int(sizes.size()), sizes.data(), CV_16F);
    std::memcpy(half.data, data(index, 2), half.total() * 2);
    half.convertTo(values, CV_32F);
  } else {
    fail(fmt::format("has constants of kind {} in tensor {}; single or half precision was expected",
                     int(tensor(index).type()), index));
  }
  return values;
}

cv::Mat TfliteConstants::integers(int index) const {
  if (tensor(index).type() != tflite::TensorType_INT32)
    fail(fmt::format("has no 32-bit integers in tensor {}", index));
  const auto sizes = shape(index);
  cv::Mat values(int(sizes.size()), sizes.data(), CV_32S);
  std::memcpy(values.data, data(index, 4), values.total() * 4);
  return values;
}

}  // namespace hyperex::tracking
