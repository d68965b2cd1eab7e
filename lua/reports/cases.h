// Scenes with expectations, run by child processes side by side; erbs test, its grid and erbs accuracy use them.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lua/program/options.h"
#include "lua/reports/expectations.h"
#include "lua/reports/figures.h"

namespace erbs::lua {

struct Case {
  std::string scene, name, directory, log;  // name: of the scene, made unique by a number
  std::vector<std::string> extra;           // arguments of erbs run besides the common ones
  bool resume = false;                      // continue from its checkpoint
  bool within_budget = false;               // stop with a checkpoint when the time of all cases is spent
  int code = 0;
  double cpu = 0;        // s, of the run and its studies
  bool overdue = false;  // it exceeded its time and was stopped
  bool started = false;
};

// Results of a case.
struct CaseResult {
  std::string scene, name, title;  // title: the first comment line of the scene
  std::vector<Verdict> verdicts;
  std::vector<LeftFigure> figures;
  std::string trouble;  // why it failed, or why there is nothing to judge; "" otherwise
  double cpu = 0;       // s, processor time
  double updates = 0;   // contact points evaluated
  bool started = true;  // false: the time of all cases was spent before it could start
  double dt_share = 0;  // dt over dt_critical; 0 if the scene has no joints
  bool passed() const;
};

// The scenes named by `words`; folders are searched for scenes with expectations. `label`: only scenes that carry it.
std::vector<Case> find_cases(const std::vector<std::string>& words, const SceneOptions& options, const std::string& out,
                             const std::string& label);

// Runs the cases, `jobs` at once, each for at most `max_wall`. Calls `ended` after each of them.
// Starts no further case when the budget is spent.
void run_cases(std::vector<Case>& cases, const SceneOptions& options, const BatchOptions& batch,
               const std::function<void(const Case&)>& ended = {});

CaseResult result_of(const Case& item);
std::string cost_text(const CaseResult& result);  // "0.31 s, 2.1e+06 pt"

}  // namespace erbs::lua
