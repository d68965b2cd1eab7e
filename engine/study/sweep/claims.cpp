#include "engine/study/sweep/claims.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "engine/base/error.h"

namespace erbs::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* worker_ending = ".worker";
constexpr auto beat_every = std::chrono::seconds(5);
constexpr auto silence = std::chrono::seconds(180);  // file systems of a network keep attributes for up to a minute

std::uint64_t inode_of(const std::string& path) {
  struct stat now {};
  return ::stat(path.c_str(), &now) == 0 ? now.st_ino : 0;
}

}  // namespace

std::string machine() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

Claims::Claims(const std::string& folder) : folder_(folder), host_(machine()), beaten_(Clock::now()) {
  fs::create_directories(folder);
  for (int i = 0; lock_ < 0; ++i) {
    name_ = fmt::format("{}-{}-{}", host_, ::getpid(), i);
    file_ = folder_ + "/" + name_ + worker_ending;
    lock_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (lock_ < 0 && errno != EEXIST)
      throw WriteError(fmt::format("cannot be written: {}; choose another folder with -o DIR", std::strerror(errno)), {file_, 0});
  }
  if (::write(lock_, host_.data(), host_.size()) != ssize_t(host_.size()) || ::flock(lock_, LOCK_EX | LOCK_NB) != 0)
    throw WriteError(fmt::format("cannot be locked: {}; choose a folder on a file system with locks, with -o DIR", std::strerror(errno)),
                     {file_, 0});
}

Claims::~Claims() {
  for (const auto& [point, held] : mine_) ::unlink(claim_of(point).c_str());
  ::unlink(file_.c_str());
  ::close(lock_);
  ::rmdir(folder_.c_str());  // the last one out; it stays while others are there
}

std::string Claims::claim_of(std::int64_t point) const { return fmt::format("{}/{}.claim", folder_, point); }

void Claims::beat() {
  if (Clock::now() - beaten_ < beat_every) return;
  beaten_ = Clock::now();
  ::futimens(lock_, nullptr);
}

bool Claims::is_void(const std::string& claim, std::uint64_t& inode) {
  const int file = ::open(claim.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;  // given up just now
  struct stat now {};
  char owner[256] = "";
  bool dead = false;
  if (::fstat(file, &now) == 0 && ::pread(file, owner, sizeof owner - 1, 0) >= 0) {
    inode = now.st_ino;
    if (owner == host_) {
      dead = ::flock(file, LOCK_EX | LOCK_NB) == 0;
    } else {
      const std::int64_t touched = std::int64_t(now.st_mtim.tv_sec) * 1'000'000'000 + now.st_mtim.tv_nsec;
      Seen& seen = seen_[inode];
      if (seen.touched != touched) seen = {touched, Clock::now()};
      dead = Clock::now() - seen.since > silence;
    }
  }
  ::close(file);
  return dead;
}

Claims::Taken Claims::take(std::int64_t point) {
  const std::string claim = claim_of(point);
  Taken how = Taken::yes;
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (::link(file_.c_str(), claim.c_str()) == 0) {
      mine_[point] = true;
      return how;
    }
    if (errno == ENOENT) throw WriteError("cannot be made: its folder has been removed meanwhile; go on with --resume", {claim, 0});
    if (errno != EEXIST)
      throw WriteError(
          fmt::format("cannot be made: {}; choose a folder on a file system with hard links, with -o DIR", std::strerror(errno)),
          {claim, 0});
    std::uint64_t dead = 0;
    if (!is_void(claim, dead)) return Taken::no;
    // Only one of several processes that saw the owner dead gets the claim out of the way. One that catches a new claim puts it back.
    const std::string aside = fmt::format("{}/{}.void-{}", folder_, point, name_);
    if (::rename(claim.c_str(), aside.c_str()) != 0) continue;
    if (inode_of(aside) != dead) ::link(aside.c_str(), claim.c_str());
    ::unlink(aside.c_str());
    how = Taken::from_the_dead;
  }
  return Taken::no;
}

void Claims::release(std::int64_t point) {
  ::unlink(claim_of(point).c_str());
  mine_.erase(point);
}

void Claims::remove_void() {
  std::error_code ignored;
  std::uint64_t inode = 0;
  for (const auto& entry : fs::directory_iterator(folder_, ignored))
    if (is_void(entry.path().string(), inode)) fs::remove(entry.path(), ignored);
}

std::string working_in(const std::string& folder) {
  std::error_code ignored;
  const std::string host = machine();
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() != worker_ending) continue;
    const int file = ::open(entry.path().c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0) continue;
    char owner[256] = "";
    struct stat there {};
    bool works = false;
    if (::pread(file, owner, sizeof owner - 1, 0) >= 0 && ::fstat(file, &there) == 0)
      works = owner == host ? ::flock(file, LOCK_EX | LOCK_NB) != 0 : std::time(nullptr) - there.st_mtim.tv_sec < silence.count();
    ::close(file);
    if (works) return entry.path().stem().string();
  }
  return "";
}

}  // namespace erbs::study
