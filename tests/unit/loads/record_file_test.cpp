#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/loads/record/record.h"
#include "tests/support/folder.h"
#include "tests/support/places.h"

using namespace erbs;
namespace fs = std::filesystem;

namespace {

struct Input {
  test::Folder folder;
  std::string path;
  explicit Input(const std::string& text, const std::string& name = "motion.txt") : path(folder.file(name)) {
    std::ofstream(path, std::ios::binary) << text;
  }
};

Record read(const std::string& text, const std::string& unit = "", double dt = 0, int column = 0) {
  const Input input(text);
  Record wanted;
  wanted.file = input.path;
  wanted.unit = unit;
  wanted.dt = dt;
  wanted.column = column;
  return read_record(wanted);
}

std::string mistake(const std::string& text, const std::string& unit = "", double dt = 0, int column = 0) {
  try {
    read(text, unit, dt, column);
  } catch (const Error& error) { return error.what(); }
  return "no mistake found";
}

std::string at2(const std::string& counts, const std::string& values) {
  return "PEER STRONG MOTION DATABASE RECORD\nSomewhere, 1/2/1999, Station, 90\nACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: "
         "HP=0.1 Hz\n" +
         counts + "\n" + values;
}

}  // namespace

TEST_CASE("PEER AT2 is read in all its forms", "[loads][record]") {
  const std::string values = "   .1000000E-01  -.2000000E-01\n   .3E-01\n";
  for (const char* counts : {"NPTS=     3, DT=   .0050 SEC,      ", "NPTS=  3, DT= .00500 SEC", "3 0.0050 NPTS, DT",
                             "    3    0.0050    NPTS, DT\r", "npts=3,dt=.005", "DT= .005 SEC, NPTS= 3"}) {
    INFO(counts);
    const Record record = read(at2(counts, values));
    CHECK(record.points == 3);
    CHECK(record.file_dt == Approx(0.005));
    CHECK(record.acceleration.values == std::vector<double>{0.01 * standard_g, -0.02 * standard_g, 0.03 * standard_g});
    CHECK(record.acceleration.times.front() == 0);
    CHECK(record.title == "Somewhere, 1/2/1999, Station, 90");
    CHECK(record.format == "PEER AT2");
  }
}

TEST_CASE("columns that touch are parted", "[loads][record]") {
  const auto values = [](const std::string& line, int count) {
    std::vector<double> g = read(at2(fmt::format("NPTS= {}, DT= .01 SEC", count), line)).acceleration.values;
    for (double& v : g) v /= standard_g;
    return g;
  };
  const auto check = [&](const std::string& line, std::vector<double> expected) {
    INFO(line);
    const std::vector<double> got = values(line, static_cast<int>(expected.size()));
    REQUIRE(got.size() == expected.size());
    for (size_t i = 0; i < got.size(); ++i) CHECK(got[i] == Approx(expected[i]).epsilon(1e-14));
  };
  check("-.1E-02-.2E-02", {-0.001, -0.002});
  check("-.1E-02-.2E-02 .3e-2+.4D-02", {-0.001, -0.002, 0.003, 0.004});
  check("0.1E-010.2E-01", {0.01, 0.02});
  check("1.5E-003 2.5E+000", {0.0015, 2.5});
  check("0.25-0.5-.75", {0.25, -0.5, -0.75});
}

TEST_CASE("a PEER file whose count is wrong is refused", "[loads][record]") {
  CHECK_THAT(mistake(at2("NPTS= 4, DT= .01 SEC", ".1 .2 .3\n")), Catch::Contains("motion.txt:4") && Catch::Contains("promises 4") &&
                                                                     Catch::Contains("holds 3") && Catch::Contains("cut short"));
  CHECK_THAT(mistake(at2("NPTS= 2, DT= .01 SEC", ".1 .2 .3\n")), Catch::Contains("longer than it says"));
  CHECK_THAT(mistake(at2("NPTS= 2.5, DT= .01 SEC", ".1 .2\n")), Catch::Contains("NPTS = 2.5"));
  CHECK_THAT(mistake(at2("NPTS= 3, DT= .00 SEC", ".1 .2 .3\n")), Catch::Contains("DT = 0"));
  CHECK_THAT(mistake(at2("NPTS= many", ".1 .2 .3\n")), Catch::Contains("motion.txt:4"));
  CHECK_THAT(mistake("A\nB\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 3, DT= .01 SEC\n.1 .2 .3\n"), Catch::Contains("velocity"));
  CHECK_THAT(mistake("A\nB\nACCELERATION TIME SERIES IN UNITS OF FURLONG\nNPTS= 3, DT= .01 SEC\n.1 .2 .3\n"),
             Catch::Contains("motion.txt:3") && Catch::Contains("furlong"));
}

TEST_CASE("one column needs a step and a unit", "[loads][record]") {
  const Record record = read("# a comment\n1.0\n-2\n\n3e0\n", "m/s2", 0.1);
  CHECK(record.acceleration.values == std::vector<double>{1, -2, 3});
  CHECK(record.acceleration.times.back() == Approx(0.2));
  CHECK(record.title == "a comment");
  CHECK_THAT(mistake("1\n2\n", "g"), Catch::Contains("dt = 0.01"));
  CHECK_THAT(mistake("1\n2\n", "", 0.1), Catch::Contains("unit = "));
  CHECK_THAT(mistake("1\n2\n", "stone", 0.1), Catch::Contains("stone"));
  CHECK(read("1 2 3 4\n5 6\n", "m/s2", 0.5).points == 6);  // values along the lines, the last line shorter
}

TEST_CASE("two columns are time and value", "[loads][record]") {
  const Record even = read("0 1\n0.5 2\n1.0 -3\n", "m/s2");
  CHECK(even.file_dt == Approx(0.5));
  const Record uneven = read("0, 1\r\n0.5; 2\r\n2.0\t-3\r\n", "gal");
  CHECK(uneven.file_dt == 0);
  CHECK(uneven.acceleration.values.back() == Approx(-0.03));
  CHECK(read("0 1 7\n1 2 8\n", "m/s2", 0, 3).acceleration.values == std::vector<double>{7, 8});
  CHECK_THAT(mistake("0 1\n1 2\n1 3\n", "g"), Catch::Contains("motion.txt:3") && Catch::Contains("increase"));
  CHECK_THAT(mistake("-1 1\n1 2\n", "g"), Catch::Contains("negative"));
  CHECK_THAT(mistake("0 1\n1 2\n", "g", 0.1), Catch::Contains("leave dt out"));
  CHECK_THAT(mistake("0 1\n1\n", "g"), Catch::Contains("motion.txt:2"));
  CHECK_THAT(mistake("0 1\n1 2\n", "g", 0, 1), Catch::Contains("times"));
  CHECK_THAT(mistake("0 1\n1 2\n", "g", 0, 9), Catch::Contains("1 to 2"));
}

TEST_CASE("rest comes before a first value that is not at zero", "[loads][record]") {
  const Record near = read("0.02 5\n0.04 6\n", "m/s2"), far = read("5.0 5\n5.1 6\n", "m/s2");
  CHECK(near.acceleration.times[0] == Approx(0).margin(1e-17));
  CHECK(near.acceleration.values[0] == 0);
  CHECK(near.points == 2);
  CHECK(far.acceleration.times[0] == Approx(4.9));  // not a ramp over five seconds
  CHECK(read("0 5\n0.04 6\n", "m/s2").acceleration.values[0] == 5);
}

TEST_CASE("CSV columns say their units", "[loads][record]") {
  const double cm = 0.01;
  for (const auto& [head, factor] : std::vector<std::pair<std::string, double>>{{"time_s,acceleration_g", standard_g},
                                                                                {"time_s,acceleration_m_s2", 1},
                                                                                {"time_s,acceleration_cm_s2", cm},
                                                                                {"Time [s],Acc [cm/s^2]", cm},
                                                                                {"t,a (m/s/s)", 1},
                                                                                {"\"time (sec)\";\"accel (gal)\"", cm},
                                                                                {"\xEF\xBB\xBFtime_s,a_cm/sec2", cm},
                                                                                {"Zeit [s];a [m/s2]", 1},
                                                                                {"Tempo (s);acc (cm/s2)", cm},
                                                                                {"t_record_s,a_g", standard_g}}) {
    INFO(head);
    const std::string comma = head.find(';') != std::string::npos ? ";" : ",";
    const Record record = read(head + "\n0" + comma + "1\n1" + comma + "2\n");
    CHECK(record.acceleration.values == std::vector<double>{factor, 2 * factor});
  }
  CHECK(read("acceleration_g,time_ms\n1,0\n2,500\n").acceleration.times.back() == Approx(0.5));
  CHECK(read("a [g];Zeit [ms]\n1;0\n2;500\n").acceleration.times.back() == Approx(0.5));
  CHECK_THAT(mistake("Zeit [h];a [g]\n0;1\n1;2\n"),
             Catch::Contains("motion.txt:1") && Catch::Contains("Zeit") && Catch::Contains("time_s"));
  CHECK_THAT(mistake("time_s,acceleration\n0,1\n1,2\n"), Catch::Contains("unit = "));
  CHECK_THAT(mistake("time_s,a (furlong)\n0,1\n1,2\n"), Catch::Contains("motion.txt:1") && Catch::Contains("furlong"));
  CHECK_THAT(mistake("time_h,a (g)\n0,1\n1,2\n"), Catch::Contains("time_h") && Catch::Contains("time_s"));
  CHECK_THAT(mistake("time_s,a_g\n0,1\n1,2\n", "m/s2"), Catch::Contains("leave unit out"));
}

TEST_CASE("what is no record is refused with its place", "[loads][record]") {
  CHECK_THAT(mistake(""), Catch::Contains("empty"));
  CHECK_THAT(mistake(" \n\t\n"), Catch::Contains("empty"));
  CHECK_THAT(mistake("# only a comment\n", "g", 0.1), Catch::Contains("no numbers"));
  CHECK_THAT(mistake("time_s,a_g\n0,1\n1,2x\n2,3\n"),
             Catch::Contains("motion.txt:3") && Catch::Contains("column 3") && Catch::Contains("\"2x\""));
  CHECK_THAT(mistake("0 1\n0.1 O.5\n", "g"), Catch::Contains("motion.txt:2") && Catch::Contains("column 5"));
  CHECK_THAT(mistake("0 1\n0.1 nan\n", "g"), Catch::Contains("motion.txt:2") && Catch::Contains("\"nan\""));
  CHECK_THAT(mistake("0 1\n0.1 inf\n", "g"), Catch::Contains("\"inf\""));
  CHECK_THAT(mistake("0 1\n0.1 1e999\n", "g"), Catch::Contains("motion.txt:2") && Catch::Contains("beyond"));
  CHECK_THAT(mistake("0 1\n0.1 --5\n", "g"), Catch::Contains("\"--5\""));
  CHECK_THAT(mistake("0 1\n0.1 1.2.3\n", "g"), Catch::Contains("motion.txt:2"));
  CHECK_THAT(mistake(at2("NPTS= 3, DT= .01 SEC", ".1 .2\n.3A\n")), Catch::Contains("motion.txt:6") && Catch::Contains("column 1"));
  CHECK_THAT(mistake("1\n", "g", 0.1), Catch::Contains("at least two"));
  Record missing;
  missing.file = "/nowhere/motion.at2";
  CHECK_THROWS_WITH(read_record(missing), Catch::Contains("/nowhere/motion.at2") && Catch::Contains("no such record"));
  Record folder;
  folder.file = fs::temp_directory_path().string();
  CHECK_THROWS_WITH(read_record(folder), Catch::Contains("folder"));
  Record zero;
  const Input input("0 0\n1 0\n");
  zero.file = input.path;
  zero.unit = "g";
  CHECK(read_record(zero).file_peak == 0);
  zero.peak = 1;
  CHECK_THROWS_WITH(read_record(zero), Catch::Contains("cannot be scaled"));
}

TEST_CASE("the hash tells files apart", "[loads][record]") {
  CHECK(read("0 1\n1 2\n", "g").hash == read("0 1\n1 2\n", "g").hash);
  CHECK(read("0 1\n1 2\n", "g").hash != read("0 1\n1 3\n", "g").hash);
}

TEST_CASE("records of PEER are read as their makers wrote them", "[loads][record]") {
  const fs::path folder = test::in_source("/../shared/data/records/peer");
  if (!fs::is_directory(folder)) {
    WARN("skipped: no PEER records beside the project");
    return;
  }
  int files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".AT2") continue;
    INFO(entry.path().filename().string());
    Record record;
    record.file = entry.path().string();
    record = read_record(record);
    ++files;
    CHECK(record.points >= 1000);
    CHECK(record.file_dt > 0.004);
    CHECK(record.file_peak > 0.02 * standard_g);
    CHECK(record.file_peak < 1.3 * standard_g);
    CHECK(std::abs(record.acceleration.area.back()) < 1e-4);  // m/s: PEER corrects the baseline
  }
  CHECK(files == 12);
  Record pacoima;
  pacoima.file = (folder / "RSN77_SFERN_PUL164-hor1.AT2").string();
  pacoima = read_record(pacoima);
  CHECK(pacoima.points == 4172);
  CHECK(pacoima.file_peak / standard_g == Approx(1.219).epsilon(1e-3));
}
