// The table of a calibration's runs. Each run is in it as soon as it ends, so that a killed calibration loses none that had ended.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "engine/record/format/csv.h"

namespace erbs::study {

class RunTable {
 public:
  using Cells = std::vector<std::string>;
  // `names`: of the columns, first "run" and "stage". `resume`: goes on with the table that is there; its runs of stage 0, which a
  // calibration makes anew each time, and a torn last line are left out. Throws Error if its columns are others.
  RunTable(std::string path, Cells names, bool resume);
  void add(int run, Cells cells);  // `cells` without the number of the run, which tells its place
  void sort();                     // puts the lines into the order of the runs, whichever ended first
  const std::map<int, Cells>& rows() const { return rows_; }
  const std::string& cell(const Cells& row, const std::string& name) const;

 private:
  void read();
  void rewrite();
  std::string path_;
  Cells names_;
  std::map<int, Cells> rows_;
  int last_ = 0;  // run of the last line
  bool sorted_ = true;
  CsvWriter writer_;
};

}  // namespace erbs::study
