// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/text_table.hpp"

#include "hyperex/core/files.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;
using Texts = testing::FileTest;
using Rows = std::vector<std::vector<std::string>>;

TEST_F(Texts, ComeBackAsTheyWere) {
  const Rows rows = {{"1e3", ""}, {"a, \"b\"; c", "[\"x\"]"}, {"007", "true"}};
  write_text_table(path("t.csv"), {"first", "second, of two"}, rows);
  const TextTable table = read_text_table(path("t.csv"));
  EXPECT_EQ(table.names, (std::vector<std::string>{"first", "second, of two"}));
  EXPECT_EQ(table.rows, rows);
  EXPECT_EQ(table.lines, (std::vector<int>{2, 3, 4}));
  write_text_table(path("t.csv"), {"a"}, {{"two\nlines"}});
  EXPECT_EQ(read_file(path("t.csv")), "a\ntwo lines\n");
}

TEST_F(Texts, MayBeWrittenByASpreadsheet) {
  write("t.csv",
        "\xEF\xBB\xBF"
        "case;key\r\n# a remark\r\n\r\n one ; 3,5 \r\n");
  const TextTable table = read_text_table(path("t.csv"));
  EXPECT_EQ(table.names, (std::vector<std::string>{"case", "key"}));
  EXPECT_EQ(table.rows, (Rows{{"one", "3,5"}}));
  EXPECT_EQ(table.lines, (std::vector<int>{4}));
}

TEST_F(Texts, TornTablesAreRefused) {
  for (const char* torn : {"", "a,a\n1,2\n", "a,b\n1\n", "1,2\n3,4\n", "a,\n1,2\n"}) {
    write("t.csv", torn);
    EXPECT_THROW(read_text_table(path("t.csv")), InputError) << torn;
  }
}

}  // namespace
}  // namespace hyperex::io
