// Functions of a script: pictures and values that are kept beside the scene, in the folder `expected`, and compared with those of a run.
#include <cmath>
#include <lua5.4/lua.hpp>

#include "lua/language/api.h"

namespace erbs::lua {

const Keys& stored_keys() {
  static const Keys keys = {{"rel", "number", "", "largest relative change", 0, 1e9},
                            {"abs", "number", "", "largest absolute change", 0, unbounded},
                            {"source", "string", "", "what sets the tolerance"}};
  return keys;
}
namespace {

int expect_stored(Call& call) {
  Expectation item;
  item.key = call.text(1, "key");
  item.place = call.place;
  item.stored = true;
  if (!lua_istable(call.lua, 2)) {
    call.mistake(fmt::format("of \"{}\": add how near the value must remain, such as {{ rel = 0.01 }}", item.key));
    return 0;
  }
  Arguments arguments(call.context, call.lua, 2, "expect_stored", call.place, stored_keys());
  const bool rel = arguments.has("rel");
  if (rel == arguments.has("abs")) arguments.mistake(fmt::format("of \"{}\": give one of rel, abs", item.key));
  item.kind = rel ? Expectation::Kind::rel : Expectation::Kind::abs;
  arguments.read(rel ? "rel" : "abs", item.tolerance);
  arguments.read("source", item.source);
  call.context.scene.expectations.push_back(std::move(item));
  return 0;
}

int expect_image(Call& call) {
  PictureExpectation item;
  item.camera = call.text(1, "camera");
  item.place = call.place;
  if (lua_type(call.lua, 2) != LUA_TNUMBER)
    call.mistake(fmt::format("t must be a time in s, not {}; write expect_image(\"{}\", 1.2)", described(call.lua, 2), item.camera));
  else item.t = lua_tonumber(call.lua, 2);
  if (!(item.t >= 0 && item.t <= 1e6)) call.mistake(fmt::format("t = {} is out of range; a time of the run, in s, is allowed", item.t));
  if (lua_istable(call.lua, 3)) {
    static const Keys keys = keys_of<PictureExpectation>();
    Arguments arguments(call.context, call.lua, 3, "expect_image", call.place, keys);
    arguments.read(item);
  } else if (!lua_isnoneornil(call.lua, 3)) {
    call.mistake(fmt::format("the tolerance must be a table, not {}; write {{ pixels = 0.01, ssim = 0.98 }}", described(call.lua, 3)));
  }
  for (const PictureExpectation& other : call.context.scene.pictures)
    if (other.camera == item.camera && std::abs(other.t - item.t) < 1e-3)
      call.mistake(fmt::format("\"{}\" at {} s was given before, at {}; leave one out", item.camera, item.t, other.place.text()));
  call.context.scene.pictures.push_back(std::move(item));
  return 0;
}

}  // namespace

std::vector<Function> stored_functions() {
  return {
      {"expect_stored",
       expect_stored,
       "key, how",
       "",
       "States that a key of metrics.json keeps the value that is stored beside the scene; erbs test --bless stores it anew.",
       {{"key", "string", "", "dotted key of a number: \"metrics.x\", \"collapse.time_s\"", -unbounded, unbounded, true},
        {"how", "stored", "", "{ rel = | abs =, source = \"...\" }", -unbounded, unbounded, true}}},
      {"expect_image",
       expect_image,
       "camera, t, how",
       "",
       "States that the picture at the time t looks like the one stored beside the scene; erbs test --bless stores it anew.",
       {{"camera", "string", "", "a camera of the scene, or from_-x, from_+x, from_-y, from_+y, from_above", -unbounded, unbounded, true},
        {"t", "number", "s", "time of the picture", 0, 1e6, true},
        {"how", "picture", "", "{ pixels = 0.01, ssim = 0.98, width = 480, height = 270, source = \"...\" }"}}},
  };
}

}  // namespace erbs::lua
