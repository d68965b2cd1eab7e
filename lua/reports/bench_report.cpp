#include "lua/reports/bench_report.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/base/error.h"
#include "engine/record/plot/figure.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

// A number at a dotted key of a row; NaN if the case failed or has no such number.
double number(const Json& row, const char* key) {
  const Json* found = find_key(row, key);
  return found != nullptr && found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

double of(const Json& rows, const char* name, const char* key) {
  return rows.contains(name) ? number(rows[name], key) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void print_bench_row(const Json& row) {
  if (row.contains("failed")) {
    say("{:<12} failed: {}\n", row["scene"].get<std::string>(), row["failed"].get<std::string>());
    return;
  }
  say("{:<12} {:>6} blocks {:>7} points  {:9.2f} us/step  {:8.0f} steps/s", row["scene"].get<std::string>(), row["blocks"].get<int>(),
      row["points"].get<int>(), number(row, "one_thread.user_us_per_step"), number(row, "one_thread.steps_per_s"));
  if (row["points"].get<int>() > 0)
    say("  {:6.3f} ns/point  {:5.1f} B/point  roofline {:.0f} %", number(row, "one_thread.ns_per_point"),
        number(row, "roofline.bytes_per_point"), 100 * number(row, "roofline.share"));
  if (row.contains("intact_vs_reference"))
    say("  {:.1f}x reference (broken {:.1f}x)", number(row, "intact_vs_reference"), number(row, "broken_vs_reference"));
  if (number(row, "one_thread.touching") > 0)
    say("  {:.2f} million pairs/s, {:.3g} CPU s per simulated s", 1e-6 * number(row, "one_thread.pairs_per_s"),
        number(row, "one_thread.cpu_s_per_s"));
  say("  two threads {:.2f}x{}\n", number(row, "two_threads_over_one"),
      row["same_bits_with_two_threads"].get<bool>() ? "" : ", RESULTS DIFFER");
  std::fflush(stdout);
}

Json bench_summary(const Json& rows) {
  const double house = of(rows, "house_951", "one_thread.ns_per_point");
  return {{"house_intact_1t_vs_oracle", of(rows, "house_951", "intact_vs_reference")},
          {"house_broken_1t_vs_oracle", of(rows, "house_951", "broken_vs_reference")},
          {"oracle_ns_per_point", of(rows, "house_951", "reference.ns_per_point")},
          {"house_intact_ns_per_point", house},
          {"house_broken_ns_per_point", of(rows, "house_951", "broken.ns_per_point")},
          {"house_2t_vs_1t", of(rows, "house_951", "two_threads_over_one")},
          {"share_of_roofline", of(rows, "house_951", "roofline.share")},
          {"dry_wall_1012_cpu_s_per_s", of(rows, "dry_wall_1012", "one_thread.cpu_s_per_s")},
          {"scaling_10k", of(rows, "house_10000", "one_thread.ns_per_point") / house},
          {"scaling_10k_dry", of(rows, "dry_wall_10012", "one_thread.ns_per_point") / of(rows, "dry_wall_1012", "one_thread.ns_per_point")},
          {"scaling_30k", of(rows, "aqueduct", "one_thread.ns_per_point") / house},
          {"bytes_per_point_30k", of(rows, "aqueduct", "bytes_per_point")},
          {"pile_pairs_per_s", of(rows, "pile", "one_thread.pairs_per_s")},
          {"effects_off_instructions", of(rows, "house_951", "effects_off_instructions")},
          {"cases", rows}};
}

void print_bench_summary(const Json& summary) {
  for (const auto& [key, value] : summary.items())
    if (key != "cases") say("{:<28} {}\n", key, value.is_number() ? fmt::format("{:.4g}", value.get<double>()) : "not measured here");
}

// Figure: nanoseconds per contact point and step of every case, beside the least time that the machine allows.
void write_bench_figure(const Json& rows, const std::string& path) {
  std::string text;
  for (const auto& [name, row] : rows.items()) {
    if (!row.contains("points") || row["points"].get<int>() == 0) continue;
    text += '"' + name + '"';
    for (const char* key : {"reference.ns_per_point", "one_thread.ns_per_point", "broken.ns_per_point", "roofline.least_ns_per_point"})
      text += std::isfinite(number(row, key)) ? fmt::format(" {:.5g}", number(row, key)) : " -";
    text += "\n";
  }
  plot::Figure figure{1100, 560};
  figure.grid = "y";
  plot::Panel p;
  p.settings = "set style histogram clustered gap 1\nset style fill solid 1.0 noborder\nset datafile missing '-'\n";
  p.key = "top left";
  p.x.tics = "noenhanced";
  p.y = {"ns per contact point and step, one thread", "[0.05:*]", "", "", "", true};
  const std::string data = figure.add_rows(text);
  p.series = {{data + " using 2:xtic(1)", "histograms lc rgb '#9a9a9a'", "reference, intact"},
              {data + " using 3", "histograms lc rgb '#2f6b8f'", "kernel"},
              {data + " using 4", "histograms lc rgb '#b5432e'", "kernel, all joints broken"},
              {data + " using 5", "histograms lc rgb '#3c7a4b'", "limit of the machine"}};
  figure.panels = {p};
  plot::draw(figure, path);
}

}  // namespace erbs::lua
