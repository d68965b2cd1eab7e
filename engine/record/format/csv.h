// Tables as text: one line of column names with units, then one line per row, comma separated.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace erbs {

// Collects rows and appends whole lines in one write: a killed run leaves no torn row.
class CsvWriter {
 public:
  CsvWriter() = default;
  // Starts a new file with the line of column names.
  CsvWriter(const std::string& path, const std::vector<std::string>& names);
  // Continues a file with the same names and keeps its first `keep_rows` rows. Error if it has fewer rows, other names, or a hash other
  // than `sum`.
  CsvWriter(const std::string& path, const std::vector<std::string>& names, long keep_rows, std::optional<std::uint64_t> sum = {});
  ~CsvWriter();
  CsvWriter(CsvWriter&& other) noexcept;
  CsvWriter& operator=(CsvWriter&& other) noexcept;

  void row(const std::vector<double>& values);  // shortest digits that read back to the same double; "nan" if unknown
  void text_row(const std::vector<std::string>& cells);
  void flush();  // afterwards the rows survive the end of the program
  void sync();   // afterwards the rows survive a failure of the machine
  long rows() const { return rows_; }
  std::uint64_t sum() const { return sum_; }  // FNV-1a of the file, rows not yet written included

 private:
  void add(const std::string& line);
  int file_ = -1;
  std::size_t columns_ = 0;
  long rows_ = 0;
  std::uint64_t sum_ = 0xcbf29ce484222325u;
  std::string path_, waiting_;
};

struct CsvTable {
  std::vector<std::string> names;              // with units                                  [columns]
  std::vector<std::vector<double>> columns;    // NaN if a cell is no number                  [columns][rows]
  std::vector<std::vector<std::string>> text;  // of columns with words only, otherwise empty [columns][rows]
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  int find(std::string_view name) const;                           // -1 if there is none
  const std::vector<double>& column(std::string_view name) const;  // Error with the nearest name if there is none
};

// Cells of one line, and one line of cells. A cell in double quotes may hold commas, and quotes written twice.
std::vector<std::string> csv_cells(std::string_view line);
std::string csv_line(const std::vector<std::string>& cells);

// Ignores an incomplete last line: the writer was killed or is still writing.
CsvTable read_csv(const std::string& path);
// Of another program, which may leave out the end of the last line.
CsvTable read_measured_csv(const std::string& path);

}  // namespace erbs
