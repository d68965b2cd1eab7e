// The verbs of the program erbs with their options, as CLI11 reads them.
#pragma once
#include <string>
#include <vector>

#include "lua/program/option_kinds.h"
#include "lua/program/options.h"

namespace erbs::lua {

struct CommandLine {
  RunCommand run;
  CheckCommand check;
  RecordCommand record;
  ExportCommand exported;
  PlotCommand plot;
  ReportCommand report;
  CompareCommand compare;
  TestCommand test;
  SweepCommand sweep;
  CalibrateCommand calibrate;
  AccuracyCommand accuracy;
  LimitCommand limit;
  CapacityCommand capacity;
  BenchCommand bench;
  EffectsCommand effects;
  std::vector<std::string> words;  // of erbs help
};

void add_verbs(CLI::App& app, CommandLine& line);

// A command of erbs run from its words. Throws CLI::ParseError or Error.
RunCommand read_run(std::vector<std::string> words);

}  // namespace erbs::lua
