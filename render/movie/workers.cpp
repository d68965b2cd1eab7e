#include "render/movie/workers.h"

#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

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

void answer(int to, const std::string& text, bool users_mistake) {
  const Answer head{text.size(), users_mistake};
  if (!send(to, &head, sizeof head) || !send(to, text.data(), text.size())) _exit(1);
}

}  // namespace

Workers::Workers(std::size_t count, Image empty, const MotionFrame& like, const std::function<Draw()>& prepare)
    : empty_(std::move(empty)),
      poses_(like.poses.size() * sizeof(float)),
      openings_(like.opening.size() * sizeof(float)),
      derived_(like.derived.size() * sizeof(float)),
      damages_(like.damage.size()),
      pixels_(empty_.rgb.size()) {
  for (std::size_t i = 0; i < count; ++i) {
    Worker w;
    void* shared =
        mmap(nullptr, poses_ + openings_ + derived_ + damages_ + pixels_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) throw Error("no more drawing processes can be started; ask for fewer --threads");
    w.shared = static_cast<unsigned char*>(shared);
    w.process = start_copy([&](int orders, int answers) { serve(w, orders, answers, prepare); });
    workers_.push_back(w);
  }
}

Workers::~Workers() {
  for (Worker& w : workers_) {
    finish(w.process);
    munmap(w.shared, poses_ + openings_ + derived_ + damages_ + pixels_);
  }
}

// Main loop of a drawing process. It ends when its orders end. Only the parent reacts to Ctrl-C.
void Workers::serve(const Worker& w, int orders, int answers, const std::function<Draw()>& prepare) {
  for (const Worker& other : workers_) close(other.process.to), close(other.process.from);
  for (const int stop : {SIGINT, SIGTERM, SIGHUP}) signal(stop, SIG_IGN);
  Draw draw;
  for (Order order; receive(orders, &order, sizeof order);) {
    try {
      if (!draw) draw = prepare();
      const Image image = draw(order.index, get(w, order.t));
      std::memcpy(pixels(w), image.rgb.data(), pixels_);
      answer(answers, "", false);
    } catch (const Error& e) { answer(answers, e.what(), true); } catch (const std::exception& e) {
      answer(answers, e.what(), false);
    }
  }
}

void Workers::put(Worker& w, const MotionFrame& f) const {
  std::memcpy(w.shared, f.poses.data(), poses_);
  std::memcpy(w.shared + poses_, f.opening.data(), openings_);
  if (derived_ > 0) std::memcpy(w.shared + poses_ + openings_, f.derived.data(), derived_);
  std::memcpy(w.shared + poses_ + openings_ + derived_, f.damage.data(), damages_);
}

MotionFrame Workers::get(const Worker& w, double t) const {
  MotionFrame f{t, std::vector<float>(poses_ / sizeof(float)), std::vector<std::uint8_t>(damages_),
                std::vector<float>(openings_ / sizeof(float)), std::vector<float>(derived_ / sizeof(float))};
  std::memcpy(f.poses.data(), w.shared, poses_);
  std::memcpy(f.opening.data(), w.shared + poses_, openings_);
  if (derived_ > 0) std::memcpy(f.derived.data(), w.shared + poses_ + openings_, derived_);
  std::memcpy(f.damage.data(), w.shared + poses_ + openings_ + derived_, damages_);
  return f;
}

void Workers::order(std::size_t worker, std::size_t index, const MotionFrame& frame) {
  put(workers_[worker], frame);
  const Order order{index, frame.t};
  send(workers_[worker].process.to, &order, sizeof order);  // collect() reports a process that no longer reads
}

Image Workers::collect(std::size_t worker) {
  const Worker& w = workers_[worker];
  Answer head;
  if (!receive(w.process.from, &head, sizeof head))
    throw std::runtime_error("a drawing process has died; is the memory full? try --threads 1, or the other --context");
  if (head.text > 0) {
    std::string text(head.text, ' ');
    receive(w.process.from, text.data(), text.size());
    if (head.users_mistake) throw Error(text);
    throw std::runtime_error(text);
  }
  Image image = empty_;
  std::memcpy(image.rgb.data(), pixels(w), pixels_);
  return image;
}

}  // namespace erbs::render
