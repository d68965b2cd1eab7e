// Readers of ground-motion files. The content decides on the format, not the file name.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/loads/record/record.h"
#include "engine/loads/record/record_text.h"

namespace erbs {

// Content of a file before scaling.
struct RecordFile {
  std::string title, format;
  std::vector<double> times;   // s
  std::vector<double> values;  // m/s2, m/s or m, by the quantity of the record
  std::vector<int> lines;      // of the file, for each value; empty where the format itself spaces them evenly
};

// The format by its marks: ESM (keys with a colon), COSMOS and CSMIP V2 (the line before the data), PEER AT2 (a header line with NPTS),
// else columns. Uses column, dt, first_time, unit, decimal and quantity of `wanted`.
RecordFile parse_record(RecordText text, const Record& wanted);

RecordFile parse_at2(RecordText& text, const Record& wanted, size_t npts_line);
RecordFile parse_esm(RecordText& text, const Record& wanted);
RecordFile parse_volume2(RecordText& text, const Record& wanted, size_t data_line);  // index of the line before the data
RecordFile parse_columns(RecordText& text, const Record& wanted);

bool is_esm(const RecordText& text);
std::optional<size_t> volume2_line(const RecordText& text, const Record& wanted);  // of the wanted quantity, else of any

// Factor to SI from the unit of the file ("": none), else from the unit of the script. A contradiction is an Error.
double factor_to_si(std::string_view in_file, const Record& wanted, const Place& place);

// Throws Error if a file that says what it holds ("acceleration", ...) holds another quantity than `wanted`.
void check_quantity(std::string_view in_file, const Record& wanted, const Place& place);
// The step of a file that gives one (s). Throws Error if `wanted` gives another.
double checked_step(double in_file, const Record& wanted, const Place& place);
// Throws Error unless as many values were found as the file promises.
void check_count(size_t found, double promised, std::string_view name, const Place& place);

// The numbers of the lines from `first` up to `last`, `touching` as in append_numbers(); decimal commas become points.
std::vector<double> numbers_of(RecordText& text, size_t first, size_t last, const Record& wanted);

}  // namespace erbs
