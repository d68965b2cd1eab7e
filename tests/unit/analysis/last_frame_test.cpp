#include <catch2/catch.hpp>

#include "engine/analysis/dynamic.h"
#include "engine/record/export/export.h"
#include "engine/record/folder/motion_file.h"
#include "tests/unit/lua/load.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;
using namespace erbs::analysis;

TEST_CASE("the last frame of a run shows its end, at whatever time that is", "[analysis]") {
  for (const char* how : {"stop_after_collapse = 0.013", "stop_when_moved = 0.07", "frame_dt = 0.04"}) {
    INFO(how);
    const std::string text = std::string(
                                 "material{ name = 'brick', density = 1800 }\n"
                                 "box{ size = { .3, .2, .1 }, at = { 0, 0, 3 }, free = true }\n"
                                 "analysis{ duration = .19, output_dt = .005, frame_dt = 10 }\nanalysis{ ") +
                             how + " }";
    lua::Script script(lua::quiet());
    Scene scene = script.load_text(text, "scene.lua", {});
    const test::Scratch dir("last_frame");
    RunOptions options;
    options.directory = dir.path;
    const Metrics metrics = run_dynamic(std::move(scene), text, options).metrics;
    CHECK(metrics.status == "completed");
    const MotionReader reader(dir.path);
    REQUIRE(reader.times().size() > 1);
    CHECK(reader.times().back() == metrics.time_s);
    CHECK(reader.times()[reader.times().size() - 2] < metrics.time_s);
    CHECK(reader.read(int(reader.times().size()) - 1).poses[2] < 3);
    const ExportedRun thinned = read_exported_run(dir.path, 0, 1, 4);
    CHECK(thinned.frames.back().t == metrics.time_s);
    CHECK(thinned.frames.size() == 1 + (reader.times().size() + 2) / 4);
  }
}
