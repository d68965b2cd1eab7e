// The one place that starts gnuplot.
#pragma once
#include <string>
#include <string_view>

namespace erbs {

// Runs `script`, which draws to its standard output, in the folder of `path`, and puts what it drew there: data files beside it go by
// their bare names, since a name that begins with < would be a command to gnuplot. gnuplot missing or failing: Error, and nothing is left
// behind. A picture is also an Error when gnuplot wrote nothing.
void run_gnuplot(const std::string& script, const std::string& path);

// `text` as a gnuplot string in single quotes, whatever it holds: it cannot end the string, nor break the SVG. The script must say
// `set encoding utf8`.
std::string gnuplot_quoted(std::string_view text);

}  // namespace erbs
