#include "engine/loads/record/record.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/text.h"
#include "engine/loads/record/correction.h"
#include "engine/loads/record/record_file.h"
#include "engine/loads/record/spline.h"

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

RecordFile parse_record(RecordText text, const Record& wanted) {
  if (is_esm(text)) return parse_esm(text, wanted);
  if (const auto line = volume2_line(text, wanted)) return parse_volume2(text, wanted, *line);
  for (size_t i = 0; i < std::min<size_t>(text.lines.size(), 12); ++i)
    if (lower(text.lines[i]).find("npts") != std::string::npos && !is_comment(text.lines[i])) return parse_at2(text, wanted, i);
  return parse_columns(text, wanted);
}

double factor_to_si(std::string_view in_file, const Record& wanted, const Place& place) {
  const std::string& quantity = wanted.quantity;
  const std::string_view known = known_units(quantity);
  if (in_file.empty() && wanted.unit.empty())
    throw Error(
        fmt::format(
            "the file does not say the unit of its values; add unit = \"{0}\" in the scene, or --unit {0} to erbs record (one of {1})",
            quantity == "acceleration" ? "g"
            : quantity == "velocity"   ? "m/s"
                                       : "m",
            known),
        place);
  const std::optional<double> said = in_file.empty() ? std::nullopt : unit_factor(quantity, in_file);
  if (!in_file.empty() && !said) {
    const std::string_view other = quantity_of_unit(in_file);
    throw Error(other.empty() ? fmt::format("unknown unit \"{}\" of {}; use one of {}", shown(in_file, 24), quantity, known)
                              : fmt::format("\"{}\" is a unit of {}, not of {}; write quantity = \"{}\", or choose another column",
                                            shown(in_file, 24), other, quantity, other),
                place);
  }
  if (wanted.unit.empty()) return *said;
  const std::optional<double> asked = unit_factor(quantity, wanted.unit);
  if (!asked) throw Error(fmt::format("unknown unit = \"{}\" of {}; use one of {}", wanted.unit, quantity, known), place);
  if (said && *said != *asked)
    throw Error(fmt::format("the file is in {}, the script says unit = \"{}\"; leave unit out", in_file, wanted.unit), place);
  return *asked;
}

void check_quantity(std::string_view in_file, const Record& wanted, const Place& place) {
  const bool known = in_file == "acceleration" || in_file == "velocity" || in_file == "displacement";
  if (!known || in_file == wanted.quantity) return;
  if (in_file == "acceleration")
    throw Error(fmt::format("the file holds an acceleration, the script says quantity = \"{}\"; leave quantity out", wanted.quantity),
                place);
  throw Error(
      fmt::format("the file holds a {0}; give the acceleration (.AT2), or quantity = \"{0}\" with smoothing to differentiate it", in_file),
      place);
}

double checked_step(double in_file, const Record& wanted, const Place& place) {
  if (wanted.dt > 0 && std::abs(wanted.dt - in_file) > 1e-9 * in_file)
    throw Error(fmt::format("the file says DT = {} s, the script dt = {} s; leave dt out (time_factor stretches time)", in_file, wanted.dt),
                place);
  return in_file;
}

void check_count(size_t found, double promised, std::string_view name, const Place& place) {
  if (static_cast<double>(found) == promised) return;
  throw Error(fmt::format("{0} promises {1:.0f} values, the file holds {2}; it is {3}: fetch it again or correct {0}", name, promised,
                          found, static_cast<double>(found) < promised ? "cut short" : "longer than it says"),
              place);
}

std::vector<double> numbers_of(RecordText& text, size_t first, size_t last, const Record& wanted) {
  if (wanted.decimal == "comma" || (wanted.decimal == "auto" && has_decimal_commas(text, first, last, true)))
    replace_decimal_commas(text, first, last);
  std::vector<double> values;
  for (size_t i = first; i < last; ++i) append_numbers(text, i, true, values);
  return values;
}

namespace {

// What contradicts itself before the file is opened.
void check_wanted(const Record& record, const Place& place) {
  if (record.file.empty()) throw Error("a record needs file = \"...\"", place);
  if (record.peak > 0 && record.scale != 1)
    throw Error(fmt::format("peak = {} m/s2 and scale = {} contradict each other; give one of them", record.peak, record.scale), place);
  if (!(record.time_factor > 0)) throw Error(fmt::format("time_factor = {} must be above 0", record.time_factor), place);
  if (record.quantity == "acceleration" && record.smoothing > 0)
    throw Error("smoothing is for a file of velocities or displacements; leave it out, or take the band-pass high", place);
  if (record.quantity != "acceleration" && !(record.smoothing > 0))
    throw Error(fmt::format("a {} is differentiated through a smoothing spline; say its corner in Hz, smoothing = 25 in the "
                            "scene, or --smoothing 25 to erbs record: above it lies noise",
                            record.quantity),
                place);
  if (record.low > 0 && record.high > 0 && record.low >= record.high)
    throw Error(
        fmt::format("the corners of the band-pass do not rise: low = {} Hz, high = {} Hz; give low below high", record.low, record.high),
        place);
}

// The step of a record that must have one; the median tells a gap from its neighbours.
double required_step(const RecordFile& file, const std::string& path) {
  if (const double step = even_step(file.times); step > 0) return step;
  std::vector<double> steps;
  for (size_t i = 1; i < file.times.size(); ++i) steps.push_back(file.times[i] - file.times[i - 1]);
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  const auto odd = static_cast<size_t>(
      std::find_if(steps.begin(), steps.end(), [&](double step) { return std::abs(step - usual) > 1e-3 * usual; }) - steps.begin());
  const size_t at = std::min(odd, steps.size() - 1) + 1, added = file.times.size() - std::min(file.lines.size(), file.times.size());
  const int line = !file.lines.empty() && at >= added ? file.lines[at - added] : 0;
  throw Error(
      fmt::format("the step varies: {:.6g} s before t = {:.6g} s, else {:.6g} s; a band-pass needs an even step: resample the record, "
                  "or leave low and high out",
                  steps[at - 1], file.times[at], usual),
      {path, line});
}

// Turns the values into a corrected acceleration and says so in the note.
void correct(RecordFile& file, Record& record, const Place& place) {
  if (record.quantity != "acceleration") {
    const Differentiated found = differentiated(file.times, std::move(file.values), record.quantity, record.smoothing, place);
    file.values = found.acceleration;
    record.note = fmt::format(
        "{} differentiated to an acceleration through a cubic smoothing spline (Reinsch 1967), at rest at the start, without phase lag, "
        "half amplitude at {:g} Hz; it leaves the given displacement by {:.2e} m rms",
        record.quantity, record.smoothing, found.rms);
  }
  add_rest(file);
  const bool band = record.low > 0 || record.high > 0;
  double end_velocity = 0, end_displacement = 0;  // m/s, m, before scaling
  const int degree = baseline_degree(record.baseline);
  remove_baseline(file.times, file.values, degree);
  if (band) {
    band_pass(required_step(file, record.file), file.values, {record.low, record.high, record.band_order}, {record.file, 0});
    remove_baseline(file.times, file.values, degree);  // of what the filter had carried beyond the ends of the record
    const Polyline line = make_polyline(file.times, file.values);
    end_velocity = line.area.back(), end_displacement = line.double_area.back();
  }
  const auto say = [&](const std::string& what) { record.note += (record.note.empty() ? "" : "; ") + what; };
  if (degree >= 0)
    say(fmt::format("{} baseline taken from the acceleration, fitted to the velocity{}", record.baseline,
                    band ? " before and after the band-pass" : ""));
  if (band)
    say(
        fmt::format("Butterworth band-pass {} Hz of order {}, forwards and backwards: zero phase, half amplitude at each corner; "
                    "its tails beyond both ends are cut off, which leaves the ground at {:.2g} m/s and {:.2g} m (before scaling)",
                    record.low > 0 && record.high > 0 ? fmt::format("{:g} to {:g}", record.low, record.high)
                    : record.low > 0                  ? fmt::format("from {:g}", record.low)
                                                      : fmt::format("up to {:g}", record.high),
                    record.band_order, end_velocity, end_displacement));
}

}  // namespace

Record read_record(Record record, const Place& place) {
  check_wanted(record, place);
  RecordText text = read_record_text(record.file);
  record.hash = text.hash;
  RecordFile file = parse_record(std::move(text), record);
  if (file.values.size() < 2) throw Error("one value makes no record; give at least two", {record.file});
  record.title = for_files(file.title);
  record.format = file.format;
  record.points = static_cast<int>(file.values.size());
  record.file_dt = even_step(file.times);
  correct(file, record, place);
  record.file_peak = largest(file.values);
  if (record.peak > 0 && record.file_peak == 0)
    throw Error("every value of the record is zero, so it cannot be scaled to a peak; check the file", {record.file});
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
