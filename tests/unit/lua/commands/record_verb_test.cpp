// The command erbs record FILE: numbers on stdout, figure in a folder.
#include <catch2/catch.hpp>

#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

TEST_CASE("El Centro's numbers are those of the catalogue", "[record][program]") {
  Bench bench;
  const std::string file = test::in_source("/scenes/records/elcentro_1940_ns.csv");
  REQUIRE(bench.erbs({"record", file, "-o", bench.out()}) == 0);
  for (const char* part :
       {"points                 1559", "0.31882 g", "PGV                    0.3609 m/s", "PGD                    0.2120 m",
        "end velocity           6.8e-04 m/s", "end displacement       -5.3 mm", "Arias intensity", "record.svg"}) {
    INFO(part);
    CHECK(contains(bench.said, part));
  }
  CHECK(text_of(bench.out() + "/record.svg").find("</svg>") != std::string::npos);
  const Json numbers = read_json(bench.out() + "/record.json");
  CHECK(numbers["pga_g"].get<double>() == Approx(0.31882));
  CHECK(numbers["end_displacement_m"].get<double>() == Approx(-5.3e-3).margin(5e-5));
  CHECK(bench.erbs({"record", file, "-o", bench.out()}) == 0);  // writing the same again is no loss
}

TEST_CASE("a file that says little asks for what it lacks", "[record][program]") {
  Bench bench;
  bench.write("one.txt", "0.1\n-0.2\n0.3\n0\n");
  bench.write("three.txt", "0 1 2\n0.01 3 4\n0.02 3 1\n");
  const std::string one = (bench.folder / "one.txt").string(), three = (bench.folder / "three.txt").string();
  CHECK(bench.erbs({"record", one, "-o", bench.out()}) == 2);
  CHECK(contains(bench.said, "--dt 0.01"));
  CHECK(bench.erbs({"record", one, "-o", bench.out(), "--dt", "0.01"}) == 2);
  CHECK(contains(bench.said, "--unit g"));
  CHECK(bench.erbs({"record", one, "-o", bench.out(), "--dt", "-1"}) == 2);
  CHECK(bench.erbs({"record", three, "-o", bench.out(), "--unit", "g", "--column", "7"}) == 2);
  CHECK(contains(bench.said, "choose 1 to 3"));
  CHECK_FALSE(fs::exists(bench.out()));
  CHECK(bench.erbs({"record", one, "-o", bench.out(), "--dt", "0.01", "--unit", "g"}) == 0);
  CHECK(contains(bench.said, "0.30000 g"));
  CHECK(bench.erbs({"record", three, "-o", bench.out(), "--unit", "m/s2", "--column", "3"}) == 2);
  CHECK(contains(bench.said, "holds another record"));
  CHECK(bench.erbs({"record", three, "-o", bench.out(), "--unit", "m/s2", "--column", "3", "--force", "-q"}) == 0);
  CHECK(read_json(bench.out() + "/record.json")["pga_m_s2"].get<double>() == 4);
}

TEST_CASE("records of one name from two folders are not drawn over each other", "[record][program]") {
  Bench bench;
  fs::create_directories(bench.folder / "a"), fs::create_directories(bench.folder / "b");
  bench.write("a/x.txt", "0 0.1\n1 -0.2\n"), bench.write("b/x.csv", "0 0.1\n1 -0.3\n");
  CHECK(bench.erbs({"record", (bench.folder / "a/x.txt").string(), (bench.folder / "b/x.csv").string(), "--unit", "g", "--force"}) == 2);
  INFO(bench.said);
  CHECK(contains(bench.said, "b/x.csv would go into the folder of"));
  CHECK(contains(bench.said, "each with its own -o DIR"));
}

TEST_CASE("a folder of something else is left alone", "[record][program]") {
  Bench bench;
  fs::create_directories(bench.out());
  bench.write("out/notes.txt", "mine");
  bench.write("one.txt", "0 0.1\n1 -0.2\n");
  CHECK(bench.erbs({"record", (bench.folder / "one.txt").string(), "--unit", "g", "-o", bench.out(), "--force"}) == 2);
  CHECK(contains(bench.said, "choose another with -o DIR"));
  CHECK(std::distance(fs::directory_iterator(bench.out()), {}) == 1);
}

TEST_CASE("a corrected record is drawn before and after, with the end values of both", "[record][program]") {
  Bench bench;
  const std::string file = test::in_source("/scenes/records/elcentro_1940_ns.csv");
  const auto numbers = [&] { return read_json(bench.out() + "/record.json"); };
  const auto drawn = [&] { return text_of(bench.out() + "/record.svg"); };
  REQUIRE(bench.erbs({"record", file, "-o", bench.out()}) == 0);
  CHECK_FALSE(numbers().contains("before_correction"));
  const Json plain = numbers();
  const std::string alone = drawn();
  for (const std::vector<std::string>& correction :
       {std::vector<std::string>{"--baseline", "quadratic"}, {"--low", "0.1", "--high", "20"}, {"--baseline", "linear", "--low", "0.2"}}) {
    std::vector<std::string> words{"record", file, "-o", bench.out()};
    words.insert(words.end(), correction.begin(), correction.end());
    INFO(fmt::format("{}", fmt::join(correction, " ")));
    REQUIRE(bench.erbs(words) == 0);
    CHECK(contains(bench.said, "before correction"));
    const Json before = numbers()["before_correction"];
    for (const char* key : {"pga_m_s2", "pgv_m_s", "pgd_m", "end_velocity_m_s", "end_displacement_m"}) {
      CHECK(before[key] == plain[key]);
      CHECK(numbers()[key] != plain[key]);
    }
    CHECK(contains(drawn(), "before"));
    CHECK_FALSE(contains(alone, "before"));
    CHECK(2 * drawn().size() > 3 * alone.size());  // two curves of each quantity
  }
  CHECK(bench.erbs({"record", file, "-o", bench.out(), "--baseline", "cubik"}) == 2);
  CHECK(bench.erbs({"record", file, "-o", bench.out(), "--low", "20", "--high", "1"}) == 2);
}
