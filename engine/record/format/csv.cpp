#include "engine/record/format/csv.h"

#include <fcntl.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/spelling.h"
#include "engine/base/text.h"

namespace erbs {
namespace {

constexpr std::size_t enough = 1 << 16;  // bytes collected before one write

std::string read_all(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("this file is missing or cannot be read; run the scene again with --force", {path, 0});
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string_view trimmed(std::string_view cell) {
  const std::size_t first = cell.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return cell.substr(first, cell.find_last_not_of(" \t\r") - first + 1);
}

std::string quote(const std::string& cell) {
  const std::string plain = for_files(cell);  // keeps one row on one line
  if (plain.find_first_of(",\"") == std::string::npos) return plain;
  std::string out = "\"";
  for (const char c : plain) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

bool number(std::string_view cell, double& value) {
  if (cell.empty() || cell == "nan") {
    value = std::nan("");
    return true;
  }
  const auto [end, failed] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return failed == std::errc() && end == cell.data() + cell.size();
}

}  // namespace

std::vector<std::string> csv_cells(std::string_view line) {
  std::vector<std::string> cells;
  std::string cell;
  bool quoted = false, was_quoted = false;
  const auto finish = [&] {
    cells.push_back(was_quoted ? cell : std::string(trimmed(cell)));
    cell.clear();
    was_quoted = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cell += line[++i];
    } else if (c == '"' && (quoted || trimmed(cell).empty())) {
      if (!quoted) cell.clear();
      quoted = !quoted;
      was_quoted = true;
    } else if (c == ',' && !quoted) {
      finish();
    } else {
      cell += c;
    }
  }
  finish();
  return cells;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i ? "," : "") + quote(cells[i]);
  return line + "\n";
}

CsvWriter::CsvWriter(const std::string& path, const std::vector<std::string>& names) : columns_(names.size()), path_(path) {
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644);
  if (file_ < 0) throw WriteError(fmt::format("cannot be written: {}", std::strerror(errno)), {path, 0});
  add(csv_line(names));
  flush();
}

CsvWriter::CsvWriter(const std::string& path, const std::vector<std::string>& names, long keep_rows, std::optional<std::uint64_t> sum)
    : columns_(names.size()), rows_(keep_rows), path_(path) {
  const std::string text = read_all(path), head = csv_line(names);
  if (text.compare(0, head.size(), head) != 0)
    throw Error("its columns are not those of this scene; resume with the scene of the run, or start anew with --force", {path, 1});
  std::size_t end = head.size();
  for (long row = 0; row < keep_rows; ++row) {
    const std::size_t stop = text.find('\n', end);
    if (stop == std::string::npos)
      throw Error(fmt::format("has {} rows, the checkpoint knows of {}; start anew with --force", row, keep_rows), {path, 0});
    end = stop + 1;
  }
  sum_ = fnv1a(std::string_view(text).substr(0, end));
  if (sum && *sum != sum_) throw Error("was changed after the checkpoint was written; start anew with --force", {path, 0});
  file_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file_ < 0 || ::ftruncate(file_, off_t(end)) != 0)
    throw WriteError(fmt::format("cannot be written: {}", std::strerror(errno)), {path, 0});
}

CsvWriter::~CsvWriter() {
  if (file_ < 0) return;
  try {
    flush();
  } catch (const std::exception&) {  // a destructor cannot report; an earlier flush() already has
  }
  ::close(file_);
}

CsvWriter::CsvWriter(CsvWriter&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      columns_(other.columns_),
      rows_(other.rows_),
      sum_(other.sum_),
      path_(std::move(other.path_)),
      waiting_(std::move(other.waiting_)) {}

CsvWriter& CsvWriter::operator=(CsvWriter&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(columns_, other.columns_);
  std::swap(rows_, other.rows_);
  std::swap(sum_, other.sum_);
  std::swap(path_, other.path_);
  std::swap(waiting_, other.waiting_);
  return *this;
}

void CsvWriter::add(const std::string& line) {
  waiting_ += line;
  sum_ = fnv1a(line, sum_);
  if (waiting_.size() >= enough) flush();
}

void CsvWriter::row(const std::vector<double>& values) {
  ERBS_ASSERT(values.size() == columns_);
  std::string line;
  for (const double value : values) {
    if (!line.empty()) line += ',';
    if (std::isnan(value)) line += "nan";
    else fmt::format_to(std::back_inserter(line), "{}", value + 0.0);  // -0 is written as 0
  }
  line += '\n';
  ++rows_;
  add(line);
}

void CsvWriter::text_row(const std::vector<std::string>& cells) {
  ERBS_ASSERT(cells.size() == columns_);
  ++rows_;
  add(csv_line(cells));
}

void CsvWriter::flush() {
  std::size_t done = 0;
  while (file_ >= 0 && done < waiting_.size()) {
    const ssize_t n = ::write(file_, waiting_.data() + done, waiting_.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const std::string why = std::strerror(errno);
      waiting_.clear();
      throw WriteError(fmt::format("cannot be written: {}; what was written before is intact", why), {path_, 0});
    }
    done += std::size_t(n);
  }
  waiting_.clear();
}

void CsvWriter::sync() {
  flush();
  if (file_ >= 0) ::fsync(file_);
}

int CsvTable::find(std::string_view name) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return int(i);
  return -1;
}

const std::vector<double>& CsvTable::column(std::string_view name) const {
  const int i = find(name);
  if (i < 0) throw Error(fmt::format("there is no column \"{}\"{}", name, did_you_mean(name, names)));
  return columns[std::size_t(i)];
}

namespace {

CsvTable table_of(const std::string& all, const std::string& path) {
  CsvTable table;
  std::size_t at = 0;
  for (int line = 1; at < all.size(); ++line) {
    const std::size_t end = all.find('\n', at);
    if (end == std::string::npos) break;
    const std::string_view text = std::string_view(all).substr(at, end - at);
    at = end + 1;
    if (trimmed(text).empty()) continue;
    const std::vector<std::string> cells = csv_cells(text);
    if (table.names.empty()) {
      table.names = cells;
      table.columns.resize(cells.size());
      table.text.resize(cells.size());
      continue;
    }
    if (cells.size() != table.names.size())
      throw Error(fmt::format("{} cells, but {} columns are named in the first line", cells.size(), table.names.size()), {path, line});
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double value = std::nan("");
      const bool word = !number(cells[i], value) || (!table.text[i].empty());
      // From the first word on, a column is text; earlier values are converted too.
      if (word && table.text[i].empty())
        for (const double before : table.columns[i]) table.text[i].push_back(std::isnan(before) ? "" : fmt::format("{}", before));
      if (word) table.text[i].push_back(cells[i]);
      table.columns[i].push_back(value);
    }
  }
  if (table.names.empty()) throw Error("is empty: its first line should name its columns", {path, 0});
  return table;
}

}  // namespace

CsvTable read_csv(const std::string& path) { return table_of(read_all(path), path); }

CsvTable read_measured_csv(const std::string& path) {
  const std::string all = read_all(path) + "\n", head = all.substr(0, all.find('\n'));
  if (head.find(',') == std::string::npos && head.find_first_of(";\t") != std::string::npos)
    throw Error("its columns are separated by semicolons or tabs; write commas between them, and points in numbers", {path, 1});
  return table_of(all, path);
}

}  // namespace erbs
