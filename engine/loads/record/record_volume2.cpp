// Corrected records of strong-motion centres, "Volume 2": headers, then for each quantity a line that announces its values.
// COSMOS (format 1.20): "12091 acceleration pts, approx 120 secs, units=cm/sec2(04),Format=(8F10.5)", after blocks "100 Real-header values
// follow on 17 lines, Format=(6F13.6)"; value 62 is the final step in ms, value 34 the step of the raw data in s.
// CSMIP: "5000 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.3)".
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "engine/base/text.h"
#include "engine/loads/record/record_file.h"

namespace erbs {
namespace {

constexpr std::array<std::string_view, 3> quantities{"acceleration", "velocity", "displacement"};

int line_number(size_t index) { return static_cast<int>(index) + 1; }

bool is_cosmos(const std::string& line) { return line.find(" pts") != std::string::npos && line.find("units=") != std::string::npos; }
bool is_csmip(const std::string& line) {
  return line.find("points of ") != std::string::npos && line.find("equally spaced at") != std::string::npos;
}

// "acceleration" or "accel", "velocity" or "veloc", "displacement" or "displ"; "" for another line.
std::string_view announced(const std::string& line) {
  if (!is_cosmos(line) && !is_csmip(line)) return "";
  for (const std::string_view quantity : quantities)
    if (line.find(quantity.substr(0, 5)) != std::string::npos) return quantity;
  return "";
}

double number_after(const std::string& line, const std::string& word) {
  const size_t at = line.find(word);
  return at == std::string::npos ? NAN : std::strtod(line.c_str() + at + word.size(), nullptr);
}

// Width of the columns, from "(8F10.5)" or "(1E15.6)" at the end of the line; 0 if there is no such text.
size_t width_of(const std::string& line) {
  for (size_t open = line.rfind('('); open != std::string::npos && open > 0; open = line.rfind('(', open - 1)) {
    char* end = nullptr;
    std::strtol(line.c_str() + open + 1, &end, 10);
    if (end != nullptr && (*end == 'f' || *end == 'e' || *end == 'i')) return static_cast<size_t>(std::strtol(end + 1, nullptr, 10));
  }
  return 0;
}

// The real header in front of the data.
std::vector<double> real_header(const RecordText& text, size_t data_line) {
  for (size_t i = data_line; i-- > 0;) {
    const std::string line = lower(text.lines[i]);
    const size_t found = line.find("real-header values follow");
    if (found == std::string::npos) continue;
    const auto lines = static_cast<size_t>(std::max(0.0, number_after(line, "follow on")));
    const size_t width = width_of(line), last = std::min(i + 1 + lines, data_line);
    std::vector<double> values;
    for (size_t k = i + 1; k < last && width > 0; ++k)
      for (size_t at = 0; at < text.lines[k].size(); at += width)
        values.push_back(std::strtod(text.lines[k].substr(at, width).c_str(), nullptr));
    return values;
  }
  return {};
}

// The step that fits the duration of the data line, which is rounded to whole seconds; agencies differ in its unit.
double cosmos_step(const RecordText& text, size_t data_line, double points, const Record& wanted) {
  const std::string line = lower(text.lines[data_line]);
  const double duration = number_after(line, "approx");
  const std::vector<double> values = real_header(text, data_line);
  std::vector<double> steps;
  for (const size_t number : {62, 34})
    if (values.size() >= number)
      for (const double unit : {1e-3, 1.0}) steps.push_back(unit * values[number - 1]);
  for (const double step : steps)
    if (step > 0 && std::isfinite(duration) && std::abs(points * step - duration) <= 1 + 2e-3 * duration) return step;
  if (wanted.dt > 0) return wanted.dt;
  throw Error(fmt::format("neither real-header value 62 (ms) nor 34 (s) is a step by which {:.0f} points last {} s; say it in the scene "
                          "with dt = 0.01, or with --dt 0.01 to erbs record",
                          points, std::isfinite(duration) ? fmt::format("{:g}", duration) : "?"),
              {text.path, line_number(data_line)});
}

// Text after "units=" up to its number in brackets or the next comma; after "in" up to the point.
std::string unit_of(const std::string& line, bool cosmos) {
  const std::string word = cosmos ? "units=" : " in ";
  const size_t from = line.find(word, cosmos ? 0 : line.find("equally spaced")), begin = from + word.size();
  if (from == std::string::npos) return "";
  return std::string(trim(std::string_view(line).substr(begin, std::min(line.find_first_of(",(", begin), line.size()) - begin)));
}

// Values end at "End-of-data", at the next announcement or at the end of the file.
size_t end_of_values(const RecordText& text, size_t data_line) {
  for (size_t i = data_line + 1; i < text.lines.size(); ++i) {
    const std::string line = lower(text.lines[i]);
    if (line.find("end-of-data") != std::string::npos || line.find("end of data") != std::string::npos || !announced(line).empty() ||
        line.find("/&") != std::string::npos)
      return i;
  }
  return text.lines.size();
}

}  // namespace

std::optional<size_t> volume2_line(const RecordText& text, const Record& wanted) {
  std::optional<size_t> any;
  for (size_t i = 0; i < text.lines.size(); ++i) {
    if (text.lines[i].size() > 400 || text.lines[i].find("ts") == std::string::npos) continue;
    const std::string_view quantity = announced(lower(text.lines[i]));
    if (quantity == wanted.quantity) return i;
    if (!quantity.empty() && !any) any = i;
  }
  return any;
}

RecordFile parse_volume2(RecordText& text, const Record& wanted, size_t data_line) {
  const std::string line = lower(text.lines[data_line]);
  const Place place{text.path, line_number(data_line)};
  const bool cosmos = is_cosmos(line);
  check_quantity(announced(line), wanted, place);
  const double points = std::strtod(line.c_str(), nullptr);
  if (!(points >= 2 && points <= 1e8 && points == std::floor(points)))
    throw Error("this line should begin with the number of values; write it as \"12091 acceleration pts, ...\"", place);
  const double dt = cosmos ? cosmos_step(text, data_line, points, wanted) : number_after(line, "spaced at");
  if (!(dt > 0 && dt <= 1e3)) throw Error("this line should give the step; write it as \"equally spaced at .010 sec\"", place);
  checked_step(dt, wanted, place);
  std::string unit = unit_of(line, cosmos);
  while (!unit.empty() && unit.back() == '.') unit.pop_back();
  const double factor = factor_to_si(unit, wanted, place);
  RecordFile file{std::string(trim(text.lines.front())), cosmos ? "COSMOS V2" : "CSMIP V2", {}, {}, {}};
  file.values = numbers_of(text, data_line + 1, end_of_values(text, data_line), wanted);
  check_count(file.values.size(), points, "this line", place);
  for (double& value : file.values) value *= factor;
  for (size_t i = 0; i < file.values.size(); ++i) file.times.push_back(wanted.first_time + static_cast<double>(i) * dt);
  return file;
}

}  // namespace erbs
