#include "engine/record/plot/record_plot.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/record/plot/gnuplot.h"
#include "tests/support/folder.h"
#include "tests/support/places.h"
#include "tests/support/text_of.h"

using namespace erbs;
namespace fs = std::filesystem;

namespace {

Record el_centro() {
  Record record;
  record.file = test::in_source("/scenes/records/elcentro_1940_ns.csv");
  return read_record(record);
}

}  // namespace

TEST_CASE("a record is drawn whole, with its numbers in words", "[record]") {
  const test::Folder own;
  const fs::path folder = own.path / "erbs record's plot";  // a name that needs quoting
  fs::create_directories(folder);
  const Record record = el_centro();
  write_record_plot(record, report(record), (folder / "record.svg").string());
  const std::string svg = test::text_of(folder / "record.svg");
  CHECK(svg.find("</svg>") != std::string::npos);
  for (const char* text :
       {"elcentro_1940_ns.csv", "0.3188 g at 2.04 s", "0.3609 m/s at 1.58 s", "0.2120 m at 2.62 s", "0.945 g at 0.19 s"}) {
    INFO(text);
    CHECK(svg.find(text) != std::string::npos);
  }
  CHECK(std::distance(fs::directory_iterator(folder), {}) == 1);  // no leftovers
}

TEST_CASE("a picture that cannot be drawn leaves nothing behind", "[record]") {
  const test::Folder own;
  const fs::path& folder = own.path;
  CHECK_THROWS_WITH(run_gnuplot("set terminal svg\nplot nonsense(\n", (folder / "a.svg").string()), Catch::Contains("gnuplot ended"));
  CHECK(fs::is_empty(folder));
  CHECK_THROWS_WITH(run_gnuplot("", (folder / "absent" / "a.svg").string()), Catch::Contains("folder"));
}

TEST_CASE("text for gnuplot cannot leave its quotes", "[record]") {
  CHECK(gnuplot_quoted("it's") == "'it''s'");
  CHECK(gnuplot_quoted("a\nsystem 'rm'") == "'a system ''rm'''");
  CHECK(gnuplot_quoted("Häuschen <b> ]]>") == "'Häuschen <b> ]] >'");
}
