// erbs test DIR|SCENE...: runs every scene with expectations in child processes side by side, and prints one table.
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "engine/base/text.h"
#include "lua/program/progress.h"
#include "lua/program/say.h"
#include "lua/reports/book.h"
#include "lua/reports/cases.h"
#include "lua/reports/grid.h"
#include "lua/reports/stored.h"

namespace erbs::lua {
namespace {

struct Row {
  std::vector<std::string> cells;
  bool passed;
};

std::vector<Row> rows_of(const CaseResult& result) {
  std::vector<Row> rows;
  for (const Verdict& v : result.verdicts)
    rows.push_back(
        {{result.name, v.key, v.expected, v.got, v.error, v.tolerance, v.passed ? "ok" : "FAILED", rows.empty() ? cost_text(result) : ""},
         v.passed});
  if (!result.started) rows.push_back({{result.name, "(run)", "", result.trouble, "", "", "not run", ""}, true});
  else if (!result.trouble.empty())
    rows.push_back({{result.name, "(run)", "", result.trouble, "", "", "FAILED", rows.empty() ? cost_text(result) : ""}, false});
  return rows;
}

// Number of letters, not bytes, of UTF-8.
size_t width_of(const std::string& text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

void print_table(const std::vector<Row>& rows) {
  const std::vector<std::string> head = {"case", "quantity", "expected", "got", "error", "tolerance", "verdict", "cost"};
  std::vector<size_t> widths;
  for (const auto& name : head) widths.push_back(name.size());
  for (const Row& row : rows)
    for (size_t c = 0; c < head.size(); ++c)
      if (row.cells[1] != "(run)" || c != 3) widths[c] = std::max(widths[c], width_of(row.cells[c]));
  const bool color = colors(STDOUT_FILENO);
  const auto line = [&](const std::vector<std::string>& cells, const char* before, const char* after) {
    std::string text;
    for (size_t c = 0; c < cells.size(); ++c) {
      std::string cell = shown(cells[c], 2000);
      const size_t width = width_of(cell);
      if (width < widths[c]) cell.append(widths[c] - width, ' ');
      if (c == 6) cell = before + cell + after;
      text += (c ? "  " : "") + cell;
    }
    while (text.ends_with(' ')) text.pop_back();
    text += '\n';
    std::fwrite(text.data(), 1, text.size(), stdout);  // raw, because it carries our colours
  };
  line(head, "", "");
  for (const Row& row : rows) line(row.cells, color ? (row.passed ? "\033[32m" : "\033[31m") : "", color ? "\033[0m" : "");
}

// Stores what the table above shows to differ. Returns the number of verdicts that this turns into passed ones.
long bless(const std::vector<CaseResult>& results) {
  long renewed = 0, broken = 0;
  for (const CaseResult& result : results) {
    for (const std::string& line : renew(result.verdicts)) {
      say("{}\n", shown(line, 2000));
      ++renewed;
    }
    if (!result.trouble.empty()) ++broken;
  }
  if (broken > 0) say("nothing to store of {} that did not run; see the table\n", counted(broken, "case"));
  else if (renewed == 0) say("nothing to store: all stored pictures and values hold\n");
  return renewed;
}

// Before hours of runs, not after them.
void check_book(const std::string& book) {
  namespace fs = std::filesystem;
  if (fs::is_directory(book)) throw Error(fmt::format("--book {} is a folder; name the file, such as {}/README.md", book, book));
  if (const fs::path folder = fs::absolute(book).parent_path(); !fs::is_directory(folder))
    throw Error(fmt::format("--book {}: there is no folder {}; make it, or correct the path", book, folder.string()));
}

}  // namespace

int verb_test(const TestCommand& command) {
  if (command.words.empty()) throw Error("test takes scenes or folders; write erbs test scenes/verify");
  if (command.bless && (command.grid || command.seeds > 0 || !command.scene.overrides.empty()))
    throw Error("--bless stores results of the scenes as they are written; leave out --grid, --seeds and -D");
  if (!command.book.empty()) check_book(command.book);
  if (command.grid || command.seeds > 0) return run_grid(command);
  std::vector<Case> cases =
      find_cases(command.words, command.scene, command.directory.empty() ? "runs/test" : command.directory, command.quick ? "quick" : "");
  const auto begin = std::chrono::steady_clock::now();
  run_cases(cases, command.scene, command.batch);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::vector<CaseResult> results;
  std::vector<Row> rows;
  for (const Case& item : cases) {
    results.push_back(result_of(item));
    for (Row& row : rows_of(results.back())) rows.push_back(std::move(row));
  }
  print_table(rows);
  auto failed = std::count_if(rows.begin(), rows.end(), [](const Row& row) { return !row.passed; });
  const auto failed_cases = std::count_if(results.begin(), results.end(), [](const CaseResult& r) { return !r.passed(); });
  say("{} of {}: {} passed, {} failed ({}) in {}\n", counted(rows.size(), "expectation"), counted(cases.size(), "case"),
      rows.size() - static_cast<size_t>(failed), failed, counted(failed_cases, "case"), duration_text(wall));
  say("{}\n", summary_line(families_of(results)));
  if (command.bless) failed -= bless(results);
  std::fflush(stdout);
  if (!command.book.empty()) write_book(results, command, wall);
  const auto left = std::count_if(results.begin(), results.end(), [](const CaseResult& r) { return !r.started; });
  if (left > 0) tell(stderr, fmt::format("{} of {} cases were not started: the time of --budget was over; give more", left, cases.size()));
  return failed > 0 ? exit_expectation : left > 0 ? exit_stopped : exit_ok;
}

}  // namespace erbs::lua
