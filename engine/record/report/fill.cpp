#include "engine/record/report/fill.h"

namespace erbs {

std::string safe_json(const Json& json) {
  std::string out;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
    if (c == '<') out += "\\u003c";
    else out += c;
  }
  return out;
}

std::string safe_html(const std::string& text) {
  const std::map<char, const char*> escapes{{'<', "&lt;"}, {'>', "&gt;"}, {'&', "&amp;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
  std::string out;
  for (const char c : text) {
    if (const auto escape = escapes.find(c); escape != escapes.end()) out += escape->second;
    else out += c;
  }
  return out;
}

std::string filled(std::string_view html, const std::map<std::string_view, std::string>& values) {
  std::string out;
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t open = html.find("{{", at), close = html.find("}}", open);
    out += html.substr(at, open - at);
    if (close == std::string_view::npos) break;
    out += values.at(html.substr(open + 2, close - open - 2));
    at = close + 2;
  }
  return out;
}

}  // namespace erbs
