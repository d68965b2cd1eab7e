#include "engine/record/folder/archive.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/hash.h"

namespace erbs {

void ArchiveOut::head(std::string_view name, std::uint64_t size, std::uint64_t count) {
  const std::uint64_t numbers[3] = {fnv1a(name), size, count};
  put(numbers, sizeof numbers);
}

std::size_t ArchiveIn::head(std::string_view name, std::uint64_t size) {
  std::uint64_t numbers[3];
  get(numbers, sizeof numbers);
  if (numbers[0] != fnv1a(name) || numbers[1] != size)
    throw Error(fmt::format("written by another version of the program (at \"{}\"); start anew with --force", name), {file_, 0});
  // Each item takes at least its own bytes, or one head.
  if (numbers[2] > left_ / std::max<std::uint64_t>(size, 1))
    throw Error(fmt::format("damaged: \"{}\" is longer than the file; start anew with --force", name), {file_, 0});
  return std::size_t(numbers[2]);
}

void ArchiveIn::expect_head(std::string_view name, std::uint64_t size, std::uint64_t count) {
  if (head(name, size) != count)
    throw Error(fmt::format("written by another version of the program (at \"{}\"); start anew with --force", name), {file_, 0});
}

void ArchiveIn::get(void* data, std::size_t size) {
  if (size > left_ || !in_.read(static_cast<char*>(data), std::streamsize(size)))
    throw Error("damaged: it ends too early; start anew with --force", {file_, 0});
  left_ -= size;
}

void ArchiveIn::get_lazy(void* zeros, std::size_t size) {
  constexpr std::size_t page = 4096;
  char bytes[page];
  for (std::size_t at = 0; at < size; at += page) {
    const std::size_t n = std::min(page, size - at);
    get(bytes, n);
    if (std::any_of(bytes, bytes + n, [](char c) { return c != 0; })) std::memcpy(static_cast<char*>(zeros) + at, bytes, n);
  }
}

void ArchiveIn::finish() const {
  if (left_ != 0)
    throw Error(fmt::format("written by another version of the program ({} bytes left over); start anew with --force", left_), {file_, 0});
}

void ResultHash::add(const void* data, std::size_t size) {
  if (size > 0) value = fnv1a({static_cast<const char*>(data), size}, value);
}

}  // namespace erbs
