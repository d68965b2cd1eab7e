#include "engine/loads/record/record_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/text.h"
#include "engine/base/units.h"

namespace erbs {
namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }
bool sign(char c) { return c == '+' || c == '-'; }
bool separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }
bool exponent_mark(char c) { return c == 'e' || c == 'E' || c == 'd' || c == 'D'; }

size_t skip_digits(std::string_view s, size_t at) {
  while (at < s.size() && digit(s[at])) ++at;
  return at;
}

// End of the number that begins at `at`; `at` itself if no number begins there.
size_t end_of_number(std::string_view s, size_t at) {
  size_t end = at + (at < s.size() && sign(s[at]) ? 1 : 0);
  const size_t whole = skip_digits(s, end);
  size_t digits = whole - end;
  end = whole;
  if (end < s.size() && s[end] == '.') {
    const size_t fraction = skip_digits(s, end + 1);
    digits += fraction - end - 1;
    end = fraction;
  }
  if (digits == 0) return at;
  if (end < s.size() && exponent_mark(s[end])) {
    const size_t first = end + 1 + (end + 1 < s.size() && sign(s[end + 1]) ? 1 : 0);
    size_t last = skip_digits(s, first);
    // An exponent of two digits, followed directly by the 0 of the next column: 0.1E-020.2E-02.
    if (last == first + 3 && last < s.size() && s[last] == '.') --last;
    if (last > first) end = last;
  }
  return end;
}

// The line as it stands in the file, its places those of the line that is read.
std::string_view given_line(const RecordText& text, size_t index) {
  return index < text.given.size() && !text.given[index].empty() ? text.given[index] : text.lines[index];
}

[[noreturn]] void not_a_number(const RecordText& text, size_t index, size_t at) {
  const std::string_view line = text.lines[index], given = given_line(text, index);
  size_t end = at;
  while (end < line.size() && !separator(line[end]) && end < at + 24) ++end;
  // Quote a word only if it begins like a number. The file may be no record, and the message must not reveal its content.
  const std::string_view word = line.substr(at, end - at);
  const bool quoted = digit(word[0]) || sign(word[0]) || word[0] == '.' || word == "nan" || word == "inf";
  throw Error(fmt::format("column {}: {} is not a number; correct it, or begin the line with # if it is a comment", at + 1,
                          quoted ? "\"" + shown(given.substr(at, end - at), 24) + "\"" : "what stands there"),
              {text.path, static_cast<int>(index) + 1});
}

double number(const RecordText& text, size_t index, size_t from, size_t to) {
  std::string digits(text.lines[index].substr(from, to - from));
  for (char& c : digits)
    if (exponent_mark(c)) c = 'e';  // from_chars reads neither Fortran's exponent D nor a leading +
  const char* first = digits.data() + (digits.front() == '+' ? 1 : 0);
  double result = 0;
  const auto [end, code] = std::from_chars(first, digits.data() + digits.size(), result);
  if (code == std::errc::result_out_of_range)
    throw Error(fmt::format("column {}: {} is beyond what a number can hold; correct it", from + 1,
                            shown(given_line(text, index).substr(from, to - from), 24)),
                {text.path, static_cast<int>(index) + 1});
  if (code != std::errc() || end != digits.data() + digits.size()) not_a_number(text, index, from);
  return result;
}

}  // namespace

RecordText read_record_text(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) throw Error("there is no such record file; check the name and the folder", {path});
  if (std::filesystem::is_directory(path, code)) throw Error("is a folder, not a record file; name a file inside", {path});
  if (std::filesystem::is_character_file(path, code) || std::filesystem::is_block_file(path, code))
    throw Error("is a device, not a record file; name a file with numbers", {path});  // some never end
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("the record file cannot be opened; check its permissions", {path});
  std::string bytes;
  try {
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  } catch (const std::ios_base::failure&) { throw Error("the record file cannot be read; name one with numbers", {path}); }
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") || bytes.find('\0') != std::string::npos)
    throw Error("is no plain text, or text in UTF-16; save it as UTF-8", {path});
  RecordText text{path, hash_text(bytes), {}, {}};
  std::string_view rest = bytes;
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") rest.remove_prefix(3);  // byte order mark, written by some editors
  bool blank = true;
  const char line_end = rest.find('\n') == std::string_view::npos ? '\r' : '\n';  // old files end their lines with CR alone
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(line_end), rest.size());
    text.lines.emplace_back(rest.substr(0, end));
    if (!text.lines.back().empty() && text.lines.back().back() == '\r') text.lines.back().pop_back();
    blank = blank && is_blank(text.lines.back());
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (blank) throw Error("the record file is empty; give a file with numbers", {path});
  return text;
}

std::string_view trim(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

std::string lower(std::string_view s) {
  std::string out(s);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

bool is_blank(std::string_view line) { return trim(line).empty(); }

bool is_comment(std::string_view line) {
  line = trim(line);
  return !line.empty() && (line[0] == '#' || line[0] == '%' || line[0] == '!' || line.substr(0, 2) == "//");
}

void append_numbers(const RecordText& text, size_t index, bool touching, std::vector<double>& out) {
  const std::string_view line = text.lines[index];
  for (size_t at = 0; at < line.size();) {
    if (separator(line[at])) {
      ++at;
      continue;
    }
    const size_t end = end_of_number(line, at);
    const bool parted = end == line.size() || separator(line[end]) || (touching && (sign(line[end]) || digit(line[end])));
    if (end == at || !parted) not_a_number(text, index, at);
    out.push_back(number(text, index, at, end));
    at = end;
  }
}

bool has_decimal_commas(const RecordText& text, size_t first, size_t last, bool single) {
  bool any = false, parted = single;
  for (size_t i = first; i < last; ++i) {
    const std::string_view line = trim(text.lines[i]);
    if (line.empty() || is_comment(line)) continue;
    if (line.find('.') != std::string_view::npos) return false;
    bool used = false;  // the number at hand has its mark
    for (size_t at = 0; at < line.size(); ++at) {
      if (separator(line[at]) && line[at] != ',') {
        used = false;
        parted = true;
      } else if (line[at] == ',') {
        if (used || at + 1 == line.size() || !digit(line[at + 1])) return false;
        used = any = true;
      } else if (sign(line[at]) && at > 0 && !exponent_mark(line[at - 1])) {
        used = false;  // columns that touch
      }
    }
  }
  return any && parted;
}

void replace_decimal_commas(RecordText& text, size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    std::string& line = text.lines[i];
    if (is_comment(line)) continue;
    text.given.resize(text.lines.size());
    text.given[i] = line;
    for (size_t at = 0; at + 1 < line.size(); ++at)
      if (line[at] == ',' && digit(line[at + 1])) line[at] = '.';
  }
}

namespace {

struct Unit {
  std::string_view quantity, name;
  double factor;  // to SI
};
constexpr double foot = 0.3048;
constexpr std::array<Unit, 18> units{{{"acceleration", "g", standard_g},
                                      {"acceleration", "mg", 1e-3 * standard_g},
                                      {"acceleration", "m/s2", 1},
                                      {"acceleration", "cm/s2", 0.01},
                                      {"acceleration", "gal", 0.01},
                                      {"acceleration", "mm/s2", 0.001},
                                      {"acceleration", "ft/s2", foot},
                                      {"acceleration", "in/s2", foot / 12},
                                      {"velocity", "m/s", 1},
                                      {"velocity", "cm/s", 0.01},
                                      {"velocity", "mm/s", 0.001},
                                      {"velocity", "ft/s", foot},
                                      {"velocity", "in/s", foot / 12},
                                      {"displacement", "m", 1},
                                      {"displacement", "cm", 0.01},
                                      {"displacement", "mm", 0.001},
                                      {"displacement", "ft", foot},
                                      {"displacement", "in", foot / 12}}};

}  // namespace

std::optional<double> unit_factor(std::string_view quantity, std::string_view name) {
  std::string unit;
  for (const char c : lower(trim(name)))
    if (c != ' ' && c != '^' && c != '*' && c != '.') unit += c == '_' ? '/' : c;
  for (size_t at; (at = unit.find("sec")) != std::string::npos;) unit.replace(at, 3, 1, 's');
  if (const size_t at = unit.find("/s/s"); at != std::string::npos) unit.replace(at, 4, std::string("/s2"));
  for (const Unit& known : units)
    if (known.quantity == quantity && known.name == unit) return known.factor;
  return std::nullopt;
}

std::string_view known_units(std::string_view quantity) {
  return quantity == "velocity"       ? "m/s, cm/s, mm/s, ft/s, in/s"
         : quantity == "displacement" ? "m, cm, mm, ft, in"
                                      : "g, mg, m/s2, cm/s2, gal, mm/s2, ft/s2, in/s2";
}

std::string_view quantity_of_unit(std::string_view name) {
  for (const std::string_view quantity : {"acceleration", "velocity", "displacement"})
    if (unit_factor(quantity, name)) return quantity;
  return "";
}

}  // namespace erbs
