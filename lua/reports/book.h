// The verification book: Markdown and one figure per family, written from a run of erbs test.
#pragma once
#include "lua/reports/cases.h"

namespace erbs::lua {

// Cases of one kind. The number in the name of a scene tells its family.
struct Family {
  std::string key, title, about;  // key: "b1", part of the name of its figure
  std::vector<const CaseResult*> cases;
  int expectations = 0, failed = 0;
  double worst = 0;  // largest ratio of error to tolerance among the expectations that hold
  std::string worst_at;
  double cpu = 0, updates = 0;
};
std::vector<Family> families_of(const std::vector<CaseResult>& results);

// "620 of 624 expectations hold ...": the line that the README repeats.
std::string summary_line(const std::vector<Family>& families);

// A link from the folder of `from` to `to`.
std::string relative_link(const std::string& from, const std::string& to);
// Text as a cell of a Markdown table; the second one for a name.
std::string cell(const std::string& text);
std::string code_cell(const std::string& name);
// Replaces the text between <!-- mark --> and <!-- /mark --> in a file; false if the file has no such marks.
bool replace_marked(const std::string& file, const std::string& mark, const std::string& text);

void write_book(const std::vector<CaseResult>& results, const TestCommand& command, double wall);

// Ratio of error to tolerance of every expectation, one row per case.
void draw_family(const Family& family, const std::string& path);

}  // namespace erbs::lua
