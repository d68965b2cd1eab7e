// PEER AT2 files: three lines of text, a line with the number of values and their step, then the values in Fortran columns.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/loads/record/record_file.h"

namespace erbs {
namespace {

struct Header {
  int points = 0;
  double dt = 0;  // s
};

// "NPTS=  5372, DT=   .0100 SEC", or the older "4000  0.0050  NPTS, DT": the two numbers have the order of the two words.
Header parse_header(const RecordText& text, size_t index) {
  const std::string line = lower(text.lines[index]);
  const Place place{text.path, static_cast<int>(index) + 1};
  double numbers[2] = {0, 0};
  int found = 0;
  for (const char* at = line.c_str(); *at != 0 && found < 2;) {
    char* end = nullptr;
    const bool starts = (*at >= '0' && *at <= '9') || *at == '.' || *at == '-';
    const double value = starts ? std::strtod(at, &end) : 0;
    if (starts && end != at) numbers[found++] = value;
    at = starts && end != at ? end : at + 1;
  }
  const size_t npts = line.find("npts"), dt = line.find("dt");
  if (found < 2 || dt == std::string::npos)
    throw Error("this line should give the number of values and their step; write it as \"NPTS= 4000, DT= .0100 SEC\"", place);
  if (dt < npts) std::swap(numbers[0], numbers[1]);
  if (line.find("msec", dt) != std::string::npos || line.find(" ms", dt) != std::string::npos)
    throw Error("the step is in ms; write it in s, as \"NPTS= 4000, DT= .0100 SEC\"", place);
  if (!(numbers[0] >= 2 && numbers[0] <= 1e8 && numbers[0] == std::floor(numbers[0])))
    throw Error(fmt::format("NPTS = {} is not a number of values; give an integer of at least 2", numbers[0]), place);
  if (!(numbers[1] > 0 && numbers[1] <= 1e3)) throw Error(fmt::format("DT = {} s is not a step; give one above 0", numbers[1]), place);
  return {static_cast<int>(numbers[0]), numbers[1]};
}

// Unit from "ACCELERATION TIME SERIES IN UNITS OF G" and its variants; "" if no line names it.
std::string header_unit(const RecordText& text, const Record& wanted, size_t npts_line, size_t& at_line) {
  for (size_t i = 0; i < npts_line; ++i) {
    const std::string line = lower(text.lines[i]);
    at_line = i;
    for (const std::string_view quantity : {"acceleration", "velocity", "displacement"})
      if (line.rfind(quantity, 0) == 0) check_quantity(quantity, wanted, {text.path, static_cast<int>(i) + 1});
    const size_t found = line.find("units of");
    if (found == std::string::npos) continue;
    const std::string_view rest = trim(std::string_view(line).substr(found + 8));
    return std::string(rest.substr(0, rest.find_first_of(" ,\t")));
  }
  at_line = npts_line;
  return {};
}

}  // namespace

RecordFile parse_at2(RecordText& text, const Record& wanted, size_t npts_line) {
  const Header header = parse_header(text, npts_line);
  const Place header_place{text.path, static_cast<int>(npts_line) + 1};
  checked_step(header.dt, wanted, header_place);
  size_t unit_line = 0;
  const std::string unit = header_unit(text, wanted, npts_line, unit_line);
  const double factor = factor_to_si(unit, wanted, {text.path, static_cast<int>(unit_line) + 1});
  RecordFile file{npts_line >= 2 ? std::string(trim(text.lines[1])) : "", "PEER AT2", {}, {}, {}};
  file.values = numbers_of(text, npts_line + 1, text.lines.size(), wanted);
  check_count(file.values.size(), header.points, "NPTS", header_place);
  for (double& value : file.values) value *= factor;
  for (int i = 0; i < header.points; ++i) file.times.push_back(wanted.first_time + i * header.dt);
  return file;
}

}  // namespace erbs
