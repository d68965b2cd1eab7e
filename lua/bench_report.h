// What erbs bench says of its measurements: rows, ratios, a figure.
#pragma once
#include <string>

#include "engine/record/json.h"

namespace erbs {

void print_bench_row(const Json& row);  // one scene
Json bench_summary(const Json& rows);   // by case: the ratios that matter, and all rows under "cases"
void print_bench_summary(const Json& summary);
void write_bench_figure(const Json& rows, const std::string& path);

}  // namespace erbs
