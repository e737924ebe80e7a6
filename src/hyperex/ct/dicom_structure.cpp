// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/dicom_structure.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hyperex::ct {
namespace {

constexpr std::size_t kPreamble = 132;
constexpr std::uint32_t kUndefined = 0xffffffff, kPicture = 0x7fe00010,
                        kTransferSyntax = 0x00020010;
constexpr std::uint32_t kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;
constexpr int kDeepest = 16;  // sequences within sequences
constexpr std::array<std::string_view, 13> kLongLengths = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                           "SV", "UC", "UN", "UR", "UT", "UV"};

/// The kinds of value that DICOM knows (PS3.5, 6.2).
constexpr std::array<std::string_view, 34> kKinds = {
    "AE", "AS", "AT", "CS", "DA", "DS", "DT", "FD", "FL", "IS", "LO", "LT",
    "OB", "OD", "OF", "OL", "OV", "OW", "PN", "SH", "SL", "SQ", "SS", "ST",
    "SV", "TM", "UC", "UI", "UL", "UN", "UR", "US", "UT", "UV"};

template <std::size_t n>
bool is_among(const std::array<std::string_view, n>& all, std::string_view one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Thrown where the walk cannot go on; caught below.
struct Fault {
  const char* what;
};

constexpr const char* kCut = "is cut off: it ends before the last pixel";
constexpr const char* kDamaged = "is damaged: its header is not valid DICOM";

class Walk {
 public:
  explicit Walk(std::string_view bytes) : bytes_(bytes) {}

  void all() {
    at_ = kPreamble;
    while (at_ + 4 <= bytes_.size() && peek_tag() >> 16U == 2) element(true, 0);
    if (at_ == bytes_.size()) throw Fault{kCut};
    check_syntax();
    while (at_ < bytes_.size() && !is_padding()) element(explicit_, 0);
  }
  std::size_t at() const { return at_; }

 private:
  /// Some programs fill a file with zeros behind the pixels.
  bool is_padding() const {
    return has_picture_ && bytes_.find_first_not_of('\0', at_) == std::string_view::npos;
  }
  std::uint32_t number(int count) {
    if (bytes_.size() - at_ < std::size_t(count)) throw Fault{kCut};
    std::uint32_t out = 0;
    for (int i = 0; i < count; ++i)
      out |= std::uint32_t(std::uint8_t(bytes_[at_ + std::size_t(i)])) << (8U * unsigned(i));
    at_ += std::size_t(count);
    return out;
  }
  std::uint32_t tag() {
    const std::uint32_t group = number(2);
    return group << 16U | number(2);
  }
  std::uint32_t peek_tag() {
    const std::size_t before = at_;
    const std::uint32_t out = tag();
    at_ = before;
    return out;
  }
  void skip(std::size_t count) {
    if (bytes_.size() - at_ < count) throw Fault{kCut};
    at_ += count;
  }

  void check_syntax() {
    while (!syntax_.empty() && (syntax_.back() == '\0' || syntax_.back() == ' '))
      syntax_.remove_suffix(1);
    explicit_ = syntax_ != "1.2.840.10008.1.2";
    if (syntax_.empty()) throw Fault{kDamaged};
    if (syntax_ == "1.2.840.10008.1.2.2" || syntax_ == "1.2.840.10008.1.2.1.99")
      throw Fault{
          "has big-endian or deflated values, which are not read; expected an export of "
          "little-endian ones"};
  }

  void element(bool is_explicit, int depth) {
    const std::uint32_t which = tag();
    has_picture_ |= which == kPicture && depth == 0;
    std::string_view kind;
    std::uint32_t length = 0;
    if (is_explicit) {
      const std::size_t from = at_;
      skip(2);
      kind = bytes_.substr(from, 2);
      if (!is_among(kKinds, kind)) throw Fault{kDamaged};
      const bool is_long = is_among(kLongLengths, kind);
      if (is_long) skip(2);
      length = number(is_long ? 4 : 2);
    } else {
      length = number(4);
    }
    if (length == kUndefined) {
      items(bytes_.size(), kind != "UN" && is_explicit, which == kPicture, depth + 1);
      return;
    }
    if (kind == "SQ") {
      if (bytes_.size() - at_ < length) throw Fault{kCut};
      items(at_ + length, is_explicit, false, depth + 1);
      return;
    }
    if (which == kTransferSyntax) syntax_ = bytes_.substr(at_, length);
    skip(length);
  }

  /// Items up to `end` or to the mark of the sequence's end.
  void items(std::size_t end, bool is_explicit, bool fragments, int depth) {
    if (depth > kDeepest) throw Fault{kDamaged};
    while (at_ < end) {
      const std::uint32_t which = tag(), length = number(4);
      if (which == kSequenceEnd) return;
      if (which != kItem) throw Fault{kDamaged};
      if (fragments) {
        skip(length);
        continue;
      }
      const std::size_t item_end = length == kUndefined ? bytes_.size() : at_ + length;
      if (item_end > bytes_.size()) throw Fault{kCut};
      while (at_ < item_end) {
        if (length == kUndefined && peek_tag() == kItemEnd) {
          tag();
          number(4);
          break;
        }
        element(is_explicit, depth);
      }
    }
    if (end == bytes_.size() && at_ > end) throw Fault{kCut};
  }

  std::string_view bytes_, syntax_;
  std::size_t at_ = 0;
  bool explicit_ = true, has_picture_ = false;
};

}  // namespace

bool begins_as_dicom(std::string_view bytes) {
  return bytes.size() >= kPreamble && bytes.substr(kPreamble - 4, 4) == "DICM";
}

std::string fault_of_dicom(std::string_view bytes) {
  try {
    Walk(bytes).all();
  } catch (const Fault& fault) {
    return fault.what;
  }
  return "";
}

std::string without_padding(std::string bytes) {
  Walk walk(bytes);
  try {
    walk.all();
    bytes.resize(walk.at());
  } catch (const Fault&) {
    return bytes;  // fault_of_dicom() reports what is wrong
  }
  return bytes;
}

}  // namespace hyperex::ct
