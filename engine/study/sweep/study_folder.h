// Tells what a study has put into its folder from files of the user: --force replaces the first and leaves the second alone.
#pragma once
#include <string>

namespace erbs::study {

// Whether results.csv or runs.csv there is the table of a study.
bool holds_tables(const std::string& directory);

// Removes both tables, and from runs/ and work/ what carries the name of a run, a claim or a worker.
void remove_tables(const std::string& directory);

}  // namespace erbs::study
