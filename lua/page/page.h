// The web page of erbs report, as the build bundled it.
#pragma once
#include "engine/record/report/report.h"

namespace erbs::lua {

// Without a script where the packages were missing when erbs was built.
const ReportPage& report_page();

}  // namespace erbs::lua
