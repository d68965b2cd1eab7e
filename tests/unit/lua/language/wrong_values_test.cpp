// Every function of the language with each key wrong in turn: wrong type, out of range, no number, misspelt, missing. The test walks the
// key lists used by help and editor, so that new keys are tested too.
#include <catch2/catch.hpp>

#include <map>
#include <regex>

#include "engine/base/text.h"
#include "lua/commands/help.h"
#include "lua/language/api.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

using Words = std::vector<std::pair<std::string, std::string>>;  // key, value as a script writes it

const std::string corners = "{ {5,5,5}, {6,5,5}, {5,6,5}, {5,5,6} }", brick = "{ length = .25, width = .12, height = .06 }";
const std::string supports =
    "{ box{ size = {1, 1, 1}, at = {9, 9, 0}, fixed = true }, box{ size = {1, 1, 1}, at = {12, 9, 0}, fixed = true } }";

// A correct call of each function: the keys needed beside the wrong one.
const std::map<std::string, Words> sound_calls{
    {"material", {{"name", "'m2'"}, {"density", "1800"}}},
    {"box", {{"size", "{.3, .2, .1}"}, {"at", "{9, 9, 0}"}, {"free", "true"}}},
    {"block", {{"vertices", corners}, {"free", "true"}}},
    {"prism", {{"polygon", "{ {0, 0}, {1, 0}, {0, 1} }"}, {"height", "1"}, {"at", "{9, 9, 0}"}, {"free", "true"}}},
    {"mesh", {{"file", "'cube.obj'"}, {"free", "true"}}},
    {"ground", {}},
    {"transform", {{"1", "function() end"}}},
    {"dry", {{"kn", "1e9"}, {"mu", ".6"}}},
    {"mortar", {{"kn", "1e9"}, {"ft", "1e5"}, {"c", "1e5"}, {"mu", ".6"}}},
    {"masonry_stiffness", {{"E", "5e9"}, {"spacing", ".5"}}},
    {"dilatant", {{"kn", "1e9"}, {"mu", ".6"}, {"psi", ".1"}, {"wear_slip", "5e-3"}}},
    {"joint", {{"law", "dry{ kn = 1e9, mu = .6 }"}}},
    {"sine", {{"amplitude", "1"}, {"frequency", "1"}}},
    {"ricker", {{"amplitude", "1"}, {"frequency", "1"}}},
    {"half_sine", {{"amplitude", "1"}, {"frequency", "1"}}},
    {"full_sine", {{"amplitude", "1"}, {"frequency", "1"}}},
    {"full_cosine", {{"amplitude", "1"}, {"frequency", "1"}}},
    {"mp_pulse", {{"amplitude", "1"}, {"frequency", "1"}, {"gamma", "2"}}},
    {"pulse", {{"amplitude", "1"}}},
    {"table_wave", {{"times", "{0, 1}"}, {"values", "{0, 1}"}}},
    {"curve_wave", {{"times", "{0, 1}"}, {"values", "{0, 1}"}}},
    {"record", {{"file", "'wave.csv'"}}},
    {"spectral_acceleration", {{"wave", "half_sine{ amplitude = 1, frequency = 1 }"}, {"period", "1"}}},
    {"ground_records", {{"x", "'wave.csv'"}}},
    {"ground_motion", {{"wave", "1"}}},
    {"force", {{"block", "'b'"}, {"wave", "1"}}},
    {"moment", {{"block", "'b'"}, {"wave", "1"}}},
    {"tilt", {{"wave", "1"}}},
    {"motion", {{"block", "'b'"}, {"wave", "1"}}},
    {"turning", {{"block", "'b'"}, {"wave", "1"}}},
    {"settle", {{"supports", supports}, {"by", ".1"}}},
    {"spread", {{"supports", supports}, {"by", ".1"}}},
    {"damping", {}},
    {"analysis", {{"duration", "1"}}},
    {"spectrum", {{"kind", "'EN 1998-1 type 1'"}, {"ground", "'B'"}, {"ag", "2"}}},
    {"recorder", {{"name", "'r'"}, {"quantity", "'displacement'"}, {"block", "'b'"}}},
    {"camera", {{"name", "'c'"}}},
    {"use_limit", {{"reason", "'it walks'"}}},
    {"bisect", {{"param", "'p'"}, {"lo", "0"}, {"hi", "1"}}},
    {"converge", {{"param", "'p'"}, {"values", "{.1, .2}"}, {"value", "function(run) return 1 end"}}},
    {"accuracy", {{"param", "'p'"}, {"values", "{ 2, 1 }"}}},
    {"ensemble", {{"n", "2"}, {"seed", "1"}, {"param", "'p'"}, {"value", "function(run) return 1 end"}}},
    {"figure", {{"name", "'f'"}, {"title", "'t'"}, {"x", "'x'"}, {"y", "'y'"}, {"curves", "{ { label = 'l', x = {1, 2}, y = {1, 2} } }"}}},
    {"rocking", {{"width", ".2"}, {"height", "1"}, {"theta", ".1"}, {"duration", "1"}}},
    {"rocking_overturning", {{"width", ".2"}, {"height", "1"}, {"wave", "half_sine{ amplitude = 1, frequency = 1 }"}, {"points", "10"}}},
    {"wall", {{"length", "1"}, {"courses", "2"}, {"brick", brick}, {"joint", ".01"}, {"quiet", "true"}, {"at", "{20, 20, 0}"}}},
    {"building", {{"plan", "{2, 2}"}, {"courses", "4"}, {"brick", brick}, {"joint", ".01"}, {"quiet", "true"}, {"at", "{20, 20, 0}"}}},
    {"arch", {{"radius", "1"}, {"thickness", ".2"}, {"width", ".3"}, {"voussoirs", "6"}, {"at", "{20, 20, 0}"}}},
    {"barrel", {{"radius", "1"}, {"thickness", ".2"}, {"width", ".6"}, {"voussoirs", "6"}, {"rows", "2"}, {"at", "{20, 20, 0}"}}},
    {"arcade",
     {{"spans", "{2}"},
      {"piers", "1.5"},
      {"width", "1"},
      {"block", "{ length = .5, height = .25 }"},
      {"tiers", "{ { springing = 1, top = 3, thickness = .3 } }"},
      {"quiet", "true"},
      {"at", "{20, 20, 0}"}}},
    {"buttress", {{"width", "1"}, {"depth", "1"}, {"courses", "4"}, {"block", "{ length = .5, height = .25 }"}, {"at", "{20, 20, 0}"}}},
    {"study", {{"scene", "'s.lua'"}, {"vary", "grid{ p = 1 }"}, {"collect", "'time_s'"}}},
    {"grid", {{"PARAM", "{1, 2}"}}},
    {"list", {{"1", "{ p = 1 }"}}},
    {"latin", {{"n", "3"}, {"PARAM", "{1, 2}"}}},
    {"random", {{"n", "3"}, {"PARAM", "{1, 2}"}}},
    {"perturbations", {{"n", "2"}}},
    {"records", {{"param", "'motion'"}, {"files", "{'a.csv'}"}}},
    {"calibration",
     {{"scene", "'s.lua'"},
      {"stages", "{ { fit = { p = {1, 2} } } }"},
      {"targets", "{ { label = 't', keys = {'time_s'}, values = {1} } }"}}},
    {"footed_block", {{"size", "{.2, .2, 1}"}, {"at", "{20, 20, 0}"}, {"free", "true"}}},
    {"column", {{"blocks", "2"}, {"size", "{.2, .2, .2}"}, {"at", "{20, 20, 0}"}}},
};

const std::map<std::string, std::vector<std::string>> wrong_of_type{
    {"number", {"'heavy'", "{}", "true", "0/0", "-1/0"}},
    {"integer", {"'many'", "{}", "true", "0/0", "1/0", "1.5", "1e18"}},
    {"string", {"5", "{}", "true", "'a\\nb'", "'a\\xff'"}},
    {"quantity", {"5", "'displacment'", "'x'"}},
    {"boolean", {"1", "'yes'", "{}"}},
    {"vec3", {"1", "'x'", "{1, 2}", "{1, 2, 'x'}", "{0/0, 0, 0}", "{0, 1/0, 0}", "{1, 2, 3, 4}"}},
    {"vec", {"1", "'x'", "{1, 2}", "{1, 2, 'x'}", "{0/0, 0, 0}", "{0, 1/0, 0}"}},
    {"points",
     {"1", "'x'", "{1}", "{{1, 2}}", "{{0/0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}", "{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}", "{}"}},
    {"pairs", {"1", "{}", "{1}", "{{1, 2, 3}}", "{{0, 0}, {1, 'x'}, {0, 1}}", "{{0, 0}, {1, 0/0}, {0, 1}}", "{{0, 0}, {1, 0}}"}},
    {"strings", {"5", "{5}", "true", "{{}}"}},
    {"numbers", {"5", "'x'", "{'x', 1}", "{0/0, 1}", "{1/0, 1}", "{}"}},
    {"faces", {"5", "{}", "{5}", "{{'a'}}", "{{0, 1, 2}}", "{{1, 2, 99}}", "{{1, 2}}", "{{1.5, 2, 3}}"}},
    {"direction", {"5", "'w'", "{0, 0, 0}", "{1, 2}", "{0/0, 0, 1}"}},
    {"points_per_face", {"'x'", "1.5", "0", "5", "{1}", "{0, 1}", "{1.5, 2}", "{1e9, 1e9}"}},
    {"law", {"5", "'dry'", "{}", "sine{ amplitude = 1, frequency = 1 }"}},
    {"wave", {"'x'", "{}", "true", "0/0", "dry{ kn = 1e9, mu = .6 }"}},
    {"function", {"5", "{}"}},
    {"question", {"5", "'x'", "{}"}},
    {"initial", {"5", "'x'", "{ velosity = {1, 0, 0} }", "{ velocity = 5 }", "{ spin = {0/0, 0, 0} }"}},
    {"parts", {"5", "{}", "{5}", "{ { vertexes = {} } }", "{ {} }"}},
    {"list", {"5", "{5}", "{ { unheard = 1 } }"}},
    {"table", {"5", "'x'"}},
    {"axes", {"5", "'x'", "{}", "{5}"}},
    {"values", {"{}", "true", "{0/0}", "{{}}", "0/0", "'a\\nb'"}},
    {"frictions", {"5", "'x'", "{5}", "{ nowhere = .5 }", "{ b = 'x' }", "{ b = {} }"}},
    {"range", {"5", "'x'", "{1}", "{2, 1}", "{0/0, 1}", "{1, 2, 3}"}},
    {"duration", {"'5 parsec'", "{}", "true", "-1", "0/0"}},
    {"bytes", {"'5 parsec'", "{}", "true", "-1", "0/0"}},
};

// Values beyond both ends of a key's range.
std::vector<std::string> out_of_range(const Key& key) {
  std::vector<std::string> values;
  const auto beyond = [](double end, double sign) { return fmt::format("{:.17g}", end + sign * std::max(1e-6, 0.01 * std::abs(end))); };
  if (std::isfinite(key.low)) values.push_back(beyond(key.low, -1));
  if (std::isfinite(key.high)) values.push_back(beyond(key.high, 1));
  return values;
}

std::string call_of(const std::string& name, const Words& words) {
  std::string keys;
  for (const auto& [key, value] : words) keys += (key == "1" ? value : key + " = " + value) + ", ";
  return name + "{ " + keys + "}";
}

// The correct call with one key changed; without `value`, the key is left out.
std::string with(const std::string& name, const std::string& key, const std::string& value) {
  Words words = sound_calls.at(name);
  std::erase_if(words, [&](const auto& word) { return word.first == key; });
  if (!value.empty()) words.emplace_back(key, value);
  return call_of(name, words);
}

struct BadCall {
  std::string call, about;  // about: required in the message; "" if a wrong table has a message of its own
};

void add_wrong(std::vector<BadCall>& all, const std::string& name, const Key& key,
               const std::function<std::string(const std::string&)>& say) {
  std::vector<std::string> values;
  if (const auto found = wrong_of_type.find(key.type); found != wrong_of_type.end()) values = found->second;
  if (key.type == "number" || key.type == "integer")
    for (auto& value : out_of_range(key)) values.push_back(value);
  if (!key.words.empty()) values.emplace_back("'nonsense'");
  for (const auto& value : values) all.push_back({say(value), key.name});
  for (const Key& inner : key.inner)
    add_wrong(all, name, inner, [&](const std::string& value) {
      std::string others;
      for (const Key& other : key.inner)
        if (other.required && other.name != inner.name) others += fmt::format("{} = .2, ", other.name);
      const std::string table = fmt::format("{{ {}{} = {} }}", others, inner.name, value);
      return say(key.type == "list" ? "{ " + table + " }" : table);
    });
}

std::vector<BadCall> all_bad() {
  std::vector<BadCall> all;
  for (const Function& function : all_functions()) {
    if (!takes_table(function) || function.name == "gravity") continue;
    const std::string& name = function.name;
    REQUIRE(sound_calls.contains(name));  // every new function of the language needs a line above
    for (const char* other : {"5", "'x'", "nil", "true"}) all.push_back({fmt::format("{}({})", name, other), name});
    all.push_back({with(name, "7", "").insert(name.size() + 1, " [1.5] = 1, "), ""});
    const bool names_params = std::any_of(function.keys.begin(), function.keys.end(), [](const Key& key) { return key.name == "PARAM"; });
    for (const Key& key : function.keys) {
      add_wrong(all, name, key, [&](const std::string& value) { return with(name, key.name, value); });
      if (key.name != "1" && !names_params) all.push_back({with(name, key.name + "z", "1"), key.name + "z"});
      if (key.required) all.push_back({with(name, key.name, ""), key.name == "1" ? "" : key.name});
    }
  }
  const std::pair<const char*, const char*> positional[] = {{"param({})", "param"},
                                                            {"param('q')", "param"},
                                                            {"param('q', true)", "param"},
                                                            {"param('q', 0/0)", "param"},
                                                            {"param('q', 1, 5)", "param"},
                                                            {"metric()", "metric"},
                                                            {"metric('m')", "metric"},
                                                            {"metric('m', 5, 1)", "metric"},
                                                            {"metric('m', '', 'x')", "metric"},
                                                            {"metric('m', '', 0/0)", "metric"},
                                                            {"expect()", "expect"},
                                                            {"expect('status')", "expect"},
                                                            {"expect('time_s', {}, {})", "expect"},
                                                            {"expect('time_s', 1, 5)", "expect"},
                                                            {"expect('time_s', 1, { rell = 1 })", "rell"},
                                                            {"expect('time_s', 1, { rel = -1 })", "rel"},
                                                            {"expect('time_s', 1, { rel = 0/0 })", "rel"},
                                                            {"expect('time_s', 1, { between = 1 })", "between"},
                                                            {"expect('time_z', 1, { rel = 1 })", "time_z"},
                                                            {"label()", "label"},
                                                            {"label(5)", "label"},
                                                            {"label({})", "label"},
                                                            {"include()", "include"},
                                                            {"include(5)", "include"},
                                                            {"include('no.lua')", "no.lua"},
                                                            {"include('/etc/passwd')", "/etc/passwd"},
                                                            {"gravity('x')", "gravity"},
                                                            {"gravity(0/0)", "gravity"},
                                                            {"gravity(1e9)", "gravity"},
                                                            {"gravity{ 1, 2 }", "gravity"},
                                                            {"gravity{ 1, 2, 'x' }", "gravity"},
                                                            {"gravity()", "gravity"},
                                                            {"gravity(0, 0, -9.81)", "3 values"},
                                                            {"metric('z', 'm', 1, 2)", "4 values"},
                                                            {"box({ size = {1, 1, 1}, free = true }, 5)", "2 values"},
                                                            {"family(5)", "family"},
                                                            {"family{ q = {1, 2} }", "q"},
                                                            {"family{ p = 5 }", "p"},
                                                            {"family{ p = {'x'} }", "p"},
                                                            {"family({ p = {1} }, 5)", "family"},
                                                            {"family({ p = {1} }, { seeds = 1 })", "seeds"}};
  for (const auto& [call, about] : positional) all.push_back({call, about});
  return all;
}

const std::string before = sound + "param('p', 1)\n";  // later statements are in line 7
const std::regex remedy(
    "must be|allowed|did you mean|known:|not one of|add |give |write |keys:|correct|check |takes |put |choose |make |use |name |keep "
    "|leave |remove |need");

// A word of study files is tried in one.
bool in_study(const std::string& call) {
  const Function* function = find_function(call.substr(0, call.find_first_of("{(")));
  return function != nullptr && (function->of_study || function->name == "study" || function->name == "calibration");
}

std::vector<std::string> mistakes_at(const std::string& folder, const std::string& call) {
  Script::Options options = quiet();
  options.study_file = in_study(call);
  const std::string rest = call.starts_with("study") || call.starts_with("calibration")
                               ? ""
                               : "\nstudy{ scene = 's.lua', vary = grid{ p = 1 }, collect = 'time_s' }";
  Script script(options);
  try {
    script.load_text(options.study_file ? "\n\n\n\n\n\n" + call + rest : before + "\n" + call, folder + "/scene.lua");
  } catch (const Errors& errors) { return errors.messages; }
  return {};
}

struct Beside {
  Bench bench;
  Beside() {
    bench.write("wave.csv", "time_s,a_m_s2\n0,0\n1,1\n");
    bench.write("cube.obj",
                "o cube\nv 5 5 5\nv 6 5 5\nv 6 6 5\nv 5 6 5\nv 5 5 7\nv 6 5 7\nv 5 6 7\nv 6 6 7\n"
                "f 4 3 2 1\nf 5 6 8 7\nf 2 3 8 6\nf 3 4 7 8\nf 4 1 5 7\nf 1 2 6 5\n");
  }
};

}  // namespace

TEST_CASE("the sound call of every function is sound", "[wrong]") {
  const Beside beside;
  for (const auto& [name, words] : sound_calls) {
    const auto mistakes = mistakes_at(beside.bench.folder.string(), call_of(name, words));
    INFO(name << ": " << fmt::format("{}", fmt::join(mistakes, "\n")));
    if (name == "spectrum")
      CHECK((mistakes.size() == 1 && mentions(mistakes, "take analysis{ kind = \"pushover\" }")));  // not of this scene
    else CHECK(mistakes.empty());
  }
}

TEST_CASE("every key of every function, wrong in each way, is refused with its place, its name and a remedy", "[wrong]") {
  const Beside beside;
  const auto all = all_bad();
  CHECK(all.size() > 2000);
  for (const BadCall& bad : all) {
    const auto mistakes = mistakes_at(beside.bench.folder.string(), bad.call);
    INFO(bad.call << "\n" << fmt::format("{}", fmt::join(mistakes, "\n")));
    CHECK(mentions(mistakes, "/scene.lua:7: "));
    CHECK((bad.about.empty() || mentions(mistakes, bad.about)));
    for (const auto& mistake : mistakes) {
      CHECK(is_plain(mistake));
      CHECK(std::regex_search(mistake, remedy));
    }
  }
}

TEST_CASE("the program ends with 2 for what is wrong, and leaves no folder", "[wrong]") {
  Beside beside;
  const auto all = all_bad();
  for (std::size_t i = 0; i < all.size(); i += 40) {
    INFO(all[i].call);
    CHECK(beside.bench.run(before + "\n" + all[i].call) == 2);
    CHECK(contains(beside.bench.said, "scene.lua:7: "));
    CHECK_FALSE(std::filesystem::exists(beside.bench.out()));
  }
}
