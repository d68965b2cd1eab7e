// erbs plot DIR...: columns of histories.csv and energy.csv, or of the curve.csv of a push, as curves, of one run or of several over each
// other.
#include <algorithm>
#include <filesystem>

#include "engine/base/system/process.h"
#include "engine/base/text.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/plot/unit.h"
#include "engine/record/report/drift.h"
#include "engine/record/report/stress_histogram.h"
#include "engine/record/results/curve_figure.h"
#include "engine/record/results/metrics.h"
#include "lua/program/options.h"
#include "lua/program/output_path.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

struct ReadRun {
  std::string folder, name;
  CsvTable table;
  std::optional<CsvTable> capacity;  // of a push
};

// Names of folders, or whole paths if two of these are the same.
std::vector<ReadRun> read_runs(const std::vector<std::string>& folders) {
  std::vector<ReadRun> runs;
  for (const std::string& folder : folders) {
    ReadRun run{folder, "", read_columns(folder), read_capacity(folder)};
    run.name = fs::canonical(folder).filename().string();
    runs.push_back(std::move(run));
  }
  std::vector<std::string> names;
  for (const ReadRun& run : runs) names.push_back(run.name);
  for (ReadRun& run : runs)
    if (std::count(names.begin(), names.end(), run.name) > 1) run.name = run.folder;
  return runs;
}

void list_columns(const CsvTable& table) {
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    if (!table.text[c].empty()) continue;
    const plot::Unit* unit = plot::find_unit(plot::unit_of(table.names[c]));
    say("{:<32} {:<8} {}\n", table.names[c], unit ? unit->shown.front().factor == 1 ? unit->shown.front().name : unit->suffix : "-",
        unit ? unit->quantity : "");
  }
}

void list_columns(const std::vector<ReadRun>& runs) {
  for (const ReadRun& run : runs) {
    if (runs.size() > 1) say("{}\n", shown(run.folder, 400));
    list_columns(run.table);
    if (!run.capacity) continue;
    say("states of equilibrium, curve.csv:\n");
    list_columns(*run.capacity);
  }
}

// "; the run has a, b, c and 12 more; erbs plot DIR --list says what they are", first those that the scene records.
std::string known_columns(const CsvTable& table) {
  constexpr std::size_t most = 16;
  std::vector<std::string> names;
  for (std::size_t c = 0; c < table.names.size(); ++c)
    if (table.text[c].empty() && table.names[c] != "time_s") names.push_back(table.names[c]);
  const std::size_t shown = std::min(names.size(), most);
  return fmt::format("; the run has {}{}; erbs plot DIR --list says what they are",
                     fmt::join(names.begin(), names.begin() + std::ptrdiff_t(shown), ", "),
                     shown < names.size() ? fmt::format(" and {} more", names.size() - shown) : "");
}

bool holds(const CsvTable& table, const std::string& pattern) {
  try {
    return !choose_columns(table, pattern).empty();
  } catch (const Error&) { return false; }
}

// The columns of the capacity are those that the histories have not; both axes are of one table.
const CsvTable& table_of(const ReadRun& run, const std::string& x) {
  return run.capacity && !holds(run.table, x) && holds(*run.capacity, x) ? *run.capacity : run.table;
}

// A pattern that fits no column of `table` may be meant for the other table of a push.
std::vector<int> columns_of(const ReadRun& run, const CsvTable& table, const std::string& pattern) {
  try {
    return choose_columns(table, pattern);
  } catch (const Error& mistake) {
    if (!run.capacity) throw;
    const bool of_states = &table == &*run.capacity;
    if (!of_states && holds(*run.capacity, pattern))
      throw Error(
          fmt::format("{} is a column of curve.csv, of the states of equilibrium, which have no time; draw it over another one of {}, "
                      "such as --x displacement_m",
                      shown(pattern, 60), fmt::join(run.capacity->names, ", ")));
    const CsvTable& other = of_states ? run.table : *run.capacity;
    throw Error(fmt::format("{}; {}: {}", mistake.what(), of_states ? "over time" : "of the states of equilibrium, curve.csv",
                            fmt::join(other.names, ", ")));
  }
}

CurveKind kind_of(const PlotCommand& command) {
  if (command.spectrum + command.response + command.envelope > 1)
    throw Error("--spectrum, --response and --envelope exclude each other; keep one");
  if (command.damping && !command.response) throw Error("--damping is that of --response; add --response, or leave it out");
  if (command.damping && *command.damping >= 1) throw Error("--damping must be below 1, a share of critical damping; try 0.05");
  if ((command.spectrum || command.response) && command.x != "time_s")
    throw Error("--spectrum and --response have their own horizontal axis; leave out --x");
  return command.spectrum   ? CurveKind::spectrum
         : command.response ? CurveKind::response
         : command.envelope ? CurveKind::envelope
                            : CurveKind::history;
}

std::string picture_of(const PlotCommand& command) {
  if (command.png && !command.output.directory.empty() && fs::path(command.output.directory).extension() != ".png")
    throw Error("--png and the ending of -o disagree; let the name end with .png", {command.output.directory});
  return output_path(command.output, (fs::path(command.words.front()) / (command.png ? "plot.png" : "plot.svg")).string(), "a picture",
                     {".svg", ".png"});
}

// Adds the curves of the columns that each pattern fits, each column once.
void add_curves(const ReadRun& run, const PlotCommand& command, CurveKind kind, std::vector<HistoryCurve>& curves) {
  const CsvTable& table = table_of(run, command.x);
  const std::vector<int> x = columns_of(run, table, command.x);
  if (x.size() > 1) {
    std::vector<std::string> names;
    for (const int c : x) names.push_back(table.names[std::size_t(c)]);
    throw Error(fmt::format("--x {} fits {} columns, {}; name one of them", shown(command.x, 60), x.size(), fmt::join(names, ", ")));
  }
  const TimeSpan span = command.time.empty() ? TimeSpan{} : time_span_of(command.time);
  std::vector<int> chosen;
  for (const std::string& pattern : command.y)
    for (const int c : columns_of(run, table, pattern))
      if (std::find(chosen.begin(), chosen.end(), c) == chosen.end()) chosen.push_back(c);
  for (const int c : chosen) {
    HistoryCurve curve = curve_of(table, x.front(), c, span);
    curve.run = run.name;
    if (kind == CurveKind::envelope) curve.y = envelope_of(curve.y);
    if (kind == CurveKind::spectrum) curve = amplitude_spectrum(curve);
    if (kind == CurveKind::response) curve = response_curve(curve, command.damping.value_or(0.05));
    curves.push_back(std::move(curve));
  }
}

void check_gnuplot() {
  if (!can_start("gnuplot")) throw Error("pictures need gnuplot, which is not installed; install the package gnuplot-nox");
}

// "first diverged": the runs whose curves end early or mean little.
std::string troubled(const std::vector<std::string>& folders) {
  std::string text;
  for (const std::string& folder : folders) {
    const std::string path = run_file(folder, "metrics.json");
    const std::string status = fs::exists(path) ? read_json(path).value("status", "completed") : "completed";
    if (status != "completed")
      text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", fs::canonical(folder).filename().string(),
                          status == "diverged" ? "" : "is ", status);
  }
  return text;
}

std::string joined(const std::string& a, const std::string& b) { return a.empty() || b.empty() ? a + b : a + "; " + b; }

void warn_of(const std::vector<std::string>& folders) {
  if (const std::string trouble = troubled(folders); !trouble.empty())
    tell(stderr, fmt::format("warning: {}; log.txt of the run says why", trouble));
  for (const std::string& folder : folders)
    if (const std::string uneven = uneven_rows(folder); !uneven.empty())
      tell(stderr, fmt::format("warning: {}: {}", shown(folder, 200), uneven));
}

std::string note_of(const PlotCommand& command, CurveKind kind) {
  std::string note = kind == CurveKind::spectrum   ? "Fourier amplitude spectrum, Hann window"
                     : kind == CurveKind::response ? fmt::format("response spectrum, {:g} % damping", 100 * command.damping.value_or(0.05))
                     : kind == CurveKind::envelope ? "running maximum of the absolute value"
                                                   : "";
  if (command.time.empty()) return note;
  const TimeSpan span = time_span_of(command.time);
  return note + fmt::format("{}{:g} s to {:g} s", note.empty() ? "" : ", ", span.from, span.to);
}

// The frames of a run within the span; without a span until its collapse, or the last state of a push, since the drift of debris means
// nothing.
DriftProfile profile_of(const std::string& folder, const PlotCommand& command) {
  const MotionReader reader(folder);
  TimeSpan span;
  if (!command.time.empty()) span = time_span_of(command.time);
  else if (fs::exists(run_file(folder, "metrics.json"))) {
    const Json metrics = read_metrics(folder);
    const Json* fall = find_key(metrics, "collapse.time_s");
    if (fall != nullptr && fall->is_number()) span.to = fall->get<double>();
    const double states = number_at(metrics, "capacity.states");  // a frame each, before those of the fall
    if (states >= 1 && states <= double(reader.times().size())) span.to = reader.times()[std::size_t(states) - 1];
  }
  std::vector<MotionFrame> frames;
  for (std::size_t i = 0; i < reader.times().size(); ++i)
    if (reader.times()[i] >= span.from && reader.times()[i] <= span.to) frames.push_back(reader.read(int(i)));
  return drift_profile(reader.scene(), frames, command.levels, command.group);
}

void draw_drift(const PlotCommand& command, const std::string& path) {
  std::vector<DriftProfile> profiles;
  for (const std::string& folder : command.words) try {
      profiles.push_back(profile_of(folder, command));
      profiles.back().run = fs::canonical(folder).filename().string();
      for (std::size_t i = 0; i + 1 < profiles.size(); ++i)
        if (profiles[i].run == profiles.back().run) profiles.back().run = folder;
    } catch (const Error& mistake) {
      if (!mistake.place.file.empty()) throw;
      throw Error(mistake.what(), {folder});
    }
  const std::string span = command.time.empty() ? "until a collapse" : note_of(command, CurveKind::history);
  warn_of(command.words);
  std::vector<std::string> levels;  // of each run; one number where they agree
  for (const DriftProfile& profile : profiles) levels.push_back(fmt::format("{}", profile.height.size()));
  if (std::ranges::count(levels, levels.front()) == std::ptrdiff_t(levels.size())) levels.resize(1);
  const std::string note =
      fmt::format("{}, {} levels, {}", command.group.empty() ? "all blocks" : command.group, fmt::join(levels, " / "), span);
  plot::draw(drift_figure(profiles, joined(note, troubled(command.words))), path);
}

void draw_histogram(const PlotCommand& command, const std::string& path) {
  std::vector<StressSample> samples;
  for (const std::string& folder : command.words) try {
      const MotionReader reader(folder);
      samples.push_back(stress_sample(reader, command.histogram, command.time));
      samples.back().run = fs::canonical(folder).filename().string();
      for (std::size_t i = 0; i + 1 < samples.size(); ++i)
        if (samples[i].run == samples.back().run) samples.back().run = folder;
    } catch (const Error& mistake) {
      if (!mistake.place.file.empty()) throw;
      throw Error(mistake.what(), {folder});
    }
  warn_of(command.words);
  plot::draw(stress_figure(samples, command.histogram), path);
}

// Figures of motion.h5 draw no columns.
bool draws_frames(const PlotCommand& command, CurveKind kind) {
  if (!command.drift && command.histogram.empty()) return false;
  const std::string option = command.drift ? "--drift" : "--histogram";
  if (command.drift && !command.histogram.empty()) throw Error("--drift and --histogram exclude each other; keep one");
  if (!command.y.empty() || kind != CurveKind::history || command.list)
    throw Error(option + " draws no columns; leave out --y, --spectrum, --response, --envelope and --list");
  const std::string path = picture_of(command);
  check_gnuplot();
  if (command.drift) draw_drift(command, path);
  else draw_histogram(command, path);
  if (!command.output.quiet)
    say("picture {} ({} of {})\n", shown(path, 400), command.drift ? "drift" : "histogram", counted(command.words.size(), "run"));
  return true;
}

}  // namespace

int verb_plot(const PlotCommand& command) {
  if (command.words.empty()) throw Error("plot takes a run folder; write erbs plot DIR --y COLUMN");
  const CurveKind kind = kind_of(command);
  if (!command.time.empty() && command.histogram.empty()) time_span_of(command.time);
  if (draws_frames(command, kind)) return exit_ok;
  const std::vector<ReadRun> runs = read_runs(command.words);
  if (command.list) return (list_columns(runs), exit_ok);
  if (command.y.empty()) throw Error(fmt::format("plot takes columns; write --y COLUMN{}", known_columns(runs.front().table)));
  const std::string path = picture_of(command);
  std::vector<HistoryCurve> curves;
  for (const ReadRun& run : runs) try {
      add_curves(run, command, kind, curves);
    } catch (const Error& mistake) {
      if (!mistake.place.file.empty()) throw;
      throw Error(mistake.what(), {run.folder});
    }
  check_gnuplot();
  warn_of(command.words);
  plot::draw(curve_figure(curves, kind, joined(note_of(command, kind), troubled(command.words))), path);
  if (!command.output.quiet) say("picture {} ({})\n", shown(path, 400), counted(curves.size(), "curve"));
  return exit_ok;
}

}  // namespace erbs::lua
