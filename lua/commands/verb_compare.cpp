// erbs compare DIR REFERENCE: a run against another run, measured displacements, or a film, which erbs-render reads.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "engine/base/correlation.h"
#include "engine/base/system/interrupt.h"
#include "engine/base/system/process.h"
#include "engine/record/folder/motion_file.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/results/compare_runs.h"
#include "engine/record/results/compare_span.h"
#include "engine/record/results/curve_figure.h"
#include "engine/record/results/curves.h"
#include "engine/record/results/limits.h"
#include "lua/program/child.h"
#include "lua/program/options.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_drawn = 8;  // columns in the figure

// Names of the free blocks of a run; none where it has no motion.h5.
std::set<std::string> block_names(const std::string& folder) {
  std::set<std::string> names;
  if (!fs::exists(run_file(folder, "motion.h5"))) return names;
  const MotionReader reader(folder);
  for (const MotionBlock& block : reader.scene().blocks)
    if (!block.fixed) names.insert(block.name);
  return names;
}

// Error for two scenes without a block in common; a warning if some differ.
void check_blocks(const std::string& run, const std::string& reference) {
  const std::set<std::string> a = block_names(run), b = block_names(reference);
  if (a.empty() || b.empty() || a == b) return;
  std::vector<std::string> common, alone;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(alone));
  if (common.empty())
    throw Error(
        fmt::format("it is a run of another scene: no block has the name of one of {}, such as {}; name a run of the same structure",
                    shown(run, 200), shown(*a.begin(), 60)),
        {reference});
  tell(stderr, fmt::format("warning: {}: {} of the block names are in one run only, such as {}; are the scenes the same?",
                           shown(reference, 200), alone.size(), shown(alone.front(), 60)));
}

CsvTable read_histories(const std::string& folder) {
  if (!is_run_folder(folder)) throw Error("it is no run folder; name one that erbs run wrote", {folder});
  const std::string path = run_file(folder, "histories.csv");
  if (!fs::exists(path)) throw Error("it has no histories.csv; run its scene again", {folder});
  CsvTable table = read_csv(path);
  if (table.rows() < 2) throw Error("it has fewer than two rows; let the run go on", {path});
  return table;
}

Json metrics_of(const std::string& folder) {
  const std::string path = run_file(folder, "metrics.json");
  return fs::exists(path) ? read_json(path) : Json::object();
}

Alignment alignment_of(const CompareCommand& command, bool of_run) {
  if (command.align == "none" || (command.align.empty() && of_run)) return Alignment::none;
  return command.align == "first-motion" ? Alignment::first_motion : Alignment::correlation;
}

// "shake 3.9 / 4.1 m/s2, height 2 / 3 m": params of the run and of the reference, at most three of them.
std::string note_of(const SceneDifferences& scenes) {
  std::string note;
  for (std::size_t i = 0; i < std::min<std::size_t>(scenes.params.size(), 3); ++i) {
    const ParamDifference& p = scenes.params[i];
    const auto value = [](const std::optional<double>& v) { return v ? fmt::format("{:.4g}", *v) : std::string("none"); };
    note += fmt::format("; {} {} / {}{}{}", p.name, value(p.run), value(p.reference), p.unit.empty() ? "" : " ", p.unit);
  }
  return scenes.params.size() > 3 ? note + "; ..." : note;
}

// The columns of the largest peaks come first.
plot::Figure figure_of(const std::vector<ColumnPair>& pairs, const TimeShift& shift, const std::string& run, const std::string& reference,
                       const std::optional<SceneDifferences>& scenes) {
  std::vector<HistoryCurve> curves;
  for (std::size_t i = 0; i < std::min(pairs.size(), most_drawn); ++i) {
    const ColumnPair& pair = pairs[i];
    HistoryCurve own{"run " + run, "time_s", pair.name, pair.run.t, pair.run.y};
    for (double& t : own.x) t -= shift.lag;
    curves.push_back(own);
    curves.push_back({"reference " + reference, "time_s", pair.name, pair.reference.t, pair.reference.y});
  }
  std::string note = shift.how == Alignment::none
                         ? "times as recorded"
                         : fmt::format("time of the reference; the run is {}, by {}", lag_text(shift.lag), words_of(shift.how));
  if (pairs.size() > most_drawn) note += fmt::format("; {} of {} columns", most_drawn, pairs.size());
  if (scenes) note += note_of(*scenes);
  return curve_figure(curves, CurveKind::history, note);
}

// The folder for the results; an error if it holds some already.
fs::path place_of(const CompareCommand& command) {
  const fs::path place = command.output.directory.empty() ? fs::path(command.words[0]) / "compare" : fs::path(command.output.directory);
  if (fs::exists(place / "compare.json") && !command.output.force)
    throw Error("it exists already; --force writes it anew, -o DIR another", {(place / "compare.json").string()});
  if (fs::exists(place) && !fs::is_directory(place)) throw Error("it is no folder; choose another name with -o DIR", {place.string()});
  return place;
}

std::string draw_figure(const plot::Figure& figure, const fs::path& place) {
  if (!can_start("gnuplot")) {
    tell(stderr, "warning: the figure needs gnuplot, which is not installed: it is left out; install the package gnuplot-nox");
    return "";
  }
  const std::string path = (place / "compare.svg").string();
  plot::draw(figure, path);
  return path;
}

bool is_table(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  return !fs::is_directory(path) && (ending == ".csv" || ending == ".txt" || ending == ".CSV");
}

bool all_passed(const std::vector<Judged>& judged) {
  return std::all_of(judged.begin(), judged.end(), [](const Judged& j) { return j.passed; });
}

// The histories of two runs or of a run and a measurement.
struct Compared {
  std::vector<ColumnPair> pairs;
  RunComparison comparison;
  ComparedSpan span;
};

bool has_response_of(const CsvTable& a, const CsvTable& b) {
  return std::ranges::any_of(a.names, [&](const std::string& name) {
    return name != "time_s" && !name.starts_with("ground_a") && std::ranges::find(b.names, name) != b.names.end();
  });
}

// Histories and energies of a run. What is left out is error of the numbers, which no two runs share.
CsvTable with_energies(const std::string& folder) {
  CsvTable table = read_columns(folder);
  for (std::size_t c = table.names.size(); c-- > 0;) {
    if (!table.names[c].starts_with("residual") && table.names[c] != "reset_J") continue;
    const auto at = std::ptrdiff_t(c);
    table.names.erase(table.names.begin() + at), table.columns.erase(table.columns.begin() + at), table.text.erase(table.text.begin() + at);
  }
  return table;
}

std::string status_of(const std::string& folder) { return metrics_of(folder).value("status", "unfinished"); }

// The rows of a push number its states of equilibrium; those of a time history are seconds.
void check_kinds(const std::string& run, const std::string& reference) {
  const bool push = metrics_of(run).contains("capacity");
  if (push == metrics_of(reference).contains("capacity")) return;
  throw Error(fmt::format("{} is a push through states of equilibrium, {} a time history; compare two of one kind",
                          shown(push ? run : reference, 400), shown(push ? reference : run, 400)));
}

// Rows of a measurement that are left out, since a cell of them is no number.
void tell_of_gaps(const CsvTable& table, const std::string& path) {
  std::size_t gaps = 0;
  for (std::size_t row = 0; row < table.rows(); ++row)
    gaps += std::ranges::any_of(table.columns, [&](const auto& column) { return !std::isfinite(column[row]); });
  if (gaps > 0)
    tell(stderr,
         fmt::format("warning: {}: {} of {} rows hold a cell that is no number; of that column the line between their neighbours counts",
                     shown(path, 200), gaps, table.rows()));
}

std::vector<ColumnPair> pairs_of(const CompareCommand& command, bool of_run) {
  const std::string &run = command.words[0], &reference = command.words[1];
  const CsvTable own = read_histories(run), other = of_run ? read_histories(reference) : read_measured_csv(reference);
  const std::string path = of_run ? run_file(reference, "histories.csv") : reference;
  if (!of_run) tell_of_gaps(other, reference);
  if (!of_run || !command.columns.empty() || has_response_of(own, other)) return pair_columns(own, other, command.columns, path);
  if (!command.output.quiet) say("the histories have no response in common: energies are compared\n");
  return pair_columns(with_energies(run), with_energies(reference), {}, run_file(reference, "energy.csv"));
}

std::vector<std::string> only_in(std::vector<std::string> of, const std::vector<std::string>& other) {
  std::erase_if(of, [&](const std::string& text) { return std::ranges::find(other, text) != other.end(); });
  return of;
}

Compared compare_histories(const CompareCommand& command) {
  const std::string &run = command.words[0], &reference = command.words[1];
  const TimeSpan chosen = command.time.empty() ? TimeSpan{} : time_span_of(command.time);
  const bool of_run = is_run_folder(reference);
  Compared c;
  if (of_run) check_kinds(run, reference);
  c.pairs = pairs_of(command, of_run);
  if (of_run) {
    check_blocks(run, reference);
    const Manifest ours = read_manifest(run), theirs = read_manifest(reference);
    c.comparison.scenes = SceneDifferences{ours.scene_hash != theirs.scene_hash, compare_params(ours.params, theirs.params),
                                           only_in(ours.notes, theirs.notes), only_in(theirs.notes, ours.notes)};
  }
  c.comparison.shift = find_shift(c.pairs, alignment_of(command, of_run), command.reach);
  const double lag = c.comparison.shift.lag;
  for (const ColumnPair& pair : c.pairs) c.comparison.columns.push_back(errors_of(pair, lag, command.reach, chosen));
  if (of_run) c.comparison.collapse = compare_collapse(metrics_of(run), metrics_of(reference), lag);
  c.span = span_of(c.pairs, c.comparison.shift, chosen, of_run);
  c.span.status_run = status_of(run);
  if (of_run) c.span.status_reference = status_of(reference);
  return c;
}

// Lets erbs-render draw and measure, then judges what it found.
int compare_pictures(const CompareCommand& command, const fs::path& place, const std::vector<Limit>& limits) {
  if (!command.time.empty()) throw Error("--time is that of histories; a film is compared as long as it lasts, so cut it instead");
  judge(limits, [](const std::string& quantity) { return values_of(Json::object(), quantity); });  // refuses what is not measured
  check_programs({renderer_path()});
  std::vector<std::string> words{command.words[0], "--compare",
                                 command.words[1], "--compare-to",
                                 place.string(),   "--no-figures",
                                 "--align",        command.align.empty() ? "correlation" : command.align,
                                 "--reach",        fmt::format("{}", command.reach)};
  words.insert(words.end(), command.film.begin(), command.film.end());
  if (command.output.force) words.emplace_back("--force");
  if (command.output.quiet) words.emplace_back("--quiet");
  catch_interrupts();
  if (const int code = run_renderer(words); code != exit_ok) return code;
  const std::string found = (place / "frames.json").string();
  const Json frames = read_json(found);
  const std::vector<Judged> judged = judge(limits, [&](const std::string& quantity) { return values_of(frames, quantity); });
  Json json{{"run", fs::canonical(command.words[0]).string()}, {"reference", fs::canonical(command.words[1]).string()}};
  for (const auto& [key, value] : frames.items())
    if (key != "frames") json[key] = value;
  if (!limits.empty()) json["expectations"] = json_of(judged), json["passed"] = all_passed(judged);
  write_json((place / "compare.json").string(), json);
  if (!command.output.quiet)
    say("{}results in {}: compare.json, frames.json, frames.svg, compare_*.mp4\n", table_of(judged), shown(place.string(), 400));
  return all_passed(judged) ? exit_ok : exit_expectation;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> film_options() {
  return {
      {"--camera", "camera of the scene, by name (default: the first)"},
      {"--eye", "x,y,z: position of a camera of your own (m)"},
      {"--target", "x,y,z: the point that it looks at (m)"},
      {"--fov", "its vertical angle of view (deg)"},
      {"--points", "x,y,z:u,v;..: four or more points (m) and their places in the picture (px), which give the camera"},
      {"--shaking", "camera (default): it moves with the shaken ground; table: the camera is at rest beside it"},
      {"--fps", "pictures a second of a folder of frames (default 25)"},
      {"--slow", "seconds of film for one second of the test (default 1)"},
      {"--film-width", "of the pictures drawn and of the films at most, px (default 640, the size that is measured)"},
      {"--film-background",
       "what the film shows where the structure is not, from which its silhouette is told. rows (default): the median colour of each row "
       "of the first picture, for a structure that fills less than half of each row; drawn: the run drawn without its blocks, for films "
       "that erbs render has made, with --no-overlay; or a PNG in the size of the film, such as a picture of the empty table"}};
}

int verb_compare(const CompareCommand& command) {
  if (command.words.size() != 2) throw Error("compare takes a run folder and a reference; write erbs compare DIR REFERENCE");
  const std::vector<Limit> limits = command.expect.empty() ? std::vector<Limit>{} : limits_of(command.expect);
  const std::string &run = command.words[0], &reference = command.words[1];
  const fs::path place = place_of(command);
  if (!fs::exists(reference))
    throw Error("there is no such file or folder; name a run folder, a CSV file, a film or a folder of PNG frames", {reference});
  if (!is_run_folder(reference) && !is_table(reference)) return compare_pictures(command, place, limits);
  if (!command.film.empty()) throw Error(fmt::format("{} belongs to a film or a folder of frames; leave it out", command.film.front()));
  const Compared compared = compare_histories(command);
  const RunComparison& comparison = compared.comparison;
  const std::vector<std::string> gaps = gaps_of(compared.span);
  const std::vector<Judged> judged = judge(limits, [&](const std::string& quantity) { return values_of(comparison, quantity); });

  Json json{{"run", fs::canonical(run).string()}, {"reference", fs::canonical(reference).string()}};
  json.update(json_of(comparison));
  json["span"] = json_of(compared.span);
  const bool passed = all_passed(judged) && (gaps.empty() || limits.empty());
  if (!limits.empty()) json["expectations"] = json_of(judged), json["passed"] = passed;
  fs::create_directories(place);
  const std::string figure = draw_figure(figure_of(compared.pairs, comparison.shift, fs::canonical(run).filename().string(),
                                                   fs::canonical(reference).filename().string(), comparison.scenes),
                                         place);
  write_json((place / "compare.json").string(), json);
  for (const std::string& gap : gaps) tell(stderr, "warning: " + gap);
  if (!command.output.quiet) {
    say("{}{}{}{}", table_of(comparison), table_of(compared.span), table_of(judged),
        passed || gaps.empty() || limits.empty() ? "" : "FAILED   what is compared is not the whole, see the warning\n");
    say("results in {}{}\n", shown(place.string(), 400), figure.empty() ? "" : ": compare.json, compare.svg");
  }
  return passed ? exit_ok : exit_expectation;
}

}  // namespace erbs::lua
