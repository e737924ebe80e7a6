// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Values one after the other as bytes, for results that the same build of the program reads back on
// the same machine (KeptResults). One function names the parts of a type for both directions:
//
//   template <class Archive, class T> requires std::same_as<std::remove_const_t<T>, Edge>
//   void parts(Archive& archive, T& edge) { auto& [from, to] = edge; archive(from, to); }
//
// where the structured binding no longer compiles once a member is added. It is found by its
// archive's namespace.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace hyperex {

class Packer {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (add(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void raw(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }
  template <class T>
  void add(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      raw(&value, sizeof value);
    else
      parts(*this, value);
  }
  void add(const std::string& text) {
    add(std::uint64_t(text.size()));
    raw(text.data(), text.size());
  }
  template <class Scalar, int... sizes>
  void add(const Eigen::Matrix<Scalar, sizes...>& matrix) {
    add(std::int64_t(matrix.rows()));
    add(std::int64_t(matrix.cols()));
    raw(matrix.data(), sizeof(Scalar) * std::size_t(matrix.size()));
  }
  template <class T, std::size_t n>
  void add(const std::array<T, n>& values) {
    for (const T& value : values) add(value);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::uint64_t(values.size()));
    if constexpr (std::is_arithmetic_v<T>)
      raw(values.data(), sizeof(T) * values.size());
    else
      for (const T& value : values) add(value);
  }

  std::string bytes_;
};

/// Throws std::runtime_error where the bytes end too soon.
class Unpacker {
 public:
  /// `bytes` must outlive this.
  explicit Unpacker(const std::string& bytes) : at_(bytes.data()), left_(bytes.size()) {}
  template <class... T>
  void operator()(T&... values) {
    (take(values), ...);
  }
  bool at_end() const { return left_ == 0; }

 private:
  void raw(void* to, std::size_t size) {
    if (size > left_) throw std::runtime_error("packed values end too soon");
    if (size == 0) return;
    std::memcpy(to, at_, size);
    at_ += size;
    left_ -= size;
  }
  /// A number of elements of at least one byte each.
  std::size_t count() {
    std::uint64_t n = 0;
    take(n);
    if (n > left_) throw std::runtime_error("packed values end too soon");
    return std::size_t(n);
  }
  template <class T>
  void take(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      raw(&value, sizeof value);
    else
      parts(*this, value);
  }
  void take(std::string& text) {
    text.resize(count());
    raw(text.data(), text.size());
  }
  template <class Scalar, int... sizes>
  void take(Eigen::Matrix<Scalar, sizes...>& matrix) {
    using D = Eigen::Matrix<Scalar, sizes...>;
    std::int64_t rows = 0, cols = 0;
    take(rows), take(cols);
    const auto most = std::int64_t(left_ / sizeof(Scalar));
    const auto fits = [](std::int64_t n, int fixed) { return fixed < 0 || n == fixed; };
    if (rows < 0 || cols < 0 || (cols > 0 && rows > most / cols) ||
        !fits(rows, D::RowsAtCompileTime) || !fits(cols, D::ColsAtCompileTime))
      throw std::runtime_error("a packed matrix of another size");
    matrix.resize(rows, cols);
    raw(matrix.data(), sizeof(Scalar) * std::size_t(matrix.size()));
  }
  template <class T, std::size_t n>
  void take(std::array<T, n>& values) {
    for (T& value : values) take(value);
  }
  template <class T>
  void take(std::vector<T>& values) {
    if constexpr (std::is_arithmetic_v<T>) {
      std::uint64_t n = 0;
      take(n);
      if (n > left_ / sizeof(T)) throw std::runtime_error("packed values end too soon");
      values.resize(std::size_t(n));
      raw(values.data(), sizeof(T) * values.size());
    } else {
      values.resize(count());
      for (T& value : values) take(value);
    }
  }

  const char* at_;
  std::size_t left_;
};

}  // namespace hyperex
