// Early ends of a run: by signals, by limits, by another run in its folder; and the effect of --resume afterwards.
#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <sstream>
#include <thread>

#include "engine/record/format/json.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

// Four bricks that slide on each other for any duration. The time step is fixed, so that no option changes it as a side effect.
const std::string sliding = four_bricks() + R"(joint{ law = dry{ kn = 1e8, mu = .3 } }
ground_motion{ wave = sine{ amplitude = 4, frequency = 3 }, direction = "x" }
recorder{ name = "top", quantity = "displacement", block = "b3" }
analysis{ duration = param("duration", 0.3), dt = 1e-5, output_dt = 0.01 }
)";

void wait_until(const std::function<bool()>& there) {
  for (int i = 0; i < 500 && !there(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  REQUIRE(there());
}

std::string hash_in(const std::string& folder) { return read_json(folder + "/metrics.json")["state_hash"].get<std::string>(); }

// Exit code and stderr of an erbs command under `sh -c`.
std::pair<int, std::string> in_shell(const Bench& bench, const std::string& before, const std::string& words,
                                     const std::string& after = "") {
  const std::string log = (bench.folder / "shell.log").string();
  const int code =
      wait_for(start({"/bin/sh", "-c", "exec 2> " + log + "; " + before + " exec " + test::in_build("/erbs ") + words + " " + after}));
  return {code, text_of(log)};
}

std::vector<pid_t> processes_of(const std::string& folder) {
  std::vector<pid_t> found;
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator("/proc", gone)) {
    const std::string line = text_of(entry.path() / "cmdline");
    if (line.find("erbs") != std::string::npos && line.find(folder) != std::string::npos)
      found.push_back(std::atoi(entry.path().filename().c_str()));
  }
  return found;
}

int processes_that_name(const std::string& folder) { return int(processes_of(folder).size()); }

}  // namespace

TEST_CASE("with --log-json each line on stderr is JSON: progress, warnings and mistakes", "[endings]") {
  Bench bench;
  bench.write("a.lua", sliding + "print('two\\nlines')\nground_motion{ wave = sine{ amplitude = 1, frequency = 1 } }\n");
  bench.write("b.lua", sliding + "box{ size = 3 }\nbox{ size = 4 }\n");
  for (const auto& [scene, wanted] : {std::pair("a.lua", 0), {"b.lua", 2}}) {
    const auto [code, said] = in_shell(bench, "", "run " + (bench.folder / scene).string() + " --log-json -o " + bench.out());
    CHECK(code == wanted);
    REQUIRE_FALSE(said.empty());
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);) {
      INFO(line);
      const Json message = Json::parse(line, nullptr, false);
      CHECK(message.is_object());
    }
    CHECK(contains(said, wanted == 0 ? "two\\nlines" : "size must be a vector"));
  }
}

TEST_CASE("every signal that asks a run to end leaves a checkpoint, and it goes on to the same bits", "[endings]") {
  ::signal(SIGHUP, SIG_DFL);  // nohup ignores it, and children inherit that
  Bench whole;
  REQUIRE(whole.run(sliding, {"-q", "--no-figures"}) == 0);
  for (const int signal : {SIGHUP, SIGTERM, SIGINT}) {
    Bench bench;
    const Child run = start(bench.command({"run", bench.scene(sliding), "-o", bench.out(), "-q", "--no-figures", "-D", "duration=1000"}),
                            (bench.folder / "log").string());
    wait_until([&] { return fs::exists(bench.out() + "/energy.csv"); });
    ::kill(run.pid, signal);
    CHECK(wait_for(run) == 130);
    CHECK(fs::exists(bench.out() + "/checkpoint.bin"));
    CHECK(read_json(bench.out() + "/metrics.json")["status"] == "interrupted");
  }
  Bench bench;
  REQUIRE(bench.run(sliding, {"-q", "--no-figures", "--until", "0.1"}) == 3);
  REQUIRE(bench.run(sliding, {"-q", "--no-figures", "--resume", "--until", "0.05"}) == 3);
  CHECK(contains(bench.said, "the run was at 0.1"));
  REQUIRE(bench.run(sliding, {"-q", "--no-figures", "--resume"}) == 0);
  CHECK(hash_in(bench.out()) == hash_in(whole.out()));
  for (const char* file : {"/histories.csv", "/energy.csv", "/events.csv"})
    CHECK(text_of(bench.out() + file) == text_of(whole.out() + file));
  CHECK(whole.run(sliding, {"-q", "--no-figures", "--resume"}) == 2);  // it left no checkpoint
  CHECK(contains(whole.said, "has come to its end"));
}

TEST_CASE("a run whose folder is moved says so, and goes on from there", "[endings]") {
  Bench whole, bench;
  REQUIRE(whole.run(sliding, {"-q", "--no-figures", "-D", "duration=20"}) == 0);
  const std::string log = (bench.folder / "log").string(), moved = (bench.folder / "moved").string();
  const Child run = start(bench.command({"run", bench.scene(sliding), "-o", bench.out(), "-q", "--no-figures", "-D", "duration=20",
                                         "--checkpoint-every", "0.1"}),
                          log);
  wait_until([&] { return fs::exists(bench.out() + "/checkpoint.bin"); });
  fs::rename(bench.out(), moved);
  CHECK(wait_for(run) == 2);
  CHECK(contains(text_of(log), "was moved or removed during the run"));
  REQUIRE(bench.erbs({"run", moved, "--resume", "-q", "--no-figures"}) == 0);
  CHECK(hash_in(moved) == hash_in(whole.out()));
}

TEST_CASE("a run goes on with its own options only", "[endings]") {
  Bench bench;
  REQUIRE(bench.run(sliding, {"-q", "--no-figures", "--until", "0.05", "--damping", "2"}) == 3);
  const std::vector<std::vector<std::string>> others{{},
                                                     {"--damping", "3"},
                                                     {"--damping", "2", "--points", "16"},
                                                     {"--damping", "2", "--rule", "gauss"},
                                                     {"--damping", "2", "--stiffness", "0.8"},
                                                     {"--damping", "2", "--set", "kernel=reference"},
                                                     {"--damping", "2", "--set", "duration=0.4"},
                                                     {"--damping", "2", "--set", "output_dt=0.02"},
                                                     {"--damping", "2", "--from", "0.2"},
                                                     {"--damping", "2", "--noise", "1e-6"},
                                                     {"--damping", "2", "--dt-fraction", "0.5"},
                                                     {"--damping", "2", "--without", "debris contact"},
                                                     {"--damping", "2", "--allow-unstable"}};
  for (auto words : others) {
    words.insert(words.end(), {"-q", "--no-figures", "--resume"});
    CHECK(bench.run(sliding, words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, "was started with other options: --damping 2"));
  }
  // If the manifest is damaged, the checkpoint still detects it.
  const std::string manifest = text_of(bench.out() + "/manifest.json");
  std::ofstream(bench.out() + "/manifest.json") << "";
  CHECK(bench.run(sliding, {"-q", "--no-figures", "--resume", "--damping", "3"}) == 2);
  CHECK(contains(bench.said, "with other options"));
  CHECK(bench.run(sliding, {"-q", "--no-figures", "--resume", "--damping", "2", "--until", "0.06"}) == 3);
  std::ofstream(bench.out() + "/manifest.json") << manifest.substr(0, 100);
  CHECK(bench.run(sliding, {"-q", "--no-figures", "--force", "--until", "0.06"}) == 3);
}

TEST_CASE("rows that were changed after the checkpoint are refused", "[endings]") {
  for (const std::string file : {"histories.csv", "energy.csv"}) {
    Bench bench;
    REQUIRE(bench.run(sliding, {"-q", "--no-figures", "--until", "0.1"}) == 3);
    std::string text = text_of(bench.out() + "/" + file);
    text[text.find('\n') + 1] ^= 1;
    std::ofstream(bench.out() + "/" + file) << text;
    CHECK(bench.run(sliding, {"-q", "--no-figures", "--resume"}) == 2);
    CHECK(contains(bench.said, file + ": was changed after the checkpoint was written"));
  }
}

TEST_CASE("two runs do not share a folder", "[endings]") {
  Bench bench;
  const Child run = start(bench.command({"run", bench.scene(sliding), "-o", bench.out(), "-q", "--no-figures", "-D", "duration=1000",
                                         "--checkpoint-every", "0.01s"}),
                          (bench.folder / "first.log").string());
  wait_until([&] { return fs::exists(bench.out() + "/checkpoint.bin"); });
  for (const std::string how : {"--resume", "--force"}) {
    CHECK(bench.erbs({"run", (bench.folder / "scene.lua").string(), "-o", bench.out(), "-q", how, "-D", "duration=1000"}) == 2);
    CHECK(contains(bench.said, "another run is at work in"));
  }
  ::kill(run.pid, SIGKILL);
  CHECK(wait_for(run) == 128 + SIGKILL);
  CHECK(bench.erbs({"run", (bench.folder / "scene.lua").string(), "-o", bench.out(), "-q", "--resume", "-D", "duration=1000", "--max-wall",
                    "0.2"}) == 3);
}

TEST_CASE("runs end with the program that started them", "[endings]") {
  for (const int signal : {SIGKILL, SIGTERM}) {
    Bench bench;
    bench.scene(sliding + "expect('status', 'completed')\n");
    const std::string out = (bench.folder / "runs").string();
    const Child test = start(bench.command({"test", (bench.folder / "scene.lua").string(), "-o", out, "-q", "-D", "duration=1000"}),
                             (bench.folder / "log").string());
    wait_until([&] { return fs::exists(out + "/scene/energy.csv"); });
    ::kill(test.pid, signal);
    CHECK(wait_for(test) == (signal == SIGKILL ? 128 + SIGKILL : 130));
    wait_until([&] { return processes_that_name(out) == 0; });
    CHECK(fs::exists(out + "/scene/checkpoint.bin"));
  }
}

TEST_CASE("cases that found no time are not called failed", "[endings]") {
  Bench bench;
  for (const char* name : {"a.lua", "b.lua", "c.lua"}) bench.write(name, sliding + "expect('status', 'completed')\n");
  CHECK(bench.erbs({"test", bench.folder.string(), "-o", (bench.folder / "runs").string(), "-q", "-j", "1", "--budget", "0.01s"}) == 3);
  CHECK(contains(bench.said, "not run"));
  CHECK_FALSE(contains(bench.said, "FAILED"));
}

TEST_CASE("a limit of the system ends a run with its code, place and remedy, and every file whole", "[endings]") {
  Bench bench;
  const std::string words = "run " + bench.scene(sliding) + " -q --no-figures --force --checkpoint-every 0.02s -o " + bench.out();
  for (int blocks = 0; blocks < 120; blocks += 5) {  // of 512 bytes
    fs::remove_all(bench.out());
    const auto [code, said] = in_shell(bench, fmt::format("ulimit -f {};", blocks), words, "> /dev/null");
    INFO(blocks << ": " << said);
    CHECK((code == 0 || code == 2 || code == 3));
    CHECK(fs::exists(bench.out() + "/checkpoint.bin.tmp") == false);
    if (code == 0) break;
    // If the log itself hits the limit, it stays empty.
    CHECK((contains(said, "cannot be") || said.empty()));
  }
  std::vector<std::string> limits{"ulimit -n 8;"};
#ifndef __SANITIZE_ADDRESS__  // a sanitized program reserves terabytes of addresses, and opens pipes to check the types of objects
  limits.push_back("ulimit -n 11;");
  limits.push_back("ulimit -v 60000;");
#endif
  for (const std::string& limit : limits) {
    fs::remove_all(bench.out());
    const auto [code, said] = in_shell(bench, limit, words);
    INFO(limit << said);
    // With the sanitizers of clang++, a program does not even start in so little memory.
    CHECK((code == 0 || (code == 2 && !said.empty()) || contains(said, "loading shared libraries")));
  }
}

TEST_CASE("a run goes on from any folder, and beside a manifest that is damaged", "[endings]") {
  Bench bench;
  bench.write("part.lua", "return 0.3\n");
  bench.write("wave.csv", "time_s,a_m_s2\n0,0\n1,1\n");
  const std::string scene =
      bench.scene(sliding + "include 'part.lua'\nground_motion{ wave = record{ file = 'wave.csv' }, direction = 'y' }\n");
  REQUIRE(bench.erbs({"run", scene, "-o", bench.out(), "-q", "--no-figures", "--until", "0.1"}) == 3);
  fs::create_directories(bench.folder / "z");
  const auto from = [&](const std::string& folder, const std::string& words) {
    const std::string command =
        "cd " + (bench.folder / folder).string() + " && exec " + test::in_build("/erbs run ") + words + " -q --no-figures --resume";
    return wait_for(start({"/bin/sh", "-c", command}, (bench.folder / "log").string()));
  };
  CHECK(from("", "scene.lua -o out --until 0.15") == 3);
  CHECK(from("z", "../scene.lua -o ../out --until 0.2") == 3);
  for (const std::string manifest : {"[1]", "{\"a\":", "{}"}) {
    bench.write("out/manifest.json", manifest);
    CHECK(from("z", "../scene.lua -o ../out --until 0.2") == 3);
  }
  bench.write("out/checkpoint.bin.tmp", "half");
  bench.write("out/notes.tmp", "of the user");
  CHECK(from("", scene + " -o out") == 0);
  CHECK_FALSE(fs::exists(bench.out() + "/checkpoint.bin.tmp"));
  CHECK(fs::exists(bench.out() + "/notes.tmp"));
}

TEST_CASE("a run of a study that was killed is made again by --resume", "[endings]") {
  Bench bench;
  const std::string scene = four_bricks() + R"(joint{ law = dry{ kn = 1e8, mu = .3 } }
recorder{ name = "top", quantity = "displacement", block = "b3" }
local seed = param("seed", 1)
analysis{ duration = seed > 1 and 5 or 0.01, dt = 1e-5, output_dt = 1 }
ensemble{ n = 1, seed = 1, name = "e", value = function(run) return run.time_s end }
)";
  const Child run =
      start(bench.command({"run", bench.scene(scene), "-o", bench.out(), "-q", "--no-figures"}), (bench.folder / "log").string());
  const std::string studies = bench.out() + "/studies/";
  wait_until([&] { return processes_that_name(studies) > 0; });
  for (const pid_t child : processes_of(studies)) ::kill(child, SIGKILL);
  CHECK(wait_for(run) == 2);  // the study has no answer
  CHECK(contains(text_of(bench.folder / "log"), "ended by signal 9"));
  CHECK(bench.run(scene, {"-q", "--no-figures", "--resume"}) == 0);
  CHECK(bench.said.empty());
  CHECK(read_json(bench.out() + "/metrics.json")["metrics"]["e_mean"].get<double>() == Approx(5));
}

TEST_CASE("what cannot be printed is told, with code 2", "[endings]") {
  Bench bench;
  const std::string scene = bench.scene(sliding);
  for (const std::string& words :
       {"check " + scene, std::string("version"), std::string("--version"), std::string("help"), std::string("help box"),
        std::string("run --help"), "run " + scene + " --no-figures --force -o " + bench.out()})
    for (const std::string after : {"> /dev/full", ">&-"}) {
      const auto [code, said] = in_shell(bench, "", words, after);
      INFO(words << after);
      CHECK(code == 2);
      CHECK(contains(said, "what was to be printed is lost"));
    }
  CHECK(in_shell(bench, "", "help", "| head -1 > /dev/null").first == 0);
}

TEST_CASE("a reader that stops in the middle of a long text changes no exit code", "[endings]") {
  Bench bench;
  // The text is longer than a pipe holds, so that it meets the closed end before the last flush.
  const std::string log = (bench.folder / "log").string();
  const int code = wait_for(start(
      {"/bin/bash", "-c", "set -o pipefail; " + test::in_build("/erbs") + " help --editor 2> " + log + " | head -c 100 > /dev/null"}));
  CHECK(code == 0);
  CHECK(text_of(log).empty());
}
