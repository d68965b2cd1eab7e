// Text of a record file: lines, numbers with their position, units.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace erbs {

struct RecordText {
  std::string path;
  std::string hash;                // of the bytes
  std::vector<std::string> lines;  // without line ends
  std::vector<std::string> given;  // as they stand in the file, where decimal commas have been replaced; else empty
};

// Throws Error if the file is missing, a folder, unreadable or blank.
RecordText read_record_text(const std::string& path);

std::string_view trim(std::string_view text);
std::string lower(std::string_view text);
bool is_comment(std::string_view line);  // begins with # % ! or //
bool is_blank(std::string_view line);

// Appends the numbers of line `index` (from 0), separated by blanks, tabs, commas or semicolons. With `touching` a sign or a digit also
// ends the number before it (Fortran columns that fill their width). Any other text is an Error with line and column.
void append_numbers(const RecordText& text, size_t index, bool touching, std::vector<double>& out);

// True if commas of these lines can only be decimal marks: each stands between digits, none of the lines has a point, and blanks, tabs or
// semicolons part the numbers. `single`: the numbers need no other separator, since each line has one.
bool has_decimal_commas(const RecordText& text, size_t first, size_t last, bool single);
void replace_decimal_commas(RecordText& text, size_t first, size_t last);  // by points, so that columns keep their places

// SI units per unit of an "acceleration", "velocity" or "displacement"; none if the unit is unknown. Reads g, m/s2, m/s^2, m/s/s,
// cm/sec**2, gal, ...
std::optional<double> unit_factor(std::string_view quantity, std::string_view name);
std::string_view known_units(std::string_view quantity);
std::string_view quantity_of_unit(std::string_view name);  // "" if no quantity has this unit

}  // namespace erbs
