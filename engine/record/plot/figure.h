// A figure: panels of series on one sheet, in one style, drawn by gnuplot. Places, looks and settings are in gnuplot's own words.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace erbs::plot {

struct Label {
  std::string text, at, look = {};  // at: "screen 0.1,0.9" or "graph 0, first 3"
};

struct Axis {
  std::string label = {}, range = {}, tics = {}, format = {}, look = {};  // "": as gnuplot chooses; look: of the label
  bool log = false;
};

struct Series {
  std::string source, look, title = {};  // source: "$d0 using 1:2", a name of add_rows() or the quoted name of a file
};

struct Box {
  double left = 0, right = 1, bottom = 0, top = 1;  // shares of the sheet
};

struct AxesBox {
  std::optional<double> left = 0;  // none: as the numbers of the axis leave room
  double right = 1, bottom = 0, top = 1;
};

struct Panel {
  Box cell = {};                     // with its labels
  std::optional<AxesBox> axes = {};  // of the axes alone; none: as the cell leaves room
  Axis x = {}, y = {};
  std::string key = {};       // place and form of the legend; "": none
  std::string settings = {};  // further lines, such as a palette
  std::vector<Label> labels = {};
  std::vector<std::string> lines = {};  // "from 0,0 to 1,1 lw 2"
  std::vector<Series> series = {};

  void add_vertical(double x_at, const std::string& look);
  void add_horizontal(double y_at, const std::string& look);
};

// One for each of several runs: told apart by readers who confuse red and green.
inline constexpr std::array<const char*, 7> run_colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

struct Figure {
  double width = 0, height = 0;  // px
  int font = 13;                 // of an SVG; a PNG is set two points smaller
  std::string grid = "x y";      // axes with grid lines
  std::string settings = {};     // for all panels
  std::vector<Label> labels = {};
  std::vector<Panel> panels = {};
  std::string data = {};  // blocks of rows
  int blocks = 0;

  std::string add_rows(const std::string& rows);  // numbers, one point a line; the name for Series::source
  bool empty() const;                             // no panel has a series
};

// The script for gnuplot. Panels without a series are left out.
std::string script_of(const Figure& figure, bool png = false);
// Draws at `path`, whose extension, svg or png, gives the format. Does nothing for an empty figure. Throws Error.
void draw(const Figure& figure, const std::string& path);

}  // namespace erbs::plot
