// A run as one web page that needs no network: what happened and how far to trust it, a replay in 3D, curves, events, parameters.
#pragma once
#include <string>
#include <string_view>

#include "engine/record/export/export.h"
#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"

namespace erbs {

// The page without a run. Its html names the places to fill: {{title}}, {{style}}, {{script}}, {{run}}, {{poses}}, {{damage}},
// {{histories}}, {{energy}}, {{capacity}}.
struct ReportPage {
  std::string_view html, style, script;
};

struct ReportedRun {
  ExportedRun run;                  // its frames thinned to at most most_poses_of_a_page poses
  int every = 1;                    // each how many-th frame is shown
  Json manifest, metrics;           // as in the folder; metrics null where the run did not end
  CsvTable histories, energy;       // thinned; without columns where the file is absent
  std::size_t history_rows = 0;     // in the folder
  Json events = Json::array();      // [[time s, event, name, value, unit], ...]
  std::size_t events_left_out = 0;  // events of single joints beyond most_events_of_a_page
  Json files = Json::array();       // names of the run's files that exist
  CsvTable push_curve;              // curve.csv of a push, a row for each state of equilibrium
  // Of a push: names and bytes of its figures (curve.svg, performance.svg), and its capacity.
  std::vector<std::pair<std::string, std::string>> push_figures, push_answers;
};

inline constexpr std::size_t most_poses_of_a_page = 310000;  // 1,000 blocks and the ground x 300 frames
inline constexpr std::size_t most_events_of_a_page = 3000;

// Error with place and remedy if DIR is no run folder, holds no frame, or cannot be read.
ReportedRun read_reported_run(const std::string& dir);

// The whole page. `folder`: the way from the page to the run folder, for its links.
std::string report_html(const ReportedRun& run, const ReportPage& page, const std::string& folder);

}  // namespace erbs
