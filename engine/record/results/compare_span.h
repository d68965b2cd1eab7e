// How much of a run and its reference is compared: their common time, and whether both have ended.
#pragma once
#include <string>
#include <vector>

#include "engine/record/results/compare_runs.h"
#include "engine/record/results/curves.h"

namespace erbs {

struct ComparedSpan {
  double from = NAN, to = NAN;               // s, of the reference: what both have, after the alignment
  double run = 0, reference = 0;             // s, length of each
  double wanted = 0;                         // s, of which it is a share: the longer one, all of a measurement, or what was asked for
  bool chosen = false;                       // by a span that was asked for
  std::string status_run, status_reference;  // of metrics.json; "unfinished" without it, "" of a measurement
  double share() const { return wanted > 0 ? (to - from) / wanted : 1; }
};

// The lag of the alignment counts as common. `chosen`: the span that is asked for, in the time of the reference; infinite ends: all.
ComparedSpan span_of(const std::vector<ColumnPair>& pairs, const TimeShift& shift, const TimeSpan& chosen, bool two_runs);

// Why equal columns do not mean equal runs, each with its remedy: a run that has not ended, or too short a common span.
std::vector<std::string> gaps_of(const ComparedSpan& span);
std::string table_of(const ComparedSpan& span);
Json json_of(const ComparedSpan& span);

}  // namespace erbs
