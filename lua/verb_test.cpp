// erbs test DIR|SCENE...: every scene that carries expectations, run by child processes side by side, as one table.
#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "engine/record/run_folder.h"
#include "lua/child.h"
#include "lua/expectations.h"
#include "lua/options.h"
#include "lua/progress.h"

namespace erbs {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string scene, name, directory, log;
  int code = 0;
};

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

bool carries_expectations(const fs::path& path) {
  const std::string text = text_of(path);
  for (size_t at = text.find("expect"); at != std::string::npos; at = text.find("expect", at + 1)) {
    const size_t next = text.find_first_not_of(" \t", at + 6);
    const size_t line = text.rfind('\n', at) + 1;  // npos + 1 is 0
    if (next != std::string::npos && text[next] == '(' && text.substr(line, at - line).find("--") == std::string::npos) return true;
  }
  return false;
}

std::vector<Case> cases_of(const Options& options) {
  std::vector<std::string> scenes;
  for (const auto& word : options.words) {
    if (fs::is_directory(word)) {
      std::vector<std::string> found;
      for (const auto& entry : fs::recursive_directory_iterator(word))
        if (entry.is_regular_file() && entry.path().extension() == ".lua" && carries_expectations(entry.path()))
          found.push_back(entry.path().string());
      std::sort(found.begin(), found.end());
      if (found.empty()) throw Error(fmt::format("{} holds no scene with expectations; add expect(...) to one", word));
      scenes.insert(scenes.end(), found.begin(), found.end());
    } else if (fs::is_regular_file(word)) {
      scenes.push_back(word);
    } else {
      throw Error(fmt::format("there is no scene and no folder {}; check the path", word));
    }
  }
  const std::string out = options.directory.empty() ? "runs/test" : options.directory;
  std::vector<Case> cases;
  std::set<std::string> names;
  for (const auto& scene : scenes) {
    std::string name = fs::path(scene).stem().string();
    for (int i = 2; !names.insert(name).second; ++i) name = fmt::format("{}_{}", fs::path(scene).stem().string(), i);
    cases.push_back({scene, name, out + "/" + name, out + "/" + name + ".log", 0});
  }
  return cases;
}

Child launch(const Case& item, const Options& options, int threads) {
  std::vector<std::string> command{own_path(), "run", item.scene, "-o", item.directory, "--force"};
  if (threads > 0) command.insert(command.end(), {"--threads", std::to_string(threads)});
  for (const auto& [name, value] : options.overrides) {
    command.push_back("-D");
    command.push_back(name + "=" + value);
  }
  if (options.max_wall) command.insert(command.end(), {"--max-wall", fmt::format("{}s", *options.max_wall)});
  fs::remove_all(item.directory + "/expectations.json");
  return start(command, item.log);
}

void run_all(std::vector<Case>& cases, const Options& options) {
  const int machine = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const size_t jobs = static_cast<size_t>(options.jobs > 0 ? options.jobs : machine);
  // as many runs at once as there are processors: one thread each; fewer: each as it sees fit (0)
  const int threads = options.threads > 0 ? options.threads : static_cast<int>(std::min(jobs, cases.size())) >= machine ? 1 : 0;
  std::map<int, Case*> running;
  size_t next = 0, done = 0;
  const bool live = isatty(STDERR_FILENO) != 0 && !options.quiet;
  while (done < cases.size()) {
    while (next < cases.size() && running.size() < jobs) {
      Case& item = cases[next++];
      running[launch(item, options, threads).pid] = &item;
    }
    if (live) fmt::print(stderr, "\r\033[K{} of {} cases, running {}", done, cases.size(), running.begin()->second->name);
    const Ended ended = wait_for_any();  // -1 where a signal came first
    const auto found = running.find(ended.pid);
    if (found == running.end()) continue;
    found->second->code = ended.code;
    running.erase(found);
    ++done;
  }
  if (live) fmt::print(stderr, "\r\033[K");
}

struct Row {
  std::vector<std::string> cells;
  bool passed;
};

std::vector<Row> rows_of(const Case& item) {
  std::vector<Row> rows;
  std::string cost;
  std::vector<Verdict> verdicts;
  try {
    if (fs::exists(run_file(item.directory, "expectations.json"))) {
      verdicts = verdicts_of(read_json(run_file(item.directory, "expectations.json")));
      const Json metrics = read_metrics(item.directory);
      const Json* wall = find_key(metrics, "wall_s.total");
      const Json* updates = find_key(metrics, "point_updates");
      cost = fmt::format("{:.2f} s, {:.2g} pt", wall && wall->is_number() ? wall->get<double>() : 0.0,
                         updates && updates->is_number() ? updates->get<double>() : 0.0);
    }
  } catch (const Error& error) { rows.push_back({{item.name, "(run folder)", "", error.what(), "", "", "FAILED", ""}, false}); }
  for (const Verdict& v : verdicts)
    rows.push_back(
        {{item.name, v.key, v.expected, v.got, v.error, v.tolerance, v.passed ? "ok" : "FAILED", rows.empty() ? cost : ""}, v.passed});
  const bool wrong_code = item.code != exit_ok && item.code != exit_expectation;
  if (wrong_code || rows.empty()) {
    const std::string why = wrong_code ? last_words(item.log, item.code, item.scene) : "the scene carries no expectation; add expect(...)";
    rows.push_back({{item.name, "(run)", "", why, "", "", "FAILED", rows.empty() ? cost : ""}, false});
  }
  return rows;
}

// Letters, not bytes, of UTF-8.
size_t width_of(const std::string& text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

void print_table(const std::vector<Row>& rows) {
  const std::vector<std::string> head{"case", "quantity", "expected", "got", "error", "tolerance", "verdict", "cost"};
  std::vector<size_t> widths;
  for (const auto& name : head) widths.push_back(name.size());
  for (const Row& row : rows)
    for (size_t c = 0; c < head.size(); ++c)
      if (row.cells[1] != "(run)" || c != 3) widths[c] = std::max(widths[c], width_of(row.cells[c]));
  const bool color = colors(STDOUT_FILENO);
  const auto line = [&](const std::vector<std::string>& cells, const char* before, const char* after) {
    std::string text;
    for (size_t c = 0; c < cells.size(); ++c) {
      std::string cell = cells[c];
      const size_t width = width_of(cell);
      if (width < widths[c]) cell.append(widths[c] - width, ' ');
      if (c == 6) cell = before + cell + after;
      text += (c ? "  " : "") + cell;
    }
    while (text.ends_with(' ')) text.pop_back();
    fmt::print("{}\n", text);
  };
  line(head, "", "");
  for (const Row& row : rows) line(row.cells, color ? (row.passed ? "\033[32m" : "\033[31m") : "", color ? "\033[0m" : "");
}

}  // namespace

int verb_test(const Options& options) {
  if (options.words.empty()) throw Error("test takes scenes or folders; write erbs test scenes/verify");
  std::vector<Case> cases = cases_of(options);
  fs::create_directories(fs::path(cases.front().directory).parent_path());
  const auto begin = std::chrono::steady_clock::now();
  run_all(cases, options);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::vector<Row> rows;
  int failed_cases = 0;
  for (const Case& item : cases) {
    bool failed = false;
    for (Row& row : rows_of(item)) {
      failed = failed || !row.passed;
      rows.push_back(std::move(row));
    }
    failed_cases += failed;
  }
  print_table(rows);
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const Row& row) { return !row.passed; });
  fmt::print("{} expectations of {} cases: {} passed, {} failed ({} cases) in {}\n", rows.size(), cases.size(),
             rows.size() - static_cast<size_t>(failed), failed, failed_cases, duration_text(wall));
  return failed == 0 ? exit_ok : exit_expectation;
}

}  // namespace erbs
