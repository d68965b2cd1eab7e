#include "engine/analysis/start/load_warnings.h"

#include <algorithm>
#include <cmath>

#include "engine/model/box_at_rest.h"

namespace erbs::analysis {
namespace {

constexpr double brief = 1e-6;  // s
constexpr double swing = 1e-5;  // m or rad, of a curve between points at 0
// Of a support, m/s. Mortar of 1800 kg/m3 in which waves travel at 1000 m/s feels 18 kPa, a fifth of a usual tensile strength.
constexpr double sudden_speed = 0.01;

// s: the start of a wave, of one through points the last of these before it acts. A smooth curve swings between points of the same value.
double begin_of(const Wave& wave) {
  return std::visit(
      [](const auto& w) {
        if constexpr (requires { w.start; }) return w.start;
        else {
          const Polyline& line = w.line;
          const auto first = std::find_if(line.values.begin(), line.values.end(), [](double value) { return value != 0; });
          const auto i = std::size_t(first - line.values.begin());
          if (i == line.times.size()) return line.times.front();
          for (std::size_t k = 0; k + 1 < i; ++k)
            if (std::fabs(value(w, 0.5 * (line.times[k] + line.times[k + 1]))) > swing) return line.times[k];
          return line.times[i > 0 ? i - 1 : 0];
        }
      },
      wave);
}

bool acts_between(const Wave& wave, double from, double to) {
  if (mean(wave, from, to) != 0) return true;  // a pulse may lie between two samples
  constexpr double every = 1e-3;               // s
  const int samples = int(std::min((to - from) / every, 1e6)) + 100;
  for (int i = 0; i <= samples; ++i)
    if (value(wave, from + (to - from) * i / samples) != 0) return true;
  return false;
}

std::string name_of(const Load& load) {
  using Kind = Load::Kind;
  const char* name = load.kind == Kind::tilt     ? "tilt"
                     : load.kind == Kind::force  ? "force"
                     : load.kind == Kind::moment ? "moment"
                     : load.kind == Kind::motion ? "motion"
                                                 : "turning";
  return load.block.empty() ? name : fmt::format("{} of block \"{}\"", name, load.block);
}

// A run that a record has ended before, or that begins after it, tells nothing about the structure.
std::string idle(const Load& load, double duration) {
  if (load.kind == Load::Kind::ground)
    return acts_between(load.wave, 0, duration)
               ? ""
               : fmt::format(
                     "this ground_motion is zero from 0 to {:g} s: does its record end before the run begins, or is a peak or "
                     "amplitude 0?",
                     duration);
  const double begin = begin_of(load.wave);
  const bool within = begin < duration || value(load.wave, 0) != 0;  // a held value acts before its wave begins
  if (within || !acts_between(load.wave, begin, begin + std::min(1e3 * resolution(load.wave), 1e3))) return "";
  return fmt::format("{}: it begins at {:g} s, and the run ends at {:g} s, so that it does nothing; begin it earlier, or run longer",
                     name_of(load), begin, duration);
}

// A record whose file leaves out a stretch. A straight line spans it, whose area moves the ground.
std::string hole_in(const Load& load) {
  const Record* record = std::get_if<Record>(&load.wave);
  if (record == nullptr) return "";
  constexpr double long_step = 10;  // times the usual one
  const std::vector<double>& t = record->acceleration.times;
  std::vector<double> steps;
  for (std::size_t i = 2; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);  // the ground may have been at rest before the first value
  if (steps.size() < 3) return "";
  const auto longest = std::ranges::max_element(steps);
  const std::size_t at = std::size_t(longest - steps.begin()) + 2;
  const double most = *longest;
  std::ranges::nth_element(steps, steps.begin() + std::ptrdiff_t(steps.size() / 2));
  if (!(most > long_step * steps[steps.size() / 2])) return "";
  return fmt::format(
      "{}: its record has no value between {:.6g} and {:.6g} s, {:.0f} of its usual steps, which a straight line spans; are lines "
      "of {} missing?",
      name_of(load), record->start + t[at - 1], record->start + t[at], most / steps[steps.size() / 2], record->file);
}

// A load that acts, but on nothing: a rotation of gravity about its own line, or a force far from its block.
std::string astray(const Load& load, const Scene& scene, const Model& model) {
  if (load.kind == Load::Kind::tilt && load.direction.cross(scene.gravity).norm() < 1e-9 * load.direction.norm() * scene.gravity.norm())
    return "tilt: its axis is the line of gravity, so that nothing tilts; give a level axis, such as \"x\"";
  if (load.kind != Load::Kind::force || !load.has_point) return "";
  const auto b = std::size_t(std::ranges::find(model.block_name, load.block) - model.block_name.begin());
  const Eigen::AlignedBox3d box = box_at_rest(model, b);
  const double beyond = box.exteriorDistance(load.point);
  if (!(beyond > 1e-3 * box.sizes().maxCoeff())) return "";
  return fmt::format("{}: its point is {:.3g} m outside of the block, which it moves with as if by an arm; is it meant so?", name_of(load),
                     beyond);
}

// Corners of a line of displacements after `begin`, at which its speed jumps by more than `sudden_speed`.
struct Corners {
  int count = 0;
  double time = 0, jump = 0;  // of the hardest: s, and m/s or rad/s
};
Corners corners_of(const Wave& wave, double begin, double duration) {
  Corners found;
  const Table* table = std::get_if<Table>(&wave);
  const auto slope = [&](std::size_t i) {  // of the segment before point i; beyond the ends a held value
    const Polyline& line = table->line;
    return i == 0 || i == line.times.size() ? 0 : (line.values[i] - line.values[i - 1]) / (line.times[i] - line.times[i - 1]);
  };
  for (std::size_t i = 0; table && table->hold && i < table->line.times.size(); ++i) {
    const double time = table->line.times[i], jump = std::fabs(slope(i + 1) - slope(i));
    if (!(time > begin && time < duration && jump > sudden_speed)) continue;
    ++found.count;
    if (jump > found.jump) found.time = time, found.jump = jump;
  }
  return found;
}

// A displacement or a speed that is there at once, where the wave begins or the run does. `bears`: the block bears others, so that a speed
// is a blow to them.
std::string blow(const Load& load, double duration, bool bears) {
  const bool rotates = load.kind == Load::Kind::turning;
  const double begin = value(load.wave, 0) != 0 ? 0 : std::max(0.0, begin_of(load.wave));
  if (!(begin < duration)) return "";
  const auto x = [&](double t) { return t < 0 ? 0 : value(load.wave, t); };  // blocks start where the scene has them
  const double jump = x(begin) - x(begin - brief), speed = (x(begin + 2 * brief) - x(begin + brief)) / brief,
               before = (x(begin - brief) - x(begin - 2 * brief)) / brief;
  const char *remedy = "begin it smoothly, as a curve_wave from 0 does", *unit = rotates ? "rad/s" : "m/s", *place = rotates ? "rad" : "m";
  std::vector<std::string> told;
  if (std::fabs(jump) > 1e-6)  // m or rad
    told.push_back(fmt::format("it jumps to {:.4g} {} at {:g} s, within one step; {}", jump, place, begin, remedy));
  else if (bears && std::fabs(speed - before) > sudden_speed)
    told.push_back(
        fmt::format("it starts at once with {:.3g} {} at {:g} s, a blow to what the block bears; {}", speed - before, unit, begin, remedy));
  if (const Corners corners = corners_of(load.wave, begin, duration); bears && corners.count > 0) {
    const std::string where = corners.count == 1 ? "" : fmt::format(" (the hardest of {} such points)", corners.count);
    told.push_back(fmt::format("its speed jumps by {:.3g} {} at {:g} s{}; a curve_wave through its points does not jolt", corners.jump,
                               unit, corners.time, where));
  }
  if (const double end = end_time(load.wave); end > begin && end < duration && std::fabs(x(end + brief) - x(end - brief)) > 1e-6)
    told.push_back(
        fmt::format("it leaps from {:.4g} {} to 0 at its end, {:g} s; a table_wave or curve_wave keeps its last value, unless "
                    "it says hold = false",
                    x(end - brief), place, end));
  return told.empty() ? "" : fmt::format("{}: {}", name_of(load), fmt::join(told, "; "));
}

// True if a joint or, at rest, the box around another block touches the block.
bool touches_others(const Model& model, std::size_t block) {
  const auto is_of = [&](const Joint& joint) { return std::size_t(joint.a) == block || std::size_t(joint.b) == block; };
  if (std::ranges::any_of(model.joint, is_of)) return true;
  const Eigen::AlignedBox3d own = box_at_rest(model, block);
  for (std::size_t b = 0; b < model.kind.size(); ++b)
    if (model.kind[b] == Kind::moving && own.exteriorDistance(box_at_rest(model, b)) < 1e-6 * own.sizes().norm()) return true;
  return false;
}

}  // namespace

std::vector<std::string> warnings_of_loads(const Scene& scene, const Model& model) {
  struct Doubt {
    const Load* load;
    std::string text;
    int others;  // loads of the same line, such as the supports of a row
  };
  std::vector<Doubt> doubts;
  for (const Load& load : scene.loads) {
    std::string text = idle(load, scene.analysis.duration);
    if (text.empty()) text = hole_in(load);
    if (text.empty()) text = astray(load, scene, model);
    if (text.empty() && (load.kind == Load::Kind::motion || load.kind == Load::Kind::turning)) {
      const auto block = std::find_if(scene.blocks.begin(), scene.blocks.end(), [&](const Block& b) { return b.name == load.block; });
      text = blow(load, scene.analysis.duration, touches_others(model, std::size_t(block - scene.blocks.begin())));
    }
    if (text.empty()) continue;
    const auto same = std::find_if(doubts.begin(), doubts.end(), [&](const Doubt& d) { return d.load->place.text() == load.place.text(); });
    if (same != doubts.end()) ++same->others;
    else doubts.push_back({&load, std::move(text), 0});
  }
  std::vector<std::string> warnings;
  for (const Doubt& d : doubts)
    warnings.push_back(
        fmt::format("{}: {}{}", d.load->place.text(), d.text, d.others > 0 ? fmt::format(" (and {} more of this line)", d.others) : ""));
  return warnings;
}

}  // namespace erbs::analysis
