#include "engine/study/calibrate/run_table.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "engine/base/error.h"

namespace erbs::study {
namespace {

namespace fs = std::filesystem;

}  // namespace

RunTable::RunTable(std::string path, Cells names, bool resume) : path_(std::move(path)), names_(std::move(names)) {
  if (resume && fs::exists(path_)) read();
  rewrite();
}

void RunTable::read() {
  std::ifstream stream(path_);
  std::string line;
  if (!std::getline(stream, line) || csv_cells(line) != names_)
    throw Error("its columns are not those of this calibration; start anew with --force", {path_, 1});
  while (std::getline(stream, line) && !stream.eof()) {  // a line without its end was torn by a kill
    Cells cells = csv_cells(line);
    int run = 0;
    if (cells.size() == names_.size() && cells[1] != "0") {
      std::from_chars(cells[0].data(), cells[0].data() + cells[0].size(), run);
      rows_[run] = std::move(cells);
    }
  }
}

// A kill while it writes leaves the old table.
void RunTable::rewrite() {
  const std::string beside = path_ + ".new";
  writer_ = CsvWriter(beside, names_);
  for (const auto& [run, cells] : rows_) writer_.text_row(cells);
  writer_.flush();
  std::error_code failed;
  fs::rename(beside, path_, failed);
  if (failed) throw WriteError(fmt::format("cannot be written: {}", failed.message()), {path_, 0});
  last_ = rows_.empty() ? 0 : rows_.rbegin()->first;
  sorted_ = true;
}

void RunTable::add(int run, Cells cells) {
  cells.insert(cells.begin(), fmt::format("{}", run));
  writer_.text_row(cells);
  writer_.flush();
  rows_[run] = std::move(cells);
  sorted_ = sorted_ && run > last_;
  last_ = std::max(last_, run);
}

void RunTable::sort() {
  if (!sorted_) rewrite();
}

const std::string& RunTable::cell(const Cells& row, const std::string& name) const {
  return row.at(std::size_t(std::find(names_.begin(), names_.end(), name) - names_.begin()));
}

}  // namespace erbs::study
