#include "engine/record/results/compare_runs.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/error.h"
#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "engine/base/units.h"
#include "engine/record/plot/unit.h"
#include "engine/record/results/signal.h"

namespace erbs {
namespace {

double peak_of(const std::vector<double>& y) {
  double peak = 0;
  for (const double value : y)
    if (std::isfinite(value)) peak = std::max(peak, std::abs(value));
  return peak;
}

// The column of the time, and its factor to s.
int time_column(const CsvTable& table, const std::string& path) {
  for (const char* name : {"time_s", "t_s", "time", "t"})
    if (const int at = table.find(name); at >= 0) return at;
  throw Error(fmt::format("it has no column time_s, but {}; let one column be time_s, in seconds",
                          shown(fmt::format("{}", fmt::join(table.names, ", ")), 120)),
              {path, 1});
}

// A name of a reference in the unit of a run, and the factor of its values.
std::pair<std::string, double> in_si(const std::string& name) {
  struct Ending {
    const char *from, *to;
    double factor;
  };
  for (const Ending& e : {Ending{"_mm", "_m", 1e-3}, {"_cm", "_m", 1e-2}, {"_g", "_m_s2", 9.80665}})
    if (name.ends_with(e.from)) return {name.substr(0, name.size() - std::string(e.from).size()) + e.to, e.factor};
  return {name, 1};
}

// Rows in which both the time and the value are numbers. Error if the time falls back.
Samples samples_of(const CsvTable& table, int time, int column, double factor, const std::string& path) {
  Samples s;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double t = table.columns[std::size_t(time)][i], y = table.columns[std::size_t(column)][i];
    if (!std::isfinite(t) || !std::isfinite(y)) continue;
    if (!s.t.empty() && t == s.t.back()) continue;
    if (!s.t.empty() && t < s.t.back())
      throw Error(fmt::format("the time falls back from {:g} s to {:g} s; sort the rows by time", s.t.back(), t), {path, int(i) + 2});
    s.t.push_back(t), s.y.push_back(factor * y);
  }
  return s;
}

// The part of a signal, shifted to earlier times, within a span, its ends interpolated.
Samples part_of(const Samples& s, double shift, double from, double to) {
  Samples part;
  const auto add = [&](double t, double y) {
    if (part.t.empty() || t > part.t.back()) part.t.push_back(t), part.y.push_back(y);
  };
  add(from, s.at(from + shift));
  for (std::size_t i = 0; i < s.t.size(); ++i)
    if (s.t[i] - shift > from && s.t[i] - shift < to) add(s.t[i] - shift, s.y[i]);
  add(to, s.at(to + shift));
  return part;
}

// The largest magnitude in each unit.
std::map<std::string, double> scales_of(const std::vector<ColumnPair>& pairs) {
  std::map<std::string, double> scales;
  for (const ColumnPair& pair : pairs) {
    double& scale = scales[plot::unit_of(pair.name)];
    scale = std::max({scale, peak_of(pair.run.y), peak_of(pair.reference.y)});
  }
  return scales;
}

ColumnPair pair_of(const CsvTable& run, int column, const CsvTable& reference, int partner, const std::string& path) {
  const std::string& name = run.names[std::size_t(column)];
  const auto [known, factor] = in_si(reference.names[std::size_t(partner)]);
  return {name, samples_of(run, time_column(run, "the run"), column, 1, "the run"),
          samples_of(reference, time_column(reference, path), partner, plot::unit_of(known) == plot::unit_of(name) ? factor : 1, path)};
}

std::vector<std::string> order_of(const Json& collapse) {
  std::vector<std::string> order;
  if (collapse.contains("sequence") && collapse["sequence"].is_array())
    for (const Json& one : collapse["sequence"])
      if (one.contains("group") && one["group"].is_string()) order.push_back(one["group"].get<std::string>());
  return order;
}

double number_in(const Json& json, const char* key) {
  const Json* value = find_key(json, key);
  return value != nullptr && value->is_number() ? value->get<double>() : NAN;
}

double angle_between(const Json& run, const Json& reference) {
  const double ax = number_in(run, "direction.0"), ay = number_in(run, "direction.1");
  const double bx = number_in(reference, "direction.0"), by = number_in(reference, "direction.1");
  return std::abs(std::atan2(ax * by - ay * bx, ax * bx + ay * by)) * 180 / pi;
}

}  // namespace

std::vector<ColumnPair> pair_columns(const CsvTable& run, const CsvTable& reference, const std::vector<std::string>& renamed,
                                     const std::string& path) {
  const int time = time_column(reference, path);
  std::vector<ColumnPair> pairs;
  for (const std::string& text : renamed) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw Error(fmt::format("--columns {} is no pair; write RUN=REFERENCE", shown(text, 60)));
    const std::string a = text.substr(0, equals), b = text.substr(equals + 1);
    if (run.find(a) < 0)
      throw Error(fmt::format("--columns {}: the run has no column of this name{}", shown(a, 60), did_you_mean(a, run.names)));
    if (reference.find(b) < 0)
      throw Error(fmt::format("--columns: there is no column {}{}", shown(b, 60), did_you_mean(b, reference.names)), {path, 1});
    pairs.push_back(pair_of(run, run.find(a), reference, reference.find(b), path));
  }
  for (int c = 0; c < int(reference.names.size()); ++c) {
    const int column = run.find(in_si(reference.names[std::size_t(c)]).first);
    if (c == time || column < 0 || run.names[std::size_t(column)] == "time_s" || !run.text[std::size_t(column)].empty()) continue;
    if (std::any_of(pairs.begin(), pairs.end(), [&](const ColumnPair& p) { return p.name == run.names[std::size_t(column)]; })) continue;
    pairs.push_back(pair_of(run, column, reference, c, path));
  }
  if (pairs.empty())
    throw Error(fmt::format("it has no column in common with the run: {} against {}; rename one, or pair them by --columns RUN=REFERENCE",
                            shown(fmt::format("{}", fmt::join(reference.names, ", ")), 120),
                            shown(fmt::format("{}", fmt::join(run.names, ", ")), 120)),
                {path, 1});
  const std::map<std::string, double> scales = scales_of(pairs);
  std::erase_if(pairs, [&](const ColumnPair& p) {
    return std::max(peak_of(p.run.y), peak_of(p.reference.y)) <= 1e-3 * scales.at(plot::unit_of(p.name)) && p.run.y.size() > 1;
  });
  if (pairs.empty()) throw Error("its common columns are zero throughout; name others by --columns RUN=REFERENCE", {path, 0});
  for (const ColumnPair& p : pairs)
    if (p.run.t.size() < 2 || p.reference.t.size() < 2)
      throw Error(
          fmt::format("column {} has fewer than two rows of numbers in one of the two; name others by --columns RUN=REFERENCE", p.name),
          {path, 0});
  return pairs;
}

TimeShift find_shift(const std::vector<ColumnPair>& pairs, Alignment how, double reach) {
  TimeShift shift;
  shift.how = how;
  if (how == Alignment::none || pairs.empty()) return shift;
  const ColumnPair* best = nullptr;
  for (const ColumnPair& pair : pairs)
    if (plot::unit_of(pair.name) == "m" && (best == nullptr || peak_of(pair.reference.y) > peak_of(best->reference.y))) best = &pair;
  if (best == nullptr) best = &pairs.front();
  shift.column = best->name;
  if (how == Alignment::first_motion) {
    shift.lag = first_motion(best->run) - first_motion(best->reference);
  } else {
    const Lag found = lag_of(best->run, best->reference, reach);
    shift.lag = found.lag, shift.correlation = found.correlation, shift.at_edge = found.at_edge;
  }
  if (!std::isfinite(shift.lag) || (how == Alignment::correlation && !std::isfinite(shift.correlation)))
    throw Error(fmt::format("{} does not move in one of the two, so that their times cannot be aligned; add --align none", best->name));
  return shift;
}

ColumnErrors errors_of(const ColumnPair& pair, double shift, double reach, const TimeSpan& span) {
  ColumnErrors e;
  e.name = pair.name;
  const double from = std::max({pair.run.t.front() - shift, pair.reference.t.front(), span.from});
  const double to = std::min({pair.run.t.back() - shift, pair.reference.t.back(), span.to});
  if (!(to > from))
    throw Error(
        fmt::format("the run and the reference have no time in common in {}, from {:g} s to {:g} s; align them by --align correlation",
                    pair.name, from, to));
  const Samples run = part_of(pair.run, shift, from, to), reference = part_of(pair.reference, 0, from, to);
  e.peak_run = peak(run.t, run.y).value, e.peak_reference = peak(reference.t, reference.y).value;
  e.rms_run = rms(run.t, run.y), e.rms_reference = rms(reference.t, reference.y);
  e.peak_error = std::abs(e.peak_run) / std::abs(e.peak_reference) - 1;
  e.rms_error = e.rms_run / e.rms_reference - 1;
  std::vector<double> times = run.t, gap;
  times.insert(times.end(), reference.t.begin(), reference.t.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (const double t : times) gap.push_back(run.at(t) - reference.at(t));
  e.difference = rms(times, gap) / std::abs(e.peak_reference);
  const Lag lag = lag_of(run, reference, std::min(reach, 0.5 * (to - from)));
  e.lag = lag.lag, e.correlation = lag.correlation;
  e.frequency_run = dominant_frequency(run.t, run.y), e.frequency_reference = dominant_frequency(reference.t, reference.y);
  e.frequency_error = e.frequency_run / e.frequency_reference - 1;
  return e;
}

CollapseErrors compare_collapse(const Json& run, const Json& reference, double shift) {
  CollapseErrors e;
  const Json *a = find_key(run, "collapse"), *b = find_key(reference, "collapse");
  if (a == nullptr || b == nullptr || !a->is_object() || !b->is_object()) return e;
  e.known = true;
  e.run = a->value("collapsed", false), e.reference = b->value("collapsed", false);
  e.time_run = number_in(*a, "time_s"), e.time_reference = number_in(*b, "time_s");
  e.order_run = order_of(*a), e.order_reference = order_of(*b);
  e.same_sequence = e.order_run == e.order_reference && e.run == e.reference;
  e.time = e.run != e.reference ? HUGE_VAL : e.run ? e.time_run - shift - e.time_reference : 0;
  e.direction = e.run != e.reference ? HUGE_VAL : e.run ? angle_between(*a, *b) : 0;
  return e;
}

std::vector<ParamDifference> compare_params(const std::vector<Param>& run, const std::vector<Param>& reference) {
  std::vector<ParamDifference> all;
  for (const Param& p : run) {
    const auto partner = std::ranges::find(reference, p.name, &Param::name);
    if (partner == reference.end()) all.push_back({p.name, p.unit, p.value, std::nullopt});
    else if (partner->value != p.value) all.push_back({p.name, p.unit, p.value, partner->value});
  }
  for (const Param& p : reference)
    if (std::ranges::find(run, p.name, &Param::name) == run.end()) all.push_back({p.name, p.unit, std::nullopt, p.value});
  return all;
}

}  // namespace erbs
