#include "engine/record/folder/run_writer.h"

#include <signal.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "engine/record/folder/run_folder.h"
#include "tests/support/text_of.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;
namespace fs = std::filesystem;

namespace {

struct Case {
  test::TwoBricks t = test::two_bricks();
  Case() {
    Recorder r;
    r.name = "top", r.quantity = "displacement", r.blocks = {"top"};
    t.scene.recorders = {r};
  }
};

// Writes row i; an event every third row, a frame every tenth.
void step(RunWriter& writer, test::TwoBricks& t, int i) {
  t.state.pose.u[1] = Vec3(0.1 * i, 0, 0);
  t.state.energy.friction = i;
  Snapshot s{.model = t.model, .pose = t.state.pose, .joints = t.state.joints, .energy = t.state.energy};
  s.t = 0.01 * i;
  s.motion = [](std::size_t) { return MovingBlock{}; };
  writer.row(s);
  if (i % 10 == 0) writer.frame(s);
  if (i % 3 == 0) writer.event(s.t, "crack", "base | top", 0.1 * i, "mm");
}

void write(const std::string& dir, Case& c, int first, int last, const WriterProgress* from = nullptr) {
  RunWriter writer(dir, c.t.scene, c.t.model, from);
  for (int i = first; i < last; ++i) step(writer, c.t, i);
  writer.close();
}

}  // namespace

TEST_CASE("rows, frames and events of a run can be read back", "[record][run_writer]") {
  const test::Scratch scratch("writer");
  fs::create_directories(scratch.path);
  Case c;
  write(scratch.path, c, 0, 15);
  const CsvTable histories = read_csv(scratch.path + "/histories.csv");
  CHECK(histories.rows() == 15);
  CHECK(histories.column("top_ux_rel_m")[3] == 0.1 * 3);
  const CsvTable energy = read_csv(scratch.path + "/energy.csv");
  CHECK(energy.column("friction_J")[4] == 4);
  CHECK(energy.names.back() == "residual_relative");
  const CsvTable events = read_csv(scratch.path + "/events.csv");
  CHECK(events.names == std::vector<std::string>{"time_s", "event", "name", "value", "unit"});
  CHECK(events.text[2][1] == "base | top");
  const MotionReader motion(scratch.path);
  REQUIRE(motion.times().size() == 2);
  CHECK(motion.read(1).poses[7] == 1.0f);
  CHECK(motion.scene().shapes.size() == 1);  // shared by three equal bricks
  REQUIRE(motion.scene().joints.size() == 1);
  CHECK(motion.scene().joints[0].polygon[2].isApprox(Vec3(0.1, 0.05, 0.05)));
  CHECK(motion.scene().joints[0].thickness == 0.005);
}

TEST_CASE("a run that is killed leaves whole rows, and goes on from its checkpoint as if never stopped", "[record][run_writer]") {
  const test::Scratch whole("whole"), killed("killed");
  fs::create_directories(whole.path);
  fs::create_directories(killed.path);
  Case c;
  write(whole.path, c, 0, 3000);

  int pipe_ends[2];
  REQUIRE(pipe(pipe_ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    RunWriter writer(killed.path, c.t.scene, c.t.model);
    for (int i = 0; i < 40; ++i) step(writer, c.t, i);
    const WriterProgress at = writer.progress();
    if (write(pipe_ends[1], &at, sizeof at) < 0) _exit(1);
    for (int i = 40; i < 1500; ++i) step(writer, c.t, 7 * i);  // discarded: after the checkpoint
    raise(SIGKILL);
  }
  WriterProgress at;
  REQUIRE(read(pipe_ends[0], &at, sizeof at) == ssize_t(sizeof at));
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  close(pipe_ends[0]);
  close(pipe_ends[1]);

  CHECK(at.history_rows == 40);
  CHECK(at.event_rows == 14);
  CHECK(at.frames == 4);
  for (const char* name : {"/histories.csv", "/energy.csv", "/events.csv"}) {
    const std::string text = test::text_of(killed.path + name);
    CHECK(text.back() == '\n');
    CHECK_NOTHROW(read_csv(killed.path + name));
  }
  CHECK(read_csv(killed.path + "/histories.csv").rows() >= 40);
  std::ofstream(killed.path + "/histories.csv", std::ios::app) << "15.0,0.";  // a torn row, as left by a power failure
  write(killed.path, c, 40, 3000, &at);
  for (const char* name : {"/histories.csv", "/energy.csv", "/events.csv"})
    CHECK(test::text_of(killed.path + name) == test::text_of(whole.path + name));
  const MotionReader motion(killed.path);
  REQUIRE(motion.times().size() == 300);
  CHECK(motion.read(299).poses == MotionReader(whole.path).read(299).poses);
}
