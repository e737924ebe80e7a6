// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/read_series.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "hyperex/core/files.hpp"
#include "hyperex/core/temporary.hpp"
#include "support/made_ct.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"
#include "support/zip_writer.hpp"

namespace hyperex::ct {
namespace {
namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Volume ten_slices() {
  return test::volume_of(test::small_head(), {0, 0, 0}, {100, 110, 27}, {4, 5, 3});
}

class ReadSeries : public testing::Test {
 protected:
  std::string refused(const fs::path& source, const SeriesChoice& choice = {}) const {
    return test::refusal([&] { read_series(source, choice); });
  }
  void expect_same(const Volume& read, const Volume& wanted) const {
    ASSERT_EQ(read.size, wanted.size);
    EXPECT_TRUE(read.step_m.isApprox(wanted.step_m, 1e-6));
    EXPECT_LT((read.origin_m - wanted.origin_m).norm(), 1e-7);
    for (std::size_t v = 0; v < read.hu.size(); ++v)
      ASSERT_NEAR(read.hu[v], wanted.hu[v], 0.51) << v;
  }
  fs::path in(const std::string& name) const { return folder_ / name; }

 private:
  const TestFolder folder_;
};

TEST_F(ReadSeries, GivesValuesAndPlacesBack) {
  const Volume made = ten_slices();
  test::write_dicom(in("ct"), made);
  const SeriesVolume read = read_series(in("ct"));
  expect_same(read.volume, made);
  EXPECT_EQ(read.kind, "DICOM");
  EXPECT_TRUE(read.notes.empty());
}

TEST_F(ReadSeries, AppliesSlopeAndIntercept) {
  const Volume made = ten_slices();
  test::DicomTags tags;
  tags.slope = 0.5, tags.intercept = -1000;
  test::write_dicom(in("ct"), made, tags);
  expect_same(read_series(in("ct")).volume, made);
}

TEST_F(ReadSeries, TakesZipsNiftiAndNrrd) {
  const Volume made = ten_slices();
  test::write_dicom(in("ct"), made);
  std::vector<test::Zipped> files;
  for (const auto& one : fs::directory_iterator(in("ct")))
    files.push_back({"study/" + one.path().filename().string(), read_file(one.path())});
  std::ofstream(in("ct.zip"), std::ios::binary) << test::zip_of(files);
  expect_same(read_series(in("ct.zip")).volume, made);
  for (const char* name : {"ct.nii", "ct.nii.gz", "ct.nrrd"}) {
    test::write_volume(in(name), made);
    expect_same(read_series(in(name)).volume, made);
  }
}

TEST_F(ReadSeries, RefusesWhatIsNoCt) {
  fs::create_directory(in("empty"));
  EXPECT_THAT(refused(in("empty")), HasSubstr("the folder is empty"));
  fs::create_directory(in("pictures"));
  std::ofstream(in("pictures") / "a.JPG") << "\xff\xd8\xff";
  std::ofstream(in("pictures") / "b.jpeg") << "\xff\xd8\xff";
  EXPECT_THAT(refused(in("pictures")),
              AllOf(HasSubstr("none of its 2 files is DICOM"), HasSubstr("pictures")));
  test::DicomTags tags;
  tags.modality = "MR";
  test::write_dicom(in("mri"), ten_slices(), tags);
  EXPECT_THAT(refused(in("mri")), HasSubstr("pictures of kind MR (an MRI"));
  EXPECT_THAT(refused(in("none")), HasSubstr("no such file or folder"));
  std::ofstream(in("a.txt")) << "text";
  EXPECT_THAT(refused(in("a.txt")), HasSubstr("expected a folder of DICOM files"));
  std::ofstream(in("a.nii")) << "text";
  EXPECT_THAT(refused(in("a.nii")), HasSubstr("damaged, cut off, or no NIfTI"));
}

TEST_F(ReadSeries, AsksWhichOfTwoSeries) {
  Volume made = ten_slices();
  test::write_dicom(in("ct"), made);
  test::DicomTags second;
  second.series_uid = "1.2.3.4.6", second.series_number = 2;
  for (float& v : made.hu) v += 10;
  test::write_dicom(in("ct"), made, second, "SECOND");
  EXPECT_THAT(refused(in("ct")),
              AllOf(HasSubstr("2 series in one folder (1: 10 slices of CT; 2: 10 slices of CT)"),
                    HasSubstr("--series")));
  expect_same(read_series(in("ct"), {.number = 2}).volume, made);
  EXPECT_THAT(refused(in("ct"), {.number = 3}), HasSubstr("--series = 3: expected 1 to 2"));
}

TEST_F(ReadSeries, PassesOverAnMriBesideTheCt) {
  const Volume made = ten_slices();
  test::write_dicom(in("ct"), made);
  test::DicomTags mri;
  mri.modality = "MR", mri.series_uid = "1.2.3.4.6";
  test::write_dicom(in("ct"), made, mri, "MR");
  expect_same(read_series(in("ct")).volume, made);
}

TEST_F(ReadSeries, NamesAFileThatIsCutAtAnyPlace) {
  test::write_dicom(in("ct"), ten_slices());
  const fs::path file = in("ct") / "IM0004.dcm";
  const std::string whole = read_file(file);
  // Everywhere in the header, then at some places of the picture.
  for (std::size_t length = 132; length < whole.size(); length += length < 1200 ? 1 : 211) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    ASSERT_THAT(refused(in("ct")), HasSubstr("IM0004.dcm is ")) << length;
  }
}

TEST_F(ReadSeries, SurvivesAHeaderWithAWrongByte) {
  test::write_dicom(in("ct"), ten_slices());
  const fs::path file = in("ct") / "IM0004.dcm";
  const std::string whole = read_file(file);
  int refusals = 0;
  for (std::size_t at = 132; at < 1200; at += 3) {
    std::string wrong = whole;
    wrong[at] = char(wrong[at] ^ 0x55);
    std::ofstream(file, std::ios::binary) << wrong;
    refusals += refused(in("ct")).empty() ? 0 : 1;
  }
  EXPECT_GT(refusals, 20);
}

TEST_F(ReadSeries, NamesNoPatient) {
  test::DicomTags tags;
  tags.patient = "Doeringer^Annabell", tags.patient_id = "HX778812", tags.birth_date = "19610407";
  const fs::path folder = in("Doeringer_CT");
  test::write_dicom(folder, ten_slices(), tags, "annabell_");
  const fs::path file = folder / "annabell_0004.dcm";
  const std::string whole = read_file(file);
  std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() - 100);
  EXPECT_EQ(refused(folder),
            "the series: file 4 of 10 (in the order of their names) is cut off: it "
            "ends before the last pixel");
  fs::remove(file);                          // the uppermost slice
  fs::remove(folder / "annabell_0005.dcm");  // one in the middle
  EXPECT_THAT(refused(folder),
              AllOf(HasSubstr("the series: 1 slice is missing"), Not(HasSubstr("oering"))));
}

TEST_F(ReadSeries, NamesNoPatientOfAZip) {
  for (const char* name : {"doeringer_annabell.dcm", "doeringer:annabell.dcm"}) {
    test::Zipped entry{name, std::string(5000, 'x')};
    entry.crc_off = std::string(name).find(':') == std::string::npos ? 1 : 0;
    std::ofstream(in("ct.zip"), std::ios::binary) << test::zip_of({entry});
    EXPECT_THAT(refused(in("ct.zip")),
                AllOf(HasSubstr("ct.zip: cannot be unpacked"), Not(HasSubstr("oering"))));
  }
}

TEST_F(ReadSeries, ShortWordsOfThePatientAreFoundBetweenSeparators) {
  test::DicomTags tags;
  tags.patient = "Xi^Yo", tags.patient_id = "7";
  test::write_dicom(in("ct"), ten_slices(), tags, "scan_Yo_");
  const fs::path file = in("ct") / "scan_Yo_0004.dcm";
  fs::resize_file(file, fs::file_size(file) - 100);
  EXPECT_THAT(refused(in("ct")), HasSubstr("file 4 of 10 (in the order of their names) is cut"));
  fs::rename(in("ct"), in("xi-ct"));
  EXPECT_THAT(refused(in("xi-ct")), testing::StartsWith("the series: file 4"));
  // Not within a word.
  fs::rename(in("xi-ct"), in("exit"));
  EXPECT_THAT(refused(in("exit")), HasSubstr("exit: file 4"));
}

TEST_F(ReadSeries, RemovesWhatAKilledCallHadUnpacked) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  fs::create_directory(in("tmp"));
  ::setenv("TMPDIR", in("tmp").c_str(), 1);
  for (const char* name : {"hyperex_ct_killed", "hyperex_ct_living", "hyperex_ct_new", "other"}) {
    fs::create_directories(in("tmp") / name / "series");
    std::ofstream(in("tmp") / name / "series" / "a.dcm") << "a slice";
    if (std::string(name) != "hyperex_ct_new")
      fs::last_write_time(in("tmp") / name,
                          fs::file_time_type::clock::now() - std::chrono::minutes(1));
  }
  const InUse living(in("tmp") / "hyperex_ct_living");
  std::ofstream(in("ct.zip"), std::ios::binary) << test::zip_of({{"a.txt", "a"}});
  refused(in("ct.zip"));
  EXPECT_FALSE(fs::exists(in("tmp") / "hyperex_ct_killed"));
  EXPECT_TRUE(fs::exists(in("tmp") / "hyperex_ct_living"));
  EXPECT_TRUE(fs::exists(in("tmp") / "hyperex_ct_new"));  // it may not be locked yet
  EXPECT_TRUE(fs::exists(in("tmp") / "other"));
  if (before == nullptr)
    ::unsetenv("TMPDIR");
  else
    ::setenv("TMPDIR", kept.c_str(), 1);
}

TEST_F(ReadSeries, TakesZerosBehindThePixels) {
  const Volume made = ten_slices();
  test::write_dicom(in("ct"), made);
  const fs::path file = in("ct") / "IM0004.dcm";
  const std::string whole = read_file(file);
  for (const std::size_t count : {1, 2, 7, 8, 512}) {
    std::ofstream(file, std::ios::binary) << whole << std::string(count, '\0');
    expect_same(read_series(in("ct")).volume, made);
  }
  std::ofstream(file, std::ios::binary) << whole << std::string(7, '\0') << 'x';
  EXPECT_THAT(refused(in("ct")), HasSubstr("IM0004.dcm is "));
}

TEST_F(ReadSeries, RefusesAScaleThatGivesNoHounsfieldUnits) {
  test::write_dicom(in("ct"), ten_slices());
  const fs::path file = in("ct") / "IM0004.dcm";
  const std::string whole = read_file(file);
  const std::string slope(
      "\x28\0\x53\x10"
      "DS\x02\0",
      8),
      intercept(
          "\x28\0\x52\x10"
          "DS\x06\0",
          8);
  for (const auto& [tag, value] :
       {std::pair{slope, "0 "}, {slope, "x "}, {intercept, "-1o24 "}, {intercept, "nan   "}}) {
    std::string wrong = whole;
    const auto at = wrong.find(tag);
    ASSERT_NE(at, std::string::npos);
    wrong.replace(at + 8, std::string(value).size(), value);
    std::ofstream(file, std::ios::binary) << wrong;
    EXPECT_THAT(refused(in("ct")), HasSubstr("IM0004.dcm states a RescaleSlope")) << value;
  }
}

TEST_F(ReadSeries, OutlivesPixelsThatEndGdcm) {
  const Volume made = ten_slices();
  test::DicomTags tags;
  tags.as_jpeg = true;
  test::write_dicom(in("ct"), made, tags);
  expect_same(read_series(in("ct")).volume, made);
  const fs::path file = in("ct") / "IM0004.dcm";
  const std::string whole = read_file(file);
  const auto frame = whole.find("\xff\xd8\xff\xc3");
  ASSERT_NE(frame, std::string::npos);
  int refusals = 0;
  for (std::size_t at = frame + 2; at < frame + 60; ++at) {
    std::string wrong = whole;
    wrong[at] = 'R';
    std::ofstream(file, std::ios::binary) << wrong;
    if (const std::string why = refused(in("ct")); !why.empty()) {
      EXPECT_THAT(why, HasSubstr("IM0004.dcm")) << at;
      ++refusals;
    }
  }
  EXPECT_GT(refusals, 20);
}

TEST_F(ReadSeries, RefusesLongLinesOfAnNrrdHeader) {
  const Volume made = ten_slices();
  test::write_volume(in("ct.nrrd"), made);
  const std::string whole = read_file(in("ct.nrrd"));
  const auto with_line = [&](const std::string& line) {
    std::string out = whole;
    out.insert(out.find('\n') + 1, line + '\n');
    std::ofstream(in("ct.nrrd"), std::ios::binary) << out;
  };
  const std::string much(5000, '3');
  for (const std::string begin :
       {"", "sizes: ", "space units: \"", "encoding: :=", "data file: "}) {
    with_line(begin + much);
    EXPECT_THAT(refused(in("ct.nrrd")), HasSubstr("ct.nrrd:2: ")) << begin;
  }
  for (const std::string begin : {"# ", "a key:=", "a key:=with: "}) {
    with_line(begin + much);
    expect_same(read_series(in("ct.nrrd")).volume, made);
  }
}

TEST_F(ReadSeries, RefusesGridsThatNoScannerGives) {
  test::write_volume(in("ct.nrrd"), ten_slices());
  const std::string whole = read_file(in("ct.nrrd"));
  const auto at = whole.find("space directions: "), end = whole.find('\n', at);
  ASSERT_NE(at, std::string::npos);
  for (const char* sides :
       {"(1e30,0,0) (0,5,0) (0,0,3)", "(4,0,0) (0,1e-9,0) (0,0,3)", "(4,0,0) (0,5,0) (0,5,1e-3)",
        "(4,0,0) (0,5,0) (0,0,600)", "(4,0,0) (0,5,0) (0,0,inf)"}) {
    std::string wrong = whole;
    wrong.replace(at, end - at, "space directions: " + std::string(sides));
    std::ofstream(in("ct.nrrd"), std::ios::binary) << wrong;
    EXPECT_NE(refused(in("ct.nrrd")), "") << sides;
  }
  Volume far = ten_slices();
  far.step_m.col(0) *= 200;
  test::write_dicom(in("ct"), far);
  EXPECT_THAT(refused(in("ct")), HasSubstr("impossible places or pixel sizes"));
}

}  // namespace
}  // namespace hyperex::ct
