#include "engine/record/plot/unit.h"

#include <algorithm>

namespace erbs::plot {
namespace {

// Longer endings come first.
const std::vector<Unit>& units() {
  static const std::vector<Unit> list{
      {"kg_m2_s", "angular momentum", {{0, 1, "kg m²/s"}}},
      {"kg_m_s", "momentum", {{0, 1, "kg m/s"}}},
      {"kg_m3", "density", {{0, 1, "kg/m³"}}},
      {"kg_m2", "moment of inertia", {{0, 1, "kg m²"}}},
      {"J_m2", "fracture energy", {{0, 1, "J/m²"}}},
      {"J_m", "energy per length", {{0, 1, "J/m"}}},
      {"Pa_m", "stiffness", {{1e8, 1e-9, "GPa/m"}, {1e5, 1e-6, "MPa/m"}, {0, 1, "Pa/m"}}},
      {"1_s", "rate", {{0, 1, "1/s"}}},
      {"rad_s2", "angular acceleration", {{0, 1, "rad/s²"}}},
      {"m_s2", "acceleration", {{0, 1, "m/s²"}}},
      {"rad_s", "spin", {{0, 1, "rad/s"}}},
      {"m_s", "velocity", {{0.5, 1, "m/s"}, {0, 1e3, "mm/s"}}},
      {"N_m", "moment", {{1e3, 1e-3, "kN m"}, {0, 1, "N m"}}},
      {"Pa", "stress", {{1e5, 1e-6, "MPa"}, {1e2, 1e-3, "kPa"}, {0, 1, "Pa"}}},
      {"rad", "rotation", {{0.05, 1, "rad"}, {0, 1e3, "mrad"}}},
      {"deg", "angle", {{0, 1, "deg"}}},
      {"Hz", "frequency", {{0, 1, "Hz"}}},
      {"kg", "mass", {{0, 1, "kg"}}},
      {"N", "force", {{1e6, 1e-6, "MN"}, {1e3, 1e-3, "kN"}, {0, 1, "N"}}},
      {"J", "energy", {{1e6, 1e-6, "MJ"}, {1e3, 1e-3, "kJ"}, {1, 1, "J"}, {0, 1e3, "mJ"}}},
      {"m", "displacement", {{1, 1, "m"}, {1e-4, 1e3, "mm"}, {0, 1e6, "µm"}}},
      {"s", "time", {{0, 1, "s"}}},
  };
  return list;
}

}  // namespace

const Unit* find_unit(const std::string& suffix) {
  for (const Unit& u : units())
    if (suffix == u.suffix) return &u;
  return nullptr;
}

const ShownUnit& shown_unit(const Unit& unit, double peak) {
  for (const ShownUnit& s : unit.shown)
    if (peak >= s.from) return s;
  return unit.shown.back();
}

std::string unit_of(const std::string& column) {
  for (const Unit& u : units()) {
    const std::string end = std::string("_") + u.suffix;
    if (column.size() > end.size() && column.ends_with(end)) return u.suffix;
  }
  return "";
}

std::string words_of(const std::string& column) {
  const std::string unit = unit_of(column);
  std::string words = column.substr(0, column.size() - (unit.empty() ? 0 : unit.size() + 1));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string unit_name(const std::string& column) {
  const Unit* unit = find_unit(unit_of(column));
  if (!unit) return "";
  std::string shown = unit->suffix;
  for (const ShownUnit& one : unit->shown)
    if (one.factor == 1) shown = one.name;
  return shown;
}

std::string label_of(const std::string& column) {
  const std::string unit = unit_name(column);
  return words_of(column) + (unit.empty() ? "" : " [" + unit + "]");
}

}  // namespace erbs::plot
