// The verification book: Markdown and one figure per family, written from a run of erbs test.
#pragma once
#include "lua/cases.h"

namespace erbs {

// Cases of one kind, told by the number in the name of the scene.
struct Family {
  std::string key, title, about;  // key: of its figure, "b1"
  std::vector<const CaseResult*> cases;
  int expectations = 0, failed = 0;
  double worst = 0;  // largest share of a tolerance that a passing expectation takes
  std::string worst_at;
  double cpu = 0, updates = 0;
};
std::vector<Family> families_of(const std::vector<CaseResult>& results);

// "620 of 624 expectations hold ...": the line the README carries too.
std::string summary_line(const std::vector<Family>& families);

// A link from the folder of `from` to `to`.
std::string relative_link(const std::string& from, const std::string& to);
// Text as a cell of a table in Markdown, and a name as one.
std::string cell(const std::string& text);
std::string code_cell(const std::string& name);
// Replaces what stands between <!-- mark --> and <!-- /mark --> in a file; false where the file has no such marks.
bool replace_marked(const std::string& file, const std::string& mark, const std::string& text);

void write_book(const std::vector<CaseResult>& results, const Options& options, double wall);

// Error over tolerance of every expectation, one row a case.
void draw_family(const Family& family, const std::string& path);

}  // namespace erbs
