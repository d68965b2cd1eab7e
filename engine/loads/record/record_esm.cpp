// ESM and ITACA text (DYNA 1.0 to 1.2): lines "KEY: value", such as SAMPLING_INTERVAL_S, NDATA, UNITS and DATA_TYPE, then one value a line.
#include <charconv>
#include <cmath>
#include <map>

#include "engine/base/text.h"
#include "engine/loads/record/record_file.h"

namespace erbs {
namespace {

struct HeaderLine {
  std::string value;
  int line = 0;  // of the file
};
using Keys = std::map<std::string, HeaderLine>;

// A key is of capitals, digits and a few signs: "VS30_M/S", "INSTRUMENT_ANALOG/DIGITAL".
size_t end_of_key(std::string_view line) {
  const size_t colon = line.find(':');
  if (colon == std::string_view::npos || colon < 2 || line[0] < 'A' || line[0] > 'Z') return std::string_view::npos;
  for (const char c : line.substr(0, colon))
    if (!((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '/' || c == '^' || c == '.' || c == '-'))
      return std::string_view::npos;
  return colon;
}

Keys header_of(const RecordText& text, size_t& first) {
  Keys keys;
  for (first = 0; first < text.lines.size(); ++first) {
    const size_t colon = end_of_key(text.lines[first]);
    if (colon == std::string_view::npos) {
      if (is_blank(text.lines[first])) continue;
      break;
    }
    const std::string_view line = text.lines[first];
    keys[std::string(line.substr(0, colon))] = {std::string(trim(line.substr(colon + 1))), static_cast<int>(first) + 1};
  }
  return keys;
}

const HeaderLine& wanted_key(const Keys& keys, const std::string& name, const RecordText& text) {
  const auto at = keys.find(name);
  if (at == keys.end() || at->second.value.empty())
    throw Error(fmt::format("the header gives no {0}; write a line \"{0}: value\", or strip the header and give the file as columns", name),
                {text.path, at == keys.end() ? 1 : at->second.line});
  return at->second;
}

double number_of(const HeaderLine& at, const std::string& name, const RecordText& text) {
  double value = NAN;
  const auto [end, code] = std::from_chars(at.value.data(), at.value.data() + at.value.size(), value);
  if (code != std::errc() || end != at.value.data() + at.value.size() || !(value > 0 && value <= 1e8))
    throw Error(fmt::format("{} is \"{}\", not a number above 0; correct it", name, shown(at.value, 24)), {text.path, at.line});
  return value;
}

std::string value_of(const Keys& keys, const std::string& name) {
  const auto at = keys.find(name);
  return at == keys.end() ? "" : at->second.value;
}

}  // namespace

bool is_esm(const RecordText& text) {
  size_t first = 0;
  return header_of(text, first).contains("SAMPLING_INTERVAL_S");
}

RecordFile parse_esm(RecordText& text, const Record& wanted) {
  size_t first = 0;
  const Keys keys = header_of(text, first);
  const HeaderLine &step = wanted_key(keys, "SAMPLING_INTERVAL_S", text), &count = wanted_key(keys, "NDATA", text);
  const double dt = checked_step(number_of(step, "SAMPLING_INTERVAL_S", text), wanted, {text.path, step.line});
  if (const auto type = keys.find("DATA_TYPE"); type != keys.end())
    check_quantity(lower(type->second.value), wanted, {text.path, type->second.line});
  const auto unit = keys.find("UNITS");
  const double factor = factor_to_si(unit == keys.end() ? "" : unit->second.value, wanted,
                                     {text.path, unit == keys.end() ? static_cast<int>(first) : unit->second.line});
  RecordFile file;
  file.format = "ESM";
  for (const char* name : {"EVENT_NAME", "EVENT_DATE_YYYYMMDD", "NETWORK", "STATION_CODE", "STREAM"})
    if (const std::string value = value_of(keys, name); !value.empty()) file.title += (file.title.empty() ? "" : ", ") + value;
  file.values = numbers_of(text, first, text.lines.size(), wanted);
  check_count(file.values.size(), number_of(count, "NDATA", text), "NDATA", {text.path, count.line});
  for (double& value : file.values) value *= factor;
  for (size_t i = 0; i < file.values.size(); ++i) file.times.push_back(wanted.first_time + static_cast<double>(i) * dt);
  return file;
}

}  // namespace erbs
