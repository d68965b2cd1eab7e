// The editor file and the help describe what the program reads.
#include <catch2/catch.hpp>
#include <fstream>

#include "engine/scene/scene.h"
#include "lua/commands/help.h"
#include "tests/support/places.h"
#include "tests/support/text_of.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

std::string editor_file_of_the_tree() { return test::text_of(test::in_source("/lua/erbs.meta.lua")); }

}  // namespace

// To update: erbs help --editor > lua/erbs.meta.lua
TEST_CASE("erbs.meta.lua is what the table of the program says", "[lua]") { CHECK(editor_file_of_the_tree() == editor_file()); }

TEST_CASE("every function and every key is in erbs.meta.lua, numbers with their unit", "[lua]") {
  const std::string text = editor_file_of_the_tree();
  for (const Function& function : all_functions()) {
    INFO(function.name);
    CHECK(contains(text, "\nfunction " + function.name + "("));
    CHECK_FALSE(function.text.empty());
    for (const Key& key : function.keys) {
      INFO(key.name);
      CHECK_FALSE(key.text.empty());
      CHECK(
          (contains(text, "---@field " + key.name) || contains(text, "---@field [" + key.name) || contains(text, "---@param " + key.name)));
      if (!key.unit.empty()) CHECK(contains(text, "[" + key.unit));
    }
  }
}

TEST_CASE("every field of every list is a key of its function", "[lua]") {
  const auto has = [](const char* name, std::string_view key) {
    const Function* function = find_function(name);
    REQUIRE(function);
    return std::any_of(function->keys.begin(), function->keys.end(), [&](const Key& k) { return k.name == key; });
  };
  for (const auto& field : Material::fields()) CHECK(has("material", field.name));
  for (const auto& field : Analysis::fields()) CHECK(has("analysis", field.name));
  for (const auto& field : Damping::fields()) CHECK(has("damping", field.name));
  for (const auto& field : Recorder::fields()) CHECK(has("recorder", field.name));
  for (const auto& field : JointRule::fields()) CHECK(has("joint", field.name));
  for (const auto& field : Mortar::fields()) CHECK(has("mortar", field.name));
  for (const auto& field : Record::fields()) CHECK(has("record", field.name));
}

TEST_CASE("help shows keys with unit, range and default, and suggests", "[lua]") {
  const std::string text = function_help("material");
  CHECK(contains(text, "density"));
  CHECK(contains(text, "kg/m3; 0.01 to 100000; required"));
  CHECK(contains(text, "default 0.6"));
  try {
    function_help("materail");
    FAIL("no error");
  } catch (const Error& error) { CHECK(contains(error.what(), "did you mean \"material\"?")); }
}
