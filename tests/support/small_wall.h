// A small wall on the ground under a pulse, for tests of the engine.
#pragma once
#include <string>

#include "engine/analysis/start/at_rest.h"
#include "engine/solve/step.h"
#include "lua/language/script.h"

namespace erbs::test {

// `more` is appended to the script: loads, analysis.
inline Scene small_wall(const std::string& more, const std::string& law = "mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6}") {
  const std::string text = R"(
    material{name="brick", density=1800}
    joint{law=)" + law + R"(, thickness=10*mm, tolerance=0.1*mm}
    box{name="foot", size={1.5,.2,.1}, at={-.1,0,-.11}, material="brick", fixed=true}
    for c = 0, 5 do
      for i = 0, 3 do
        box{name="b"..c.."_"..i, size={.25,.125,.1}, at={i*.26+(c%2)*.13, 0, c*.11}, material="brick"}
      end
    end
  )" + more;
  lua::Script script(lua::Script::Options{.quiet = true});
  return script.load_text(text, "small_wall.lua");
}

// Runs to `until` (s) and leaves the prepared run in `out`.
inline void run_to(const Scene& scene, int threads, double until, analysis::Prepared& out) {
  out = analysis::prepare(scene, false);
  start_at_rest(scene, out, threads);
  Solver solver(out.model, out.state, out.range, threads);
  solver.advance_until([&] { return out.state.time.t >= until; });
}

}  // namespace erbs::test
