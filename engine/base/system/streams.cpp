#include "engine/base/system/streams.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace erbs {
namespace {

// A long text has met the end of its pipe long before the last flush, which then finds nothing wrong: the pipe itself tells.
bool reader_is_gone() {
  pollfd out{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  return ::poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

}  // namespace

void prepare_streams() {
  for (int fd = 0; fd <= 2; ++fd) {
    if (::fcntl(fd, F_GETFD) >= 0 || errno != EBADF) continue;
    // /dev/full lets writes to a closed stdout fail, so that the loss is reported
    if (fd == 1 && ::open("/dev/full", O_WRONLY) == fd) continue;
    if (::open("/dev/null", O_RDWR) < 0) return;
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

int finish_streams(int code, int failed) {
  errno = 0;
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  const int why = errno;
  if (!lost || why == EPIPE || reader_is_gone()) return code;  // who stops reading loses nothing
  tell(stderr, fmt::format("what was to be printed is lost: {}; give standard output a place",
                           why != 0 ? std::strerror(why) : "standard output cannot be written"));
  return code == 0 ? failed : code;
}

}  // namespace erbs
