// Time step, stiffness and damping of one scene with both solvers: its runs, its table, its figure.
#pragma once
#include "engine/study/stability_map.h"
#include "lua/options.h"

namespace erbs {

struct MapStudy {
  std::string scene, name, directory;
  std::string quantity, unit;
  double from = 0, window = 0;  // s of the scene's time
  Stiffness nominal;
  double critical_damping = 0;                        // 1/s, C_c / m = 2 omega of the stiffest block in translation, Gu and Miao's eq. (6)
  std::vector<std::pair<std::string, double>> steps;  // s, from short to long
  std::vector<double> dampings, factors;
  std::vector<MapRun> all;
};

void write_map_csv(const MapStudy& study, const std::string& command, const std::string& path);
// By gnuplot; the ending of the path, svg or png, says which.
void draw_map(const MapStudy& study, const std::string& path);

}  // namespace erbs
