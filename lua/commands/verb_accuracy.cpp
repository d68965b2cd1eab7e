// erbs accuracy SCENE.lua: the cost of one more digit in this scene, and the setting that gives it for the least cost.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "engine/base/text.h"
#include "engine/record/folder/run_folder.h"
#include "lua/program/progress.h"
#include "lua/program/say.h"
#include "lua/reports/accuracy/tables.h"
#include "lua/reports/book.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

// Answers --target and --budget: the setting, and the line to write into the scene.
int answer(const AccuracyStudy& s, const AccuracyCommand& command) {
  const study::Goal& q = s.quantity();
  const auto tell_of = [&](std::size_t i) {
    const study::Measured& m = s.all[i];
    say("  {} costs {:.3g} s, with an error of {}\n", m.setting.name, m.cpu, error_text(q, s.error(m)));
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

// The problems of the folder, and further scenes for the table of qualities: NAME_quality.lua beside the folder.
std::vector<std::string> problems_of(const std::string& folder) {
  if (!fs::is_directory(folder)) throw Error(fmt::format("there is no folder {}; the study needs its problems", folder));
  std::vector<std::string> problems, others;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".lua" && entry.path().filename().string().starts_with("p")) problems.push_back(entry.path().string());
  if (problems.empty()) throw Error(fmt::format("{} holds no problem p1_... of the study", folder));
  for (const auto& entry : fs::directory_iterator(fs::absolute(folder).lexically_normal().parent_path()))
    if (entry.path().filename().string().ends_with("_quality.lua")) others.push_back(fs::relative(entry.path()).string());
  std::sort(problems.begin(), problems.end());
  std::sort(others.begin(), others.end());
  problems.insert(problems.end(), others.begin(), others.end());
  return problems;
}

int whole_study(const AccuracyCommand& command) {
  const std::string folder = command.words.empty() ? "scenes/accuracy" : command.words.front();
  const std::vector<std::string> scenes = problems_of(folder);
  const std::string out = command.output.directory.empty() ? "runs/accuracy" : command.output.directory;
  AccuracyResult result = carry_out_accuracy(scenes, out, command);
  std::vector<AccuracyStudy>& all = result.studies;
  write_accuracy_csv(all, run_file(out, "accuracy.csv"));
  for (const AccuracyStudy& s : all) say("{}\n\n", plain_sentence(s.quantity(), s.main, s.all));
  const std::string quality = quality_table(all);
  std::erase_if(all, [](const AccuracyStudy& s) { return !s.name.starts_with("p"); });  // scenes for the table of qualities only
  const std::string table = accuracy_table(all), sentence = seconds_sentence(all);
  for (const char* picture : {"accuracy.svg", "accuracy.png"}) draw_accuracies(all, run_file(out, picture));
  const fs::path home = fs::weakly_canonical(folder).parent_path().parent_path();  // the parent folder of scenes/
  if (fs::is_directory(home / "media")) draw_accuracies(all, (home / "media/accuracy.png").string());
  const std::string readme = (fs::weakly_canonical(folder) / "README.md").string();
  if (fs::exists(readme)) replace_marked(readme, "accuracy", table), replace_marked(readme, "quality", quality);
  if (fs::exists(home / "README.md")) replace_marked((home / "README.md").string(), "accuracy", sentence);
  say("{}\n{}\n{}\n{}, {}, {} of processor time, {} of wall-clock time; {}/accuracy.csv, accuracy.svg, accuracy.png\n", table, quality,
      sentence, counted(all.size(), "problem"), counted(result.runs, "run"), duration_text(result.cpu), duration_text(result.wall), out);
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
  const AccuracyResult result = carry_out_accuracy({scene}, directory, command);
  const AccuracyStudy& s = result.studies.front();
  print_settings(s);
  write_accuracy_csv(result.studies, run_file(directory, "accuracy.csv"));
  for (const char* picture : {"accuracy.svg", "accuracy.png"}) draw_accuracy(s, run_file(directory, picture));
  say("\n{}\n", plain_sentence(s.quantity(), s.main, s.all));
  const int code = answer(s, command);
  say("{}, {} of processor time, {} of wall-clock time; {}/accuracy.csv, accuracy.svg, accuracy.png\n", counted(result.runs, "run"),
      duration_text(result.cpu), duration_text(result.wall), directory);
  if (s.waiting > 0)
    say("{} of them did not fit into {}; --resume makes them, --within 10m allows more time\n", s.waiting, duration_text(command.within));
  const bool any = std::any_of(s.all.begin(), s.all.end(), [&](const study::Measured& m) { return m.values[s.main].has_value(); });
  const bool refused =
      std::all_of(s.all.begin(), s.all.end(), [](const study::Measured& m) { return m.reason.starts_with("exit code 2"); });
  return any ? code : refused ? exit_usage : exit_numbers;
}

}  // namespace erbs::lua
