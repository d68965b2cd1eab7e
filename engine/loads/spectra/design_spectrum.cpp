#include "engine/loads/spectra/design_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/units.h"

namespace erbs {
namespace {

// EN 1998-1:2004, tables 3.2 (type 1) and 3.3 (type 2).
struct GroundType {
  char name;
  double S, TB, TC, TD;  // -, s
};
constexpr std::array<GroundType, 5> type1{{{'A', 1.0, 0.15, 0.4, 2.0},
                                           {'B', 1.2, 0.15, 0.5, 2.0},
                                           {'C', 1.15, 0.2, 0.6, 2.0},
                                           {'D', 1.35, 0.2, 0.8, 2.0},
                                           {'E', 1.4, 0.15, 0.5, 2.0}}};
constexpr std::array<GroundType, 5> type2{{{'A', 1.0, 0.05, 0.25, 1.2},
                                           {'B', 1.35, 0.05, 0.25, 1.2},
                                           {'C', 1.5, 0.1, 0.25, 1.2},
                                           {'D', 1.8, 0.1, 0.3, 1.2},
                                           {'E', 1.6, 0.05, 0.25, 1.2}}};

constexpr double tbsc_last = 6;  // s, T_L of TBSC 2018 section 2.3.4

bool is_en(const DesignSpectrum& s) { return s.kind.starts_with("EN 1998-1"); }

GroundType ground_of(const DesignSpectrum& s) {
  GroundType own{' ', 0, 0, 0, 0};
  for (const GroundType& one : s.kind == "EN 1998-1 type 2" ? type2 : type1)
    if (s.ground.size() == 1 && s.ground[0] == one.name) own = one;
  if (s.S > 0) own.S = s.S;
  if (s.TB > 0) own.TB = s.TB;
  if (s.TC > 0) own.TC = s.TC;
  if (s.TD > 0) own.TD = s.TD;
  return own;
}

// Both codes draw one shape: from `start` up to `plateau`, then 1 / T, then 1 / T^2.
struct CodeShape {
  double start, plateau;  // m/s2
};
CodeShape shape_of(const DesignSpectrum& s) {
  if (!is_en(s)) return {0.4 * s.SDS * standard_g, s.SDS * standard_g};  // TBSC 2018 (2.2)
  const double peak = s.ag * ground_of(s).S;
  return {peak, 2.5 * damping_correction(s.damping) * peak};  // EN 1998-1:2004 (3.2) to (3.5)
}

void check_table(const DesignSpectrum& s, std::vector<std::string>& mistakes) {
  const auto say = [&](std::string_view text) { mistakes.emplace_back(text); };
  if (s.period.size() < 2) return say("table needs two rows at least; give { { T = 0, Sa = 0.3*g }, { T = 0.1, Sa = 0.7*g }, ... }");
  if (s.period.front() != 0)
    say(fmt::format("table begins at T = {:g} s; put {{ T = 0, Sa = ... }} first, the peak acceleration of the ground", s.period.front()));
  for (std::size_t i = 1; i < s.period.size(); ++i)
    if (!(s.period[i] > s.period[i - 1]))
      say(fmt::format("table: T = {:g} s in row {} does not follow {:g} s; list the periods in growing order, each once", s.period[i],
                      i + 1, s.period[i - 1]));
  if (*std::max_element(s.acceleration.begin(), s.acceleration.end()) <= 0)
    say("table asks for no acceleration; give Sa in m/s2, as 0.7*g");
  if (!(s.TC > 0)) say("table needs TC, the period at which its plateau ends: N2 treats shorter periods in another way; add TC = 0.5, say");
  else if (s.TC > s.period.back())
    say(fmt::format("TC = {:g} s lies beyond the last row of the table, {:g} s; take a smaller TC, or add rows", s.TC, s.period.back()));
}

void check_en(const DesignSpectrum& s, std::vector<std::string>& mistakes) {
  const auto say = [&](std::string_view text) { mistakes.emplace_back(text); };
  if (!(s.ag > 0)) say("EN 1998-1 needs ag, the ground acceleration on ground A; add ag = 0.2*g, say");
  const bool own = s.S > 0 && s.TB > 0 && s.TC > 0 && s.TD > 0;
  if (s.ground.empty() && !own) return say("EN 1998-1 needs a ground type; add ground = \"B\", say, or all of S, TB, TC and TD");
  const CornerPeriods corner = corner_periods(s);
  if (!(corner.begin <= corner.end && corner.end < corner.last))
    say(fmt::format("corner periods must grow, and TB = {:g} s, TC = {:g} s, TD = {:g} s do not; give TB <= TC < TD", corner.begin,
                    corner.end, corner.last));
}

void check_tbsc(const DesignSpectrum& s, std::vector<std::string>& mistakes) {
  if (!(s.SDS > 0 && s.SD1 > 0)) {
    mistakes.emplace_back("TBSC 2018 needs SDS and SD1, shares of g of the site and its soil; add SDS = 0.9, SD1 = 0.25, say");
    return;
  }
  const CornerPeriods corner = corner_periods(s);
  if (!(corner.end < corner.last))
    mistakes.push_back(fmt::format("corner periods must grow, and T_B = SD1 / SDS = {:g} s lies beyond T_L = {:g} s; check SDS and SD1",
                                   corner.end, corner.last));
}

// Keys that another kind reads.
void check_strangers(const DesignSpectrum& s, std::vector<std::string>& mistakes) {
  const bool en = is_en(s), tbsc = s.kind == "TBSC 2018", table = s.kind == "table";
  const DesignSpectrum unset;
  const auto stranger = [&](bool given, bool welcome, const char* key, const char* kind) {
    if (given && !welcome) mistakes.push_back(fmt::format("{} belongs to kind = \"{}\"; leave it out of \"{}\"", key, kind, s.kind));
  };
  stranger(!s.ground.empty(), en, "ground", "EN 1998-1 type 1");
  stranger(s.ag != 0, en, "ag", "EN 1998-1 type 1");
  stranger(s.damping != unset.damping, en, "damping", "EN 1998-1 type 1");
  stranger(s.S != 0, en, "S", "EN 1998-1 type 1");
  stranger(s.TB != 0, en, "TB", "EN 1998-1 type 1");
  stranger(s.TC != 0, en || table, "TC", "EN 1998-1 type 1");
  stranger(s.TD != 0, en, "TD", "EN 1998-1 type 1");
  stranger(s.SDS != 0, tbsc, "SDS", "TBSC 2018");
  stranger(s.SD1 != 0, tbsc, "SD1", "TBSC 2018");
  stranger(!s.period.empty(), table, "table", "table");
}

}  // namespace

std::vector<std::string> check_spectrum(const DesignSpectrum& s) {
  std::vector<std::string> mistakes;
  if (s.kind.empty())
    return {"there is no spectrum; add kind = \"EN 1998-1 type 1\" or \"TBSC 2018\", or table = { { T = 0, Sa = ... }, ... }"};
  check_strangers(s, mistakes);
  if (is_en(s)) check_en(s, mistakes);
  else if (s.kind == "TBSC 2018") check_tbsc(s, mistakes);
  else check_table(s, mistakes);
  return mistakes;
}

CornerPeriods corner_periods(const DesignSpectrum& s) {
  if (s.kind == "table") return {0, s.TC, 0};
  if (!is_en(s)) return {0.2 * s.SD1 / s.SDS, s.SD1 / s.SDS, tbsc_last};  // TBSC 2018 (2.3)
  const GroundType ground = ground_of(s);
  return {ground.TB, ground.TC, ground.TD};
}

double damping_correction(double damping) { return std::max(0.55, std::sqrt(10 / (5 + 100 * damping))); }

double last_period(const DesignSpectrum& s) { return s.kind == "table" ? s.period.back() : unbounded; }

double spectral_acceleration(const DesignSpectrum& s, double period) {
  if (s.kind == "table") {
    if (!(period <= s.period.back()))
      throw Error(fmt::format("the period {:.4g} s lies beyond the last row of the spectrum, {:g} s; add rows to its table", period,
                              s.period.back()));
    const std::size_t i = std::size_t(std::upper_bound(s.period.begin() + 1, s.period.end() - 1, period) - s.period.begin());
    const double share = (period - s.period[i - 1]) / (s.period[i] - s.period[i - 1]);
    return s.acceleration[i - 1] + share * (s.acceleration[i] - s.acceleration[i - 1]);
  }
  const CodeShape shape = shape_of(s);
  const CornerPeriods corner = corner_periods(s);
  if (period < corner.begin) return shape.start + (shape.plateau - shape.start) * period / corner.begin;
  if (period <= corner.end) return shape.plateau;
  if (period <= corner.last) return shape.plateau * corner.end / period;
  return shape.plateau * corner.end * corner.last / (period * period);
}

double spectral_displacement(const DesignSpectrum& s, double period) {
  return spectral_acceleration(s, period) * period * period / (4 * pi * pi);  // EN 1998-1:2004 (3.7)
}

std::string spectrum_name(const DesignSpectrum& s) {
  if (s.kind == "TBSC 2018") return fmt::format("TBSC 2018, SDS = {:g}, SD1 = {:g}", s.SDS, s.SD1);
  if (!is_en(s)) return fmt::format("table of {} periods", s.period.size());
  std::string text = s.kind + (s.ground.empty() ? "" : ", ground " + s.ground) + fmt::format(", ag = {:.3g} g", s.ag / standard_g);
  for (const auto& [key, value] : {std::pair{"S", s.S}, {"TB", s.TB}, {"TC", s.TC}, {"TD", s.TD}})
    if (value > 0) text += fmt::format(", {} = {:g}", key, value);
  return text + (s.damping == 0.05 ? "" : fmt::format(", damping {:g} %", 100 * s.damping));
}

}  // namespace erbs
