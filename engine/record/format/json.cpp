#include "engine/record/format/json.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"

namespace erbs {

Json read_json(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("this file is missing or cannot be read; is its folder a run folder?", {path, 0});
  std::stringstream text;
  text << in.rdbuf();
  try {
    return Json::parse(text.str());
  } catch (const nlohmann::json::exception& mistake) {
    throw Error(fmt::format("not valid JSON ({}); run the scene again", mistake.what()), {path, 0});
  }
}

void write_text_atomically(const std::string& path, std::string_view text) {
  const std::string beside = path + ".tmp";
  {
    errno = 0;
    std::ofstream out(beside, std::ios::binary | std::ios::trunc);
    out.write(text.data(), std::streamsize(text.size()));
    out.close();
    if (!out) {
      const std::string why = std::strerror(errno);
      std::remove(beside.c_str());
      throw WriteError(fmt::format("cannot be written: {}", why), {path, 0});
    }
  }
  std::error_code failed;
  std::filesystem::rename(beside, path, failed);
  if (failed) {
    std::remove(beside.c_str());
    throw WriteError(fmt::format("cannot be replaced: {}", failed.message()), {path, 0});
  }
}

std::string whole_text(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_json(const std::string& path, const Json& json) {
  // Names of files and blocks may hold any bytes. Bytes that are not UTF-8 are replaced, so that the file is not lost.
  write_text_atomically(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

const Json* find_key(const Json& json, std::string_view dotted) {
  const Json* at = &json;
  while (!dotted.empty()) {
    const std::size_t dot = dotted.find('.');
    const std::string key(dotted.substr(0, dot));
    dotted = dot == std::string_view::npos ? std::string_view() : dotted.substr(dot + 1);
    if (at->is_object() && at->contains(key)) {
      at = &at->at(key);
    } else if (at->is_array() && !key.empty() && key.size() < 9 && key.find_first_not_of("0123456789") == std::string::npos &&
               std::stoul(key) < at->size()) {
      at = &at->at(std::stoul(key));
    } else {
      return nullptr;
    }
  }
  return at;
}

double number_at(const Json& json, std::string_view dotted) {
  const Json* value = find_key(json, dotted);
  return value && value->is_number() ? value->get<double>() : 0;
}

}  // namespace erbs
