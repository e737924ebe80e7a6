// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the module: what ITK and GDCM do for it. Their shared libraries would delay the
// start of every command (docs/architecture.md). So they are linked to a library of their own,
// hx_itk.so (itk_module.cpp), which is loaded with the first CT. It shares with the program only
// the interface in this header and uses no other code of Hyperex.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyperex::ct {

/// Lengths in millimetres.
struct ItkGrid {
  std::array<int, 3> size{};
  std::array<double, 3> spacing_mm{};
};

/// In ITK's frame, which is DICOM's of the patient; the first index varies fastest.
struct ItkVolume {
  ItkGrid grid;
  std::array<double, 3> origin_mm{};
  std::array<std::array<double, 3>, 3> direction{};  ///< rows; columns are the ways of the indices
  int dimensions = 0, components = 0;
  std::vector<float> values;
};

struct DicomPixels {
  int columns = 0, rows = 0;
  bool is_signed = false;
  double slope = 1, intercept = 0;
  std::vector<char> bytes;  ///< 16 bits a pixel
};

using DicomTag = std::pair<std::uint16_t, std::uint16_t>;
struct DicomValues {
  std::vector<std::string> values;  ///< of the requested tags, as stored; "" where there is none
  bool has_picture = false, compressed = false;
  std::size_t picture_bytes = 0;  ///< 0 where it is compressed
};

class ItkLibrary {
 public:
  virtual ~ItkLibrary() = default;
  /// Values of tags of a file, given as its bytes; none where GDCM cannot read it.
  virtual std::optional<DicomValues> values_of(const std::string& bytes,
                                               const std::vector<DicomTag>& tags) const = 0;
  /// None where it holds no picture of one value of 16 bits a pixel, or a damaged one.
  virtual std::optional<DicomPixels> pixels_of(const std::string& bytes) const = 0;
  /// A NIfTI file, or else NRRD. None where it cannot be read.
  virtual std::optional<ItkVolume> read_volume(const std::string& file, bool nifti) const = 0;
  virtual void pieces(const std::vector<std::uint8_t>& mask, const ItkGrid& grid, bool corners,
                      std::vector<int>& number, std::vector<std::size_t>& count) const = 0;
  /// Millimetres; negative within the mask.
  virtual std::vector<float> signed_distance_mm(const std::vector<std::uint8_t>& mask,
                                                const ItkGrid& grid) const = 0;
  virtual std::vector<std::uint8_t> watershed(const std::vector<std::uint8_t>& level,
                                              const std::vector<std::uint8_t>& markers,
                                              const ItkGrid& grid) const = 0;
};

/// Loads hx_itk.so. Throws InputError where that fails.
const ItkLibrary& itk_library();

}  // namespace hyperex::ct
