// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/dicom_slices.hpp"

#include <fmt/format.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmStringFilter.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <sstream>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/ct/dicom_structure.hpp"

namespace hyperex::ct {
namespace {
namespace fs = std::filesystem;
using gdcm::Tag;

const Tag kPixels(0x7fe0, 0x0010);
/// What may name the patient: names, numbers, dates of birth, and identifiers of study and file.
constexpr std::array<std::array<std::uint16_t, 2>, 11> kPrivate = {{{0x0010, 0x0010},
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
constexpr std::size_t kLeastWord = 3;

/// GDCM writes its own remarks, which may hold names, to standard error.
void silence_gdcm() {
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

std::string value_of(const gdcm::DataSet& data, const Tag& tag) {
  if (!data.FindDataElement(tag)) return "";
  const gdcm::ByteValue* bytes = data.GetDataElement(tag).GetByteValue();
  if (bytes == nullptr) return "";
  std::string text(bytes->GetPointer(), bytes->GetLength());
  const auto is_blank = [](char c) { return c == ' ' || c == '\0'; };
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  while (!text.empty() && is_blank(text.front())) text.erase(text.begin());
  return text;
}

/// The numbers of a value such as "1\0\0"; empty where one of them is none.
std::vector<double> numbers_of(const gdcm::DataSet& data, const Tag& tag) {
  std::vector<double> out;
  const std::string text = value_of(data, tag) + '\\';
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = text.find('\\', begin);
    std::string one = text.substr(begin, end - begin);
    one.erase(std::remove(one.begin(), one.end(), ' '), one.end());
    if (one.starts_with('+')) one.erase(0, 1);
    double number = 0;
    const auto read = std::from_chars(one.data(), one.data() + one.size(), number);
    if (read.ec != std::errc() || read.ptr != one.data() + one.size()) return {};
    out.push_back(number);
  }
  return out;
}

int short_of(const gdcm::DataSet& data, const Tag& tag) {
  const gdcm::ByteValue* bytes =
      data.FindDataElement(tag) ? data.GetDataElement(tag).GetByteValue() : nullptr;
  if (bytes == nullptr || bytes->GetLength() < 2) return 0;
  std::uint16_t number = 0;
  std::memcpy(&number, bytes->GetPointer(), 2);
  return number;
}

void add_private_words(const gdcm::DataSet& data, std::set<std::string>& words) {
  for (const auto& tag : kPrivate) {
    std::string word;
    for (const char c : value_of(data, Tag(tag[0], tag[1])) + '^') {
      const bool splits = c == '^' || c == ' ' || c == '=' || c == '\\' || c == ',';
      if (!splits) word += c;
      if (!splits) continue;
      if (word.size() >= kLeastWord) words.insert(lower_case(word));
      word.clear();
    }
  }
}

/// Fills the place, or says in `fault` what is missing.
void read_place(const gdcm::DataSet& data, DicomSlice& slice) {
  const auto at = numbers_of(data, Tag(0x0020, 0x0032)),
             way = numbers_of(data, Tag(0x0020, 0x0037)),
             step = numbers_of(data, Tag(0x0028, 0x0030));
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
  slice.place.rows = short_of(data, Tag(0x0028, 0x0010));
  slice.place.columns = short_of(data, Tag(0x0028, 0x0011));
  const double off = std::abs(slice.place.along_row.norm() - 1) +
                     std::abs(slice.place.along_column.norm() - 1) +
                     std::abs(slice.place.along_row.dot(slice.place.along_column));
  const bool sound = step[0] > 0 && step[1] > 0 && slice.place.first_mm.allFinite() && off < 1e-2;
  if (!sound || slice.place.rows < 2 || slice.place.columns < 2)
    slice.fault = "states an impossible place, direction, size or pixel size";
}

/// What of the picture's form is none of a CT; GDCM takes a header at its word.
bool has_odd_pixels(const gdcm::DataSet& data) {
  const int allocated = short_of(data, Tag(0x0028, 0x0100)),
            stored = short_of(data, Tag(0x0028, 0x0101)),
            high = short_of(data, Tag(0x0028, 0x0102)),
            is_signed = short_of(data, Tag(0x0028, 0x0103)),
            samples = short_of(data, Tag(0x0028, 0x0002));
  return allocated != 16 || stored < 8 || stored > 16 || high != stored - 1 || is_signed > 1 ||
         samples != 1 || !value_of(data, Tag(0x0028, 0x0004)).starts_with("MONOCHROME");
}

/// Uncompressed, the picture has a known number of bytes.
bool has_wrong_length(const gdcm::Reader& reader) {
  const gdcm::DataSet& data = reader.GetFile().GetDataSet();
  if (reader.GetFile().GetHeader().GetDataSetTransferSyntax().IsEncapsulated()) return false;
  const gdcm::ByteValue* bytes = data.GetDataElement(kPixels).GetByteValue();
  return bytes == nullptr ||
         bytes->GetLength() < 2U * unsigned(short_of(data, Tag(0x0028, 0x0010))) *
                                  unsigned(short_of(data, Tag(0x0028, 0x0011)));
}

/// All bytes of a DICOM file, or the first few of another.
std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(256, '\0');
  in.read(bytes.data(), std::streamsize(bytes.size()));
  bytes.resize(std::size_t(in.gcount()));
  return begins_as_dicom(bytes) ? read_file(file) : bytes;
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
  gdcm::Reader reader;
  std::istringstream stream(bytes);
  reader.SetStream(stream);
  bool read = false;
  try {
    read = reader.Read();
  } catch (const std::exception&) {
    read = false;
  }
  const gdcm::DataSet& data = reader.GetFile().GetDataSet();
  add_private_words(data, words);
  slice.modality = value_of(data, Tag(0x0008, 0x0060));
  slice.series = value_of(data, Tag(0x0020, 0x000e));
  if (const auto number = numbers_of(data, Tag(0x0020, 0x0011)); number.size() == 1)
    slice.series_number = int(number[0]);
  slice.survey = value_of(data, Tag(0x0008, 0x0008)).find("LOCALIZER") != std::string::npos;
  const auto frames = numbers_of(data, Tag(0x0028, 0x0008));
  const bool has_picture = data.FindDataElement(kPixels);
  slice.other = read && !slice.modality.empty() && slice.modality != "CT" &&
                !has_picture;  // a report, a list of files
  if (!read || slice.modality.empty() || !has_picture)
    slice.fault = "is cut off or damaged: it states no modality or holds no picture";
  else if (slice.modality != "CT" || slice.survey)
    return slice;
  else if (frames.size() == 1 && frames[0] > 1)
    slice.fault =
        "holds several slices (a multi-frame file), which are not read; expected a file for each "
        "slice, as scanners and 3D Slicer export them";
  else if (has_odd_pixels(data))
    slice.fault = "holds a picture of another kind than a CT's (one value of 16 bits a pixel)";
  else if (read_place(data, slice); slice.fault.empty() && has_wrong_length(reader))
    slice.fault = "is damaged: its picture has fewer pixels than it states";
  return slice;
}

bool names_patient(const std::string& name, const std::set<std::string>& words) {
  const std::string low = lower_case(name);
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return low.find(word) != std::string::npos; });
}

}  // namespace

DicomFolder read_dicom_headers(const fs::path& folder) {
  silence_gdcm();
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
  const auto damaged = [&]() {
    return InputError(slice.name +
                      ": its pixels are damaged or of a kind that GDCM does not read; "
                      "expected a slice of a CT");
  };
  gdcm::ImageReader reader;
  const std::string whole = read_file(slice.file);
  if (!fault_of_dicom(whole).empty()) throw damaged();  // since its header was read
  std::istringstream stream(whole);
  reader.SetStream(stream);
  bool read = false;
  try {
    read = reader.Read();
  } catch (const std::exception&) {
    read = false;
  }
  if (!read) throw damaged();
  const gdcm::Image& image = reader.GetImage();
  const gdcm::PixelFormat& format = image.GetPixelFormat();
  const std::size_t count = std::size_t(slice.place.rows) * slice.place.columns;
  const bool of_size = image.GetDimension(0) == unsigned(slice.place.columns) &&
                       image.GetDimension(1) == unsigned(slice.place.rows);
  std::vector<char> bytes(image.GetBufferLength());
  if (!of_size || format.GetSamplesPerPixel() != 1 || format.GetBitsAllocated() != 16 ||
      bytes.size() != 2 * count || !image.GetBuffer(bytes.data()))
    throw damaged();
  const double slope = image.GetSlope(), intercept = image.GetIntercept();
  const bool is_signed = format.GetPixelRepresentation() == 1;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint16_t raw = 0;
    std::memcpy(&raw, bytes.data() + 2 * i, 2);
    const double value = is_signed ? double(std::int16_t(raw)) : double(raw);
    to[i] = float(value * slope + intercept);
  }
}

}  // namespace hyperex::ct
