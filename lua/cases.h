// Scenes that carry expectations, run by child processes side by side: what erbs test and its grid stand on.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lua/expectations.h"
#include "lua/figures.h"
#include "lua/options.h"

namespace erbs {

struct Case {
  std::string scene, name, directory, log;  // name: of the scene, made unique
  std::vector<std::string> extra;           // words for erbs run besides those of every case
  bool resume = false;                      // goes on from its checkpoint
  bool within_budget = false;               // stops itself, with a checkpoint, once the budget of all is spent
  int code = 0;
  double cpu = 0;        // s, of the run and its studies
  bool overdue = false;  // had to be stopped
  bool started = false;
};

// What a case left behind.
struct CaseResult {
  std::string scene, name, title;  // title: the first comment line of the scene
  std::vector<Verdict> verdicts;
  std::vector<LeftFigure> figures;
  std::string trouble;  // why it ended badly, or gave nothing to judge; "" where neither
  double cpu = 0;       // s of processor
  double updates = 0;   // contact points evaluated
  bool started = true;  // false: the budget of all was over before
  double dt_share = 0;  // dt over dt_critical; 0 where nothing is joined
  bool passed() const;
};

// The scenes of these words (folders are searched for scenes with expectations), those that carry `label` where one is given.
std::vector<Case> find_cases(const Options& options, const std::string& out, const std::string& label);

// Runs them, options.jobs at once, each for at most options.max_wall; `ended` is called after each. None is started once
// options.budget is spent.
void run_cases(std::vector<Case>& cases, const Options& options, const std::function<void(const Case&)>& ended = {});

CaseResult result_of(const Case& item);
std::string cost_text(const CaseResult& result);  // "0.31 s, 2.1e+06 pt"

}  // namespace erbs
