#include "engine/study/stability_map.h"

#include <cmath>
#include <limits>

namespace erbs::study {

Stiffness stiffer(Stiffness s, double factor) { return {s.critical / std::sqrt(factor), s.block / std::sqrt(factor), s.feed * factor}; }

// Explicit damping: the roots of z^2 - (2 - e - w2) z + 1 - e, with w2 = (omega dt)^2 and e = c dt, lie in the unit circle while
// w2 < 4 - 2 e and e < 2. Centred damping adds e / 2 on both sides, and the limit of w2 stays 4.
std::optional<Room> room_of(const Scheme& scheme, const Stiffness& s, double dt) {
  const double limit = scheme.sequential ? s.block : s.critical;
  if (!(dt < limit)) return std::nullopt;
  Room room{scheme.sequential ? 0.5 * dt * s.feed : 0, std::numeric_limits<double>::infinity()};
  if (scheme.explicit_damping) room.most = 2 / dt * (1 - dt * dt / (limit * limit));
  if (room.most <= room.least) return std::nullopt;
  return room;
}

bool foretold(const MapRun& run, const Stiffness& nominal) {
  const auto room = room_of(run.scheme, stiffer(nominal, run.factor), run.dt);
  return room && run.damping >= room->least && run.damping <= room->most;
}

std::optional<double> ratio_of(const MapRun& run, const MapRun& reference) {
  for (auto mine = run.seen.rbegin(); mine != run.seen.rend(); ++mine)
    for (const MapRun::Seen& other : reference.seen)  // times may differ by a step
      if (std::fabs(other.until - mine->until) <= 0.01 * mine->until && other.value != 0) return mine->value / other.value;
  return std::nullopt;
}

const char* word(MapRun::Verdict verdict) {
  switch (verdict) {
    case MapRun::Verdict::waiting:
      return "not run";
    case MapRun::Verdict::converged:
      return "bounded";
    case MapRun::Verdict::bounded:
      return "bounded so far";
    case MapRun::Verdict::diverged:
      return "diverged, caught";
    case MapRun::Verdict::ledger:
      return "wrong energy, caught";
    case MapRun::Verdict::failed:
      return "failed";
  }
  return "";
}

}  // namespace erbs::study
