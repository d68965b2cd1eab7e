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

// m/s2 per unit; none if the unit is unknown. Reads g, m/s2, m/s^2, m/s/s, cm/sec**2, gal, ...
std::optional<double> acceleration_unit(std::string_view name);
inline constexpr std::string_view known_units = "g, mg, m/s2, cm/s2, gal, mm/s2, ft/s2, in/s2";

}  // namespace erbs
