// Command lines: every option of every verb, as its own help lists them, with hostile or meaningless strings.
#include <catch2/catch.hpp>

#include <map>
#include <regex>

#include "engine/base/text.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

struct Option {
  std::string name, type;  // type: as shown by help; "" for a flag
};

// The lines "  --threads INT:1 to 1024     threads ..." of help.
std::vector<Option> options_of(Bench& bench, const std::string& verb) {
  REQUIRE(bench.erbs({verb, "--help"}) == 0);
  std::vector<Option> all;
  const std::regex line("\n  (?:-[a-z],)?(--?[A-Za-z-]+)(?: ([^ \n]+(?: [^ \n]+)*))?(?=  |\n)");
  for (std::sregex_iterator at(bench.said.begin(), bench.said.end(), line), end; at != end; ++at)
    if ((*at)[1] != "--help") all.push_back({(*at)[1], (*at)[2]});
  return all;
}

// Free text: a folder, a file, a name. Any value may be intended.
bool is_free(const std::string& type) {
  return type.starts_with("DIR") || type.starts_with("FILE") || type == "TEXT" || type.find("=value") != std::string::npos ||
         type.starts_with("EFFECT") || type.starts_with("NAME");
}

const std::vector<std::string> hostile{"",
                                       "a\nb",
                                       "it's \"so\"",
                                       "system('touch pwned')",
                                       "$(touch pwned)",
                                       "`touch pwned`",
                                       "<touch pwned",
                                       "|touch pwned",
                                       "]]>",
                                       "<b>&",
                                       "a\x1b[31m",
                                       "a\xff\xfe",
                                       "a\rb",
                                       "\xe2\x80\xae",
                                       "nan",
                                       "inf",
                                       "1e400",
                                       "-0x1p999",
                                       "1e3x",
                                       "-5",
                                       "--",
                                       "%s%n",
                                       "..",
                                       std::string(100000, 'x')};

// Runs in the folder of the bench, so that files named by options appear there.
int inside(Bench& bench, const std::vector<std::string>& words) {
  std::vector<std::string> command{"/bin/sh", "-c", "cd \"$0\" && exec \"$@\"", bench.folder.string()};
  for (const std::string& word : bench.command(words)) command.push_back(word);
  const int code = wait_for(start(command, (bench.folder / "log").string()));
  bench.said = text_of(bench.folder / "log");
  return code;
}

// Checks the output line by line: it must neither control a terminal nor flood it.
void check_said(const Bench& bench) {
  INFO(bench.said.substr(0, 2000));
  CHECK(bench.said.size() < 30000);
  CHECK(printable(bench.said) == bench.said);
  CHECK_FALSE(contains(bench.said, "terminate called"));
}

void check_no_harm(const Bench& bench) {
  CHECK_FALSE(fs::exists("pwned"));
  for (const auto& entry : fs::recursive_directory_iterator(bench.folder)) CHECK(entry.path().filename() != "pwned");
}

const std::vector<std::string> verbs{"run", "check", "record", "test", "accuracy", "bench", "effects"};

}  // namespace

TEST_CASE("every option of every verb refuses what it cannot mean, by its name", "[options]") {
  Bench bench;
  // No simulation runs: a command line that passes ends at a wrong scene or record.
  const std::string wrong = bench.scene("boxx{}\n");
  std::size_t tried = 0;
  std::map<std::string, std::string> verbs_of;  // the first verb that has it
  for (const auto& verb : verbs) {
    const auto options = options_of(bench, verb);
    for (const Option& option : options) verbs_of.emplace(option.name + option.type, verb);
    REQUIRE(options.size() >= 3);
    for (const Option& option : options)
      for (std::size_t i = 0; i < hostile.size(); ++i) {
        const std::string& value = hostile[i];
        // Other verbs share an option of the same name; for them only a sample is repeated.
        if (i % 8 != 3 && verbs_of[option.name + option.type] != verb) continue;
        if (option.type.empty() && value.empty()) continue;  // --force= is --force
        // As one word: a separate value that begins with a dash would be an option.
        const std::string word = option.name.starts_with("--") ? option.name + "=" + value : option.name + value;
        if (word == option.name) continue;  // -o without a value takes the next word
        ++tried;
        INFO(verb << " " << shown(word));
        const int code = inside(bench, {verb, wrong, word});
        CHECK((code == 2 || (code == 4 && verb == "test")));  // a wrong scene is a failed case of a test
        check_said(bench);
        // -5 s is a time that --from may not be, 1e400 a number that no option accepts.
        if (!is_free(option.type)) CHECK(contains(bench.said, option.name));
      }
  }
  CHECK(tried > 800);
  check_no_harm(bench);
  for (const auto& entry : fs::directory_iterator(bench.folder)) {
    INFO(entry.path());
    CHECK(entry.path().extension() != ".tmp");
  }
}

TEST_CASE("words, verbs and options that there are not are told in plain letters", "[options]") {
  Bench bench;
  for (const std::string& value : hostile) {
    if (value == "..") continue;  // an existing folder, with scenes of others
    INFO(shown(value));
    for (const auto& words : std::vector<std::vector<std::string>>{{value},
                                                                   {"--" + value},
                                                                   {"help", value},
                                                                   {"record", value},
                                                                   {"check", value},
                                                                   {"test", value},
                                                                   {"effects", value},
                                                                   {"accuracy", value},
                                                                   {"bench", value},
                                                                   {"render", value}}) {
      const int code = inside(bench, words);
      INFO(words.front().substr(0, 100));
      CHECK((code == 2 || value == "--"));  // which ends the options
      check_said(bench);
    }
  }
  check_no_harm(bench);
}

TEST_CASE("options that contradict each other, or mean nothing, are refused", "[options]") {
  Bench bench;
  const std::string scene = bench.scene(four_bricks() + "joint{ law = dry{ kn = 1e9, mu = .6 } }\nanalysis{ duration = .01 }\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--noise-seed", "3"}, "--noise-seed"},
      {{"--set", "output_dt=.001", "--set", "output_dt=.002"}, "output_dt was set before"},
      {{"--set", "dt_fraction=.5", "--dt-fraction", ".3"}, "both give the time step"},
      {{"--threads", "1.5"}, "1.5 is no whole number"},
      {{"--allow", (bench.folder / "nowhere").string()}, "there is no folder"}};
  for (const auto& [options, wanted] : cases) {
    std::vector<std::string> words{"run", scene, "-o", bench.out()};
    words.insert(words.end(), options.begin(), options.end());
    INFO(wanted);
    CHECK(bench.erbs(words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, wanted));
    CHECK_FALSE(fs::exists(bench.out()));
  }
  CHECK(bench.erbs({"run", scene, "-o", bench.out(), "--no-figures", "--without", "ground x"}) == 0);
  CHECK(contains(bench.said, "the scene has no such effect"));
  for (const fs::path& book : {bench.folder, bench.folder / "nowhere" / "book.md"}) {
    CHECK(bench.erbs({"test", scene, "--book", book.string()}) == 2);
    CHECK_FALSE(contains(bench.said, "verdict"));  // told before the runs
  }
}

TEST_CASE("what a run is told on its command line stands escaped in its files", "[options]") {
  for (const std::string value : {"a\nb", "a\x1b[31m", "a\xff\xfe", "<b>&]]>", "it's \"so\" $(touch pwned)"}) {
    Bench bench;
    const std::string scene = four_bricks() +
                              "joint{ law = dry{ kn = 1e9, mu = .6 } }\nanalysis{ duration = param('duration', 1) }\n"
                              "recorder{ name = 'r', quantity = 'displacement', block = 'b3' }\n";
    const std::string out = (bench.folder / ("out" + value)).string();
    fs::create_directories(bench.folder / value);
    INFO(shown(value));
    // A Lua comment holds any characters, and -D takes an expression.
    CHECK(bench.erbs({"run", bench.scene(scene), "-o", out, "-D", "duration=0.01 --[==[" + value + "]==]", "--allow",
                      (bench.folder / value).string()}) == 0);
    check_said(bench);
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
      const std::string kind = entry.path().extension().string();
      if (kind != ".json" && kind != ".csv" && kind != ".svg" && kind != ".txt" && kind != ".xdmf" && kind != ".gnuplot") continue;
      INFO(entry.path().filename());
      ++files;
      const std::string text = text_of(entry.path());
      CHECK(printable(text) == text);
      if (kind == ".svg" || kind == ".xdmf") CHECK_FALSE(contains(text, "<b>"));
    }
    CHECK(files >= 7);
    check_no_harm(bench);
  }
}
