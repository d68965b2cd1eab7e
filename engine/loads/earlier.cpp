#include "engine/loads/earlier.h"

namespace erbs {

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
