#include "engine/loads/earlier.h"

namespace erbs {

double start_time(const Wave& wave) {
  return std::visit(
      [](const auto& w) {
        if constexpr (requires { w.start; }) return w.start;
        else return w.line.times.front();
      },
      wave);
}

Wave earlier(const Wave& wave, double by) {
  Wave moved = wave;
  std::visit(
      [&](auto& w) {
        if constexpr (requires { w.start; }) w.start -= by;
        else
          for (double& t : w.line.times) t -= by;
      },
      moved);
  return moved;
}

}  // namespace erbs
