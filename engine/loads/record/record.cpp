#include "engine/loads/record/record.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/text.h"
#include "engine/loads/record/record_file.h"

namespace erbs {
namespace {

double largest(const std::vector<double>& values) {
  double peak = 0;
  for (const double value : values) peak = std::max(peak, std::abs(value));
  return peak;
}

// Step of evenly spaced times, else 0. The tolerance of 1e-3 accepts times printed with few digits.
double even_step(const std::vector<double>& times) {
  const double step = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (size_t i = 1; i < times.size(); ++i)
    if (std::abs(times[i] - times[i - 1] - step) > 1e-3 * step) return 0;
  return step;
}

// If the first value comes after time 0 (El Centro: at one step), the ground is at rest until one step before it.
void add_rest(RecordFile& file) {
  const double first = file.times.front();
  if (first <= 0) return;
  file.times.insert(file.times.begin(), std::max(0.0, first - (file.times[1] - first)));
  file.values.insert(file.values.begin(), 0.0);
}

}  // namespace

RecordFile parse_record(const RecordText& text, const Record& wanted) {
  for (size_t i = 0; i < std::min<size_t>(text.lines.size(), 12); ++i)
    if (lower(text.lines[i]).find("npts") != std::string::npos && !is_comment(text.lines[i])) return parse_at2(text, wanted, i);
  return parse_columns(text, wanted);
}

double factor_to_si(std::string_view in_file, const Record& wanted, const Place& place) {
  if (in_file.empty() && wanted.unit.empty())
    throw Error(
        fmt::format("the file does not say the unit of its values; add unit = \"g\" in the scene, or --unit g to erbs record (one of {})",
                    known_units),
        place);
  const std::optional<double> said = in_file.empty() ? std::nullopt : acceleration_unit(in_file);
  if (!in_file.empty() && !said)
    throw Error(fmt::format("unknown unit \"{}\" of acceleration; use one of {}", shown(in_file, 24), known_units), place);
  if (wanted.unit.empty()) return *said;
  const std::optional<double> asked = acceleration_unit(wanted.unit);
  if (!asked) throw Error(fmt::format("unknown unit = \"{}\" of acceleration; use one of {}", wanted.unit, known_units), place);
  if (said && *said != *asked)
    throw Error(fmt::format("the file is in {}, the script says unit = \"{}\"; leave unit out", in_file, wanted.unit), place);
  return *asked;
}

Record read_record(Record record, const Place& place) {
  if (record.file.empty()) throw Error("a record needs file = \"...\"", place);
  if (record.peak > 0 && record.scale != 1)
    throw Error(fmt::format("peak = {} m/s2 and scale = {} contradict each other; give one of them", record.peak, record.scale), place);
  if (!(record.time_factor > 0)) throw Error(fmt::format("time_factor = {} must be above 0", record.time_factor), place);
  const RecordText text = read_record_text(record.file);
  RecordFile file = parse_record(text, record);
  if (file.values.size() < 2) throw Error("one value makes no record; give at least two", {record.file});
  record.title = for_files(file.title);
  record.format = file.format;
  record.hash = text.hash;
  record.points = static_cast<int>(file.values.size());
  record.file_dt = even_step(file.times);
  record.file_peak = largest(file.values);
  if (record.peak > 0 && record.file_peak == 0)
    throw Error("every value of the record is zero, so it cannot be scaled to a peak; check the file", {record.file});
  add_rest(file);
  const double factor = record.peak > 0 ? record.peak / record.file_peak : record.scale;
  for (double& value : file.values) value *= factor;
  for (double& time : file.times) time *= record.time_factor;
  constexpr double most_acceleration = 1e6, longest = 1e6;  // m/s2, s
  if (!(largest(file.values) <= most_acceleration))
    throw Error(fmt::format("its peak is {:.3g} m/s2; at most {:g} is allowed: check the unit and the scale", largest(file.values),
                            most_acceleration),
                {record.file});
  if (!(file.times.back() <= longest))
    throw Error(fmt::format("it lasts {:.3g} s; at most {:g} s is allowed: check the unit of its times", file.times.back(), longest),
                {record.file});
  record.acceleration = make_polyline(std::move(file.times), std::move(file.values));
  return record;
}

double end_time(const Record& wave) { return wave.start + wave.acceleration.times.back(); }

double value(const Record& wave, double t) {
  const Polyline& a = wave.acceleration;
  const double s = t - wave.start;
  return s < a.times.front() || s > a.times.back() ? 0.0 : value_inside(a, s);
}

double area(const Record& wave, double t) { return area_inside(wave.acceleration, t - wave.start); }

double double_area(const Record& wave, double t) {
  const Polyline& a = wave.acceleration;
  const double s = t - wave.start;
  return double_area_inside(a, s) + std::max(0.0, s - a.times.back()) * a.area.back();
}

double mean(const Record& wave, double t0, double t1) {
  if (t1 < t0) std::swap(t0, t1);
  if (t0 == t1) return value(wave, t0);
  const Polyline& a = wave.acceleration;
  const double s0 = t0 - wave.start, s1 = t1 - wave.start;
  return s1 > s0 ? area_between(a, s0, s1) / (s1 - s0) : value(wave, t0);
}

}  // namespace erbs
