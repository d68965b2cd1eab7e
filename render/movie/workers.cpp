#include "render/movie/workers.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
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
    void* shared = mmap(nullptr, most_orders * bytes(), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) throw Error("no more drawing processes can be started; ask for fewer --threads");
    w.shared = static_cast<unsigned char*>(shared);
    w.process = start_copy([&](int orders, int answers) { serve(w, orders, answers, prepare); });
    workers_.push_back(w);
  }
}

Workers::~Workers() {
  for (Worker& w : workers_) {
    finish(w.process);
    munmap(w.shared, most_orders * bytes());
  }
}

// Main loop of a drawing process. It ends when its orders end. Only the parent reacts to Ctrl-C.
void Workers::serve(const Worker& w, int orders, int answers, const std::function<Draw()>& prepare) {
  for (const Worker& other : workers_) close(other.process.to), close(other.process.from);
  for (const int stop : {SIGINT, SIGTERM, SIGHUP}) signal(stop, SIG_IGN);
  Draw draw;
  std::size_t drawn = 0;
  for (Order order; receive(orders, &order, sizeof order); ++drawn) {
    unsigned char* const place = place_of(w, drawn);
    try {
      if (!draw) draw = prepare();
      const Image image = draw(order.index, get(place, order.t));
      std::memcpy(place + pixels_at(), image.rgb.data(), pixels_);
      answer(answers, "", false);
    } catch (const Error& e) { answer(answers, e.what(), true); } catch (const std::exception& e) {
      answer(answers, e.what(), false);
    }
  }
}

// Sizes are in bytes; an empty array has no address that could be copied from.
void Workers::put(unsigned char* place, const MotionFrame& f) const {
  const auto append = [&](const void* from, std::size_t size) {
    if (size > 0) std::memcpy(place, from, size);
    place += size;
  };
  append(f.poses.data(), poses_);
  append(f.opening.data(), openings_);
  append(f.derived.data(), derived_);
  append(f.damage.data(), damages_);
}

MotionFrame Workers::get(const unsigned char* place, double t) const {
  MotionFrame f{t, std::vector<float>(poses_ / sizeof(float)), std::vector<std::uint8_t>(damages_),
                std::vector<float>(openings_ / sizeof(float)), std::vector<float>(derived_ / sizeof(float))};
  const auto take = [&](void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, place, size);
    place += size;
  };
  take(f.poses.data(), poses_);
  take(f.opening.data(), openings_);
  take(f.derived.data(), derived_);
  take(f.damage.data(), damages_);
  return f;
}

void Workers::order(std::size_t worker, std::size_t index, const MotionFrame& frame) {
  Worker& w = workers_[worker];
  ERBS_ASSERT(w.ordered - w.collected < most_orders);
  put(place_of(w, w.ordered++), frame);
  const Order order{index, frame.t};
  send(w.process.to, &order, sizeof order);  // collect() reports a process that no longer reads
}

Image Workers::collect(std::size_t worker) {
  Worker& w = workers_[worker];
  Answer head;
  const unsigned char* const place = place_of(w, w.collected++);
  if (!receive(w.process.from, &head, sizeof head))
    throw std::runtime_error("a drawing process has died; is the memory full? try --threads 1, or the other --context");
  if (head.text > 0) {
    std::string text(head.text, ' ');
    receive(w.process.from, text.data(), text.size());
    if (head.users_mistake) throw Error(text);
    throw std::runtime_error(text);
  }
  Image image = empty_;
  std::memcpy(image.rgb.data(), place + pixels_at(), pixels_);
  return image;
}

void Workers::draw_in_order(std::size_t count, const std::function<MotionFrame(std::size_t)>& frame,
                            const std::function<bool(std::size_t, Image)>& take) {
  const std::size_t n = workers_.size(), under_way = n * most_orders;
  for (std::size_t i = 0; i < std::min(under_way, count); ++i) order(i % n, i, frame(i));
  for (std::size_t i = 0; i < count; ++i) {
    Image image = collect(i % n);
    if (const std::size_t next = i + under_way; next < count) order(next % n, next, frame(next));
    if (!take(i, std::move(image))) return;
  }
}

}  // namespace erbs::render
