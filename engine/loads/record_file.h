// The readers of ground-motion files. The form is told from the content, not from the name.
#pragma once
#include <string>
#include <vector>

#include "engine/loads/record.h"
#include "engine/loads/record_text.h"

namespace erbs {

// What a file says, before scaling.
struct RecordFile {
  std::string title, format;
  std::vector<double> times;   // s
  std::vector<double> values;  // m/s2
};

// By content: PEER AT2 (a header line with NPTS), else columns. wanted: column, dt, first_time and unit.
RecordFile parse_record(const RecordText& text, const Record& wanted);

RecordFile parse_at2(const RecordText& text, const Record& wanted, size_t npts_line);
RecordFile parse_columns(const RecordText& text, const Record& wanted);

// The factor to m/s2 of the unit the file names ("": none) or, failing that, the script. They may not contradict each other.
double factor_to_si(std::string_view in_file, const Record& wanted, const Place& place);

}  // namespace erbs
