// The units that end the names of columns, and the units in which figures show them.
#pragma once
#include <string>
#include <vector>

namespace erbs::plot {

// Applies to peaks (SI) of `from` and more.
struct ShownUnit {
  double from, factor;  // factor: from SI to the unit
  const char* name;
};

struct Unit {
  const char* suffix;            // "m_s2"
  const char* quantity;          // "acceleration"
  std::vector<ShownUnit> shown;  // the largest `from` first
};

const Unit* find_unit(const std::string& suffix);  // null if there is none
const ShownUnit& shown_unit(const Unit& unit, double peak);

// unit_of: the unit at the end of a column's name ("m_s2"), or "". words_of: the rest of the name in plain words.
std::string unit_of(const std::string& column);
std::string words_of(const std::string& column);
// The SI unit of a column as figures write it ("m/s²"), or "".
std::string unit_name(const std::string& column);
// For an axis in SI: "shake_m_s2" reads "shake [m/s²]".
std::string label_of(const std::string& column);

}  // namespace erbs::plot
