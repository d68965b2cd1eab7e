// A record from a text, through a file.
#pragma once
#include <fstream>
#include <functional>
#include <string>

#include "engine/base/error.h"
#include "engine/loads/record/record.h"
#include "tests/support/folder.h"

namespace erbs::test {

inline Record read_text(
    const std::string& text, const std::function<void(Record&)>& set = [](Record&) {}) {
  const Folder folder;
  Record wanted;
  wanted.file = folder.file("motion.txt");
  std::ofstream(wanted.file, std::ios::binary) << text;
  set(wanted);
  return read_record(wanted, {"scene.lua", 7});
}

inline std::string mistake_in(
    const std::string& text, const std::function<void(Record&)>& set = [](Record&) {}) {
  try {
    read_text(text, set);
  } catch (const Error& error) { return error.what(); }
  return "no mistake found";
}

}  // namespace erbs::test
