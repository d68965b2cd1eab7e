// The command erbs plot DIR: pictures of columns, and a cause and a remedy for each mistake.
#include <catch2/catch.hpp>

#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

// A run folder of eleven rows, as far as erbs plot reads it.
std::string run_folder(const Bench& bench, const std::string& name, double factor = 1) {
  fs::create_directories(bench.folder / name);
  std::string histories = "time_s,top_ux_m,top_ax_m_s2,base_fx_N\n", energy = "time_s,kinetic_J,unknown_J\n";
  for (int i = 0; i <= 10; ++i) {
    histories += fmt::format("{},{},{},{}\n", 0.1 * i, factor * 0.01 * i, factor * (i % 3), 1000 * i);
    energy += fmt::format("{},{},{}\n", 0.1 * i, i * i, i == 7 ? "nan" : "1");
  }
  bench.write(name + "/histories.csv", histories);
  bench.write(name + "/energy.csv", energy);
  return (bench.folder / name).string();
}

}  // namespace

TEST_CASE("two runs are drawn over each other, whatever their names", "[plot][program]") {
  Bench bench;
  const std::string plain = run_folder(bench, "first"), odd = run_folder(bench, "Häuschen \"q\" it's $HOME `id` a_b\\n", 2);
  REQUIRE(bench.erbs({"plot", plain, odd, "--y", "top_ux_m,kinetic_J"}) == 0);
  CHECK(contains(bench.said, "4 curves"));
  const std::string svg = text_of(plain + "/plot.svg");
  for (const char* text : {"</svg>", "time [s]", "top ux [mm]", "kinetic [J]", "first: top ux", "it's $HOME `id` a_b\\n: top ux"}) {
    INFO(text);
    CHECK(contains(svg, text));
  }
  REQUIRE(bench.erbs({"plot", odd, "--x", "top_ux_m", "--y", "base", "--png", "-q"}) == 0);
  CHECK(bench.said.empty());
  CHECK(text_of(odd + "/plot.png").substr(1, 3) == "PNG");
  CHECK(std::distance(fs::directory_iterator(odd), {}) == 3);  // no leftovers
}

TEST_CASE("spectra, envelopes and spans are drawn", "[plot][program]") {
  Bench bench;
  const std::string run = run_folder(bench, "first"), picture = (bench.folder / "a picture.svg").string();
  CHECK(bench.erbs({"plot", run, "--y", "top*", "--spectrum", "-o", picture}) == 0);
  CHECK(contains(text_of(picture), "frequency [Hz]"));
  CHECK(bench.erbs({"plot", run, "--y", "top_ax", "--response", "--damping", "0.02", "--force", "-o", picture}) == 0);
  CHECK(contains(text_of(picture), "2 % damping"));
  CHECK(bench.erbs({"plot", run, "--y", "top_ux", "--envelope", "--time", "0.2:0.6", "--force", "-o", picture}) == 0);
  CHECK(contains(text_of(picture), "0.2 s to 0.6 s"));
  CHECK(bench.erbs({"plot", run, "--y", "unknown_J", "--time", "0:0.5", "--force", "-o", picture}) == 0);
  CHECK(bench.erbs({"plot", run, "--list"}) == 0);
  CHECK(contains(bench.said, "base_fx_N"));
  CHECK(contains(bench.said, "m/s²"));
}

TEST_CASE("the capacity of a push is drawn: base shear over displacement", "[plot][program]") {
  Bench bench;
  const std::string run = run_folder(bench, "push"), other = run_folder(bench, "other"), picture = run + "/plot.svg";
  std::string states = "multiplier_g,displacement_m,base_shear_N,base_shear_over_weight\n";
  for (int i = 0; i < 6; ++i) states += fmt::format("{},{},{},{}\n", 0.1 * i, 0.002 * i, 1000 * i, i == 5 ? "nan" : "0.1");
  bench.write("push/curve.csv", states), bench.write("other/curve.csv", states);
  REQUIRE(bench.erbs({"plot", run, other, "--x", "displacement_m", "--y", "base_shear_N"}) == 0);
  CHECK(contains(bench.said, "2 curves"));
  CHECK(contains(text_of(picture), "displacement [mm]"));
  CHECK(contains(text_of(picture), "base shear [kN]"));
  REQUIRE(bench.erbs({"plot", run, "--list"}) == 0);
  CHECK(contains(bench.said, "base_shear_over_weight"));
  CHECK(bench.erbs({"plot", run, "--x", "top_ux_m", "--y", "base_fx_N", "--force"}) == 0);  // of the histories, as before
  CHECK(bench.erbs({"plot", run, "--x", "displacement_m", "--y", "base_shear_N", "--time", "0:1", "--force"}) == 2);
  CHECK(contains(bench.said, "leave out --time"));
}

TEST_CASE("each mistake has its cause and its remedy", "[plot][program]") {
  Bench bench;
  const std::string run = run_folder(bench, "first");
  fs::create_directories(bench.folder / "empty");
  fs::create_directories(bench.folder / "begun");
  bench.write("begun/histories.csv", "time_s,top_ux_m\n");
  const auto refused = [&](std::vector<std::string> words, const char* why) {
    words.insert(words.begin(), "plot");
    INFO(fmt::format("{}", fmt::join(words, " ")));
    CHECK(bench.erbs(words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, why));
  };
  refused({(bench.folder / "absent").string(), "--y", "a"}, "erbs run SCENE.lua");
  refused({(bench.folder / "empty").string(), "--y", "a"}, "neither histories.csv nor energy.csv");
  refused({(bench.folder / "begun").string(), "--y", "top_ux_m"}, "no rows");
  refused({run}, "--list says what they are");
  refused({run, "--y", "top_vx_m"}, "did you mean \"top_ux_m\"");
  refused({run, "--y", "top_ux_m", "--x", "top"}, "name one of them");
  refused({run, "--y", "top_ux_m", "--time", "3:1"}, "try 2:4.5");
  refused({run, "--y", "top_ux_m", "--time", "7:9"}, "choose a longer span");
  refused({run, "--y", "unknown_J"}, "not finite at 0.7 s");
  refused({run, "--y", "base_fx_N", "--response"}, "_m_s2");
  refused({run, "--y", "top_ux_m", "--time", "0:0.3", "--spectrum"}, "eight rows");
  refused({run, "--y", "top_ux_m", "--spectrum", "--envelope"}, "keep one");
  refused({run, "--y", "top_ax", "--damping", "0.1"}, "add --response");
  refused({run, "--y", "top_ax", "--response", "--damping", "2"}, "below 1");
  refused({run, "--y", "top_ux_m", "--spectrum", "--x", "base_fx_N"}, "leave out --x");
  refused({run, "--y", "top_ux_m", "-o", (bench.folder / "a.pdf").string()}, ".svg or .png");
  refused({run, "--y", "top_ux_m", "-o", (bench.folder / "no" / "a.svg").string()}, "does not exist");
  CHECK_FALSE(fs::exists(run + "/plot.svg"));
  bench.write("first/plot.svg", "mine");
  refused({run, "--y", "top_ux_m"}, "--force");
  CHECK(text_of(run + "/plot.svg") == "mine");
  CHECK(bench.erbs({"plot", run, "--y", "top_ux_m", "--force"}) == 0);
}

TEST_CASE("without gnuplot nothing is written", "[plot][program]") {
  Bench bench;
  const std::string run = run_folder(bench, "first");
  const int code =
      wait_for(start({"/usr/bin/env", "PATH=" + bench.folder.string(), test::in_build("/erbs"), "plot", run, "--y", "top_ux_m"},
                     (bench.folder / "log").string()));
  CHECK(code == 2);
  CHECK(contains(text_of(bench.folder / "log"), "gnuplot-nox"));
  CHECK(std::distance(fs::directory_iterator(run), {}) == 2);
}

TEST_CASE("drift over height is drawn from the poses of a run, for a group too", "[plot][drift][program]") {
  Bench bench;
  REQUIRE(bench.run(four_bricks() + "joint{ law = dry{ kn = 1e8, ks = 4e7, mu = .6 } }\nground_motion{ wave = sine{ amplitude = .2 * g, "
                                    "frequency = 2 }, direction = 'y' }\nanalysis{ duration = .2 }",
                    {"--no-figures"}) == 0);
  REQUIRE(bench.erbs({"plot", bench.out(), "--drift", "--levels", "4"}) == 0);
  const std::string svg = text_of(bench.out() + "/plot.svg");
  for (const char* text : {"</svg>", "largest drift [%]", "height above the support [m]", "along y", "all blocks, 4 levels"}) {
    INFO(text);
    CHECK(contains(svg, text));
  }
  CHECK(bench.erbs({"plot", bench.out(), "--drift", "--group", "pier", "--force", "--time", "0:0.1"}) == 0);
  CHECK(contains(text_of(bench.out() + "/plot.svg"), "pier, 4 levels, 0 s to 0.1 s"));
  for (const auto& [words, said] : {std::pair<std::vector<std::string>, std::string>{{"--group", "peer"}, "did you mean \"pier\"?"},
                                    {{"--time", "5:6"}, "no frame lies within the span"},
                                    {{"--y", "top"}, "--drift draws no columns"},
                                    {{"--levels", "1"}, "--levels"}}) {
    std::vector<std::string> all{"plot", bench.out(), "--drift", "--force"};
    all.insert(all.end(), words.begin(), words.end());
    CHECK(bench.erbs(all) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, said));
  }
}

TEST_CASE("a histogram of joint stresses is drawn from the frames of a run", "[plot][histogram][program]") {
  Bench bench;
  const std::string wall =
      "material{ name = 'stone', density = 2000 }\nbox{ name = 'floor', size = {3, 3, .5}, at = {-1, -1, -.5}, fixed = true }\n"
      "column{ blocks = 4, size = {1, 1, .5} }\njoint{ law = dry{ kn = 1e10, mu = .7 } }\n";
  bench.write("kept.lua", wall + "analysis{ duration = .01, frame_dt = .005, frame_stress = true }");
  bench.write("plain.lua", wall + "analysis{ duration = .01 }");
  const std::string kept = bench.folder / "kept", plain = bench.folder / "plain";
  REQUIRE(bench.erbs({"run", bench.folder / "kept.lua", "-o", kept, "-q"}) == 0);
  REQUIRE(bench.erbs({"run", bench.folder / "plain.lua", "-o", plain, "-q"}) == 0);
  REQUIRE(bench.erbs({"plot", kept, "--histogram", "normal_stress"}) == 0);
  CHECK(contains(bench.said, "histogram of 1 run"));
  const std::string svg = text_of(kept + "/plot.svg");
  for (const char* text : {"normal stress, tension positive [kPa]", "area [%]"}) {
    INFO(text);
    CHECK(contains(svg, text));
  }
  CHECK(bench.erbs({"plot", kept, kept, "--histogram", "shear_stress", "--time", "0.005", "--png"}) == 0);
  const auto refused = [&](const std::vector<std::string>& line, const char* why) {
    CHECK(bench.erbs(line) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, why));
  };
  refused({"plot", plain, "--histogram", "normal_stress"}, "frame_stress = true");
  refused({"plot", kept, "--histogram", "stress"}, "normal_stress");
  refused({"plot", kept, "--histogram", "normal_stress", "--drift"}, "exclude each other");
  refused({"plot", kept, "--histogram", "normal_stress", "--force", "--time", "0:1"}, "one time");
  refused({"plot", kept, "--histogram", "normal_stress", "--y", "x"}, "draws no columns");
}

TEST_CASE("a column that a push lacks is met with those of its curve", "[plot][program]") {
  Bench bench;
  const std::string push = run_folder(bench, "push");
  bench.write("push/curve.csv", "multiplier_g,displacement_m,base_shear_N\n0,0,0\n0.1,0.001,100\n0.2,0.003,200\n");
  CHECK(bench.erbs({"plot", push, "--y", "base_shear_N"}) == 2);
  CHECK(contains(bench.said, "base_shear_N is a column of curve.csv"));
  CHECK(contains(bench.said, "multiplier_g, displacement_m, base_shear_N, such as --x displacement_m"));
  CHECK(bench.erbs({"plot", push, "--y", "load"}) == 2);
  CHECK(contains(bench.said, "there is no column \"load\""));
  CHECK(contains(bench.said, "curve.csv: multiplier_g, displacement_m, base_shear_N"));
  CHECK(bench.erbs({"plot", push, "--x", "displacement_m", "--y", "top_ux_m"}) == 2);
  CHECK(contains(bench.said, "over time: time_s, top_ux_m"));
}

TEST_CASE("runs of other heights have their own numbers of levels", "[plot][drift][program]") {
  Bench bench;
  std::vector<std::string> words{"plot", "--drift"};
  for (const int count : {3, 5}) {
    const std::string out = (bench.folder / std::to_string(count)).string();
    bench.write("pier.lua", fmt::format("material{{ name = 'stone', density = 2000 }} ground{{ size = 4 }}\n"
                                        "for i = 1, {} do box{{ size = {{ .1, .1, .1 }}, at = {{ 0, 0, .1*i - .1 }} }} end\n"
                                        "joint{{ law = dry{{ kn = 1*GPa, mu = 0.6 }} }} analysis{{ duration = .05 }}",
                                        count));
    REQUIRE(bench.erbs({"run", (bench.folder / "pier.lua").string(), "-o", out, "-q", "--no-figures"}) == 0);
    words.insert(words.begin() + 1, out);
  }
  REQUIRE(bench.erbs(words) == 0);
  CHECK(contains(text_of(words[1] + "/plot.svg"), "all blocks, 5 / 3 levels"));
}

TEST_CASE("a plot says that a run diverged, that a file was cut off, and labels an axis of long numbers", "[plot][program]") {
  Bench bench;
  const std::string run = run_folder(bench, "first", 1e14), picture = run + "/plot.svg";
  bench.write("first/metrics.json", R"({"status": "diverged"})");
  bench.write("first/energy.csv", "time_s,kinetic_J\n0,0\n0.1,-1e15\n0.2,-1.8047e15\n");
  REQUIRE(bench.erbs({"plot", run, "--y", "kinetic_J"}) == 0);
  CHECK(contains(bench.said, "warning: first diverged"));
  CHECK(contains(bench.said, "energy.csv ends at 0.2 s, histories.csv at 1 s"));
  const std::string svg = text_of(picture);
  CHECK(contains(svg, "first diverged"));
  CHECK(contains(svg, "kinetic [MJ]"));
  // The label of the axis lies in the picture: gnuplot writes it turned, at translate(x,y).
  const std::size_t turned = svg.find("rotate(270)");
  REQUIRE(turned != std::string::npos);
  const std::size_t at = svg.rfind("translate(", turned);
  CHECK(std::stod(svg.substr(at + 10)) > 8);
}
