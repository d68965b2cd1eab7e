#include "engine/loads/record/components.h"

#include <cmath>

namespace erbs {
namespace {

constexpr const char* axes[] = {"x", "y", "z"};

// The step of a component, of its first interval if the times are uneven.
double step_of(const Record& r) { return r.file_dt > 0 ? r.file_dt : r.acceleration.times[1] - r.acceleration.times[0]; }

void check_axes(const std::array<Record, 3>& read, const Place& place) {
  const Record* first = nullptr;
  int first_axis = 0;
  for (int i = 0; i < 3; ++i) {
    const Record& one = read[std::size_t(i)];
    if (one.file.empty()) continue;
    if (first == nullptr) {
      first = &one, first_axis = i;
    } else if (std::fabs(step_of(one) - step_of(*first)) > 1e-6 * step_of(*first) || (one.file_dt > 0) != (first->file_dt > 0)) {
      const auto step = [](const Record& r) { return r.file_dt > 0 ? fmt::format("{:.6g} s", r.file_dt) : std::string("uneven"); };
      throw Error(
          fmt::format("the components have no common time axis: the step of {} ({}) is {}, of {} ({}) {}; give files of one station "
                      "and one step",
                      axes[first_axis], first->file, step(*first), axes[i], one.file, step(one)),
          place);
    }
  }
}

}  // namespace

Components read_components(const std::array<Record, 3>& wanted, const std::string& named, const Place& place) {
  Components out;
  double peak = 0, scale = 1;
  int leading = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    if (wanted[i].file.empty()) continue;
    peak = wanted[i].peak, scale = wanted[i].scale;
    Record plain = wanted[i];
    plain.peak = 0, plain.scale = 1;
    out.of[i] = read_record(plain, place);
    const bool leads =
        named == "strongest" ? leading < 0 || out.of[i].file_peak > out.of[std::size_t(leading)].file_peak : named == axes[i];
    if (leads) leading = int(i);
  }
  if (leading < 0)
    throw Error(named == "strongest" ? std::string("there is no component; give x, y or z = \"file\"")
                                     : fmt::format("of = \"{0}\" names a component without a file; give {0}, or leave `of` out", named),
                place);
  check_axes(out.of, place);
  const double reference = out.of[std::size_t(leading)].file_peak;
  if (peak > 0 && reference == 0)
    throw Error(fmt::format("every value of the component {} is zero, so it cannot be scaled to a peak; check the file", axes[leading]),
                {out.of[std::size_t(leading)].file});
  const double factor = peak > 0 ? peak / reference : scale;
  std::string lengths;
  for (std::size_t i = 0; i < 3; ++i) {
    if (wanted[i].file.empty()) continue;
    Record scaled = wanted[i];
    scaled.peak = 0, scaled.scale = factor;
    out.of[i] = read_record(scaled, place);
    lengths += fmt::format("{}{} {:.4g} m/s2 over {:.2f} s", lengths.empty() ? "" : ", ", axes[i], std::fabs(factor) * out.of[i].file_peak,
                           out.of[i].acceleration.times.back());
  }
  out.note = fmt::format("components of one motion, all times {:.6g} (peak of {}): {}; none accelerates after its end", factor,
                         axes[leading], lengths);
  return out;
}

}  // namespace erbs
