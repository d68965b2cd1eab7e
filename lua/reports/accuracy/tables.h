// Tables and sentences of the study of accuracy.
#pragma once
#include <string>
#include <vector>

#include "lua/reports/accuracy/accuracy.h"

namespace erbs::lua {

std::string error_text(const study::Goal& quantity, const std::optional<double>& error);  // "0.31 %"; with its unit where it is absolute
std::string cost_text(const study::Measured& run);                                        // "0.12 s, 1.8e+04 pt"

void print_settings(const AccuracyStudy& study);                          // a line for every setting, and the orders
std::string accuracy_table(const std::vector<AccuracyStudy>& studies);    // Markdown: fronts, costs, and what ends them
std::string quality_table(const std::vector<AccuracyStudy>& studies);     // Markdown: errors and costs of the three qualities
std::string seconds_sentence(const std::vector<AccuracyStudy>& studies);  // what 1 % and 0.1 % cost, for README.md

}  // namespace erbs::lua
