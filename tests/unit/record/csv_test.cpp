#include "engine/record/format/csv.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "engine/base/error.h"
#include "tests/support/text_of.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;

namespace {

std::string csv_in(const test::Scratch& scratch) {
  std::filesystem::create_directories(scratch.path);
  return scratch.path + "/a.csv";
}

}  // namespace

TEST_CASE("numbers written to a table read back to the same bits", "[record][csv]") {
  const test::Scratch scratch("csv");
  const std::string path = csv_in(scratch);
  const std::vector<double> row{0.1, 1.0 / 3, -2.2250738585072014e-308, 1e300, std::nan("")};
  CsvWriter(path, {"time_s", "a", "b", "c", "d"}).row(row);
  const CsvTable table = read_csv(path);
  REQUIRE(table.rows() == 1);
  for (std::size_t i = 0; i < 4; ++i) CHECK(table.columns[i][0] == row[i]);
  CHECK(std::isnan(table.column("d")[0]));
  CHECK_THROWS_WITH(table.column("time"), Catch::Contains("time_s"));
}

TEST_CASE("a column of words keeps commas and quotes", "[record][csv]") {
  const test::Scratch scratch("words");
  const std::string path = csv_in(scratch);
  CsvWriter writer(path, {"time_s", "name"});
  writer.text_row({"1", "7"});
  writer.text_row({"2", "a, \"b\" | c"});
  writer.flush();
  const CsvTable table = read_csv(path);
  CHECK(table.text[0].empty());
  CHECK(table.text[1] == std::vector<std::string>{"7", "a, \"b\" | c"});
  CHECK(table.column("time_s") == std::vector<double>{1, 2});
}

TEST_CASE("a torn last line is left out, a short row is a mistake with its line", "[record][csv]") {
  const test::Scratch scratch("torn");
  const std::string path = csv_in(scratch);
  std::ofstream(path) << "time_s, a\n0,1\n1,2\n2,";
  CHECK(read_csv(path).column("a") == std::vector<double>{1, 2});
  std::ofstream(path) << "time_s,a\n0,1\n1\n";
  CHECK_THROWS_WITH(read_csv(path), Catch::Contains("a.csv:3"));
}

TEST_CASE("a table of another program keeps a last line without an end, and says so where commas are missing", "[record][csv]") {
  const test::Scratch scratch("measured");
  const std::string path = csv_in(scratch);
  std::ofstream(path) << "time_s,a\n0,1\n1,2\n2,3";
  CHECK(read_measured_csv(path).column("a") == std::vector<double>{1, 2, 3});
  std::ofstream(path) << "time_s,a\r\n0,1\r\n";
  CHECK(read_measured_csv(path).column("a") == std::vector<double>{1});
  std::ofstream(path) << "time_s;a\n0;1,5\n";
  CHECK_THROWS_WITH(read_measured_csv(path), Catch::Contains("semicolons"));
}

TEST_CASE("a resumed table is that of one uninterrupted run", "[record][csv]") {
  const test::Scratch scratch("resume");
  const std::string path = csv_in(scratch);
  {
    CsvWriter whole(path, {"time_s", "a"});
    for (int i = 0; i < 6; ++i) whole.row({0.1 * i, double(i)});
  }
  const std::string expected = test::text_of(path);
  {
    CsvWriter first(path, {"time_s", "a"});
    for (int i = 0; i < 5; ++i) first.row({0.1 * i, double(i)});
  }
  std::ofstream(path, std::ios::app) << "0.5,";  // a torn row
  {
    CsvWriter second(path, {"time_s", "a"}, 3);
    CHECK(second.rows() == 3);
    for (int i = 3; i < 6; ++i) second.row({0.1 * i, double(i)});
  }
  CHECK(test::text_of(path) == expected);
  CHECK_THROWS_WITH(CsvWriter(path, {"time_s", "b"}, 3), Catch::Contains("columns"));
  CHECK_THROWS_WITH(CsvWriter(path, {"time_s", "a"}, 7), Catch::Contains("6 rows"));
}
