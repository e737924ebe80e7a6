// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Options as bytes, for the keys of kept results: an option that a struct describes cannot be left
// out of them.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/packed.hpp"

namespace hyperex {

/// Packs every option that `Options` describes (core/describe.hpp).
template <class Options>
class OptionPacker {
 public:
  OptionPacker(const Options& options, Packer& bytes) : options_(options), bytes_(bytes) {}

  template <class At>
  void option(const char* name, At at, const char*, const OptionDetails& = {}) {
    bytes_(std::string(name));
    add(at(options_));
  }
  template <class At, class AllAt>
  void one_or_all(const char* name, At at, const char*, AllAt all_at, const char*) {
    option(name, at, "");
    add(all_at(options_));
  }
  template <class At, class Words>
  void factors(const char* name, At at, const Words&, const char*, const OptionDetails&) {
    option(name, at, "");
  }

 private:
  template <class Value>
  void add(const Value& value) {
    if constexpr (Described<Value>) {
      OptionPacker<Value> inner(value, bytes_);
      Value::describe(inner);
    } else {
      bytes_(value);
    }
  }
  template <class Value>
  void add(const std::optional<Value>& value) {
    bytes_(value.has_value());
    if (value) add(*value);
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    bytes_(std::uint64_t(values.size()));
    for (const Value& value : values) add(value);
  }
  /// A file counts by its content, wherever it lies.
  void add(const std::filesystem::path& file) {
    bytes_(file.empty() ? std::string() : read_file(file));
  }

  const Options& options_;
  Packer& bytes_;
};

/// Appends all options, the contents of the files that they name included. Throws InputError where
/// such a file cannot be read.
template <Described Options>
void pack_options(const Options& options, Packer& bytes) {
  OptionPacker<Options> packer(options, bytes);
  Options::describe(packer);
}

}  // namespace hyperex
