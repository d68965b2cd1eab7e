#include "engine/record/results/curves.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "engine/loads/record/response_spectrum.h"
#include "engine/record/plot/unit.h"
#include "engine/record/results/signal.h"

namespace erbs {
namespace {

namespace fs = std::filesystem;

double number_of(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value) ? value : NAN;
}

// Whether `name` matches a pattern in which * stands for any text and ? for one letter.
bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  if (pattern.front() == '*') return matches(pattern.substr(1), name) || (!name.empty() && matches(pattern, name.substr(1)));
  return !name.empty() && (pattern.front() == '?' || pattern.front() == name.front()) && matches(pattern.substr(1), name.substr(1));
}

// A run may have been ended between the rows of its two files.
void join(CsvTable& table, const CsvTable& more) {
  const int t = table.find("time_s"), t_more = more.find("time_s");
  if (t_more < 0) return;
  const std::vector<double>&times = table.columns[std::size_t(t)], &times_more = more.columns[std::size_t(t_more)];
  std::size_t rows = 0;
  while (rows < std::min(times.size(), times_more.size()) && times[rows] == times_more[rows]) ++rows;
  for (std::size_t c = 0; c < more.names.size(); ++c) {
    if (table.find(more.names[c]) >= 0) continue;
    table.names.push_back(more.names[c]);
    table.columns.push_back(more.columns[c]);
    table.text.push_back(more.text[c]);
  }
  for (auto& column : table.columns) column.resize(rows);
  for (auto& column : table.text)
    if (!column.empty()) column.resize(rows);
}

void check_over_time(const HistoryCurve& history) {
  if (history.x_name != "time_s") throw Error("a spectrum is taken over time; leave out --x");
}

}  // namespace

TimeSpan time_span_of(const std::string& text) {
  const std::size_t colon = text.find(':');
  TimeSpan span{NAN, NAN};
  if (colon != std::string::npos) span = {number_of(text.substr(0, colon)), number_of(text.substr(colon + 1))};
  if (!(span.from <= span.to)) throw Error(fmt::format("--time {} is not a span of seconds; try 2:4.5", shown(text, 60)));
  return span;
}

CsvTable read_columns(const std::string& folder) {
  if (!fs::is_directory(folder)) throw Error("there is no run folder of this name; erbs run SCENE.lua -o DIR makes one", {folder});
  CsvTable table;
  for (const char* name : {"histories.csv", "energy.csv"}) {
    const std::string path = (fs::path(folder) / name).string();
    if (!fs::exists(path)) continue;
    CsvTable read = read_csv(path);
    if (read.find("time_s") < 0) throw Error("it has no column time_s; name a folder that erbs run wrote", {path});
    if (read.rows() < 2)
      throw Error(fmt::format("it has {}, and a curve takes two; let the run go on", read.rows() == 0 ? "no rows" : "one row"), {path});
    if (table.names.empty()) table = std::move(read);
    else join(table, read);
  }
  if (table.names.empty())
    throw Error("it holds neither histories.csv nor energy.csv; name a folder that erbs run wrote, such as runs/first", {folder});
  return table;
}

std::string uneven_rows(const std::string& folder) {
  const std::string histories = (fs::path(folder) / "histories.csv").string(), energy = (fs::path(folder) / "energy.csv").string();
  if (!fs::exists(histories) || !fs::exists(energy)) return "";
  const CsvTable a = read_csv(histories), b = read_csv(energy);
  const int time_a = a.find("time_s"), time_b = b.find("time_s");
  if (time_a < 0 || time_b < 0 || std::max(a.rows(), b.rows()) <= std::min(a.rows(), b.rows()) + 1) return "";
  const auto end_of = [](const CsvTable& table, int time) { return table.rows() > 0 ? table.columns[std::size_t(time)].back() : 0.0; };
  const bool energy_ends = b.rows() < a.rows();
  return fmt::format(
      "{} ends at {:g} s, {} at {:g} s: the file was cut off, and only what both have is drawn together; run the scene again",
      energy_ends ? "energy.csv" : "histories.csv", energy_ends ? end_of(b, time_b) : end_of(a, time_a),
      energy_ends ? "histories.csv" : "energy.csv", energy_ends ? end_of(a, time_a) : end_of(b, time_b));
}

std::optional<CsvTable> read_capacity(const std::string& folder) {
  const std::string path = (fs::path(folder) / "curve.csv").string();
  return fs::exists(path) ? std::optional(read_csv(path)) : std::nullopt;
}

std::vector<int> choose_columns(const CsvTable& table, const std::string& pattern) {
  const bool is_glob = pattern.find_first_of("*?") != std::string::npos;
  // "***" would try every way to share a name among the stars.
  std::string plain = pattern;
  plain.erase(std::unique(plain.begin(), plain.end(), [](char a, char b) { return a == '*' && b == '*'; }), plain.end());
  if (std::count(plain.begin(), plain.end(), '*') > 4)
    throw Error(fmt::format("the pattern {} has more than four stars; write a simpler one", shown(pattern, 60)));
  std::vector<int> chosen;
  std::vector<std::string> known;
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    if (!table.text[c].empty()) continue;
    const std::string& name = table.names[c];
    known.push_back(name);
    if (name == pattern) return {static_cast<int>(c)};
    if (!pattern.empty() && (is_glob ? matches(plain, name) : name.starts_with(pattern))) chosen.push_back(static_cast<int>(c));
  }
  if (chosen.empty())
    throw Error(
        fmt::format("there is no column \"{}\" (erbs plot DIR --list lists all){}", shown(pattern, 60), did_you_mean(pattern, known)));
  return chosen;
}

HistoryCurve curve_of(const CsvTable& table, int x, int y, TimeSpan span) {
  HistoryCurve curve{"", table.names[std::size_t(x)], table.names[std::size_t(y)], {}, {}};
  if (table.find("time_s") < 0) {
    if (std::isfinite(span.from) || std::isfinite(span.to)) throw Error("states of equilibrium have no time; leave out --time");
    for (std::size_t i = 0; i < table.rows(); ++i)
      if (std::isfinite(table.columns[std::size_t(x)][i]) && std::isfinite(table.columns[std::size_t(y)][i]))
        curve.x.push_back(table.columns[std::size_t(x)][i]), curve.y.push_back(table.columns[std::size_t(y)][i]);
    if (curve.x.size() < 2) throw Error("a curve takes two states of equilibrium; let the push go on");
    return curve;
  }
  const std::vector<double>& t = table.column("time_s");
  const double slack = 1e-9 * (1 + std::abs(t.back()));  // times of rows are sums of many steps
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t[i])) throw Error(fmt::format("the time in row {} is not finite; mend or remove that row", i + 1));
    if (t[i] < span.from - slack || t[i] > span.to + slack) continue;
    for (const int c : {x, y})
      if (!std::isfinite(table.columns[std::size_t(c)][i]))
        throw Error(fmt::format("column {} is not finite at {:.6g} s; choose a span without that row, with --time T0:T1",
                                table.names[std::size_t(c)], t[i]));
    curve.x.push_back(table.columns[std::size_t(x)][i]);
    curve.y.push_back(table.columns[std::size_t(y)][i]);
  }
  if (curve.x.size() < 2)
    throw Error(fmt::format("--time {:g}:{:g} holds {} of the rows, which last from {:.6g} s to {:.6g} s; choose a longer span within",
                            span.from, span.to, curve.x.empty() ? "none" : "one", t.front(), t.back()));
  return curve;
}

std::vector<double> envelope_of(const std::vector<double>& y) {
  std::vector<double> largest;
  for (const double value : y) largest.push_back(std::max(largest.empty() ? 0.0 : largest.back(), std::abs(value)));
  return largest;
}

HistoryCurve amplitude_spectrum(const HistoryCurve& history) {
  check_over_time(history);
  Spectrum s = spectrum(history.x, history.y);
  if (s.frequency.size() < 3) throw Error(fmt::format("a spectrum takes eight rows, not {}; choose a longer span", history.x.size()));
  s.frequency.erase(s.frequency.begin());  // the mean is removed
  s.amplitude.erase(s.amplitude.begin());
  return {history.run, "frequency_Hz", history.y_name, s.frequency, s.amplitude};
}

HistoryCurve response_curve(const HistoryCurve& history, double damping_ratio) {
  check_over_time(history);
  if (plot::unit_of(history.y_name) != "m_s2")
    throw Error(fmt::format("--response takes accelerations, and {} is none; choose columns that end with _m_s2", history.y_name));
  HistoryCurve curve{history.run, "period_s", history.y_name, {}, {}};
  for (const ResponsePoint& p : response_spectrum(make_polyline(history.x, history.y), spectrum_periods(0.02, 5, 241), damping_ratio)) {
    curve.x.push_back(p.period);
    curve.y.push_back(p.acceleration);
  }
  return curve;
}

HistoryCurve thinned(const HistoryCurve& curve, std::size_t most) {
  const std::size_t n = curve.x.size(), pieces = std::max<std::size_t>(1, most / 5);
  if (n <= most) return curve;
  HistoryCurve out{curve.run, curve.x_name, curve.y_name, {}, {}};
  for (std::size_t k = 0; k < pieces; ++k) {
    const std::size_t first = k * n / pieces, end = (k + 1) * n / pieces;
    std::array<std::size_t, 6> kept{first, first, first, first, first, end - 1};
    for (std::size_t i = first; i < end; ++i) {
      if (curve.x[i] < curve.x[kept[1]]) kept[1] = i;
      if (curve.x[i] > curve.x[kept[2]]) kept[2] = i;
      if (curve.y[i] < curve.y[kept[3]]) kept[3] = i;
      if (curve.y[i] > curve.y[kept[4]]) kept[4] = i;
    }
    std::sort(kept.begin(), kept.end());
    const auto last = std::unique(kept.begin(), kept.end());
    for (auto i = kept.begin(); i != last; ++i) {
      out.x.push_back(curve.x[*i]);
      out.y.push_back(curve.y[*i]);
    }
  }
  return out;
}

}  // namespace erbs
