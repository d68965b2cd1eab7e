#include "engine/record/report/stress_histogram.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/record/plot/unit.h"

namespace erbs {
namespace {

constexpr int about_bins = 40;

double area_of(const MotionJoint& joint) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < joint.polygon.size(); ++i)
    sum += (joint.polygon[i] - joint.polygon[0]).cross(joint.polygon[i + 1] - joint.polygon[0]);
  return 0.5 * sum.norm();
}

double seconds(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw Error(fmt::format("--time {} is not a time in seconds; a histogram shows one time, such as --time 2.5", shown(text, 60)));
  return value;
}

// 1, 2 or 5 times a power of ten, the least that is not below `width`.
double round_up(double width) {
  const double decade = std::pow(10, std::floor(std::log10(width)));
  for (const double lead : {1, 2, 5})
    if (lead * decade >= width * (1 - 1e-9)) return lead * decade;
  return 10 * decade;
}

double greatest_of(const std::vector<StressSample>& samples) {
  double peak = 0;
  for (const StressSample& sample : samples)
    for (const double stress : sample.stress) peak = std::max(peak, std::fabs(stress));
  return peak;
}

}  // namespace

StressSample stress_sample(const MotionReader& reader, const std::string& quantity, const std::string& time) {
  const double wanted = time.empty() ? 0 : seconds(time);
  const std::vector<double>& times = reader.times();
  if (times.empty()) throw Error("the run has no frames yet; run it longer than its frame_dt");
  if (reader.scene().joints.empty()) throw Error("the run has no joints, so that there are no stresses to count");
  if (!reader.has_stress())
    throw Error("the run has kept no stresses of its joints; say analysis{ frame_stress = true } and run the scene again");
  std::size_t frame = times.size() - 1;
  if (!time.empty()) {
    if (wanted < times.front() - 1e-9 || wanted > times.back() + 1e-9)
      throw Error(
          fmt::format("--time {:g} s lies outside the run, which has frames from {:g} s to {:g} s", wanted, times.front(), times.back()));
    const auto nearest = [&](double a, double b) { return std::fabs(a - wanted) < std::fabs(b - wanted); };
    frame = std::size_t(std::min_element(times.begin(), times.end(), nearest) - times.begin());
  }
  const MotionFrame read = reader.read(int(frame));
  StressSample sample;
  sample.t = times[frame];
  for (const float stress : quantity == "shear_stress" ? read.shear_stress : read.normal_stress) sample.stress.push_back(double(stress));
  for (const MotionJoint& joint : reader.scene().joints) sample.area.push_back(area_of(joint));
  return sample;
}

StressBins stress_bins(const std::vector<StressSample>& samples) {
  double low = 0, high = 0;  // zero is the edge of a bin
  for (const StressSample& sample : samples)
    for (const double stress : sample.stress) low = std::min(low, stress), high = std::max(high, stress);
  StressBins bins;
  bins.width = high - low > 0 ? round_up((high - low) / about_bins) : 1;
  bins.low = bins.width * std::floor(low / bins.width * (1 - 1e-9));
  const auto count = std::size_t(std::max(1.0, std::ceil((high - bins.low) / bins.width * (1 - 1e-9))));
  for (const StressSample& sample : samples) {
    std::vector<double> share(count, 0);
    double total = 0;
    for (const double area : sample.area) total += area;
    for (std::size_t j = 0; j < sample.stress.size(); ++j) {
      const double at = std::floor((sample.stress[j] - bins.low) / bins.width);
      share[std::size_t(std::clamp(at, 0.0, double(count - 1)))] += total > 0 ? sample.area[j] / total : 0;
    }
    bins.share.push_back(std::move(share));
  }
  return bins;
}

plot::Figure stress_figure(const std::vector<StressSample>& samples, const std::string& quantity) {
  if (samples.size() > plot::run_colors.size())
    throw Error(fmt::format("{} runs are more than a histogram can tell apart, which is {}; choose fewer", samples.size(),
                            plot::run_colors.size()));
  const StressBins bins = stress_bins(samples);
  const plot::ShownUnit& unit = plot::shown_unit(*plot::find_unit("Pa"), greatest_of(samples));
  constexpr double height = 460;
  plot::Figure figure{760, height};
  const bool several = samples.size() > 1;  // named in the legend
  const auto title_of = [](const StressSample& sample) { return fmt::format("{} at {:.4g} s", sample.run, sample.t); };
  const std::string title = several ? fmt::format("{} runs", samples.size()) : title_of(samples.front());
  figure.labels = {
      {title, fmt::format("screen 0.10,{:.4f}", 1 - 22 / height), "left font ',15' tc rgb '#111111' noenhanced"},
      {fmt::format("mean stress of each joint, bins of {:g} {}; zero once contact has replaced it", unit.factor * bins.width, unit.name),
       fmt::format("screen 0.10,{:.4f}", 1 - 45 / height), "left font ',12' tc rgb '#555555' noenhanced"}};
  plot::Panel p;
  p.axes = plot::AxesBox{0.10, 0.96, 0.14, 0.86};
  p.x = {fmt::format("{} [{}]", quantity == "shear_stress" ? "shear stress" : "normal stress, tension positive", unit.name)};
  p.y = {"share of the joints' area [%]", "[0:*]"};
  p.settings = "set style fill solid 0.55 noborder\n";
  // Compression lies far to the left, in few joints; shear to the right.
  if (several) p.key = fmt::format("top {} Left reverse samplen 2 noenhanced", quantity == "shear_stress" ? "right" : "left");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::string rows;
    // The outline steps down to zero at both ends.
    const auto row = [&](double edge, double share) { rows += fmt::format("{:.9g} {:.9g}\n", unit.factor * edge, 100 * share); };
    row(bins.low, 0);
    for (std::size_t k = 0; k < bins.share[i].size(); ++k) {
      row(bins.low + double(k) * bins.width, bins.share[i][k]);
      row(bins.low + double(k + 1) * bins.width, bins.share[i][k]);
    }
    row(bins.low + double(bins.share[i].size()) * bins.width, 0);
    const std::string source = figure.add_rows(rows) + " using 1:2";
    if (!several) p.series.push_back({source, fmt::format("filledcurves y1=0 lc rgb '{}'", plot::run_colors[i])});
    p.series.push_back({source, fmt::format("lines lw 1.6 lc rgb '{}'", plot::run_colors[i]), several ? title_of(samples[i]) : ""});
  }
  figure.panels.push_back(p);
  return figure;
}

}  // namespace erbs
