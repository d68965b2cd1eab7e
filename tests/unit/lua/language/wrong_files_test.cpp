// Records and meshes damaged at random places: the message always names the scene's line, the file and a remedy.
#include <catch2/catch.hpp>

#include <random>

#include "engine/base/text.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

using Lines = std::vector<std::string>;

struct Draw {
  std::mt19937 from;
  std::size_t below(std::size_t n) { return from() % n; }
  template <class T>
  const T& one(const std::vector<T>& list) {
    return list[below(list.size())];
  }
};

const Lines junk{"x",        "nan",
                 "inf",      "1e400",
                 "1e300",    "0x",
                 "--1",      "1..2",
                 "\x1b[31m", std::string("1\0 2", 4),
                 "\xff\xfe", "'",
                 "$(id)",    "]]>",
                 "=1+1",     std::string(5000, '9')};

Lines csv() {
  Lines lines{"time_s,a_m_s2"};
  for (int i = 0; i < 40; ++i) lines.push_back(fmt::format("{:.2f},{:.3f}", 0.02 * i, 0.1 * (i % 7)));
  return lines;
}

Lines at2() {
  Lines lines{"PEER NGA", "A quake", "ACCELERATION IN UNITS OF G", "NPTS= 40, DT= .01 SEC"};
  for (int i = 0; i < 8; ++i) lines.emplace_back(" .1E-01 .2E-01 -.1E-01 .3E-02 .0E+00");
  return lines;
}

Lines cube() {
  return {"o cube",  "v 5 5 5",   "v 6 5 5",   "v 6 6 5",   "v 5 6 5",   "v 5 5 7",   "v 6 5 7",  "v 5 6 7",
          "v 6 6 7", "f 4 3 2 1", "f 5 6 8 7", "f 2 3 8 6", "f 3 4 7 8", "f 4 1 5 7", "f 1 2 6 5"};
}

// Each function damages any file of its kind, for every draw.
std::string wrong_csv(Draw& draw) {
  Lines lines = csv();
  std::string& line = lines[2 + draw.below(lines.size() - 2)];
  const std::size_t comma = line.find(',');
  switch (draw.below(6)) {
    case 0:
      line = line.substr(0, comma + 1) + draw.one(junk);
      break;
    case 1:
      line = draw.one(junk) + line.substr(comma);
      break;
    case 2:
      line = line.substr(0, comma);
      break;
    case 3:
      line = "0.00" + line.substr(comma);
      break;  // time decreases
    case 4:
      line = "-1e9" + line.substr(comma);
      break;
    default:
      line = line.substr(0, comma + 1);
      break;
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

std::string wrong_at2(Draw& draw) {
  Lines lines = at2();
  const std::size_t at = 4 + draw.below(8);
  switch (draw.below(5)) {
    case 0:
      lines[at] += " " + draw.one(junk);
      break;
    case 1:
      lines.erase(lines.begin() + std::ptrdiff_t(at));
      break;
    case 2:
      lines[3] = "NPTS= " + draw.one(junk) + ", DT= .01 SEC";
      break;
    case 3:
      lines[3] = "NPTS= 40, DT= " + draw.one(Lines{"0", "-1", "nan", "1e30", "x"}) + " SEC";
      break;
    default:
      lines[3] = draw.one(Lines{"", "NPTS 40", "DT= .01", "NPTS= 99999999999999999999, DT= .01 SEC"});
      break;
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

std::string wrong_obj(Draw& draw) {
  Lines lines = cube();
  const std::size_t corner = 1 + draw.below(8), side = 9 + draw.below(6);
  switch (draw.below(5)) {
    case 0:
      lines.erase(lines.begin() + std::ptrdiff_t(side));
      break;  // a hole
    case 1:
      lines[side] = "f 1 2 99";
      break;  // no such corner
    case 2:
      lines[corner] = "v 5.4 5.4 6";
      break;  // a dent
    case 3:
      lines[corner] = "v " + draw.one(Lines{"nan 5 5", "inf 5 5", "1e300 5 5"});
      break;
    default:
      lines.resize(1 + draw.below(12));
      break;  // cut short
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

std::string bytes(Draw& draw) {
  std::string text(1 + draw.below(3000), ' ');
  for (char& c : text) c = static_cast<char>(draw.below(256));
  return "\x01" + text;
}

}  // namespace

TEST_CASE("a record or a mesh with one thing wrong in it is refused at the scene's line, and said why", "[wrong]") {
  const Bench bench;
  const std::string record = "ground_motion{ wave = record{ file = '@', unit = 'g', dt = .01 }, direction = 'x' }",
                    mesh = "mesh{ file = '@', free = true }";
  const struct {
    std::string name, sentence;
    std::string (*make)(Draw&);
  } kinds[] = {{"wrong.csv", record, wrong_csv}, {"wrong.at2", record, wrong_at2}, {"wrong.obj", mesh, wrong_obj},
               {"bytes.csv", record, bytes},     {"bytes.at2", record, bytes},     {"bytes.obj", mesh, bytes},
               {"bytes.stl", mesh, bytes},       {"bytes.ply", mesh, bytes},       {"bytes.glb", mesh, bytes}};
  for (const auto& [name, sentence, make] : kinds)
    for (unsigned seed = 1; seed <= 60; ++seed) {
      Draw draw{std::mt19937(seed)};
      const std::string text = make(draw);
      bench.write(name, text);
      std::string piece = sentence;
      piece.replace(piece.find('@'), 1, name);
      Script script(quiet());
      std::vector<std::string> mistakes;
      try {
        script.load_text(sound + "\n" + piece, (bench.folder / "scene.lua").string());
      } catch (const Errors& errors) { mistakes = errors.messages; }
      INFO(name << ", seed " << seed << ":\n" << printable(text).substr(0, 1500) << "\n" << fmt::format("{}", fmt::join(mistakes, "\n")));
      REQUIRE(mistakes.size() == 1);
      CHECK(contains(mistakes[0], "/scene.lua:6: "));
      CHECK(contains(mistakes[0], name));
      CHECK(mistakes[0].size() < 1000);
      CHECK(is_plain(mistakes[0]));
      CHECK((contains(mistakes[0], ";") || contains(mistakes[0], "promises")));  // the remedy follows
    }
}

TEST_CASE("a record with a hole is warned of, one of even steps or few points is not", "[bad_input]") {
  const auto rows = [](double from, double to) {
    std::string text;
    for (double t = from; t < to; t += 0.01) text += fmt::format("{:.2f}, {:.3f}\n", t, std::sin(20 * t));
    return text;
  };
  const std::pair<std::string, bool> list[] = {
      {rows(0, 1) + rows(1.6, 2), true}, {rows(0, 2), false}, {rows(.3, 2), false}, {"0, 0\n1, 1\n2, 0\n", false}};
  for (const auto& [text, warned] : list) {
    Bench bench;
    bench.write("own.csv", text);
    CHECK(bench.erbs({"check", bench.scene(pier + "ground_motion{ wave = record{ file = 'own.csv', unit = 'm/s2' }, direction = 'x' }")}) ==
          0);
    INFO(bench.said);
    CHECK(contains(bench.said, "its record has no value between 0.99 and 1.6 s, 61 of its usual steps") == warned);
  }
}
