// Functions of a script: damping, analysis, recorders and cameras.
#include <cmath>
#include <lua5.4/lua.hpp>

#include "lua/language/api.h"

namespace erbs::lua {
namespace {

int damping(Call& call) {
  Arguments arguments = call.arguments();
  Damping& into = call.context.scene.damping;
  if (into.place.line > 0) arguments.mistake(fmt::format("it was given before, at {}; put all keys into one", into.place.text()));
  into.place = call.place;
  arguments.read(into);
  return 0;
}

Keys monitor_keys() { return keys_of<Monitor>(); }

// Keys of analysis{} besides the fields of `PushSettings`.
Keys push_keys() {
  return {{"direction", "direction", "",
           "tilt: side that goes down; pushover: direction of the acceleration on the masses (default \"x\"; with a pattern that of its "
           "resultant)",
           -1e9, 1e9},
          {"path", "numbers", "", "tilt, pushover: multipliers (tilt: rad) to visit in turn before the push to the end"},
          {"pattern", "list", "", "pushover: forces at the multiplier 1 (default: g times the mass of each block, along direction)",
           -unbounded, unbounded, false, "", "", keys_of<PatternForce>()},
          {"monitor", "table", "", "point whose displacement along direction is the abscissa of the curve", -unbounded, unbounded, false,
           "", "", monitor_keys()}};
}

void read_push(Call& call, Arguments& arguments) {
  static const Keys pattern = keys_of<PatternForce>(), monitor = monitor_keys();
  const Frame& frame = call.context.frame();
  PushSettings& push = call.context.scene.push;
  const bool first = push.place.line == 0;
  push.place = call.place;
  arguments.read(push);
  static const Keys own = joined({keys_of<PushSettings>(), push_keys()});
  for (const Key& key : own)
    if (!push.quasi_static() && key.name != "kind" && arguments.has(key.name))
      arguments.mistake(fmt::format("\"{}\" belongs to a push; add kind = \"tilt\" or \"pushover\", or remove it", key.name));
  arguments.direction("direction", push.direction);
  if (first || arguments.has("direction")) push.direction = frame.vector(push.direction);
  call.context.own_direction = call.context.own_direction || arguments.has("direction");
  arguments.read("path", push.path);
  if (arguments.has("pattern")) push.pattern.clear();
  for (Arguments& one : arguments.tables("pattern", pattern)) {
    PatternForce& force = push.pattern.emplace_back();
    one.read(force);
    force.force = frame.vector(force.force);
  }
  Vec3 resultant = Vec3::Zero();
  double all = 0;
  for (const PatternForce& force : push.pattern) resultant += force.force, all += force.force.norm();
  // The curve is that of the displacement along the push. Forces that cancel may push to any side.
  if (!call.context.own_direction && std::isfinite(all) && resultant.norm() > 1e-6 * all) push.direction = resultant.normalized();
  if (auto one = arguments.table("monitor", monitor)) {
    one->read(push.monitor);
    push.monitor.has_point = one->has("point");
    push.monitor.point = frame.point(push.monitor.point);
  }
}

int analysis(Call& call) {
  static const Keys step_keys = {{"1", "number", "s", "time step", 0, 1, true},
                                 {"unstable", "boolean", "", "allow a step beyond the limit"}};
  Arguments arguments = call.arguments();
  Analysis& into = call.context.scene.analysis;
  into.place = call.place;
  for (const auto& field : Analysis::fields())
    if (field.name != "dt") field.member.visit([&](auto member) { arguments.read(std::string(field.name), into.*member); });
  read_push(call, arguments);
  std::string quality;
  arguments.read("quality", quality);
  if (!quality.empty() && !call.context.quality_set) call.context.quality = quality;
  if (arguments.has("dt") || arguments.has("dt_fraction")) call.context.own_step = true;
  if (!arguments.is_table("dt")) {
    arguments.read("dt", into.dt);
  } else if (auto step = arguments.table("dt", step_keys)) {
    step->read("1", into.dt);
    step->read("unstable", into.unstable);
  }
  return 0;
}

// Keys of spectrum{} besides the fields.
const Keys& row_keys() {
  static const Keys keys{{"T", "number", "s", "period", 0, 100, true}, {"Sa", "number", "m/s2", "elastic acceleration", 0, 1e3, true}};
  return keys;
}

int spectrum(Call& call) {
  Arguments arguments = call.arguments();
  PerformanceDemand& demand = call.context.scene.performance;
  if (demand.place.line > 0) {
    arguments.mistake(
        fmt::format("there is one at {} already; keep one, and evaluate others after the run with erbs capacity", demand.place.text()));
    return 0;
  }
  demand.place = call.place;
  arguments.read(demand);
  arguments.read("blocks", demand.blocks);
  DesignSpectrum& asked = demand.spectrum;
  arguments.read(asked);
  if (arguments.has("table")) {
    for (Arguments& row : arguments.tables("table", row_keys())) {
      row.read("T", asked.period.emplace_back());
      row.read("Sa", asked.acceleration.emplace_back());
    }
    if (!arguments.has("kind")) asked.kind = "table";
  }
  if (!arguments.has("kind") && asked.kind.empty())
    for (const std::string& mistake : check_spectrum(asked)) arguments.mistake(mistake);
  return 0;
}

int recorder(Call& call) {
  const size_t told_before = call.context.told();
  Arguments arguments = call.arguments();
  Scene& scene = call.context.scene;
  Recorder item;
  item.place = call.place;
  arguments.read(item);
  item.has_point = arguments.has("point");
  item.point = call.context.frame().point(item.point);
  std::vector<std::string> one, several;
  arguments.read("block", one);
  arguments.read("blocks", several);
  item.blocks = one;
  item.blocks.insert(item.blocks.end(), several.begin(), several.end());
  arguments.read("others", item.others);
  // Without a word about blocks some quantities are of the whole model: a list that came out empty must not mean that.
  const auto names_none = [&](const char* key, bool none) {
    if (arguments.has(key) && none && call.context.told() == told_before)
      arguments.mistake(fmt::format("{} names no block; name one, or leave it out", key));
  };
  names_none("block", one.empty());
  names_none("blocks", several.empty());
  names_none("others", item.others.empty());
  for (const char* key : {"group", "other_group"}) {
    std::string group;
    arguments.read(key, group);
    names_none(key, group.empty());
    if (!group.empty()) call.context.group_recorders.push_back({scene.recorders.size(), group, key[0] == 'o'});
  }
  scene.recorders.push_back(std::move(item));
  return 0;
}

int camera(Call& call) {
  Arguments arguments = call.arguments();
  const Frame& frame = call.context.frame();
  Camera item;
  item.place = call.place;
  arguments.read(item);
  if ((item.eye - item.target).norm() < 1e-9) arguments.mistake("eye and target are the same point; move one of them");
  if (item.up.isZero(0)) arguments.mistake("up is zero; give the direction that points up in the picture, such as {0, 0, 1}");
  item.eye = frame.point(item.eye);
  item.target = frame.point(item.target);
  item.up = frame.vector(item.up);
  call.context.scene.cameras.push_back(std::move(item));
  return 0;
}

}  // namespace

// Keys of recorder{}. The type "quantity" makes help and editors list all quantities.
Keys recorder_keys() {
  Keys keys = keys_of<Recorder>();
  for (Key& key : keys)
    if (key.name == "quantity") key.type = "quantity";
  return keys;
}

std::vector<Function> analysis_functions() {
  return {
      {"damping", damping, "{ ... }", "", "Damping of blocks and of joints.", keys_of<Damping>()},
      {"analysis", analysis, "{ ... }", "", "Kind, duration, time step and end of the run. A later call changes the keys that it gives.",
       joined(
           {keys_of<Analysis>(),
            keys_of<PushSettings>(),
            push_keys(),
            {{"quality", "string", "",
              "a measured pair of step (over its limit) and contact points, for values that the scene leaves open: 0.9 and 2 x 2, 0.9 and "
              "3 x 3, 0.25 and 5 x 5",
              -unbounded, unbounded, false, "draft|standard|reference"}}})},
      {"spectrum", spectrum, "{ ... }", "",
       "Elastic spectrum whose performance point on the curve of the pushover is computed: capacity.performance, performance.svg.",
       joined({keys_of<DesignSpectrum>(),
               {{"table", "list", "", "rows { T = ..., Sa = ... } of another spectrum, from T = 0 on", -unbounded, unbounded, false, "", "",
                 row_keys()}},
               keys_of<PerformanceDemand>(),
               {{"blocks", "strings", "", "names of the blocks that give the displaced shape, instead of a group"}}})},
      {"recorder", recorder, "{ ... }", "",
       "Writes a quantity of a block to histories.csv; for several blocks their mean, for forces their sum.",
       joined({recorder_keys(),
               {{"block", "strings", "", "name of the block"},
                {"blocks", "strings", "", "names of several blocks"},
                {"group", "string", "", "all blocks of a group"},
                {"others", "strings", "", "for joint quantities: names of the blocks on the other side (default: any)"},
                {"other_group", "string", "", "for joint quantities: all blocks of a group on the other side"}}})},
      {"camera", camera, "{ ... }", "", "A view for the pictures.", keys_of<Camera>()},
  };
}

}  // namespace erbs::lua
