// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/read_series.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <map>

#include "hyperex/core/error.hpp"
#include "hyperex/core/interrupt.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/temporary.hpp"
#include "hyperex/ct/dicom_slices.hpp"
#include "hyperex/io/zip.hpp"

namespace hyperex::ct {
namespace {
namespace fs = std::filesystem;

constexpr double kUpright_deg = 0.5;
constexpr long kNew_s = 10;

/// The slices of one series.
using Group = std::vector<const DicomSlice*>;

[[noreturn]] void refuse_folder(const DicomFolder& folder, const fs::path& source) {
  if (folder.other_files == 0)
    throw InputError(source, "the folder is empty; expected the DICOM files of a CT");
  throw InputError(source,
                   fmt::format("none of its {} files is DICOM{}; expected the DICOM files of a CT",
                               folder.other_files,
                               folder.pictures == folder.other_files
                                   ? ": they are pictures, without places and Hounsfield units"
                                   : ""));
}

/// The groups by series, in the order of their numbers; survey pictures left out.
std::vector<Group> groups_of(const DicomFolder& folder) {
  std::map<std::string, Group> by_series;
  for (const DicomSlice& slice : folder.slices)
    if (!slice.survey && !slice.other) by_series[slice.series].push_back(&slice);
  std::vector<Group> out;
  out.reserve(by_series.size());
  for (auto& [key, group] : by_series) out.push_back(std::move(group));
  const auto number = [](const Group& group) {
    int highest = 0;
    for (const DicomSlice* slice : group) highest = std::max(highest, slice->series_number);
    return highest;
  };
  std::stable_sort(out.begin(), out.end(),
                   [&](const Group& a, const Group& b) { return number(a) < number(b); });
  return out;
}

const DicomSlice& first_of(const Group& group) {
  return *group.front();
}

const Group& chosen_of(const std::vector<Group>& groups, const SeriesChoice& choice,
                       const std::string& source) {
  std::string list;
  for (std::size_t g = 0; g < groups.size(); ++g)
    list += fmt::format(
        "{}{}: {} slice{} of {}", g == 0 ? "" : "; ", g + 1, groups[g].size(),
        groups[g].size() == 1 ? "" : "s",
        first_of(groups[g]).modality.empty() ? "unknown kind" : first_of(groups[g]).modality);
  if (choice.number) {
    if (*choice.number < 1 || *choice.number > int(groups.size()))
      throw InputError(
          fmt::format("--series = {}: expected 1 to {} ({})", *choice.number, groups.size(), list));
    return groups[std::size_t(*choice.number - 1)];
  }
  std::vector<const Group*> of_ct;
  for (const Group& group : groups)
    if (first_of(group).modality == "CT" || !first_of(group).fault.empty()) of_ct.push_back(&group);
  if (of_ct.size() == 1) return *of_ct.front();
  if (groups.size() == 1) return groups.front();
  throw InputError(fmt::format(
      "{}: {} series in one folder ({}); expected one, or --series with its number here", source,
      groups.size(), list));
}

SeriesVolume read_folder(const fs::path& folder, const fs::path& source,
                         const SeriesChoice& choice) {
  const DicomFolder found = read_dicom_headers(folder);
  if (found.slices.empty()) refuse_folder(found, source);
  const std::string shown = found.shown(source);
  // A file whose series cannot be read may belong to any.
  for (const DicomSlice& slice : found.slices)
    if (!slice.fault.empty() && slice.series.empty() && !slice.other)
      throw InputError(shown + ": " + slice.name + " " + slice.fault);
  const std::vector<Group> groups = groups_of(found);
  if (groups.empty())
    throw InputError(shown + ": survey pictures (localizers) alone; expected the slices of a CT");
  const Group& group = chosen_of(groups, choice, shown);
  std::vector<SlicePlace> places;
  for (const DicomSlice* slice : group) {
    if (!slice->fault.empty()) throw InputError(shown + ": " + slice->name + " " + slice->fault);
    if (slice->modality != "CT")
      throw InputError(
          fmt::format("{}: pictures of kind {}{}; expected a CT", shown, slice->modality,
                      slice->modality == "MR" ? " (an MRI, which shows no bone)" : ""));
    places.push_back(slice->place);
  }
  const SliceStack stack = order_slices(places, shown);
  if (!stack.grid.is_possible())
    throw InputError(shown +
                     ": its slices state impossible places or pixel sizes; expected steps of 0.01 "
                     "to 100 mm, no more than 5 m in all");
  SeriesVolume out;
  out.kind = "DICOM";
  out.shown = shown;
  out.volume = stack.grid;
  out.volume.hu.resize(out.volume.count());
  out.tilt_deg = stack.tilt_deg;
  const std::size_t of_slice = std::size_t(out.volume.size[0]) * out.volume.size[1];
  {
    Progress progress("reading the slices", long(group.size()));
    for (std::size_t k = 0; k < stack.order.size(); ++k) {
      try {
        read_pixels(*group[stack.order[k]], out.volume.hu.data() + k * of_slice);
      } catch (const InputError& error) {
        throw InputError(shown + ": " + error.what());
      }
      progress.update(long(k) + 1);
    }
  }
  if (out.tilt_deg > kUpright_deg)
    out.notes.push_back(
        fmt::format("The gantry was tilted by {:.1f} degrees: the slices are taken where they lay.",
                    out.tilt_deg));
  if (const auto surveys = std::count_if(found.slices.begin(), found.slices.end(),
                                         [](const DicomSlice& s) { return s.survey; }))
    out.notes.push_back(fmt::format("{} survey picture(s) were left out.", surveys));
  if (found.other_files > 0)
    out.notes.push_back(
        fmt::format("{} file(s) that are no DICOM were left out.", found.other_files));
  return out;
}

constexpr const char* kUnpacked = "hyperex_ct_";

/// Removes the folders of this user that killed calls left in the temporary folder. Those that a
/// living process uses are locked.
void remove_unpacked_leftovers() {
  std::error_code error, ignored;
  std::vector<fs::path> found;
  for (fs::directory_iterator at(fs::temp_directory_path(), error), end; !error && at != end;
       at.increment(error))
    if (at->path().filename().string().starts_with(kUnpacked)) found.push_back(at->path());
  for (const fs::path& path : found) {
    struct stat status {};
    // A new folder is not locked at once.
    if (::lstat(path.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) ||
        status.st_uid != ::geteuid() || std::time(nullptr) - status.st_mtime < kNew_s)
      continue;
    if (const InUse lock(path); lock.held()) fs::remove_all(path, ignored);
  }
}

/// A new folder that only its owner may read; removed at the end.
class UnpackedFolder {
 public:
  UnpackedFolder() {
    remove_unpacked_leftovers();
    std::string name = (fs::temp_directory_path() / (std::string(kUnpacked) + "XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr)
      throw InputError(fs::temp_directory_path(), "no folder can be made there to unpack into");
    path_.emplace(name);
    in_use_.emplace(path_->path());
  }
  ~UnpackedFolder() {
    std::error_code ignored;
    fs::remove_all(path_->path(), ignored);
  }
  UnpackedFolder(const UnpackedFolder&) = delete;
  UnpackedFolder& operator=(const UnpackedFolder&) = delete;
  fs::path inside() const { return path_->path() / "series"; }

 private:
  std::optional<TemporaryPath> path_;
  std::optional<InUse> in_use_;
};

/// What unzip() says names entries, and an entry may name the patient.
void unpack(const fs::path& zip, const fs::path& folder) {
  try {
    io::unzip(zip, folder);
  } catch (const InputError&) {
    throw InputError(zip,
                     "cannot be unpacked: it is no zip, damaged, encrypted or too large, or one of "
                     "its names or kinds of file is not allowed; expected a sound zip, or the "
                     "folder that another program unpacks from it");
  }
}

}  // namespace

SeriesVolume read_series(const fs::path& source, const SeriesChoice& choice) {
  const fs::file_status status = fs::status(source);
  if (!fs::exists(status)) throw InputError(source, "no such file or folder");
  if (fs::is_directory(status)) return read_folder(source, source, choice);
  if (is_volume_file(source)) {
    SeriesVolume out;
    out.kind =
        lower_case(source.filename().string()).find(".nii") != std::string::npos ? "NIfTI" : "NRRD";
    out.shown = source.string();
    Progress progress("reading the volume", 0);
    out.volume = read_volume_file(source);
    return out;
  }
  if (lower_case(source.extension().string()) == ".zip") {
    const UnpackedFolder unpacked;
    unpack(source, unpacked.inside());
    return read_folder(unpacked.inside(), source, choice);
  }
  throw InputError(
      source, "expected a folder of DICOM files, a .zip of one, or a .nii, .nii.gz or .nrrd file");
}

}  // namespace hyperex::ct
