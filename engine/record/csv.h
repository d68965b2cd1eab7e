// Tables of text: one line of names with units, then one line a row, comma separated.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace erbs {

// Appends whole lines only, gathered and handed over in one write: a run that is killed leaves no torn row.
class CsvWriter {
 public:
  CsvWriter() = default;
  // Starts the file anew with its line of names.
  CsvWriter(const std::string& path, const std::vector<std::string>& names);
  // Goes on with a file of the same names, of which the first `keep_rows` rows stay. Error where it has fewer, other names, or is not
  // what sum() was of.
  CsvWriter(const std::string& path, const std::vector<std::string>& names, long keep_rows, std::optional<std::uint64_t> sum = {});
  ~CsvWriter();
  CsvWriter(CsvWriter&& other) noexcept;
  CsvWriter& operator=(CsvWriter&& other) noexcept;

  void row(const std::vector<double>& values);  // shortest digits that read back to the same double; "nan" where unknown
  void text_row(const std::vector<std::string>& cells);
  void flush();  // after this the rows survive the death of the program
  void sync();   // ... and of the machine
  long rows() const { return rows_; }
  std::uint64_t sum() const { return sum_; }  // FNV-1a of the file, with the rows that wait

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
  std::vector<std::vector<double>> columns;    // NaN where a cell is no number               [columns][rows]
  std::vector<std::vector<std::string>> text;  // only of columns that hold words, else empty [columns][rows]
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  int find(std::string_view name) const;                           // -1 where there is none
  const std::vector<double>& column(std::string_view name) const;  // Error with the nearest name where there is none
};

// A last line without its end (the writer was killed, or is still writing) is left out.
CsvTable read_csv(const std::string& path);

}  // namespace erbs
