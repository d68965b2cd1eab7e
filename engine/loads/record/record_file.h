// Readers of ground-motion files. The content decides on the format, not the file name.
#pragma once
#include <string>
#include <vector>

#include "engine/loads/record/record.h"
#include "engine/loads/record/record_text.h"

namespace erbs {

// Content of a file before scaling.
struct RecordFile {
  std::string title, format;
  std::vector<double> times;   // s
  std::vector<double> values;  // m/s2
};

// PEER AT2 (if a header line contains NPTS), else columns. Uses column, dt, first_time and unit of `wanted`.
RecordFile parse_record(const RecordText& text, const Record& wanted);

RecordFile parse_at2(const RecordText& text, const Record& wanted, size_t npts_line);
RecordFile parse_columns(const RecordText& text, const Record& wanted);

// Factor to m/s2 from the unit of the file ("": none), else from the unit of the script. A contradiction is an Error.
double factor_to_si(std::string_view in_file, const Record& wanted, const Place& place);

}  // namespace erbs
