// A scene can only compute: it cannot reach files, exhaust the machine, or run for ever.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "tests/support/folder.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// Loads a script in a process of its own; returns its exit code and its stderr.
std::pair<int, std::string> in_a_child(const std::string& text, double limit) {
  const test::Folder folder;
  const std::string log = folder.file("log");
  const pid_t pid = fork();
  if (pid == 0) {
    if (!std::freopen(log.c_str(), "w", stderr)) _exit(9);
    mistakes_of(text, {}, quiet(limit));
    _exit(0);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  std::ifstream stream(log);
  std::string said((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said};
}

}  // namespace

TEST_CASE("a loop without end is stopped, and pcall does not swallow it", "[lua][sandbox]") {
  for (const char* loop : {"while true do end", "while true do pcall(function() while true do end end) end",
                           "local function f() return pcall(f) end while true do f() end", "local function f() return f() end f()",
                           "while true do xpcall(function() while true do end end, function(e) while true do end end) end",
                           "for i = 1, math.huge do local s = ('x'):rep(10):upper() end", "transform{ function() while true do end end }",
                           "ground_motion{ wave = function(x) while true do end end }"}) {
    const std::clock_t begin = std::clock();
    const auto mistakes = mistakes_of(sound + loop, {}, quiet(0.2));
    INFO(loop);
    CHECK(mentions(mistakes, "the script ran longer than"));
    CHECK(mentions(mistakes, "scene.lua:"));
    CHECK(double(std::clock() - begin) / CLOCKS_PER_SEC < 1.0);
  }
}

TEST_CASE("a pattern of exponential cost ends the process with code 2", "[lua][sandbox]") {
  const auto [code, said] = in_a_child("local n = 40\nstring.find(('a'):rep(n), ('a?'):rep(n) .. ('a'):rep(n) .. 'b')", 0.2);
  CHECK(code == 2);
  CHECK(contains(said, "scene.lua:2: string.find: the script ran longer than 0.2 s"));
}

TEST_CASE("work that a scene asks of the program ends with its time, and is not taken for a loop", "[lua][sandbox]") {
  // A hull of 5000 points takes longer than the interval of the script's hook.
  const auto [code, said] = in_a_child(
      "local v = {} for i = 1, 5000 do v[i] = { math.random(), math.random(), math.random() } end\n"
      "for i = 1, 1e5 do block{ vertices = v } end",
      0.5);
  CHECK(code == 2);
  CHECK(contains(said, "scene.lua:2: block: the script ran longer than 0.5 s; that is more work than a scene may ask for"));
}

TEST_CASE("a library loop in C ends the process with code 2", "[lua][sandbox]") {
  const auto [code, said] = in_a_child("table.move({}, 1, 1e15, 2)", 0.2);
  CHECK(code == 2);
  CHECK(contains(said, "scene.lua:1: table.move"));
}

TEST_CASE("memory is capped", "[lua][sandbox]") {
  for (const char* bomb :
       {"local s = 'x' while true do s = s .. s end", "local t = {} for i = 1, math.huge do t[i] = { i } end", "local s = ('x'):rep(1e10)",
        "local t = {} while true do t[#t + 1] = sine{ amplitude = 1, frequency = 1 } end"}) {
    INFO(bomb);
    const auto mistakes = mistakes_of(bomb, {}, quiet(10, size_t{32} << 20));
    CHECK((mentions(mistakes, "MiB of memory") || mentions(mistakes, "too large") || mentions(mistakes, "not enough memory")));
  }
  CHECK(mentions(mistakes_of("local t = {}\nfor i = 1, math.huge do\n t[i] = { i }\nend", {}, quiet(10, size_t{32} << 20)),
                 "scene.lua:3: the script needs more than 32 MiB of memory"));
}

TEST_CASE("what reaches outside is not there", "[lua][sandbox]") {
  for (const char* name :
       {"io", "os", "package", "debug", "coroutine", "require", "load", "loadfile", "dofile", "loadstring", "collectgarbage", "warn"}) {
    INFO(name);
    CHECK(mentions(mistakes_in("local x = " + std::string(name)), "unknown name"));
  }
  CHECK(mentions(mistakes_in("local x = string.dump(function() end)"), "attempt to call a nil value"));
  CHECK(mentions(mistakes_in("setmetatable({}, { __gc = function() while true do end end })"), "__gc is not available"));
  CHECK(mentions(mistakes_in("getmetatable(_G).__index = nil"), "scene.lua:6:"));
}

TEST_CASE("the language cannot be changed from a scene", "[lua][sandbox]") {
  CHECK(mentions(mistakes_in("box = nil"), "is a name of the language"));
  CHECK(mentions(mistakes_in("_G.box = print"), "is a name of the language"));
  CHECK(mentions(mistakes_in("setmetatable(_G, {})"), "protected metatable"));
}

TEST_CASE("next goes through a table in the order of pairs", "[lua][sandbox]") {
  const std::string begin = R"(
local t = {} for i = 1, 40 do t["k" .. i] = i end
t[3], t[1], t[2.5], t[true], t[false] = 1, 2, 3, 4, 5
local ordered = {} for k in pairs(t) do ordered[#ordered + 1] = k end
)";
  for (const char* claim : {
           "local i = 0 for k, v in next, t do i = i + 1 assert(k == ordered[i] and v == t[k]) end assert(i == 45)",
           "local i = 0 for k in next, t do i = i + 1 assert(k == ordered[i]) t[k] = nil end assert(i == 45 and next(t) == nil)",
           "local i = 0 for a in next, t do i = i + 1 for b in next, t do assert(b ~= nil) end assert(a == ordered[i]) end assert(i == 45)",
           "local i, k = 0, next(t) while k ~= nil do i = i + 1 assert(k == ordered[i]) t[k] = nil k = next(t) end assert(i == 45)",
           "assert(next({}) == nil and next({ 7 }) == 1 and select(2, next({ 7 })) == 7)",
       }) {
    INFO(claim);
    CHECK(mistakes_in(begin + claim).empty());
  }
  CHECK(mentions(mistakes_in("next({ 1 }, 'x')"), "scene.lua:6: next: this key is not in the table"));
}

TEST_CASE("no text of a script holds an address", "[lua][sandbox]") {
  const std::string begin = "local t, f = {}, function() end local named = setmetatable({}, { __tostring = function() return 'me' end })\n";
  for (const char* claim : {
           "assert(tostring(t) == 'table' and tostring(f) == 'function' and tostring(print) == 'function' and tostring(named) == 'me')",
           "assert(tostring(nil) == 'nil' and tostring(.5) == '0.5' and tostring('a') == 'a' and tostring(true) == 'true')",
           "assert(string.format('%s|%5s|%-3s|%%|%d', t, 'a', named, 3) == 'table|    a|me |%|3')",
           "assert(('%s %q %.2f %s'):format(f, 'x', 1.5, nil) == 'function \"x\" 1.50 nil')",
           "assert(not tostring(dry{ kn = 1e9, mu = .6 }):find('0x'))",
       }) {
    INFO(claim);
    CHECK(mistakes_in(begin + claim).empty());
  }
  CHECK(mentions(mistakes_in("string.format('%p', {})"), "%p is not available in scenes"));
  CHECK(mentions(mistakes_in("string.format('%d', {})"), "number expected, got table"));
  CHECK(mentions(mistakes_in("string.format('%s')"), "(no value)"));
}

TEST_CASE("include stays inside the scene's folder", "[lua][sandbox]") {
  CHECK(mentions(mistakes_in("include '/etc/passwd'"), "leaves the folder of the scene"));
  CHECK(mentions(mistakes_in("include '../../etc/passwd'"), "leaves the folder of the scene"));
  CHECK(mentions(mistakes_in("include 'nope.lua'"), "there is no such file"));
}

TEST_CASE("bytecode is refused", "[lua][sandbox]") {
  const std::string bytecode = std::string("\x1bLua") + "T\0\x19\x93\r\n\x1a\n";
  CHECK(mentions(mistakes_of(bytecode), "attempt to load a binary chunk"));
}

TEST_CASE("the same script builds the same scene every time", "[lua][sandbox]") {
  const std::string piece =
      "local names = {} for i = 1, 40 do names['k' .. i] = i end\n"
      "for name, i in pairs(names) do box{ name = name, size = {1,1,1}, at = {2*i + math.random(),5,0}, material = 'brick' } end";
  const Scene a = scene_of(piece), b = scene_of(piece);
  REQUIRE(a.blocks.size() == 41);
  REQUIRE(b.blocks.size() == 41);
  bool same = true;
  for (size_t i = 0; i < a.blocks.size(); ++i)
    same = same && a.blocks[i].name == b.blocks[i].name && a.blocks[i].parts[0].vertices[0] == b.blocks[i].parts[0].vertices[0];
  CHECK(same);
}
