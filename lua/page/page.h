// The web page of erbs report, as the build bundled it.
#pragma once
#include "engine/record/report/report.h"

namespace erbs::lua {

// Without a script where the packages were missing when erbs was built.
const ReportPage& report_page();
// Of a study; its script is part of it, and its style is that of page.css.
std::string_view study_page();
std::string_view study_style();

}  // namespace erbs::lua
