// Report of erbs bench: rows, ratios and a figure.
#pragma once
#include <string>

#include "engine/record/format/json.h"

namespace erbs::lua {

void print_bench_row(const Json& row);  // of one scene
Json bench_summary(const Json& rows);   // ratios of the benchmark by name, and all rows under "cases"
void print_bench_summary(const Json& summary);
void write_bench_figure(const Json& rows, const std::string& path);

}  // namespace erbs::lua
