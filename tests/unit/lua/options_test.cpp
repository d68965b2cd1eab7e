// What a command line may hold: every option of every verb, as its own help lists them, with strings that mean harm or nothing.
#include <catch2/catch.hpp>

#include <map>
#include <regex>

#include "engine/base/text.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
namespace fs = std::filesystem;

namespace {

struct Option {
  std::string name, type;  // type: as help shows it; "" of a flag
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

// Free text: a folder, a file, a name. Whatever is said there may be meant.
bool is_free(const std::string& type) {
  return type.starts_with("DIR") || type.starts_with("FILE") || type == "TEXT" || type.find("=value") != std::string::npos ||
         type.starts_with("EFFECT");
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

// In the folder of the bench: what an option names is made there.
int inside(Bench& bench, const std::vector<std::string>& words) {
  std::vector<std::string> command{"/bin/sh", "-c", "cd \"$0\" && exec \"$@\"", bench.folder.string()};
  for (const std::string& word : bench.command(words)) command.push_back(word);
  const int code = wait_for(start(command, (bench.folder / "log").string()));
  bench.said = text_of(bench.folder / "log");
  return code;
}

// What is told, line by line: a terminal is not controlled by it, nor flooded.
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
  // nothing is run: what passes the command line ends at a scene, or a record, that is wrong
  const std::string wrong = bench.scene("boxx{}\n");
  std::size_t tried = 0;
  std::map<std::string, std::string> verbs_of;  // the first that has it
  for (const auto& verb : verbs) {
    const auto options = options_of(bench, verb);
    for (const Option& option : options) verbs_of.emplace(option.name + option.type, verb);
    REQUIRE(options.size() >= 3);
    for (const Option& option : options)
      for (std::size_t i = 0; i < hostile.size(); ++i) {
        const std::string& value = hostile[i];
        // an option of the same name is the same to other verbs: a sample of them is tried again
        if (i % 8 != 3 && verbs_of[option.name + option.type] != verb) continue;
        if (option.type.empty() && value.empty()) continue;  // --force= is --force
        // as one word: a value of its own that begins with a dash is an option
        const std::string word = option.name.starts_with("--") ? option.name + "=" + value : option.name + value;
        if (word == option.name) continue;  // -o without a word takes the next one
        ++tried;
        INFO(verb << " " << shown(word));
        const int code = inside(bench, {verb, wrong, word});
        CHECK((code == 2 || (code == 4 && verb == "test")));  // of a test, a scene that is wrong is a case that fails
        check_said(bench);
        // -5 s is a time that --from may never be, 1e400 a number that no option takes
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
    if (value == "..") continue;  // a folder that is there, of scenes of others
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

TEST_CASE("what a run is told on its command line stands escaped in its files", "[options]") {
  for (const std::string value : {"a\nb", "a\x1b[31m", "a\xff\xfe", "<b>&]]>", "it's \"so\" $(touch pwned)"}) {
    Bench bench;
    const std::string scene = four_bricks() +
                              "joint{ law = dry{ kn = 1e9, mu = .6 } }\nanalysis{ duration = param('duration', 1) }\n"
                              "recorder{ name = 'r', quantity = 'displacement', block = 'b3' }\n";
    const std::string out = (bench.folder / ("out" + value)).string();
    fs::create_directories(bench.folder / value);
    INFO(shown(value));
    // a comment of Lua holds any letters, and -D takes an expression
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
