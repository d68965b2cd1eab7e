// Stability map: one scene at many time steps, stiffnesses and dampings with both solvers. Its runs, its table, its figure.
#pragma once
#include "engine/study/stability_map.h"
#include "lua/program/options.h"

namespace erbs::lua {

struct MapStudy {
  std::string scene, name, directory;
  std::string quantity, unit;
  double from = 0, window = 0;  // s, simulated time of the scene
  study::Stiffness nominal;
  double critical_damping = 0;                        // 1/s, C_c / m = 2 omega of the stiffest block in translation, Gu and Miao eq. (6)
  std::vector<std::pair<std::string, double>> steps;  // name and length (s), from short to long
  std::vector<double> dampings, factors;
  std::vector<study::MapRun> all;
};

void write_map_csv(const MapStudy& study, const std::string& command, const std::string& path);
// Figure by gnuplot; the file extension, svg or png, selects the format.
void draw_map(const MapStudy& study, const std::string& path);

}  // namespace erbs::lua
