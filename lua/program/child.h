// Other programs that erbs starts.
#pragma once
#include "engine/base/system/process.h"

namespace erbs::lua {

std::string renderer_path();  // path of erbs-render: beside erbs, otherwise found by PATH
int run_renderer(const std::vector<std::string>& arguments);

// Throws Error if one of these programs cannot be started: a user should learn it before a long run, not after it.
void check_programs(const std::vector<std::string>& names);

// A word as a shell at the prompt reads it, and sbatch in a comment of a script: plain, or in quotes.
std::string shell_quoted(const std::string& word);
std::string shell_word(const std::string& word);

}  // namespace erbs::lua
