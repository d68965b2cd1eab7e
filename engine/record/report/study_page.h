// A study as one web page that needs no network: its answer, its figures, and each table as a chart to choose and rows to sort.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"

namespace erbs {

struct StudyTable {
  std::string name;  // heading
  CsvTable table;
  std::vector<std::string> links;  // of each row, from the page to its run; "" where it is not kept
  int x = 0, y = 0, colour = -1;   // columns of the chart at first; colour -1: none
  int only = -1;                   // column that names what a row tells of, where one such value is shown at a time; -1: none
  bool logarithmic = false;
  std::string first_unit = {};  // of the first column, whose name does not end with it; "": none
};

struct StudyFigure {
  std::string name, svg;  // the file's name and its bytes
};

struct ReportedStudy {
  std::string title, kind;                                   // "overturning map"; "sweep"
  std::vector<std::pair<std::string, std::string>> answers;  // what and how much
  std::vector<StudyFigure> figures;
  std::vector<StudyTable> tables;
  std::vector<std::string> files;  // names of files beside the page
};

// The folder of a sweep, of erbs accuracy, or of a run whose scene has studies.
bool is_study_folder(const std::string& dir);
// Where the page belongs by default.
std::string study_page_path(const std::string& dir);
// `page`: where it will stand, for its links. Error with place and remedy if DIR holds no study or cannot be read.
ReportedStudy read_reported_study(const std::string& dir, const std::string& page);

// `html` names the places to fill: {{title}}, {{style}}, {{kind}}, {{cards}}, {{figures}}, {{files}}, {{study}}.
std::string study_html(const ReportedStudy& study, std::string_view html, std::string_view style);

}  // namespace erbs
