// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/dicom_slices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/ct/dicom_structure.hpp"
#include "hyperex/ct/itk_library.hpp"
#include "hyperex/ct/read_in_child.hpp"

namespace hyperex::ct {
namespace {
namespace fs = std::filesystem;

constexpr DicomTag kImageType{0x0008, 0x0008}, kModality{0x0008, 0x0060}, kSeries{0x0020, 0x000e},
    kSeriesNumber{0x0020, 0x0011}, kPosition{0x0020, 0x0032}, kOrientation{0x0020, 0x0037},
    kSamples{0x0028, 0x0002}, kColours{0x0028, 0x0004}, kFrames{0x0028, 0x0008},
    kRows{0x0028, 0x0010}, kColumns{0x0028, 0x0011}, kSpacing{0x0028, 0x0030},
    kAllocated{0x0028, 0x0100}, kStored{0x0028, 0x0101}, kHighBit{0x0028, 0x0102},
    kSigned{0x0028, 0x0103}, kIntercept{0x0028, 0x1052}, kSlope{0x0028, 0x1053};
/// What may name the patient: names, numbers, dates of birth, and identifiers of study and file.
constexpr std::array<DicomTag, 11> kPrivate = {{{0x0010, 0x0010},
                                                {0x0010, 0x0020},
                                                {0x0010, 0x0030},
                                                {0x0010, 0x1000},
                                                {0x0010, 0x1001},
                                                {0x0010, 0x1005},
                                                {0x0008, 0x0050},
                                                {0x0008, 0x0018},
                                                {0x0020, 0x0010},
                                                {0x0020, 0x000d},
                                                {0x0020, 0x000e}}};
constexpr DicomTag kPatient = kPrivate[0];
constexpr double kMostNumber = 2147483647;  // of a series, as DICOM has it
constexpr std::size_t kLeastWord = 3;       // bytes, that are looked for within other words

const std::vector<DicomTag>& all_tags() {
  static const std::vector<DicomTag> all = [] {
    std::vector<DicomTag> out = {kImageType,   kModality,  kSeries,    kSeriesNumber, kPosition,
                                 kOrientation, kSamples,   kColours,   kFrames,       kRows,
                                 kColumns,     kSpacing,   kAllocated, kStored,       kHighBit,
                                 kSigned,      kIntercept, kSlope};
    out.insert(out.end(), kPrivate.begin(), kPrivate.end());
    return out;
  }();
  return all;
}

/// The values of a header.
class Header {
 public:
  explicit Header(DicomValues values) : values_(std::move(values)) {}

  std::string text(const DicomTag& tag) const {
    std::string out = raw(tag);
    const auto is_blank = [](char c) { return c == ' ' || c == '\0'; };
    while (!out.empty() && is_blank(out.back())) out.pop_back();
    while (!out.empty() && is_blank(out.front())) out.erase(out.begin());
    return out;
  }
  /// The numbers of a value such as "1\0\0"; empty where one of them is none.
  std::vector<double> numbers(const DicomTag& tag) const {
    std::vector<double> out;
    const std::string whole = text(tag) + '\\';
    for (std::size_t begin = 0, end = 0; begin < whole.size(); begin = end + 1) {
      end = whole.find('\\', begin);
      std::string one = whole.substr(begin, end - begin);
      one.erase(std::remove(one.begin(), one.end(), ' '), one.end());
      if (one.starts_with('+')) one.erase(0, 1);
      double number = 0;
      const auto read = std::from_chars(one.data(), one.data() + one.size(), number);
      if (read.ec != std::errc() || read.ptr != one.data() + one.size()) return {};
      out.push_back(number);
    }
    return out;
  }
  /// A binary number of 16 bits.
  int binary(const DicomTag& tag) const {
    const std::string& bytes = raw(tag);
    std::uint16_t number = 0;
    if (bytes.size() >= 2) std::memcpy(&number, bytes.data(), 2);
    return number;
  }
  bool has_picture() const { return values_.has_picture; }
  bool is_compressed() const { return values_.compressed; }
  /// Uncompressed, the picture has a known number of bytes.
  bool has_wrong_length() const {
    return !values_.compressed && values_.picture_bytes < std::size_t(2) *
                                                              std::size_t(binary(kRows)) *
                                                              std::size_t(binary(kColumns));
  }

 private:
  const std::string& raw(const DicomTag& tag) const {
    const auto at = std::find(all_tags().begin(), all_tags().end(), tag) - all_tags().begin();
    return values_.values[std::size_t(at)];
  }
  DicomValues values_;
};

void add_private_words(const Header& header, std::set<std::string>& words) {
  for (const DicomTag& tag : kPrivate) {
    std::string word;
    for (const char c : header.text(tag) + '^') {
      const bool splits = c == '^' || c == ' ' || c == '=' || c == '\\' || c == ',';
      if (!splits) word += c;
      if (!splits) continue;
      // Short numbers stand in too many names; short names are looked for as whole words.
      if (word.size() >= kLeastWord || (tag == kPatient && !word.empty()))
        words.insert(lower_case(word));
      word.clear();
    }
  }
}

/// Fills the place, or says in `fault` what is missing.
void read_place(const Header& header, DicomSlice& slice) {
  const auto at = header.numbers(kPosition), way = header.numbers(kOrientation),
             step = header.numbers(kSpacing);
  if (at.size() != 3 || way.size() != 6 || step.size() != 2) {
    slice.fault =
        "states no place, direction or pixel size (ImagePositionPatient, "
        "ImageOrientationPatient, PixelSpacing)";
    return;
  }
  slice.place.first_mm = {at[0], at[1], at[2]};
  slice.place.along_row = {way[0], way[1], way[2]};
  slice.place.along_column = {way[3], way[4], way[5]};
  slice.place.column_step_mm = step[0], slice.place.row_step_mm = step[1];
  slice.place.rows = header.binary(kRows);
  slice.place.columns = header.binary(kColumns);
  const double off = std::abs(slice.place.along_row.norm() - 1) +
                     std::abs(slice.place.along_column.norm() - 1) +
                     std::abs(slice.place.along_row.dot(slice.place.along_column));
  const bool sound = step[0] > 0 && step[1] > 0 && slice.place.first_mm.allFinite() && off < 1e-2;
  if (!sound || slice.place.rows < 2 || slice.place.columns < 2)
    slice.fault = "states an impossible place, direction, size or pixel size";
}

/// What of the picture's form is none of a CT; GDCM takes a header at its word.
bool has_odd_pixels(const Header& header) {
  const int stored = header.binary(kStored);
  return header.binary(kAllocated) != 16 || stored < 8 || stored > 16 ||
         header.binary(kHighBit) != stored - 1 || header.binary(kSigned) > 1 ||
         header.binary(kSamples) != 1 || !header.text(kColours).starts_with("MONOCHROME");
}

/// The way from pixels to Hounsfield units; GDCM takes what it cannot read for 1 or 0.
bool has_odd_scale(const Header& header) {
  const auto is_number = [&](const DicomTag& tag) {
    const auto numbers = header.numbers(tag);
    return header.text(tag).empty() || (numbers.size() == 1 && std::isfinite(numbers[0]));
  };
  const auto slope = header.numbers(kSlope);
  return !is_number(kIntercept) || !is_number(kSlope) || (slope.size() == 1 && slope[0] == 0);
}

/// All bytes of a DICOM file, or the first few of another.
std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(256, '\0');
  in.read(bytes.data(), std::streamsize(bytes.size()));
  bytes.resize(std::size_t(in.gcount()));
  return begins_as_dicom(bytes) ? without_padding(read_file(file)) : bytes;
}

bool begins_as_picture(const fs::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return ending == ".jpg" || ending == ".jpeg" || ending == ".png" || ending == ".bmp" ||
         ending == ".tif" || ending == ".tiff" || ending == ".gif";
}

/// `bytes`: the file's, a DICOM file.
DicomSlice header_of(const fs::path& file, const std::string& bytes, std::set<std::string>& words) {
  DicomSlice slice;
  slice.file = file;
  slice.fault = fault_of_dicom(bytes);
  if (!slice.fault.empty()) return slice;
  auto values = itk_library().values_of(bytes, all_tags());
  if (!values) {
    slice.fault = "is damaged: its header is not valid DICOM";
    return slice;
  }
  const Header header(std::move(*values));
  add_private_words(header, words);
  slice.modality = header.text(kModality);
  slice.series = header.text(kSeries);
  if (const auto number = header.numbers(kSeriesNumber); number.size() == 1)
    slice.series_number = int(std::clamp(number[0], -kMostNumber, kMostNumber));
  slice.compressed = header.is_compressed();
  slice.survey = header.text(kImageType).find("LOCALIZER") != std::string::npos;
  // A report, a list of files: a picture of no kind.
  slice.other = !slice.modality.empty() && slice.modality != "CT" && !header.has_picture();
  const auto frames = header.numbers(kFrames);
  if (slice.modality.empty() || !header.has_picture())
    slice.fault = "is cut off or damaged: it states no modality or holds no picture";
  else if (slice.modality != "CT" || slice.survey)
    return slice;
  else if (frames.size() == 1 && frames[0] > 1)
    slice.fault =
        "holds several slices (a multi-frame file), which are not read; expected a file for each "
        "slice, as scanners and 3D Slicer export them";
  else if (has_odd_pixels(header))
    slice.fault = "holds a picture of another kind than a CT's (one value of 16 bits a pixel)";
  else if (has_odd_scale(header))
    slice.fault =
        "states a RescaleSlope or RescaleIntercept that is no number, or a slope of 0; expected "
        "those that give Hounsfield units";
  else if (read_place(header, slice); slice.fault.empty() && header.has_wrong_length())
    slice.fault = "is damaged: its picture has fewer pixels than it states";
  return slice;
}

/// Bytes of letters beyond ASCII count as letters.
bool is_of_word(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || std::isalnum(byte) != 0;
}

bool holds_word(const std::string& low, const std::string& word) {
  if (word.size() >= kLeastWord) return low.find(word) != std::string::npos;
  for (auto at = low.find(word); at != std::string::npos; at = low.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_of_word(low[at - 1])) && (end == low.size() || !is_of_word(low[end])))
      return true;
  }
  return false;
}

bool names_patient(const std::string& name, const std::set<std::string>& words) {
  const std::string low = lower_case(name);
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return holds_word(low, word); });
}

}  // namespace

DicomFolder read_dicom_headers(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& one : fs::recursive_directory_iterator(folder))
    if (one.is_regular_file() && !one.path().filename().string().starts_with('.') &&
        lower_case(one.path().filename().string()) != "dicomdir")
      files.push_back(one.path());
  std::sort(files.begin(), files.end());
  DicomFolder out;
  std::set<std::string> words;
  Progress progress("reading the headers of the slices", long(files.size()));
  long done = 0;
  for (const fs::path& file : files) {
    progress.update(++done);
    const std::string bytes = bytes_of(file);
    if (!begins_as_dicom(bytes)) {
      ++out.other_files;
      out.pictures += begins_as_picture(file) ? 1 : 0;
      continue;
    }
    out.slices.push_back(header_of(file, bytes, words));
    out.slices.back().name = fs::relative(file, folder).string();
  }
  for (std::size_t i = 0; i < out.slices.size(); ++i)
    if (std::string& name = out.slices[i].name; names_patient(name, words))
      name = fmt::format("file {} of {} (in the order of their names)", i + 1, out.slices.size());
  out.private_words = std::move(words);
  return out;
}

std::string DicomFolder::shown(const fs::path& path) const {
  return names_patient(path.string(), private_words) ? "the series" : path.string();
}

void read_pixels(const DicomSlice& slice, float* to) {
  const std::string whole = without_padding(read_file(slice.file));
  std::optional<DicomPixels> read;
  if (fault_of_dicom(whole).empty())
    read = slice.compressed ? pixels_in_child(whole) : itk_library().pixels_of(whole);
  if (!read || read->columns != slice.place.columns || read->rows != slice.place.rows)
    throw InputError(slice.name +
                     ": its pixels are damaged or of a kind that GDCM does not read; expected a "
                     "slice of a CT");
  const std::size_t count = std::size_t(read->rows) * std::size_t(read->columns);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint16_t raw = 0;
    std::memcpy(&raw, read->bytes.data() + 2 * i, 2);
    const double value = read->is_signed ? double(std::int16_t(raw)) : double(raw);
    to[i] = float(value * read->slope + read->intercept);
  }
}

}  // namespace hyperex::ct
