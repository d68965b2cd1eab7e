// erbs accuracy SCENE.lua: the cost of one more digit in this scene, and the setting that gives it for the least cost.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "engine/record/folder/run_folder.h"
#include "lua/program/progress.h"
#include "lua/program/say.h"
#include "lua/reading/quality.h"
#include "lua/reports/accuracy.h"
#include "lua/reports/book.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

std::string error_text(const study::Goal& q, const std::optional<double>& error) {
  if (!error) return "-";
  return q.reference != 0 ? fmt::format("{:.3g} %", 100 * *error) : fmt::format("{:.3g} {}", *error, q.unit);
}

void print_table(const AccuracyStudy& s) {
  const study::Goal& q = s.quantity();
  say("{}: {}\n{} = {:.8g} {} by {}{}\n\n", s.name, s.title, q.name, q.reference, q.unit, q.from,
      q.uncertainty > 0 ? fmt::format(", uncertainty {:.2g}", q.uncertainty) : "");
  say("{:<22}  {:<32}  {:>14}  {:>12}  {:>9}  {:>12}\n", "knob", "setting", "value", "error", "cpu s", "evaluations");
  std::vector<std::size_t> order(s.all.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const study::Setting &x = s.all[a].setting, &y = s.all[b].setting;
    return x.knob != y.knob ? x.knob < y.knob : x.size > y.size;
  });
  for (const std::size_t i : order) {
    const study::Measured& m = s.all[i];
    const auto& value = m.values[s.main];
    say("{:<22}  {:<32}  {:>14}  {:>12}  {:>9.3f}  {:>12.3g}{}\n", m.setting.knob, m.setting.name,
        value ? fmt::format("{:.8g}", *value) : "-", error_text(q, error_of(q, value)), m.cpu, m.updates,
        m.reason.empty() ? "" : "  " + m.reason);
  }
  for (const auto& text : s.not_applicable) say("{:<22}  not applicable\n", text);
  for (const study::Curve& c : curves_of(q, s.main, s.all))
    if (c.slope)
      say("{}: the error falls with the power {:.2f} of {}\n", c.knob, *c.slope,
          c.knob == "time step"          ? "dt"
          : c.knob.starts_with("points") ? "the spacing of points"
                                         : "its size");
}

// Answers --target and --budget: the setting, and the line to write into the scene.
int answer(const AccuracyStudy& s, const AccuracyCommand& command) {
  const study::Goal& q = s.quantity();
  const auto tell_of = [&](std::size_t i) {
    const study::Measured& m = s.all[i];
    say("  {} costs {:.3g} s, with an error of {}\n", m.setting.name, m.cpu, error_text(q, error_of(q, m.values[s.main])));
    say("  {}\n", m.setting.line.empty() ? "no change is needed" : m.setting.line);
  };
  int code = exit_ok;
  const std::vector<std::size_t> front = pareto(q, s.main, s.all, true);
  if (command.target > 0) {
    say("target {:g} %:\n", 100 * command.target);
    if (const auto found = cheapest(q, s.main, s.all, command.target)) {
      tell_of(*found);
    } else if (front.empty()) {
      say("  no run gave a value\n");
      code = exit_expectation;
    } else {
      say("  no setting reaches it; {}. The best:\n", what_limits(q, s.main, s.all));
      tell_of(front.back());
      code = exit_expectation;
    }
  }
  if (command.budget > 0) {
    say("budget {}:\n", duration_text(command.budget));
    if (const auto found = best_within(q, s.main, s.all, command.budget)) tell_of(*found);
    else say("  no run that gave a value fits; the cheapest takes {:.3g} s\n", front.empty() ? 0.0 : s.all[front.front()].cpu);
    if (!best_within(q, s.main, s.all, command.budget)) code = exit_expectation;
  }
  return code;
}

void check_folder(const std::string& directory, const AccuracyCommand& command) {
  if (!fs::exists(directory)) return;
  if (!command.output.force && !command.batch.resume)
    throw Error(fmt::format("{} exists; write --resume to keep its runs, or --force to make them again", directory));
}

void write_study(const AccuracyStudy& s) {
  write_accuracy_csv(s, run_file(s.directory, "accuracy.csv"));
  draw_accuracy(s, run_file(s.directory, "accuracy.svg"));
  draw_accuracy(s, run_file(s.directory, "accuracy.png"));
}

// The row of the study's README.md: best slopes, cheapest settings for 1 % and 0.1 %.
std::string study_row(const AccuracyStudy& s) {
  const study::Goal& q = s.quantity();
  std::string slopes;
  for (const study::Curve& c : curves_of(q, s.main, s.all))
    if (c.slope && (c.knob == "time step" || c.knob.starts_with("points")))
      slopes += fmt::format("{}{} {:.2f}", slopes.empty() ? "" : ", ", c.knob, *c.slope);
  const auto cost = [&](double target) {
    const auto i = cheapest(q, s.main, s.all, target);
    return i ? fmt::format("{}: {:.2g} pt", s.all[*i].setting.name, s.all[*i].updates) : std::string("not reached");
  };
  const std::vector<std::size_t> front = pareto(q, s.main, s.all, true);
  return fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", s.name, cell(s.title), code_cell(q.name), slopes.empty() ? "-" : slopes,
                     cost(0.01), cost(0.001), front.empty() ? "-" : error_text(q, error_of(q, s.all[front.back()].values[s.main])));
}

// The row of a problem in the table of qualities: the error of each, and its number of evaluations over that of standard.
std::string quality_row(const AccuracyStudy& s) {
  const auto find = [&](const Quality& q) {
    return std::find_if(s.all.begin(), s.all.end(), [&](const study::Measured& m) {
      return m.setting.knob == study::quality_knob && m.setting.name.ends_with(q.name);
    });
  };
  std::string errors, costs;
  const auto standard = find(qualities[1]);
  for (const Quality& q : qualities) {
    const auto m = find(q);
    if (m == s.all.end() || standard == s.all.end()) return "";
    errors += " " + error_text(s.quantity(), error_of(s.quantity(), m->values[s.main])) + " |";
    costs += m->updates > 0 && standard->updates > 0 ? fmt::format(" {:.2g} |", m->updates / standard->updates)
                                                     : fmt::format(" {:.2g} (s) |", m->cpu / standard->cpu);
  }
  const double uncertain = s.quantity().reference != 0 ? s.quantity().uncertainty / std::fabs(s.quantity().reference) : 0;
  return fmt::format("| `{}` | {} |{} {} |{}\n", s.name, code_cell(s.quantity().name), errors,
                     uncertain > 0 ? fmt::format("{:.2g} %", 100 * uncertain) : "exact", costs);
}

int whole_study(const AccuracyCommand& command) {
  const std::string folder = command.words.empty() ? "scenes/accuracy" : command.words.front();
  if (!fs::is_directory(folder)) throw Error(fmt::format("there is no folder {}; the study needs its problems", folder));
  std::vector<std::string> scenes;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".lua" && entry.path().filename().string().starts_with("p")) scenes.push_back(entry.path().string());
  std::sort(scenes.begin(), scenes.end());
  const size_t problems = scenes.size();
  // further scenes for the table of qualities
  for (const auto& entry : fs::directory_iterator(fs::absolute(folder).lexically_normal().parent_path()))
    if (entry.path().filename().string().ends_with("_quality.lua")) scenes.push_back(fs::relative(entry.path()).string());
  std::sort(scenes.begin() + static_cast<std::ptrdiff_t>(problems), scenes.end());
  if (problems == 0) throw Error(fmt::format("{} holds no problem p1_... of the study", folder));
  const std::string out = command.output.directory.empty() ? "runs/accuracy" : command.output.directory;
  check_folder(out, command);
  std::vector<AccuracyStudy> all;
  std::string table =
      "| problem | | quantity | order of the error in | cheapest for 1 % | cheapest for 0.1 % | best |\n|---|---|---|---|---|---|---|\n";
  std::string quality =
      "| problem | quantity | error of draft | standard | reference | what it is measured by, uncertain | cost of draft | standard | "
      "reference |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  double wall = 0;
  for (const auto& scene : scenes) {
    all.push_back(carry_out_accuracy(scene, out + "/" + fs::path(scene).stem().string(), command));
    const AccuracyStudy& s = all.back();
    write_study(s);
    quality += quality_row(s);
    if (s.name.starts_with("p")) table += study_row(s);
    wall += s.wall;
    say("{}\n\n", plain_sentence(s.quantity(), s.main, s.all));
    std::fflush(stdout);
  }
  std::erase_if(all, [](const AccuracyStudy& s) { return !s.name.starts_with("p"); });  // scenes for the table of qualities only
  const fs::path home = fs::weakly_canonical(folder).parent_path().parent_path();       // the parent folder of scenes/
  const std::string picture = fs::is_directory(home / "media") ? (home / "media/accuracy.png").string() : out + "/accuracy.png";
  draw_accuracies(all, picture);
  const std::string readme = (fs::weakly_canonical(folder) / "README.md").string();
  if (fs::exists(readme)) replace_marked(readme, "accuracy", table), replace_marked(readme, "quality", quality);
  say("{}\n{}{} problems in {}; figure {}\n", table, quality, all.size(), duration_text(wall), picture);
  return exit_ok;
}

}  // namespace

int verb_accuracy(const AccuracyCommand& command) {
  if (command.whole_study) return whole_study(command);
  if (command.words.size() != 1) throw Error("accuracy takes one scene; write erbs accuracy SCENE.lua, or erbs accuracy --study");
  const std::string& scene = command.words.front();
  if (!fs::is_regular_file(scene)) throw Error(fmt::format("there is no scene {}; check the path", scene));
  const std::string directory =
      command.output.directory.empty() ? "runs/accuracy_" + fs::path(scene).stem().string() : command.output.directory;
  check_folder(directory, command);
  const AccuracyStudy s = carry_out_accuracy(scene, directory, command);
  print_table(s);
  write_study(s);
  say("\n{}\n", plain_sentence(s.quantity(), s.main, s.all));
  const int code = answer(s, command);
  say("{} runs, {} of processor time, {} of wall-clock time; {}/accuracy.csv, accuracy.svg, accuracy.png\n", s.all.size(),
      duration_text(s.cpu), duration_text(s.wall), directory);
  if (s.waiting > 0)
    say("{} of them did not fit into {}; --resume makes them, --within 10m allows more time\n", s.waiting, duration_text(command.within));
  const bool any = std::any_of(s.all.begin(), s.all.end(), [&](const study::Measured& m) { return m.values[s.main].has_value(); });
  const bool refused =
      std::all_of(s.all.begin(), s.all.end(), [](const study::Measured& m) { return m.reason.starts_with("exit code 2"); });
  return any ? code : refused ? exit_usage : exit_numbers;
}

}  // namespace erbs::lua
