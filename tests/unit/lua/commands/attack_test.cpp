// Attacks through a scene, a file or a command line. None may reach a shell, a terminal, other files, or the machine's memory.
#include <catch2/catch.hpp>

#include "engine/base/text.h"
#include "engine/record/format/json.h"
#include "lua/language/api.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
using namespace std::string_literals;
namespace fs = std::filesystem;

namespace {

// Six lines, so that a test's own line is line 7.
const std::string dry_pier = four_bricks() + R"(joint{ law = dry{ kn = 1*GPa, mu = .6 } }
analysis{ duration = param("duration", 0.01, "[s]") }

)";

// A string as a script writes it, byte by byte.
std::string in_lua(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return out + "\"";
}

const std::vector<std::string> controls{"a\nsystem('touch pwned')\n#", "a\x1b[31m", "a\0b"s, "a\xff\xfe", "a\rb", "a\xe2\x80\xae"};
const std::vector<std::string> signs{
    "it's \"so\"", "system('touch pwned')", "`touch pwned`", "$(touch pwned)", "<b>&amp;", "]]>", "<touch pwned", "%s%n", "a\\",
    "Häuschen"};

bool is_text(const Key& key) { return key.type == "string" || key.type == "strings" || key.type == "quantity"; }

// Every statement that passes `text` to a string argument of the language.
std::vector<std::string> sentences(const std::string& text) {
  std::vector<std::string> all;
  for (const Function& function : api()) {
    if (takes_table(function)) {
      for (const Key& key : function.keys) {
        if (is_text(key)) all.push_back(fmt::format("{}{{ {} = {} }}", function.name, key.name, in_lua(text)));
        for (const Key& inner : key.inner)
          if (is_text(inner))
            all.push_back(fmt::format(fmt::runtime(key.type == "table" ? "{}{{ {} = {{ {} = {} }} }}" : "{}{{ {} = {{ {{ {} = {} }} }} }}"),
                                      function.name, key.name, inner.name, in_lua(text)));
      }
      continue;
    }
    for (std::size_t i = 0; i < function.keys.size(); ++i) {
      if (!is_text(function.keys[i])) continue;
      std::vector<std::string> words;
      for (std::size_t k = 0; k < function.keys.size(); ++k)
        words.push_back(k == i ? in_lua(text) : is_text(function.keys[k]) ? "\"a\"" : "1");
      all.push_back(fmt::format("{}({})", function.name, fmt::join(words, ", ")));
    }
  }
  return all;
}

}  // namespace

TEST_CASE("no string of the language takes control characters or bytes that are no UTF-8", "[attack]") {
  for (const std::string& text : controls) {
    const auto all = sentences(text);
    REQUIRE(all.size() > 40);
    for (const std::string& sentence : all) {
      INFO(sentence);
      auto mistakes = mistakes_in(sentence);
      if (mentions(mistakes, "belongs in a study")) {
        Script::Options options = quiet();
        options.study_file = true;
        mistakes = mistakes_of("\n\n\n\n\n" + sentence, {}, options);
      }
      CHECK(mentions(mistakes, "scene.lua:6: "));
      CHECK(mentions(mistakes, "holds control characters or bytes that are no UTF-8"));
      for (const auto& mistake : mistakes) CHECK(is_plain(mistake));
    }
  }
}

TEST_CASE("figures, recorders, metrics and titles of any letters are drawn and run nothing", "[attack]") {
  Bench bench;
  std::string scene = "-- <b> ]]> 'title' \"of\" system('touch pwned') \\\n" + dry_pier;
  scene += "recorder{ name = 'top', quantity = 'displacement', block = 'b3' }\n";
  int n = 0;
  for (const std::string& text : signs) {
    const std::string said = in_lua(text);
    scene += fmt::format(
        "figure{{ name = \"f{0}\", title = {1}, x = {1}, y = {1}, curves = {{ {{ label = {1}, x = {{1, 2}}, y = {{1, 2}} }} }} }}\n", n,
        said);
    scene += fmt::format("metric('m{0}', {1}, {0})\nparam('p{0}', 1, {1})\n", n++, said);
  }
  const int code = bench.run(scene);
  INFO(bench.said);
  REQUIRE(code == 0);
  for (const auto& entry : fs::recursive_directory_iterator(bench.folder)) {
    CHECK(entry.path().filename().string().find("pwned") == std::string::npos);
    if (entry.path().extension() != ".svg") continue;
    const std::string svg = text_of(entry.path());
    INFO(entry.path());
    CHECK(contains(svg, "</svg>"));
    CHECK_FALSE(contains(svg, "<b>"));
    CHECK_FALSE(contains(svg, "]]>"));
  }
  CHECK(fs::exists(bench.out() + "/histories.svg"));
  CHECK(fs::exists(bench.out() + "/figures/f0.svg"));
  CHECK_FALSE(fs::exists("pwned"));
}

TEST_CASE("folders and scenes of any name are drawn and run nothing", "[attack]") {
  for (const std::string name : {"<touch pwned", "it's 'quoted' ]]>", "Häuschen", "-o", "a\nb\x1b[31m", "\xff", "|touch pwned", "tcp:1"}) {
    Bench bench;
    fs::create_directories(bench.folder / name);
    std::ofstream(bench.folder / name / (name + ".lua")) << dry_pier;
    CHECK(bench.erbs({"run", (bench.folder / name / (name + ".lua")).string(), "-o", (bench.folder / name / "out").string()}) == 0);
    INFO(bench.said);
    CHECK(is_plain(bench.said.substr(0, bench.said.find('\n'))));
    CHECK_FALSE(contains(bench.said, "\x1b"));
    CHECK(fs::exists(bench.folder / name / "out/energy.svg"));
    CHECK_NOTHROW(read_json((bench.folder / name / "out/manifest.json").string()));
    CHECK_FALSE(fs::exists("pwned"));
  }
}

TEST_CASE("what a script says in its own words reaches the terminal escaped", "[attack]") {
  Bench bench;
  for (const std::string& text : controls)
    for (const std::string& sentence : {"error(" + in_lua(text) + ")", "box{ [" + in_lua(text) + "] = 1 }",
                                        "local x = _G[" + in_lua(text) + "]", "local t = {} t." + std::string("f(") + in_lua(text) + ")"}) {
      CHECK(bench.run(dry_pier + sentence) == 2);
      INFO(sentence << "\n" << bench.said);
      CHECK(contains(bench.said, "scene.lua:7:"));
      for (std::size_t at = 0; at < bench.said.size(); at = bench.said.find('\n', at) + 1)
        CHECK(is_plain(bench.said.substr(at, bench.said.find('\n', at) - at)));
    }
  CHECK(bench.run(dry_pier + "print('a\\x1b[31m\\0b')") == 0);
  CHECK(contains(bench.said, "a\\x1b[31m\\0b"));
  CHECK(contains(text_of(bench.out() + "/log.txt"), "a\\x1b[31m\\0b"));
  CHECK(bench.erbs({"check", "no\x1b[31m.lua", "-D", "a\x1b=1"}) == 2);
  CHECK_FALSE(contains(bench.said, "\x1b"));
  CHECK(bench.run(dry_pier + "error(string.rep('x', 1e8))") == 2);
  CHECK(bench.said.size() < 50000);
  CHECK(bench.run(dry_pier + "error({})") == 2);
  CHECK(contains(bench.said, "scene.lua:7: an error that is a table, not a message"));
}

TEST_CASE("a scene reads inside its folder and what the command line allows", "[attack]") {
  Bench bench;
  const fs::path own = bench.folder / "own", other = bench.folder / "other";
  fs::create_directories(own / "below");
  fs::create_directories(other);
  for (const auto& file : {own / "a.csv", own / "below/b.csv", other / "secret.csv"})
    std::ofstream(file) << "time_s,a_m_s2\n0,0\n1,1\nroot:x:0\n";
  fs::create_symlink(other / "secret.csv", own / "link.csv");
  fs::create_directory_symlink(other, own / "away");
  const auto check = [&](const std::string& file, std::vector<std::string> more = {}) {
    std::ofstream(own / "s.lua") << dry_pier << "ground_motion{ wave = record{ file = \"" << file << "\" }, direction = 'x' }";
    std::vector<std::string> words{"check", "-q", (own / "s.lua").string()};
    words.insert(words.end(), more.begin(), more.end());
    const int code = bench.erbs(words);
    CHECK(code == 2);
    CHECK_FALSE(contains(bench.said, "root"));
    return bench.said;
  };
  const std::string not_allowed = "lies outside of the scene's folder", read = "column 1: what stands there is not a number";
  for (const std::string& file : {"a.csv"s, "below/b.csv"s, "below/../a.csv"s, (own / "a.csv").string()})
    CHECK(contains(check(file), read));
  for (const std::string& file : {"../other/secret.csv"s, "link.csv"s, "away/secret.csv"s, (other / "secret.csv").string(), "/etc/shadow"s,
                                  "/no/such/file"s, "/proc/self/mem"s, "../none.csv"s, std::string(500, 'x') + "/../../y"}) {
    INFO(file);
    const std::string said = check(file);
    CHECK((contains(said, not_allowed) || contains(said, "is not there")));
  }
  CHECK(contains(check((other / "secret.csv").string(), {"--allow", other.string()}), read));
  CHECK(contains(check("secret.csv", {"--allow", other.string() + "/"}), read));
  CHECK(contains(check("link.csv", {"--allow", other.string()}), read));
}

TEST_CASE("a mesh reads no other file than a scene may", "[attack]") {
  Bench bench;
  const std::string cube =
      "o cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 0 1 2\nv 1 1 2\n"
      "f 4 3 2 1\nf 5 6 8 7\nf 2 3 8 6\nf 3 4 7 8\nf 4 1 5 7\nf 1 2 6 5\n";
  const auto code = [&](const std::string& file) {
    return bench.run(dry_pier + "mesh{ file = '" + file + "', at = {5, 5, 5}, free = true }", {"--force"});
  };
  bench.write("fifo.obj", "mtllib /etc/passwd\n" + cube);
  CHECK(code("fifo.obj") == 0);
  for (const std::string face : {"f 1 2\n", "f 1\n", "l 1 2\n"}) {
    bench.write("thin.obj", cube + face);
    CHECK((code("thin.obj") == 2 || face[0] == 'l' || code("thin.obj") == 0));
    INFO(bench.said);
    CHECK_FALSE(contains(bench.said, "signal"));
  }
  bench.write("wrong.dxf", "0\nSECTION\n");
  CHECK(code("wrong.dxf") == 2);
  CHECK(contains(bench.said, "its ending is none of .obj"));
  bench.write("junk.obj", "root:x:0:0\n");
  CHECK(code("junk.obj") == 2);
  CHECK_FALSE(contains(bench.said, "root"));
}

TEST_CASE("what a scene asks for ends soon, in time and memory, and says how", "[attack]") {
  Bench bench;
  const std::pair<std::string, std::string> list[] = {
      {"local s = string.rep('x', 2^27) for i = 1, 40 do print(s) end", "printed more than 1 MiB"},
      {"for i = 1, 4000 do box{ size = {.1, .1, .1}, at = {10, 10, 0}, free = true } end", "at least"},
      {"for i = 1, 1e5 do box{ sise = 1 } end", "more than 1000 times"},
      {"local v = {} for i = 1, 90000 do v[i] = { math.random(), math.random(), math.random() } end block{ vertices = v }", "at most 5000"},
      {"local p = {} for i = 1, 2000 do p[i] = { vertices = { {0,0,0}, {1,0,0}, {0,1,0}, {0,0,1} } } end block{ parts = p }",
       "at most 1000"},
      {"wall{ length = 1, courses = 1e300, joint = .01, brick = { length = .2, width = .1, height = .1 } }", "courses"},
      {"string.format = nil", "libraries"},
      {"local s = string s.rep = print", "libraries"},
      {"local x = getmetatable('').__index.format", "scene.lua:7"},
  };
  for (const auto& [piece, words] : list) {
    INFO(piece);
    CHECK(bench.erbs({"check", "-q", bench.scene(dry_pier + piece)}) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, words));
    CHECK(contains(bench.said, "scene.lua"));
    CHECK(bench.said.size() < 5000);
  }
  CHECK(bench.erbs({"check", "-q", bench.scene(dry_pier), "--max-blocks", "3"}) == 2);
  CHECK(contains(bench.said, "at most 3 blocks"));
  CHECK(bench.erbs({"check", "-q", bench.scene(dry_pier), "--max-points", "30"}) == 2);
  CHECK(contains(bench.said, "36 contact points; at most 30"));
}

TEST_CASE("NaN and what has no end is outside of every range", "[attack]") {
  Bench bench;
  const std::string scene = bench.scene(dry_pier);
  for (const std::string option : {"--threads", "--dt-fraction", "--points", "--stiffness", "--damping", "--noise", "--until", "--max-wall",
                                   "--checkpoint-every", "--from", "--max-blocks", "--max-points"})
    for (const std::string value : {"nan", "-nan", "inf", "-1", "x", ""}) {
      INFO(option << " " << value);
      CHECK(bench.erbs({"run", scene, "-o", bench.out(), option, value}) == 2);
      CHECK_FALSE(fs::exists(bench.out()));
    }
  for (const std::string setting : {"duration=nan", "output_dt=nan", "lazy_rotation=nan", "dt=nan", "energy_gate=nan", "seed=1.5",
                                    "sleep=2", "dt=1e-300", "duration=", "kernel=x"}) {
    INFO(setting);
    CHECK(bench.erbs({"run", scene, "-o", bench.out(), "--set", setting}) == 2);
    CHECK_FALSE(fs::exists(bench.out()));
  }
  for (const std::string piece :
       {"param('q', 0/0)", "param('q', 1/0)", "expect('time_s', 0/0, { rel = .1 })", "gravity(0/0)",
        "analysis{ duration = 1, dt = 1e-300 }", "ground_motion{ wave = function(t) return t end, sample = 1e-300 }",
        "ground_motion{ wave = record{ file = '' } }", "mesh{ file = '' }", "metric('a/b', '', 1)", "metric('a.b', '', 1)",
        "param('a b', 1)"}) {
    INFO(piece);
    CHECK(bench.erbs({"check", "-q", bench.scene(dry_pier + piece)}) == 2);
    CHECK(contains(bench.said, "scene.lua:7: "));
  }
  CHECK(bench.erbs({"record", test::in_source("/scenes/records/elcentro_1940_ns.csv"), "--dt", "nan"}) == 2);
}

TEST_CASE("what only the model shows wrong is told before there is a folder", "[attack]") {
  Bench bench;
  const std::string twice =
      "recorder{ name = 'r', quantity = 'displacement', block = 'b1' } recorder{ name = 'r', quantity = 'displacement', block = 'b2' }";
  CHECK(bench.run(dry_pier + twice) == 2);
  CHECK(contains(bench.said, "scene.lua:7: "));
  CHECK_FALSE(fs::exists(bench.out()));
  CHECK(bench.erbs({"check", "-q", bench.scene(dry_pier + twice)}) == 2);
}

TEST_CASE("texts of editors are read, others refused with a remedy", "[attack]") {
  Bench bench;
  bench.write("bom.lua", "\xEF\xBB\xBF" + dry_pier);
  CHECK(bench.erbs({"check", "-q", (bench.folder / "bom.lua").string()}) == 0);
  bench.write("wide.lua", "\xFF\xFE-\0-\0"s);
  CHECK(bench.erbs({"check", "-q", (bench.folder / "wide.lua").string()}) == 2);
  CHECK(contains(bench.said, "save it as UTF-8"));
  bench.write("wide.csv",
              "\xFF\xFE"
              "0\0,\0"s);
  CHECK(bench.erbs({"record", (bench.folder / "wide.csv").string()}) == 2);
  CHECK(contains(bench.said, "save it as UTF-8"));
  bench.write("huge.csv", "time_s,a_m_s2\n0,0\n1,1e300\n");
  CHECK(bench.erbs({"record", (bench.folder / "huge.csv").string()}) == 2);
  CHECK(contains(bench.said, "check the unit"));
  CHECK(bench.erbs({"record", "/proc/self/mem"}) == 2);
  CHECK(contains(bench.said, "/proc/self/mem: the record file cannot be read; name one with numbers"));
  for (const char* verb : {"record", "check"}) {
    CHECK(bench.erbs({verb, "/dev/zero"}) == 2);  // it has no end
    CHECK(contains(bench.said, "is a device, not a"));
  }
  bench.write("deep.lua", std::string(100000, '(') + "1" + std::string(100000, ')'));
  CHECK(bench.erbs({"check", "-q", (bench.folder / "deep.lua").string()}) == 2);
  CHECK(contains(bench.said, "deep.lua"));
  CHECK(bench.erbs({"run", bench.scene(dry_pier), "-o", (bench.folder / std::string(300, 'x')).string()}) == 2);
  CHECK(contains(bench.said, "choose another with -o DIR"));
}
