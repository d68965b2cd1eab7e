// The one place that starts gnuplot.
#pragma once
#include <string>
#include <string_view>

namespace erbs {

// Runs `script`, which draws to its standard output, and puts what it drew at `path`. gnuplot missing or failing: Error, and
// nothing is left behind. A picture is also an Error when gnuplot wrote nothing.
void run_gnuplot(const std::string& script, const std::string& path);

// `text` as a gnuplot string in single quotes that cannot end it, nor break the SVG.
std::string gnuplot_quoted(std::string_view text);

}  // namespace erbs
