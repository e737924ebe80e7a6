// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/csv.hpp"

#include <cmath>
#include <limits>

#include "hyperex/core/files.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;
using Csv = testing::FileTest;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST_F(Csv, RoundTripIsExact) {
  Eigen::MatrixXd rows(3, 2);
  rows << 0, 1.0 / 3, nan, -1e-300, 1e22, 0.1 + 0.2;
  write_csv(path("t.csv"), {"time_s", "S"}, rows);
  const CsvTable table = read_csv(path("t.csv"));
  EXPECT_EQ(table.names, (std::vector<std::string>{"time_s", "S"}));
  ASSERT_EQ(table.values.rows(), 3);
  for (int i = 0; i < 6; ++i) {
    const double written = rows(i / 2, i % 2), read = table.values(i / 2, i % 2);
    EXPECT_TRUE(written == read || (std::isnan(written) && std::isnan(read))) << i;
  }
  write_csv(path("u.csv"), {"row", "square"}, 4, [](long row, std::vector<double>& values) {
    values = {double(row), double(row * row)};
  });
  EXPECT_EQ(read_csv(path("u.csv")).values(3, 1), 9);
}

TEST_F(Csv, FilesThatAreNoTextAreRefusedByWhatTheyAre) {
  const auto refused = [&](const std::string& bytes, const std::string& words) {
    const auto file = write("t.csv", bytes);
    expect_refused(file, words, [&] { read_csv(file); });
  };
  refused("%PDF-1.4\n%\xE2\xE3\n1 0 obj\n", "t.csv: is a PDF, not a table of text");
  refused("PK\x03\x04....",
          "is an archive (ZIP), as spreadsheets are (.xlsx, .ods), not a table of "
          "text: export the table as CSV");
  refused("\xD0\xCF\x11\xE0..", "office program (.xls, .doc)");
  refused("\x89PNG\r\n\x1A\n", "is a picture (PNG)");
  refused("\xFF\xD8\xFF\xE0..", "is a picture (JPEG)");
  refused("\x1F\x8B\x08..", "is a compressed file (gzip), not a table of text: unpack it");
  refused(std::string("\xFF\xFEt\0,\0x\0", 8), "is text in UTF-16");
  refused(std::string("time_s,x\n1,2\0\n", 15), "is a binary file, not a table of text");
  EXPECT_EQ(read_csv(write("t.csv", "\xEF\xBB\xBFtime_s,PK\n1,2\n")).values(0, 1), 2);
}

TEST_F(Csv, TextsStandLastAndBreakNoReader) {
  write_csv_with_text(path("t.csv"), {"a", "b"}, "why", 2,
                      [](long row, std::vector<double>& values) -> std::string {
                        values = {double(row), nan};
                        return row == 0 ? "" : "torn, \"here\"\nand there";
                      });
  EXPECT_EQ(read_file(path("t.csv")), "a,b,why\n0,nan,\n1,nan,torn; 'here' and there\n");
  const CsvTable table = read_csv(
      path("t.csv"), [](const std::string&, std::string_view text) -> std::optional<double> {
        return double(text.size());
      });
  EXPECT_EQ(table.values(1, table.column("why")), 22);
  EXPECT_TRUE(std::isnan(table.values(0, table.column("why"))));
}

TEST_F(Csv, PutsUpWithWhatProgramsWrite) {
  const CsvTable table = read_csv(
      write("t.csv",
            "\xEF\xBB\xBF# a comment\r\n\"time_s\", x0 ,y0\r\n\r\n0, 1.5 ,\r\n# between\r\n"
            "+1,NaN,-2e3"));
  EXPECT_EQ(table.names, (std::vector<std::string>{"time_s", "x0", "y0"}));
  ASSERT_EQ(table.values.rows(), 2);
  EXPECT_EQ(table.values(0, 1), 1.5);
  EXPECT_TRUE(std::isnan(table.values(0, 2)));
  EXPECT_TRUE(std::isnan(table.values(1, 1)));
  EXPECT_EQ(table.values(1, 0), 1);
  EXPECT_EQ(table.values(1, 2), -2000);
  EXPECT_EQ(table.lines, (std::vector<int>{4, 6}));
  EXPECT_EQ(table.find("y0"), 2);
  EXPECT_FALSE(table.find("z0"));
  expect_refused(table.file, "a column \"z0\"", [&] { table.column("z0"); });
  EXPECT_EQ(read_csv(write("s.csv", "a;b\n1;2\n")).values(0, 1), 2);
  EXPECT_EQ(read_csv(write("r.csv", "a,b\n")).values.rows(), 0);
}

TEST_F(Csv, NamesWithCommasAndQuotesComeBackAsTheyWere) {
  const std::vector<std::string> names = {"time_s", "mole, left_x_mm", "the \"scar\"", "a;b"};
  const Eigen::MatrixXd rows = Eigen::MatrixXd::Constant(2, 4, 1.5);
  write_csv(path("q.csv"), names, rows);
  const CsvTable table = read_csv(path("q.csv"));
  EXPECT_EQ(table.names, names);
  EXPECT_EQ(table.values, rows);
}

TEST_F(Csv, QuotesMayStandAroundAnyCell) {
  const CsvTable table = read_csv(write("q.csv", "\"a;1\" ; b;\"c\"\n\"1.5\";2; \"3\"\n"));
  EXPECT_EQ(table.names, (std::vector<std::string>{"a;1", "b", "c"}));
  EXPECT_EQ(table.values.row(0), Eigen::RowVector3d(1.5, 2, 3));
}

TEST_F(Csv, RefusesEachFaultWithOneLine) {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", "is empty"},
      {"# only\n", "is empty"},
      {"1,2,3\n4,5,6\n", ":1: 1,2,3: expected the names of the columns"},
      {"a,b,a\n1,2,3\n", ":1: column 3 = a: expected each name once"},
      {"a,,c\n1,2,3\n", ":1: column 2: expected a name"},
      {"a,b\n1,2\n3\n", ":3: 1 cells: expected 2"},
      {"a,b\n1,2,3\n", ":2: 3 cells: expected 2"},
      {"a;b\n0,5;1\n",
       ":2: column 1 (a) = 0,5: expected a finite number with a point, not a comma"},
      {"a,b\n0,5,1,5\n", ":2: 4 cells: expected 2, as the first line names them; are its decimals"},
      {"a,b\n\n1,two\n", ":3: column 2 (b) = two: expected a finite number"},
      {"a,b\n1,inf\n", ":2: column 2 (b) = inf"},
      {"a,b\n1,1.5mm\n", ":2: column 2 (b) = 1.5mm"},
      {"a,b\033[31m\n1,2\n", ":1: column 2 = b?[31m: expected a name in UTF-8 without control"},
      {"a,K\xe4se\n1,2\n", "expected a name in UTF-8"},
      {"a,b\n\"1,2\n", ":2: column 1 (a) = \"1"},
      {"a;b\n1;2,5\n", ":2: column 2 (b) = 2,5"},
  };
  for (const auto& [text, part] : faults) {
    const auto file = write("bad.csv", text);
    expect_refused(file, part, [&] { read_csv(file); });
  }
}

}  // namespace
}  // namespace hyperex::io
