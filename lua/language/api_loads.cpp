// Functions of a script: ground motions, forces, moments, tilt, prescribed motions and gravity.
#include <array>
#include <lua5.4/lua.hpp>

#include "engine/loads/record/components.h"
#include "lua/language/api.h"

namespace erbs::lua {
namespace {

// The wave of a load: a wave value, a number, or a Lua function. A function is sampled later, when the duration is known.
void read_wave(Call& call, Arguments& arguments, Load& load) {
  double sample = 1e-3;
  arguments.read("sample", sample);
  if (arguments.is_function("wave")) {
    call.context.samplings.push_back({call.context.scene.loads.size(), arguments.function("wave"), sample, call.place});
  } else {
    if (arguments.has("sample")) arguments.mistake("\"sample\" is for a wave that is a Lua function; remove it");
    if (auto wave = arguments.wave("wave")) load.wave = std::move(*wave);
  }
}

// A place or an angle given by points stays what it was last: without it a block or gravity would leap back within one step.
void keep_last_value(Wave& wave) {
  if (auto* table = std::get_if<Table>(&wave)) table->hold |= !table->says_hold;
  if (auto* curve = std::get_if<Curve>(&wave); curve && !curve->says_hold && !curve->hold)
    *curve = make_curve(curve->line.times, curve->line.values, true);
}

int add_load(Call& call, Load::Kind kind, const char* direction) {
  Arguments arguments = call.arguments();
  const Frame& frame = call.context.frame();
  Load load;
  load.kind = kind;
  load.place = call.place;
  arguments.read("name", load.name);
  read_wave(call, arguments, load);
  if (kind == Load::Kind::tilt || kind == Load::Kind::motion || kind == Load::Kind::turning) keep_last_value(load.wave);
  arguments.direction(direction, load.direction);
  load.direction = frame.vector(load.direction);
  if (kind == Load::Kind::force || kind == Load::Kind::moment || kind == Load::Kind::motion || kind == Load::Kind::turning)
    arguments.read("block", load.block);
  if (kind == Load::Kind::force || kind == Load::Kind::turning) {
    const char* point = kind == Load::Kind::force ? "point" : "about";
    load.has_point = arguments.has(point);
    arguments.read(point, load.point);
    load.point = frame.point(load.point);
  }
  call.context.scene.loads.push_back(std::move(load));
  return 0;
}

int ground_motion(Call& call) { return add_load(call, Load::Kind::ground, "direction"); }
int force(Call& call) { return add_load(call, Load::Kind::force, "direction"); }
int moment(Call& call) { return add_load(call, Load::Kind::moment, "direction"); }
int tilt(Call& call) { return add_load(call, Load::Kind::tilt, "axis"); }
int motion(Call& call) { return add_load(call, Load::Kind::motion, "direction"); }

int turning(Call& call) { return add_load(call, Load::Kind::turning, "axis"); }

struct MotionKeys {  // of ground_records{}
  std::string x, y, z, of = "strongest";

  static Fields<MotionKeys> fields() {
    return {
        {"x", &MotionKeys::x, "", "file of the component along x"},
        {"y", &MotionKeys::y, "", "file of the component along y"},
        {"z", &MotionKeys::z, "", "file of the component along z, upwards"},
        {"of", &MotionKeys::of, "", "component whose peak becomes `peak`; all components have one scale", 0, 0, false, "strongest|x|y|z"},
    };
  }
};

Keys ground_records_keys() {
  Keys of_record = keys_of<Record>();
  std::erase_if(of_record, [](const Key& key) { return key.name == "file"; });
  return joined({keys_of<MotionKeys>(), of_record});
}

int ground_records(Call& call) {
  Arguments arguments = call.arguments();
  MotionKeys files;
  Record common;
  arguments.read(files);
  for (const auto& field : Record::fields())
    if (field.name != "file") field.member.visit([&](auto member) { arguments.read(std::string(field.name), common.*member); });
  check_scale(arguments, common);
  std::array<Record, 3> wanted{common, common, common};
  const std::string* names[] = {&files.x, &files.y, &files.z};
  Components motion;
  try {
    for (std::size_t i = 0; i < 3; ++i)
      if (!names[i]->empty()) wanted[i].file = find_input(call.context, *names[i], call.place).string();
    motion = read_components(wanted, files.of, call.place);
  } catch (const Error& error) {  // of the script line, or of a file with its own place
    if (error.place.file == call.place.file) call.context.mistake({}, error.what());
    else call.mistake(error.what());
    return 0;
  }
  Context& context = call.context;
  for (int i = 0; i < 3; ++i) {
    Record& one = motion.of[std::size_t(i)];
    if (one.file.empty()) continue;
    context.scene.inputs[one.file] = one.hash;
    note_record(context, one, call.place);
    context.took(4 * sizeof(double) * one.acceleration.times.size());
    Load load;
    load.kind = Load::Kind::ground;
    load.place = call.place;
    load.direction = context.frame().vector(Vec3::Unit(i));
    load.wave = std::move(one);
    context.scene.loads.push_back(std::move(load));
  }
  context.scene.notes.push_back(call.place.text() + ": " + motion.note);
  return 0;
}

int gravity(Call& call) {
  Scene& scene = call.context.scene;
  Place& before = call.context.gravity;
  if (before.line > 0) call.mistake(fmt::format("it was given before, at {}; keep one", before.text()));
  before = call.place;
  if (lua_type(call.lua, 1) == LUA_TNUMBER) {
    const double g = lua_tonumber(call.lua, 1);
    if (g >= 0 && g <= 1000) scene.gravity = call.context.frame().vector({0, 0, -g});
    else call.mistake(fmt::format("{} m/s2 is out of range; allowed is 0 to 1000 m/s2 (downwards)", written(g)));
    return 0;
  }
  if (!lua_istable(call.lua, 1))
    throw Error(
        fmt::format("gravity takes a number or a vector, not {}; write gravity(9.81) or gravity{{ 0, 0, -9.81 }}", described(call.lua, 1)),
        call.place);
  Arguments arguments = call.arguments();
  Vec3 vector = Vec3::Zero();
  arguments.read("1", vector.x());
  arguments.read("2", vector.y());
  arguments.read("3", vector.z());
  scene.gravity = call.context.frame().vector(vector);
  return 0;
}

Keys load_keys(const std::string& unit, const std::string& direction, const std::string& meaning, bool block) {
  Keys keys = {{"wave", "wave", unit, "a wave, a number, or a function of time", -unbounded, unbounded, true},
               {direction, "direction", "", meaning, -1e9, 1e9, false, "", "\"x\""},
               {"sample", "number", "s", "sampling step of a Lua function", 1e-6, 10, false, "", "0.001"},
               {"name", "string", "", "name, for reports"}};
  if (block) keys.insert(keys.begin(), {"block", "string", "", "name of the block", -unbounded, unbounded, true});
  return keys;
}

}  // namespace

std::vector<Function> load_functions() {
  Keys force_keys = load_keys("N", "direction", "\"x\", \"y\", \"z\" or a vector", true);
  force_keys.push_back({"point", "vec3", "m", "point of application on the block at rest (default the centroid)", -1e6, 1e6});
  Keys turning_keys = load_keys("rad", "axis", "\"x\", \"y\", \"z\" or a vector", true);
  turning_keys.push_back({"about", "vec3", "m", "centre of the rotation, at rest (default the centroid)", -1e6, 1e6});
  return {
      {"ground_motion", ground_motion, "{ ... }", "",
       "Shakes the ground by an acceleration; several ground motions add up. A positive acceleration moves the ground along its direction "
       "and pushes the structure the other way.",
       load_keys("m/s2", "direction", "\"x\", \"y\", \"z\" or a vector", false)},
      {"ground_records", ground_records, "{ ... }", "",
       "Shakes the ground by up to three components of one recorded motion, along x, y and z: one time axis and one scale. The other keys "
       "are "
       "those of record{}.",
       ground_records_keys()},
      {"force", force, "{ ... }", "", "A force on a block.", force_keys},
      {"moment", moment, "{ ... }", "", "A moment on a block.",
       load_keys("N m", "direction", "axis of the moment: \"x\", \"y\", \"z\" or a vector", true)},
      {"tilt", tilt, "{ ... }", "",
       "Rotates gravity by an angle about an axis, like a tilting table. The rotation is right-handed: a positive angle about x pulls "
       "towards +y, about y towards -x.",
       load_keys("rad", "axis", "\"x\", \"y\", \"z\" or a vector", false)},
      {"motion", motion, "{ ... }", "",
       "Prescribes the displacement of a block along a direction; its other degrees of freedom are fixed. A function is followed smoothly; "
       "the corners of a table_wave are jolts; a curve_wave has none, and starts and ends at rest. Both keep their last value.",
       load_keys("m", "direction", "\"x\", \"y\", \"z\" or a vector", true)},
      {"turning", turning, "{ ... }", "",
       "Prescribes the rotation of a block about an axis. Its position is fixed, unless motion{} prescribes it.", turning_keys},
      {"gravity",
       gravity,
       "{ ... }",
       "",
       "Gravity as gravity(9.81), downwards, or gravity{ 0, 0, -9.81 }.",
       {{"1", "number", "m/s2", "along x (or the one number: downwards)", -1000, 1000, true},
        {"2", "number", "m/s2", "along y", -1000, 1000, true},
        {"3", "number", "m/s2", "along z", -1000, 1000, true}}},
  };
}

}  // namespace erbs::lua
