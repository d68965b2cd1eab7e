// The text of a record file: lines, numbers with their place, units.
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

// Missing, a folder, unreadable or blank: Error.
RecordText read_record_text(const std::string& path);

std::string_view trim(std::string_view text);
std::string lower(std::string_view text);
bool is_comment(std::string_view line);  // begins with # % ! or //
bool is_blank(std::string_view line);

// The numbers of line `index` (counted from 0), separated by blanks, tabs, commas or semicolons. With `touching` a sign ends
// the number before it as well (Fortran columns that fill their width). Anything else is an Error with line and column.
void append_numbers(const RecordText& text, size_t index, bool touching, std::vector<double>& out);

// Metres per second squared in one unit; nothing where the unit is unknown. Reads g, m/s2, m/s^2, m/s/s, cm/sec**2, gal, ...
std::optional<double> acceleration_unit(std::string_view name);
inline constexpr std::string_view known_units = "g, mg, m/s2, cm/s2, gal, mm/s2, ft/s2, in/s2";

}  // namespace erbs
