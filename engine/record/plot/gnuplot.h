// The only place that starts gnuplot.
#pragma once
#include <string>
#include <string_view>

namespace erbs {

// Runs `script` in the folder of `path` and stores its standard output at `path`. Data files in that folder are named without a path, since
// gnuplot takes a name that begins with < for a command. Error if gnuplot is missing, fails or writes nothing; no file is left behind then.
void run_gnuplot(const std::string& script, const std::string& path);

// `text` as a gnuplot string in single quotes. No content can end the string or break the SVG. The script must say `set encoding utf8`.
std::string gnuplot_quoted(std::string_view text);

}  // namespace erbs
