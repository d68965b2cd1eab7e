// Layouts as their makers describe them, with invented values: ESM (DYNA 1.2), COSMOS 1.20, CSMIP, decimal commas.
#include <catch2/catch.hpp>

#include "engine/base/units.h"
#include "engine/loads/record/record_text.h"
#include "tests/unit/loads/record_input.h"

using namespace erbs;
using Catch::Contains;
using test::mistake_in;
using test::read_text;

namespace {

std::string esm(const std::string& count, const std::string& values, const std::string& step = "0.005000",
                const std::string& unit = "cm/s^2", const std::string& type = "ACCELERATION") {
  return "EVENT_NAME: SOMEWHERE\nEVENT_ID: XX-0001\nEVENT_DATE_YYYYMMDD: 20160824\nNETWORK: XX\nSTATION_CODE: ABC\nSTATION_NAME: \n"
         "VS30_M/S: 670\nDATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20160824_013628.000\nSAMPLING_INTERVAL_S: " +
         step + "\nNDATA: " + count + "\nDURATION_S: 0.020\nSTREAM: HNE\nUNITS: " + unit +
         "\nINSTRUMENT_ANALOG/DIGITAL: D\nPGA_CM/S^2: -3.500000\nDATABASE_VERSION:\nHEADER_FORMAT: DYNA 1.2\nDATA_TYPE: " + type +
         "\nPROCESSING: manual\n" + values;
}

// `reals`: values of the real header from number 1 on; the others are unknown, -999.
std::string cosmos(const std::string& announcement, const std::string& values, double value_34, double value_62) {
  std::string text = "Corrected acceleration  (Format v01.20 with 13 text lines) Src: 00x\n";
  for (int i = 0; i < 12; ++i) text += "Some text of the header\n";
  text += " 100 Integer-header values follow on  10 lines, Format= (10I8)\n";
  for (int i = 0; i < 10; ++i) text += "       1    -999    -999    -999    -999    -999    -999    -999    -999    -999\n";
  text += " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n";
  for (int i = 1; i <= 100; ++i)
    text += fmt::format("{:13.6f}{}", i == 34 ? value_34 : i == 62 ? value_62 : -999.0, i % 6 == 0 || i == 100 ? "\n" : "");
  text += "   1 Comment line(s) follow, each starting with a \"|\":\n|\n" + announcement + "\n" + values;
  return text + "End-of-data for Chan  1 acceleration\n";
}

std::string tone(int n, double step, const char* form = "{:10.5f}") {
  std::string text;
  for (int i = 0; i < n; ++i)
    text += fmt::format(fmt::runtime(form), 100 * std::sin(2 * i * step)) + (i % 8 == 7 || i + 1 == n ? "\n" : "");
  return text;
}

}  // namespace

TEST_CASE("ESM text is read by its keys", "[loads][record]") {
  const Record r = read_text(esm("4", "0.5\n1.0\n-3.5\n2e-1\n"));
  CHECK(r.format == "ESM");
  CHECK(r.points == 4);
  CHECK(r.file_dt == Approx(0.005));
  CHECK(r.file_peak == Approx(0.035));
  CHECK(r.title == "SOMEWHERE, 20160824, XX, ABC, HNE");
  CHECK(read_text(esm("2", "1\n2\n", "0.01", "cm/s^2", "")).points == 2);  // older files do not tell the type
}

TEST_CASE("mistakes in ESM text name line, cause and remedy", "[loads][record]") {
  CHECK_THAT(mistake_in(esm("5", "1\n2\n3\n")), Contains("motion.txt:10") && Contains("NDATA promises 5") && Contains("cut short"));
  CHECK_THAT(mistake_in(esm("2", "1\n2\n3\n")), Contains("longer than it says"));
  CHECK_THAT(mistake_in(esm("3", "1\n2x\n3\n")), Contains("motion.txt:21") && Contains("\"2x\""));
  CHECK_THAT(mistake_in(esm("3", "1\n2\n3\n", "")), Contains("motion.txt:9") && Contains("SAMPLING_INTERVAL_S"));
  CHECK_THAT(mistake_in(esm("3", "1\n2\n3\n", "-0.01")), Contains("\"-0.01\"") && Contains("above 0"));
  CHECK_THAT(mistake_in(esm("three", "1\n2\n3\n")), Contains("\"three\""));
  CHECK_THAT(mistake_in(esm("3", "1\n2\n3\n", "0.01", "furlong")), Contains("motion.txt:13") && Contains("furlong") && Contains("cm/s2"));
  CHECK_THAT(mistake_in(esm("3", "1\n2\n3\n", "0.01", "cm", "DISPLACEMENT")),
             Contains("motion.txt:18") && Contains("displacement") && Contains("smoothing"));
  CHECK_THAT(mistake_in(esm("3", "1\n2\n3\n"), [](Record& r) { r.dt = 0.02; }), Contains("leave dt out"));
}

TEST_CASE("COSMOS V2 takes its step from the real header, in ms or s", "[loads][record]") {
  const std::string line = "    200 acceleration pts, approx    4 secs, units=cm/sec2(04),Format=(8F10.5)";
  for (const auto& [v34, v62] : std::vector<std::pair<double, double>>{{-999, 20}, {0.02, -999}, {0.005, 20}, {20, -999}, {-999, 0.02}}) {
    INFO(v34 << " " << v62);
    const Record r = read_text(cosmos(line, tone(200, 0.02), v34, v62));
    CHECK(r.format == "COSMOS V2");
    CHECK(r.points == 200);
    CHECK(r.file_dt == Approx(0.02));
    CHECK(r.acceleration.values[50] == Approx(std::sin(2.0)).epsilon(1e-5));
  }
  CHECK_THAT(mistake_in(cosmos(line, tone(200, 0.02), -999, -999)), Contains("motion.txt:45") && Contains("--dt"));
  CHECK(read_text(cosmos(line, tone(200, 0.02), -999, -999), [](Record& r) { r.dt = 0.02; }).file_dt == Approx(0.02));
  CHECK_THAT(mistake_in(cosmos(line, tone(199, 0.02), -999, 20)), Contains("motion.txt:45") && Contains("promises 200") && Contains("199"));
  CHECK_THAT(mistake_in(cosmos("200 acceleration pts, approx 4 secs, units=counts(50),Format=(8F10.5)", tone(200, 0.02), -999, 20)),
             Contains("counts"));
}

TEST_CASE("of a file with several quantities the wanted one is read", "[loads][record]") {
  const std::string first = cosmos("   16 acceleration pts, approx 0 secs, units=cm/sec2(04),Format=(8F10.5)", tone(16, 0.02), -999, 20);
  const std::string second = cosmos("   16 displacement pts, approx 0 secs, units=cm(06),Format=(8F10.5)", tone(16, 0.02), -999, 20);
  CHECK(read_text(first + second).acceleration.values[8] == Approx(std::sin(0.32)).epsilon(1e-5));
  const auto displacement = [](Record& r) { r.quantity = "displacement", r.smoothing = 20; };
  CHECK_THAT(read_text(first + second, displacement).note, Contains("displacement differentiated"));
  CHECK_THAT(mistake_in(second), Contains("displacement") && Contains("smoothing"));
}

TEST_CASE("CSMIP V2 says its step beside the count", "[loads][record]") {
  const std::string head =
      "CORRECTED ACCELEROGRAM 24436-S2496\nText\n   24 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.3)\n";
  const Record r = read_text(head + tone(24, 0.02, "{:10.3f}") + "/&  ----------  End of data for channel  1\n");
  CHECK(r.format == "CSMIP V2");
  CHECK(r.points == 24);
  CHECK(r.file_dt == Approx(0.02));
  CHECK(r.acceleration.values[10] == Approx(std::sin(0.4)).epsilon(1e-4));
}

TEST_CASE("a mistake in a file with decimal commas quotes the file", "[loads][record][bad_input]") {
  const auto in_g = [](Record& r) { r.unit = "m/s2"; };
  const auto commas = [](Record& r) { r.unit = "m/s2", r.decimal = "comma"; };
  CHECK_THAT(mistake_in("0,0 1,5\n0,1 1,2x3\n", in_g), Contains("motion.txt:2: column 5: \"1,2x3\" is not a number"));
  CHECK_THAT(mistake_in("0,0; 1,5\n0,1; 1.234,5\n", commas), Contains("motion.txt:2: column 6: \"1.234,5\" is not a number"));
  CHECK_THAT(mistake_in("0,0; 1,5\n0,1; 1,5e999\n", commas), Contains("motion.txt:2: column 6: 1,5e999 is beyond"));
  CHECK_THAT(mistake_in("0.0; 1.5\n0,1; 1.5\n", in_g),
             Contains("3 numbers where the lines before have 2; take out") && Contains("--decimal comma"));
  CHECK_THAT(mistake_in("0.0 1.5\n0.1 1.5 2\n", in_g), Contains("have 2; take out what is too much") && !Contains("comma"));
}

TEST_CASE("decimal commas are told from commas between columns", "[loads][record]") {
  const auto in_g = [](Record& r) { r.unit = "m/s2"; };
  for (const char* text : {"0,00; 1,5\n0,01; -2,5\n", "0,00\t1,5\n0,01\t-2,5\n", "0,00 1,5\n0,01 -2,5\n", "0;1,5\n,01;-2,5\n",
                           "time_s; a\n0,00; 1,5\n0,01; -2,5E+0\n"}) {
    INFO(text);
    const Record r = read_text(text, in_g);
    CHECK(r.acceleration.values == std::vector<double>{1.5, -2.5});
    CHECK(r.file_dt == Approx(0.01));
  }
  CHECK(read_text("0,1\n1,2\n", in_g).acceleration.values == std::vector<double>{1, 2});  // two columns
  CHECK(read_text("0, 1.5\n1, 2.5\n", in_g).acceleration.values == std::vector<double>{1.5, 2.5});
  CHECK(read_text("0; 1.5\n1; 2.5\n", in_g).acceleration.values == std::vector<double>{1.5, 2.5});
  const auto lone = [](Record& r) { r.unit = "g", r.dt = 0.01; };
  CHECK(read_text("0,5\n-0,25\n", lone).acceleration.values[1] == Approx(-0.25 * standard_g));
  const auto said = [](Record& r) { r.unit = "m/s2", r.dt = 0.01, r.decimal = "comma"; };
  CHECK(read_text("3,5\n4\n", said).acceleration.values == std::vector<double>{3.5, 4});
  CHECK_THAT(mistake_in("0; 1,5,2\n1; 2\n", in_g), Contains("motion.txt:2") && Contains("complete the line"));
  const std::string at2 = "PEER\nX\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 4, DT= .0100 SEC\n";
  CHECK(read_text(at2 + " ,1E-01-,2E-01 ,3 ,4\n").acceleration.values[1] == Approx(-0.02 * standard_g));
}

TEST_CASE("a quantity and its unit must agree", "[loads][record]") {
  CHECK_THAT(mistake_in("time_s,u_mm\n0,1\n1,2\n"), Contains("motion.txt:1") && Contains("displacement") && Contains("quantity"));
  CHECK_THAT(mistake_in("0 1\n1 2\n", [](Record& r) { r.unit = "m", r.quantity = "displacement"; }),
             Contains("scene.lua:7") && Contains("smoothing"));
  CHECK_THAT(mistake_in("0 1\n1 2\n", [](Record& r) { r.unit = "g", r.smoothing = 5; }), Contains("scene.lua:7") && Contains("smoothing"));
  CHECK_THAT(mistake_in("A\nB\nDISPLACEMENT TIME SERIES IN UNITS OF CM\nNPTS= 3, DT= .01 SEC\n.1 .2 .3\n"),
             Contains("motion.txt:3") && Contains("displacement"));
}

TEST_CASE("the help on a unit lists all units of an acceleration", "[loads][record]") {
  for (const auto& field : Record::fields())
    if (field.name == "unit") CHECK_THAT(std::string(field.text), Contains(std::string(known_units("acceleration")) + ";"));
}

TEST_CASE("lines may end with CR alone, and a step in ms is no step in s", "[loads][record]") {
  const auto in_g = [](Record& r) { r.unit = "m/s2"; };
  CHECK(read_text("0,1\r1,2\r", in_g).acceleration.values == std::vector<double>{1, 2});
  const std::string head = "PEER\nX\nACCELERATION TIME SERIES IN UNITS OF G\n";
  CHECK_THAT(mistake_in(head + "NPTS= 3, DT= 10 MSEC\n.1 .2 .3\n"), Contains("motion.txt:4") && Contains("in ms") && Contains("in s"));
}
