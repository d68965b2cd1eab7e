#include "engine/study/sweep/shared_table.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>

#include "engine/base/error.h"
#include "engine/record/format/csv.h"

namespace erbs::study {
namespace {

// The file under its lock. A file that another process has just replaced by its sorted copy is opened anew.
class Locked {
 public:
  Locked(const std::string& path, int flags) : path_(path) {
    for (;;) {
      file_ = ::open(path.c_str(), flags | O_CLOEXEC, 0644);
      if (file_ < 0) fail();
      while (::flock(file_, LOCK_EX) != 0)
        if (errno != EINTR) fail();
      struct stat here {
      }, there{};
      if (::fstat(file_, &here) == 0 && ::stat(path.c_str(), &there) == 0 && here.st_ino == there.st_ino) return;
      ::close(file_);
    }
  }
  ~Locked() { ::close(file_); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

  std::int64_t size() const {
    struct stat now {};
    if (::fstat(file_, &now) != 0) fail();
    return now.st_size;
  }
  std::uint64_t inode() const {
    struct stat now {};
    if (::fstat(file_, &now) != 0) fail();
    return now.st_ino;
  }
  std::string read(std::int64_t from, std::int64_t to) const {
    std::string text(static_cast<std::size_t>(to - from), '\0');
    for (std::size_t got = 0; got < text.size();) {
      const ssize_t n = ::pread(file_, text.data() + got, text.size() - got, from + std::int64_t(got));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail();
      got += std::size_t(n);
    }
    return text;
  }
  // Where the last whole line ends.
  std::int64_t whole() const {
    constexpr std::int64_t piece = 4096;
    for (std::int64_t end = size(); end > 0; end -= std::min(end, piece)) {
      const std::int64_t from = std::max(std::int64_t(0), end - piece);
      const std::size_t at = read(from, end).rfind('\n');
      if (at != std::string::npos) return from + std::int64_t(at) + 1;
    }
    return 0;
  }
  void cut(std::int64_t size) const {
    if (::ftruncate(file_, size) != 0) fail();
  }
  void write(const std::string& text) const {
    const ssize_t n = ::write(file_, text.data(), text.size());
    if (n >= 0 && n != ssize_t(text.size())) errno = ENOSPC;  // a part of it still went in
    if (n != ssize_t(text.size())) fail();
  }
  void sync() const {
    if (::fdatasync(file_) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw WriteError(fmt::format("cannot be written: {}; make room, or allow it, and go on with --resume", std::strerror(errno)),
                     {path_, 0});
  }
  std::string path_;
  int file_ = -1;
};

}  // namespace

SharedTable::SharedTable(std::string path, const Cells& names, std::string key)
    : path_(std::move(path)), key_(std::move(key)), columns_(names.size() + 1), synced_(std::chrono::steady_clock::now()) {
  Cells all = names;
  all.emplace_back("study");
  head_ = csv_line(all);
  const Locked file(path_, O_RDWR | O_CREAT | O_APPEND);
  const std::int64_t whole = file.whole();
  if (whole < file.size()) file.cut(whole);
  if (whole == 0) file.write(head_);
  else if (file.read(0, std::min(whole, std::int64_t(head_.size()))) != head_) refuse("its columns differ");
}

void SharedTable::refuse(const std::string& what) const {
  throw Error(fmt::format("is of another study: {}; choose another folder with -o DIR, or replace it with --force", what), {path_, 0});
}

void SharedTable::append(const Cells& cells) {
  Cells all = cells;
  all.push_back(key_);
  ERBS_ASSERT(all.size() == columns_);
  const Locked file(path_, O_RDWR | O_CREAT | O_APPEND);
  const std::int64_t whole = file.whole();
  if (whole < file.size()) file.cut(whole);
  file.write((whole == 0 ? head_ : "") + csv_line(all));
  const auto now = std::chrono::steady_clock::now();
  unsynced_ = now - synced_ <= std::chrono::seconds(1);
  if (!unsynced_) file.sync(), synced_ = now;
}

void SharedTable::sync() {
  if (!unsynced_) return;
  Locked(path_, O_RDWR | O_APPEND).sync();
  unsynced_ = false;
}

void SharedTable::rewind() { inode_ = 0, offset_ = 0; }

void SharedTable::read_new(const std::function<void(const Cells&)>& visit) {
  struct stat there {};
  if (inode_ != 0 && ::stat(path_.c_str(), &there) == 0 && there.st_ino == inode_ && there.st_size == offset_) return;
  const Locked file(path_, O_RDWR | O_CREAT | O_APPEND);
  if (file.inode() != inode_) inode_ = file.inode(), offset_ = std::min(std::int64_t(head_.size()), file.size());
  const std::int64_t end = file.whole();
  constexpr std::int64_t piece = 1 << 20;  // memory stays flat, however long the table
  std::string rest;
  for (std::int64_t from = offset_; from < end; from += piece) {
    rest += file.read(from, std::min(end, from + piece));
    std::size_t begin = 0;
    for (std::size_t stop; (stop = rest.find('\n', begin)) != std::string::npos; begin = stop + 1) {
      const Cells cells = csv_cells(std::string_view(rest).substr(begin, stop - begin));
      if (cells.size() != columns_ || cells.back() != key_)
        refuse(fmt::format(
            "its row \"{}\" bears the key {}, this study has {}: the scene, a file that it reads, a value or the program differs",
            cells.front().substr(0, 20), cells.back().substr(0, 20), key_));
      visit(cells);
    }
    rest.erase(0, begin);
  }
  offset_ = std::max(offset_, end);
}

std::int64_t SharedTable::sort() {
  const Locked file(path_, O_RDWR | O_APPEND);
  const std::string text = file.read(0, file.whole());
  std::map<long long, std::string_view> lines;
  bool sorted = true;
  long long before = -1;
  for (std::size_t begin = head_.size(), stop; (stop = text.find('\n', begin)) != std::string::npos; begin = stop + 1) {
    const long long index = std::atoll(text.c_str() + begin);
    sorted = sorted && index > before;
    before = index;
    lines.emplace(index, std::string_view(text).substr(begin, stop + 1 - begin));
  }
  if (!sorted) {
    const std::string copy = path_ + ".sorted";
    {
      const Locked out(copy, O_RDWR | O_CREAT | O_TRUNC);
      std::string whole = head_;
      for (const auto& [index, line] : lines) whole += line;
      out.write(whole);
      out.sync();
    }
    if (::rename(copy.c_str(), path_.c_str()) != 0)
      throw WriteError(fmt::format("cannot be replaced by its sorted copy: {}", std::strerror(errno)), {path_, 0});
  } else {
    file.sync();
  }
  unsynced_ = false;
  return std::int64_t(lines.size());
}

}  // namespace erbs::study
