#include "render/movie/workers.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include "engine/base/error.h"

namespace erbs::render {
namespace {

struct Order {
  std::size_t index;
  double t;
};
// Followed by as many bytes of text: the message of an Error or another exception.
struct Answer {
  std::size_t text = 0;
  bool users_mistake = false;
};

bool send(int to, const void* bytes, std::size_t count) {
  for (const char* at = static_cast<const char*>(bytes); count > 0;) {
    const ssize_t n = write(to, at, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    count -= static_cast<std::size_t>(n);
  }
  return true;
}

bool receive(int from, void* bytes, std::size_t count) {
  for (char* at = static_cast<char*>(bytes); count > 0;) {
    const ssize_t n = read(from, at, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    count -= static_cast<std::size_t>(n);
  }
  return true;
}

void answer(int to, const std::string& text, bool users_mistake) {
  const Answer head{text.size(), users_mistake};
  if (!send(to, &head, sizeof head) || !send(to, text.data(), text.size())) _exit(1);
}

}  // namespace

Workers::Workers(std::size_t count, int width, int height, const MotionFrame& like, const std::function<Draw()>& prepare)
    : width_(width),
      height_(height),
      poses_(like.poses.size() * sizeof(float)),
      openings_(like.opening.size() * sizeof(float)),
      damages_(like.damage.size()),
      pixels_(Image(width, height).rgb.size()) {
  signal(SIGPIPE, SIG_IGN);  // write() reports a process that died
  for (std::size_t i = 0; i < count; ++i) {
    Worker w;
    std::array<int, 2> orders{}, answers{};
    void* shared = mmap(nullptr, poses_ + openings_ + damages_ + pixels_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED || pipe2(orders.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0)
      throw Error("no more drawing processes can be started; ask for fewer --threads");
    w.shared = static_cast<unsigned char*>(shared);
    const pid_t parent = getpid();
    w.pid = fork();
    if (w.pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);  // it must not outlive its parent
      if (getppid() != parent) _exit(1);
      for (const Worker& other : workers_) close(other.orders), close(other.answers);
      close(orders[1]), close(answers[0]);
      w.orders = orders[0], w.answers = answers[1];
      serve(w, prepare);
    }
    close(orders[0]), close(answers[1]);
    w.orders = orders[1], w.answers = answers[0];
    workers_.push_back(w);
    if (w.pid < 0) throw Error("no more drawing processes can be started; ask for fewer --threads");
  }
}

Workers::~Workers() {
  for (const Worker& w : workers_) close(w.orders), close(w.answers);
  for (const Worker& w : workers_) {
    while (w.pid > 0 && waitpid(w.pid, nullptr, 0) < 0 && errno == EINTR) {}
    munmap(w.shared, poses_ + openings_ + damages_ + pixels_);
  }
}

// Main loop of a drawing process. It ends when its orders end. Only the parent reacts to Ctrl-C.
void Workers::serve(Worker& w, const std::function<Draw()>& prepare) {
  signal(SIGINT, SIG_IGN);
  signal(SIGTERM, SIG_IGN);
  signal(SIGHUP, SIG_IGN);
  Draw draw;
  for (Order order; receive(w.orders, &order, sizeof order);) {
    try {
      if (!draw) draw = prepare();
      const Image image = draw(order.index, get(w, order.t));
      std::memcpy(pixels(w), image.rgb.data(), pixels_);
      answer(w.answers, "", false);
    } catch (const Error& e) { answer(w.answers, e.what(), true); } catch (const std::exception& e) {
      answer(w.answers, e.what(), false);
    }
  }
  _exit(0);
}

void Workers::put(Worker& w, const MotionFrame& f) const {
  std::memcpy(w.shared, f.poses.data(), poses_);
  std::memcpy(w.shared + poses_, f.opening.data(), openings_);
  std::memcpy(w.shared + poses_ + openings_, f.damage.data(), damages_);
}

MotionFrame Workers::get(const Worker& w, double t) const {
  MotionFrame f{t, std::vector<float>(poses_ / sizeof(float)), std::vector<std::uint8_t>(damages_),
                std::vector<float>(openings_ / sizeof(float))};
  std::memcpy(f.poses.data(), w.shared, poses_);
  std::memcpy(f.opening.data(), w.shared + poses_, openings_);
  std::memcpy(f.damage.data(), w.shared + poses_ + openings_, damages_);
  return f;
}

void Workers::order(std::size_t worker, std::size_t index, const MotionFrame& frame) {
  put(workers_[worker], frame);
  const Order order{index, frame.t};
  send(workers_[worker].orders, &order, sizeof order);  // collect() reports a process that no longer reads
}

Image Workers::collect(std::size_t worker) {
  const Worker& w = workers_[worker];
  Answer head;
  if (!receive(w.answers, &head, sizeof head))
    throw std::runtime_error("a drawing process has died; is the memory full? try --threads 1, or the other --context");
  if (head.text > 0) {
    std::string text(head.text, ' ');
    receive(w.answers, text.data(), text.size());
    if (head.users_mistake) throw Error(text);
    throw std::runtime_error(text);
  }
  Image image(width_, height_);
  std::memcpy(image.rgb.data(), pixels(w), pixels_);
  return image;
}

}  // namespace erbs::render
