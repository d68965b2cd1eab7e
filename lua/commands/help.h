// Help texts of the scene language.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "lua/language/api.h"

namespace erbs::lua {

std::vector<Function> all_functions();  // the functions of the table, then the ones written in Lua
bool is_function(const std::string& name);
std::string function_help(const std::string& name);  // throws Error with the nearest known name
std::string functions_list();
std::string editor_file();  // the text of erbs.meta.lua

// The table `run` that a metric function receives.
inline constexpr std::string_view run_help = R"(the table run:
  the keys of metrics.json (run.time_s, run.energy, run.collapse ...), and all of them in run.metrics
  run.metrics.metrics      metrics above this one, and results of the scene's studies, by their names
  run.time                 times of the rows of histories.csv (s)
  run.columns              names of its columns
  run.history(column)      its values, one per row
  run.peak(column)         largest magnitude;  run.peak_time(column) its time (s)
  run.max(column), run.min(column), run.mean(column), run.rms(column), run.first(column), run.last(column)
  run.at(column, t)        value at time t, linear between rows; nil beyond the run
  run.frequency(column, from, to)  dominant frequency (Hz), in a band if one is given: Hann window, spectrum, parabola through the peak
  run.period(column)       mean time between rising crossings of zero (s)
  run.crossings(column, level, rising)   times at which the column crosses the level
  run.events               { { time, event, name, value }, ... } of events.csv; run.first_crack is the first crack, or nil
)";

inline constexpr std::string_view editor_head = R"(---@meta
-- The scene language of ERBS for editors (LuaCATS). Written by `erbs help --editor > lua/erbs.meta.lua` from the table of the
-- program; a test compares the two. All numbers are SI; units are factors: 5*mm, 0.2*MPa, 30*deg, 0.4*g.

---@alias erbs.vec3 number[] x, y, z
---@class erbs.law a joint law
---@class erbs.wave a function of time; wave(t) is its value
---@operator call(number): number
---@class erbs.axes what a study varies

---@class erbs.run argument of a metric function: the keys of metrics.json, and
---@field metrics table metrics.json
---@field time number[] times of the rows of histories.csv [s]
---@field columns string[] names of the columns of histories.csv
---@field history fun(column: string): number[] values, one per row
---@field peak fun(column: string): number largest magnitude
---@field peak_time fun(column: string): number time of the largest magnitude [s]
---@field max fun(column: string): number
---@field min fun(column: string): number
---@field mean fun(column: string): number
---@field rms fun(column: string): number
---@field first fun(column: string): number
---@field last fun(column: string): number
---@field at fun(column: string, t: number): number value at time t [s], linear between rows
---@field frequency fun(column: string, from?: number, to?: number): number dominant frequency, in a band if one is given [Hz]
---@field period fun(column: string): number mean time between rising crossings of zero [s]
---@field crossings fun(column: string, level?: number, rising?: boolean): number[] times of crossing the level [s]
---@field events { time: number, event: string, name: string, value: number }[] events.csv
---@field first_crack { time: number, name: string }? the first crack

m, cm, mm, km = 1, 1e-2, 1e-3, 1e3 -- m
s, ms = 1, 1e-3 -- s
kg, t = 1, 1e3 -- kg; t is the tonne
N, kN, MN = 1, 1e3, 1e6 -- N
Pa, kPa, MPa, GPa = 1, 1e3, 1e6, 1e9 -- Pa
J, Hz = 1, 1 -- J, 1/s
pi, deg = math.pi, math.pi / 180 -- rad
g = 9.81 -- m/s2
start_noise = 0 -- noise in the initial state of every free block: erbs run --noise, erbs test --grid [m and rad]

)";

}  // namespace erbs::lua
