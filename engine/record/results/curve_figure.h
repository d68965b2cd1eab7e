// Curves of run folders as a figure: a panel for each unit, one horizontal axis.
#pragma once
#include <string>
#include <vector>

#include "engine/record/plot/figure.h"
#include "engine/record/results/curves.h"

namespace erbs {

enum class CurveKind { history, envelope, spectrum, response };

// A panel for each unit of the curves, and for each quantity without one. All have runs; their names are shown if there are several.
// `note`: second line of the title. Error for more curves than a figure can tell apart.
plot::Figure curve_figure(const std::vector<HistoryCurve>& curves, CurveKind kind, const std::string& note);

}  // namespace erbs
