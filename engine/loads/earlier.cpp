#include "engine/loads/earlier.h"

namespace erbs {

Wave earlier(const Wave& wave, double by) {
  Wave moved = wave;
  std::visit(
      [&](auto& w) {
        if constexpr (requires { w.start; }) w.start -= by;
        else if constexpr (requires { w.times; })
          for (double& t : w.times) t -= by;
        else
          for (double& t : w.line.times) t -= by;
      },
      moved);
  return moved;
}

}  // namespace erbs
