// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <tiny_gltf.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hyperex::io {

/// Reads the accessors of a glTF model and checks each against the bytes available. If an accessor
/// is invalid, throws InputError; `what` is the name of its values in the message. Both constructor
/// arguments must outlive this object.
class GltfAccessors {
 public:
  GltfAccessors(const std::filesystem::path& file, const tinygltf::Model& model)
      : file_(file), model_(model) {}

  std::size_t count(int id, const char* what) const { return accessor(id, what).count; }
  /// Numbers per item.
  int columns(int id, const char* what) const;
  /// `columns` numbers per item, row-major. Normalised integers are scaled to real numbers.
  std::vector<double> read(int id, int columns, const char* what) const;
  /// The same for accessors that may be sparse or, as glTF has it, without values: then all are 0.
  /// `count`: the items that it must have.
  std::vector<double> read_sparse(int id, int columns, std::size_t count, const char* what) const;
  /// The bytes of a buffer view.
  std::pair<const unsigned char*, std::size_t> view(int id, const char* what) const;

 private:
  struct Items {
    int buffer_view;
    std::size_t byte_offset, count;
    int component_type, type;
    bool normalized;
  };
  /// Calls take(k, value) for each number, in order. Checks that the buffer view has them all.
  template <class Take>
  void items(int id, const char* what, const Items& items, int columns, const Take& take) const;
  const tinygltf::Accessor& accessor(int id, const char* what) const;
  [[noreturn]] void fail(int id, const char* what, const std::string& why) const;

  const std::filesystem::path& file_;
  const tinygltf::Model& model_;
};

}  // namespace hyperex::io
