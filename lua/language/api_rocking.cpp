// Functions of a script: the equations of a rigid rocking block, solved while the scene is read or inside a metric.
// A scene of one block compares its run with them.
#include <cmath>
#include <lua5.4/lua.hpp>

#include "engine/analysis/flat_bed.h"
#include "engine/analysis/rocking.h"
#include "lua/language/api.h"

namespace erbs::lua {
namespace {

Keys block_keys() {
  return {
      {"width", "number", "m", "base of the block; with `height` it gives alpha, p and mu of a homogeneous block", 1e-6, 1e6},
      {"height", "number", "m", "height of the block", 1e-6, 1e6},
      {"alpha", "number", "rad", "slenderness, atan(width / height) (default from width and height)", 1e-6, 1.5},
      {"p", "number", "rad/s", "sqrt(m g R / I0) (default from width and height: sqrt(3 g / (4 R)))", 1e-6, 1e6},
      {"mu", "number", "", "spin after an impact over the spin before (default Housner's: 1 - 3/2 sin^2 alpha)", 0, 1},
      {"gravity", "number", "m/s2", "strength of gravity (default: the scene's)", 1e-6, 1000},
      {"linear", "boolean", "", "small angles: sin x = x, cos x = 1", -unbounded, unbounded, false, "", "false"},
  };
}

analysis::RockingBlock read_block(Call& call, Arguments& arguments) {
  double width = 1, height = 1, gravity = call.context.scene.gravity.norm();
  arguments.read("width", width);
  arguments.read("height", height);
  arguments.read("gravity", gravity);
  if (arguments.has("width") != arguments.has("height")) arguments.mistake("give width and height both");
  if (!arguments.has("width") && !(arguments.has("alpha") && arguments.has("p")))
    arguments.mistake("the block is not given; say width and height, or alpha and p");
  if (!(gravity > 0)) {
    arguments.mistake("the scene has no gravity; give gravity = 9.81");
    gravity = standard_g;
  }
  analysis::RockingBlock block = analysis::homogeneous_block(width, height, gravity);
  arguments.read("alpha", block.alpha);
  if (arguments.has("alpha")) block.mu = std::max(0.0, 1 - 1.5 * std::pow(std::sin(block.alpha), 2));
  arguments.read("p", block.p);
  arguments.read("mu", block.mu);
  arguments.read("linear", block.linear);
  if (block.mu < 0)
    arguments.mistake(fmt::format("Housner's mu = {:.3g} of so stout a block is below zero: it does not rock; give mu", block.mu)),
        block.mu = 0;
  return block;
}

void set(lua_State* lua, const char* key, double value) {
  lua_pushnumber(lua, value);
  lua_setfield(lua, -2, key);
}

void set(lua_State* lua, const char* key, const std::vector<double>& values, double scale = 1) {
  lua_createtable(lua, static_cast<int>(values.size()), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    lua_pushnumber(lua, scale * values[i]);
    lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
  }
  lua_setfield(lua, -2, key);
}

void describe(lua_State* lua, const analysis::RockingBlock& block) {
  set(lua, "alpha", block.alpha);
  set(lua, "p", block.p);
  set(lua, "mu", block.mu);
  set(lua, "threshold", block.gravity * (block.linear ? block.alpha : std::tan(block.alpha)));
}

// The wave of the key "wave"; a Lua function is sampled over `duration`.
std::optional<Wave> read_wave(Arguments& arguments, double duration) {
  double sample = 1e-3;
  arguments.read("sample", sample);
  if (arguments.has("sample") && !arguments.is_function("wave"))
    arguments.mistake("\"sample\" is for a wave that is a Lua function; remove it");
  return arguments.wave("wave", duration, sample);
}

// The bed of the keys kn, density and restitution.
struct Bed {
  analysis::BedToe toe;
  double kept = 0;  // spin after an impact of the whole face over the spin before
};

std::optional<Bed> read_bed(Call& call, Arguments& arguments, const analysis::RockingBlock& block) {
  double width = 0, height = 0, kn = 0, density = 0, restitution = 0.3;
  arguments.read("width", width);
  arguments.read("height", height);
  arguments.read("kn", kn);
  arguments.read("density", density);
  arguments.read("restitution", restitution);
  if (!arguments.has("kn")) {
    for (const char* key : {"density", "restitution"})
      if (arguments.has(key))
        arguments.mistake(fmt::format("\"{}\" is of the block on a bed; give kn, the stiffness of the bed, or remove it", key));
    return std::nullopt;
  }
  if (!arguments.has("width") || !arguments.has("density")) {
    arguments.mistake("a bed of the stiffness kn asks for width, height and density of the block; give them");
    return std::nullopt;
  }
  if (!(width > 0 && height > 0 && kn > 0 && density > 0)) return std::nullopt;
  const double b = width / 2, h = height / 2, radius2 = (b * b + h * h) / 3;
  const Bed bed{analysis::toe_on_bed(b, h, radius2, density * block.gravity * height / kn, block.gravity),
                analysis::spin_kept(radius2 + h * h, b, b * analysis::impulse_share(restitution))};
  const analysis::RockingBlock rigid = analysis::homogeneous_block(width, height, block.gravity);
  const std::string note = fmt::format(
      "{}: rocking: a block of {:g} x {:g} m on a bed of {:.3g} Pa/m. {}. With its whole face on the bed an impact keeps about {:.3f} of "
      "the "
      "spin where Housner's block keeps {:.3f}; feet at its edges make it his: footed_block{{}}",
      call.place.text(), width, height, kn, told(bed.toe, b, rigid.alpha, rigid.p), bed.kept, rigid.mu);
  std::vector<std::string>& notes = call.context.scene.notes;
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  return bed;
}

int rocking(Call& call) {
  const std::size_t told_before = call.context.told();
  Arguments arguments = call.arguments();
  const analysis::RockingBlock block = read_block(call, arguments);
  const std::optional<Bed> bed = read_bed(call, arguments, block);
  analysis::RockingStart start;
  double duration = 0;
  arguments.read("theta", start.theta);
  arguments.read("spin", start.spin);
  arguments.read("duration", duration);
  const auto wave = read_wave(arguments, duration);
  if (std::fabs(start.theta) >= block.alpha)
    arguments.mistake(
        fmt::format("theta = {} rad is past alpha = {:.4g} rad: the block falls at once; make it smaller", start.theta, block.alpha));
  analysis::RockingRun run;
  const bool sound = call.context.told() == told_before;  // a value out of range may take for ever
  if (sound && duration > 0) run = rock(block, {wave ? &*wave : nullptr, 1}, start, duration);
  lua_newtable(call.lua);
  describe(call.lua, block);
  if (bed) {
    lua_newtable(call.lua);
    set(call.lua, "toe", bed->toe.width);
    set(call.lua, "inwards", bed->toe.inwards);
    set(call.lua, "alpha", bed->toe.alpha);
    set(call.lua, "p", bed->toe.p);
    set(call.lua, "mu", bed->kept);
    set(call.lua, "threshold", bed->toe.threshold * block.gravity * std::tan(block.alpha));
    lua_setfield(call.lua, -2, "bed");
  }
  set(call.lua, "t", run.t);
  set(call.lua, "theta", run.theta);
  set(call.lua, "impacts", run.impact);
  set(call.lua, "amplitudes", run.amplitude, 1 / block.alpha);
  lua_pushboolean(call.lua, run.overturned);
  lua_setfield(call.lua, -2, "overturned");
  if (run.overturned) set(call.lua, "overturned_at", run.overturned_at);
  return 1;
}

int rocking_overturning(Call& call) {
  const std::size_t told_before = call.context.told();
  Arguments arguments = call.arguments();
  const analysis::RockingBlock block = read_block(call, arguments);
  std::string criterion = "overturning";
  double low = 0.9, high = 20;
  int points = 1000;
  arguments.read("criterion", criterion);
  arguments.read("from", low);
  arguments.read("to", high);
  arguments.read("points", points);
  if (low >= high) arguments.mistake("from must be below to");
  double duration = 0;
  arguments.read("duration", duration);
  const auto wave = read_wave(arguments, duration);
  if (wave && duration == 0 && std::isfinite(end_time(*wave))) duration = end_time(*wave) + 12 / block.p;
  if (duration == 0 && (wave || arguments.is_function("wave")))
    arguments.mistake("the wave does not end; say how long to watch: duration = ...");
  std::vector<analysis::OverturningBand> bands;
  const analysis::Criterion asked = criterion == "alpha_at_end" ? analysis::Criterion::alpha_at_end : analysis::Criterion::overturning;
  if (wave && duration > 0 && call.context.told() == told_before)
    bands = overturning_bands(block, *wave, asked, low, high, points, duration);
  lua_newtable(call.lua);
  describe(call.lua, block);
  if (!bands.empty()) set(call.lua, "lowest", bands.front().from);
  lua_createtable(call.lua, static_cast<int>(bands.size()), 0);
  for (std::size_t i = 0; i < bands.size(); ++i) {
    lua_newtable(call.lua);
    set(call.lua, "from", bands[i].from);
    set(call.lua, "to", bands[i].to);
    set(call.lua, "impacts", bands[i].impacts);
    lua_rawseti(call.lua, -2, static_cast<lua_Integer>(i + 1));
  }
  lua_setfield(call.lua, -2, "bands");
  return 1;
}

}  // namespace

std::vector<Function> companion_functions() {
  const Key sample{"sample", "number", "s", "sampling step of a Lua function", 1e-6, 10, false, "", "0.001"};
  return {
      {"rocking", rocking, "{ ... }",
       "table: alpha, p, mu, threshold (m/s2), t, theta (rad), impacts (s), amplitudes (over alpha, before each impact), overturned, "
       "overturned_at; with kn: bed = { toe, inwards (m, from the edge to the line about which the block turns), alpha, p, mu, threshold "
       "}, "
       "as the bed changes them",
       "Solution of Housner's equations for a rigid rocking block, to compare with a scene of one block.",
       joined({block_keys(),
               {{"wave", "wave", "m/s2", "acceleration of the ground (default: none, free rocking)"},
                sample,
                {"theta", "number", "rad", "tilt at the start", -1.5, 1.5, false, "", "0"},
                {"spin", "number", "rad/s", "spin at the start", -1e3, 1e3, false, "", "0"},
                {"kn", "number", "Pa/m", "stiffness of a bed, of which erbs check and the log then tell what it does to this block", 1e3,
                 1e16},
                {"density", "number", "kg/m3", "of the block on the bed", 0.01, 1e5},
                {"restitution", "number", "", "of the block on the bed", 0, 1, false, "", "0.3"},
                {"duration", "number", "s", "simulated time", 1e-9, 1e5, true}}})},
      {"rocking_overturning", rocking_overturning, "{ ... }",
       "table: alpha, p, mu, threshold (m/s2), lowest (factor), bands { { from, to, impacts }, ... } whose gaps are safe islands",
       "Factors on a wave at which a rigid rocking block overturns from rest.",
       joined({block_keys(),
               {{"wave", "wave", "m/s2", "acceleration of the ground for a factor of 1", -unbounded, unbounded, true},
                sample,
                {"criterion", "string", "", "overturning: it falls; alpha_at_end: |theta| has reached alpha when the wave ends", 0, 0,
                 false, "overturning|alpha_at_end", "overturning"},
                {"from", "number", "", "smallest factor tried", 0, 1e9, false, "", "0.9"},
                {"to", "number", "", "largest factor tried", 0, 1e9, false, "", "20"},
                {"points", "integer", "", "number of factors tried in between; narrower safe islands are not found", 1, 100000, false, "",
                 "1000"},
                {"duration", "number", "s", "simulated time (default: until 12 / p after the wave; required for a Lua function)", 1e-9,
                 1e5}}})},
  };
}

}  // namespace erbs::lua
