#include "common/io/csv.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::csv_test {
namespace {

using test::file_bytes;
using test::TemporaryFolder;

TEST(Csv, WritesHeaderUnitsAndCells) {
  const TemporaryFolder folder;
  CsvTable table;
  table.comments = {"two\nlines"};
  table.columns = {{"engine", ""}, {"time", "s"}, {"steps", ""}, {"kappa", ""}};
  table.rows = {{std::string("md"), 0.1, std::int64_t{12}, 1e4},
                {std::string("a \"b\", c"), -0.0, std::int64_t{-3}, std::monostate{}}};
  write_csv(folder.file("a.csv"), table);
  EXPECT_EQ(file_bytes(folder.file("a.csv")),
            "# two\n# lines\nengine,time [s],steps,kappa\nmd,0.1,12,10000\n\"a \"\"b\"\", c\",-0,-3,\n");
  EXPECT_EQ(folder.entries(), 1);
  table.rows.push_back({1.0});
  EXPECT_THROW(write_csv(folder.file("b.csv"), table), std::invalid_argument);
  EXPECT_THROW(write_csv(folder.file("no/b.csv"), CsvTable{}), RunError);
}

// Random bit patterns cover every exponent; the sign of zero, infinities and NaN are added.
TEST(Csv, NumbersComeBackWithTheirBits) {
  const TemporaryFolder folder;
  CsvTable table;
  table.columns = {{"x", "m"}, {"y", ""}};
  RandomStream random(1, 2);
  const auto any_bits = [&] {
    const auto half = [&] { return static_cast<std::uint64_t>(random.uniform() * 0x1p32); };
    const double value = std::bit_cast<double>((half() << 32) | half());
    return std::isfinite(value) ? value : 0.0;
  };
  for (int k = 0; k < 5000; ++k) table.rows.push_back({any_bits(), any_bits()});
  table.rows.push_back({-0.0, std::numeric_limits<double>::denorm_min()});
  table.rows.push_back({std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
  write_csv(folder.file("a.csv"), table);
  const NumberTable back = read_csv(folder.file("a.csv"));
  ASSERT_EQ(back.rows(), 5002);
  EXPECT_EQ(back.columns, table.columns);
  for (int row = 0; row < back.rows(); ++row)
    for (int k = 0; k < 2; ++k)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(back.at(row, k)),
                std::bit_cast<std::uint64_t>(std::get<double>(table.rows[row][k])))
          << row;
  EXPECT_TRUE(std::isnan(parse_csv("a\nnan\n", "n").at(0, 0)));
}

TEST(Csv, ReadsWhatPeopleAndSpreadsheetsWrite) {
  const NumberTable table =
      parse_csv("#  first \r\n\r\n time [s] , \"a, b\" ,+z\r\n 1 ,\t2e-3, +3\r\n# between\n\"4\",5,6", "n");
  EXPECT_EQ(table.comments, (std::vector<std::string>{"first", "between"}));
  EXPECT_EQ(table.columns, (std::vector<CsvColumn>{{"time", "s"}, {"a, b", ""}, {"+z", ""}}));
  ASSERT_EQ(table.rows(), 2);
  EXPECT_EQ(table.at(0, 0), 1);
  EXPECT_EQ(table.at(0, 1), 2e-3);
  EXPECT_EQ(table.at(0, 2), 3);
  EXPECT_EQ(table.at(1, 0), 4);
  EXPECT_EQ(table.find("time"), 0);
  EXPECT_FALSE(table.find("absent"));
  EXPECT_EQ(to_string(table.mistake(1, 2, "bad")), "n:6:7: error: bad");
  EXPECT_EQ(to_string(table.mistake(1, "bad")), "n:3:13: error: bad");
}

std::string refusal(const std::string& text) {
  try {
    parse_csv(text, "f.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Csv, MistakesHaveTheirPlace) {
  EXPECT_EQ(refusal("x,y\n1,2\n3, 4b\n"), "f.csv:3:4: error: expected a number, found '4b'");
  EXPECT_EQ(refusal("x,y\n1,\n"), "f.csv:2:3: error: expected a number, found ''");
  EXPECT_EQ(refusal("x,y\n1 2,3\n"), "f.csv:2:1: error: expected a number, found '1 2'");
  EXPECT_EQ(refusal("x,y\n1,2,3\n"), "f.csv:2:1: error: expected 2 cells as in the header, found 3");
  EXPECT_EQ(refusal("x,y,x\n"), "f.csv:1:5: error: the column 'x' appears twice");
  EXPECT_EQ(refusal("x,,y\n"), "f.csv:1:3: error: a column without a name");
  EXPECT_EQ(refusal("1,2\n3,4\n"),
            "f.csv:1:1: error: expected the name of a column, found the number 1\n"
            "f.csv:1:3: error: expected the name of a column, found the number 2");
  EXPECT_EQ(refusal("# only a comment\n"), "f.csv: error: the file has no header line");
  EXPECT_EQ(refusal("x,y\na,b\nc,1\n"),
            "f.csv:2:1: error: expected a number, found 'a'\nf.csv:2:3: error: expected a number, found 'b'\n"
            "f.csv:3:1: error: expected a number, found 'c'");
  EXPECT_EQ(refusal("x\n1e999\n"), "f.csv:2:1: error: expected a number, found '1e999'");
  EXPECT_THROW(read_csv("/nonexistent/a.csv"), InputError);
}

TEST(Csv, EmptyCellsOfOwnTables) {
  const NumberTable table = parse_csv("a,b\n1,\n,2\n", "t.csv", EmptyCells::not_a_number);
  ASSERT_EQ(table.rows(), 2);
  EXPECT_TRUE(std::isnan(table.at(0, 1)) && std::isnan(table.at(1, 0)));
  EXPECT_EQ(table.at(1, 1), 2);
  EXPECT_THROW(parse_csv("a,b\n1,\n", "t.csv"), InputError);
  EXPECT_THROW(parse_csv("a,b\n1,x\n", "t.csv", EmptyCells::not_a_number), InputError);
}

}  // namespace
}  // namespace galet::test::csv_test
