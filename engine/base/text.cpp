#include "engine/base/text.h"

#include <algorithm>
#include <cctype>

#include "engine/base/error.h"

namespace erbs {
namespace {

// First UTF-8 character of `text`; length 0 if its bytes are invalid.
struct Letter {
  std::size_t length = 0;
  unsigned code = 0;
};

Letter letter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return {1, first};
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return {};
  unsigned code = first & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const unsigned least = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0x80;  // a smaller code is an overlong encoding
  if (code < least || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return {};
  return {length, code};
}

bool controls(unsigned code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) ||
         code == 0x200e || code == 0x200f || code == 0xfeff;
}

std::string escaped(std::string_view bytes) {
  std::string out;
  for (const char c : bytes) {
    if (c == '\n') out += "\\n";
    else if (c == '\t') out += "\\t";
    else if (c == '\r') out += "\\r";
    else if (c == '\0') out += "\\0";
    else out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return out;
}

// Calls plain(bytes) for each plain character and other(bytes, valid) for each other one, in order.
template <class Plain, class Other>
void each_letter(std::string_view text, Plain&& plain, Other&& other) {
  while (!text.empty()) {
    const Letter l = letter(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(1, l.length));
    if (l.length > 0 && !controls(l.code)) plain(bytes);
    else other(bytes, l.length > 0);
    text.remove_prefix(bytes.size());
  }
}

bool as_json = false;

// Of printable text, which has no control characters but line ends and tabs.
std::string as_json_line(std::string_view text) {
  std::string out = "{\"message\":\"";
  for (const char c : text) out += c == '\n' ? "\\n" : c == '\t' ? "\\t" : c == '"' ? "\\\"" : c == '\\' ? "\\\\" : std::string(1, c);
  return out + "\"}\n";
}

}  // namespace

bool is_plain(std::string_view text) {
  bool all = true;
  each_letter(
      text, [](std::string_view) {}, [&](std::string_view, bool) { all = false; });
  return all;
}

bool is_name(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '+' || c == '-';
  };
  return !text.empty() && text.front() != '-' && text.front() != '+' && std::all_of(text.begin(), text.end(), allowed);
}

std::string shown(std::string_view text, std::size_t most) {
  std::string out;
  bool cut = false;
  const auto add = [&](const std::string& piece) {
    cut = cut || out.size() + piece.size() > most;
    if (!cut) out += piece;
  };
  each_letter(
      text.substr(0, most + 4), [&](std::string_view l) { add(std::string(l)); }, [&](std::string_view l, bool) { add(escaped(l)); });
  return cut || text.size() > most + 4 ? out + "..." : out;
}

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  each_letter(
      text, [&](std::string_view l) { out += l; },
      [&](std::string_view l, bool) { out += l == "\n" || l == "\t" ? std::string(l) : escaped(l); });
  return out;
}

void tell_as_json() { as_json = true; }

void tell(std::FILE* to, std::string_view text) {
  constexpr std::size_t most = 4000;  // bytes per line: foreign names and words may have any length
  std::string all;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    all += line.size() > most ? shown(line, most) : printable(line);
    all += '\n';
    begin = end + 1;
  }
  if (as_json && to == stderr) all = as_json_line(all.substr(0, all.size() - 1));
  std::fwrite(all.data(), 1, all.size(), to);
}

std::string for_files(std::string_view text) {
  std::string out;
  each_letter(
      text, [&](std::string_view l) { out += l; }, [&](std::string_view, bool valid) { out += valid ? " " : "\xEF\xBF\xBD"; });
  return out;
}

std::string for_xml(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string file_stem(std::string_view name) {
  std::string stem = for_files(name);
  for (char& c : stem)
    if (static_cast<unsigned char>(c) < 0x80 && !std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-' && c != '+') c = '_';
  return stem.empty() ? "run" : stem;
}

}  // namespace erbs
