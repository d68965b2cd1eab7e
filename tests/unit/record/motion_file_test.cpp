#include "engine/record/folder/motion_file.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"
#include "engine/record/folder/identity.h"
#include "engine/record/format/h5.h"
#include "tests/support/folder.h"

using namespace erbs;

namespace {

using test::Folder;

MotionScene two_blocks() {
  MotionScene scene;
  const MotionShape tetrahedron{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const int part = share_shape(scene, tetrahedron);
  scene.blocks = {{"base", "ground", 0, true, {0, 0, -1}, {part}}, {"a long name of a stone", "wall", 1, false, {1, 2, 3}, {part, part}}};
  scene.joints = {{0, 1, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {0, 0, 1}, 0.005}};
  return scene;
}

MotionFrame frame_at(int i) {
  MotionFrame f{0.04 * i, std::vector<float>(14), {static_cast<std::uint8_t>(i)}, {0.001f * static_cast<float>(i)}};
  for (std::size_t k = 0; k < f.poses.size(); ++k) f.poses[k] = static_cast<float>(i) + 0.01f * static_cast<float>(k);
  return f;
}

void check_frames(const std::filesystem::path& dir, int frames) {
  const MotionReader reader(dir.string());
  REQUIRE(reader.times().size() == static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    const MotionFrame got = reader.read(i), want = frame_at(i);
    CHECK(got.t == want.t);
    CHECK(got.poses == want.poses);
    CHECK(got.damage == want.damage);
    CHECK(got.opening == want.opening);
  }
}

}  // namespace

TEST_CASE("a motion file gives back what was written", "[record][motion_file]") {
  const Folder dir;
  const MotionScene scene = two_blocks();
  CHECK(scene.shapes.size() == 1);
  MotionWriter writer(dir.path.string(), scene);
  for (int i = 0; i < 3; ++i) writer.write(frame_at(i));
  CHECK(writer.frames() == 3);
  writer.close();
  check_frames(dir.path, 3);

  const MotionReader reader(dir.path.string());
  const MotionScene& got = reader.scene();
  CHECK(got.shapes == scene.shapes);
  REQUIRE(got.blocks.size() == 2);
  CHECK(got.blocks[1].name == "a long name of a stone");
  CHECK(got.blocks[1].group == "wall");
  CHECK(got.blocks[1].material == 1);
  CHECK(got.blocks[0].fixed);
  CHECK_FALSE(got.blocks[1].fixed);
  CHECK(got.blocks[1].rest == scene.blocks[1].rest);
  CHECK(got.blocks[1].parts == scene.blocks[1].parts);
  REQUIRE(got.joints.size() == 1);
  CHECK(got.joints[0].b == 1);
  CHECK(got.joints[0].polygon == scene.joints[0].polygon);
  CHECK(got.joints[0].normal == scene.joints[0].normal);
  CHECK(got.joints[0].thickness == 0.005);
}

TEST_CASE("a motion file goes on from a chosen frame", "[record][motion_file]") {
  const Folder dir;
  MotionWriter first(dir.path.string(), two_blocks());
  for (int i = 0; i < 5; ++i) first.write(frame_at(i + 100));
  first.close();
  {
    MotionWriter anew(dir.path.string(), two_blocks());
    for (int i = 0; i < 2; ++i) anew.write(frame_at(i));
    for (int i = 0; i < 3; ++i) anew.write(frame_at(50));
  }
  MotionWriter again(dir.path.string(), 2);
  CHECK(again.frames() == 2);
  for (int i = 2; i < 6; ++i) again.write(frame_at(i));
  again.close();
  check_frames(dir.path, 6);
  CHECK_THROWS_AS(MotionWriter(dir.path.string(), 7), Error);

  std::ifstream in(dir.path / "motion.xdmf");
  std::stringstream text;
  text << in.rdbuf();
  CHECK(text.str().find("frame5") != std::string::npos);
  CHECK(text.str().find("frame6") == std::string::npos);
  CHECK(text.str().find("</Xdmf>") != std::string::npos);
}

TEST_CASE("a killed writer leaves every whole frame, and the file can be gone on with", "[record][motion_file]") {
  const Folder dir;
  const pid_t child = fork();
  if (child == 0) {
    MotionWriter writer(dir.path.string(), two_blocks());
    for (int i = 0; i < 600; ++i) writer.write(frame_at(i));  // more than one chunk of times
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  check_frames(dir.path, 600);
  MotionWriter writer(dir.path.string(), 400);
  for (int i = 400; i < 610; ++i) writer.write(frame_at(i));
  CHECK(MotionReader(dir.path.string()).times().size() == 610);  // read while the file grows
  writer.close();
  check_frames(dir.path, 610);
}

TEST_CASE("a full disk leaves every frame written before, and the file can be gone on with", "[record][motion_file]") {
  for (rlim_t room = 12000; room < 40000; room += 1777) {
    INFO(room);
    const Folder dir;
    std::array<int, 2> pipe_ends{};
    REQUIRE(pipe(pipe_ends.data()) == 0);
    const pid_t child = fork();
    if (child == 0) {
      signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{room, room};
      setrlimit(RLIMIT_FSIZE, &limit);
      int written = 0;
      try {
        MotionWriter writer(dir.path.string(), two_blocks());
        for (; written < 600; ++written) writer.write(frame_at(written));
      } catch (const WriteError&) {
        // the writer has closed what it could not write, as at the end of a run
      }
      _exit(write(pipe_ends[1], &written, sizeof written) == sizeof written ? 0 : 1);
    }
    int written = 0, status = 0;
    CHECK(read(pipe_ends[0], &written, sizeof written) == sizeof written);
    close(pipe_ends[0]), close(pipe_ends[1]);
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(written < 600);
    if (written == 0) continue;
    const int kept = written - written / 3;  // as of a checkpoint some frames ago
    MotionWriter writer(dir.path.string(), kept);
    for (int i = kept; i < kept + 50; ++i) writer.write(frame_at(i));
    writer.close();
    check_frames(dir.path, kept + 50);
  }
}

TEST_CASE("a motion file whose head does not fit its sum is refused soon", "[record][motion_file]") {
  const Folder dir;
  MotionWriter writer(dir.path.string(), two_blocks());
  writer.write(frame_at(0));
  writer.close();
  std::fstream file(dir.path / "motion.h5", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(33);  // within the superblock, which ends with its checksum
  file.put('\x5a');
  file.close();
  CHECK_THROWS_WITH(MotionReader(dir.path.string()), Catch::Contains("motion.h5") && Catch::Contains("run the scene again"));
}

TEST_CASE("stresses of joints are kept if asked for, through a resume too, and a file without them is read", "[record][motion_file]") {
  const Folder dir;
  const auto stressed = [](int i) {
    MotionFrame f = frame_at(i);
    f.normal_stress = {-1e6F * static_cast<float>(i)}, f.shear_stress = {2e5F};
    f.force = {1, 2, 3}, f.force_at = {4, 5, static_cast<float>(i)};
    return f;
  };
  MotionWriter writer(dir.path.string(), two_blocks(), true);
  for (int i = 0; i < 3; ++i) writer.write(stressed(i));
  writer.close();
  MotionWriter again(dir.path.string(), 2);
  again.write(stressed(7));
  again.close();
  const MotionReader reader(dir.path.string());
  CHECK(reader.has_stress());
  REQUIRE(reader.times().size() == 3);
  CHECK(reader.read(1).normal_stress == std::vector<float>{-1e6F});
  CHECK(reader.read(2).normal_stress == std::vector<float>{-7e6F});
  CHECK(reader.read(2).shear_stress == std::vector<float>{2e5F});
  CHECK(reader.has_forces());
  CHECK(reader.read(2).force == std::vector<float>{1, 2, 3});
  CHECK(reader.read(2).force_at == std::vector<float>{4, 5, 7});
  MotionWriter plain(dir.path.string(), two_blocks());
  plain.write(frame_at(0));
  plain.close();
  const MotionReader without(dir.path.string());
  CHECK_FALSE(without.has_stress());
  CHECK(without.read(0).normal_stress.empty());
}

TEST_CASE("poses are relative to the ground, or as one at rest beside it sees them", "[record][motion_file]") {
  const Folder dir;
  {
    MotionWriter writer(dir.path.string(), two_blocks(), false, true);
    for (int i = 0; i < 2; ++i) {
      MotionFrame f = frame_at(i);
      f.ground = {0.1 * i, -0.2 * i, 0};
      writer.write(f);
    }
  }
  MotionWriter(dir.path.string(), 1);  // goes on
  {
    MotionWriter writer(dir.path.string(), 1);
    MotionFrame f = frame_at(1);
    f.ground = {0.5, 0.25, -0.125};
    writer.write(f);
  }
  MotionReader reader(dir.path.string());
  CHECK(reader.read(1).poses == frame_at(1).poses);
  reader.stand_beside_the_ground();
  const MotionFrame seen = reader.read(1);
  CHECK(position_of(seen, 1).isApprox(position_of(frame_at(1), 1) + Vec3(0.5, 0.25, -0.125), 1e-6));
  CHECK(seen.poses[10] == frame_at(1).poses[10]);  // no rotation
  const Folder still;
  MotionWriter(still.path.string(), two_blocks()).write(frame_at(0));
  MotionReader without(still.path.string());
  CHECK_THROWS_WITH(without.stand_beside_the_ground(), Catch::Contains("no displacement of the ground"));
}

TEST_CASE("a scene without joints and a file that is none", "[record][motion_file]") {
  const Folder dir;
  MotionScene scene = two_blocks();
  scene.joints.clear();
  MotionFrame f = frame_at(0);
  f.damage.clear();
  f.opening.clear();
  MotionWriter writer(dir.path.string(), scene);
  writer.write(f);
  writer.close();
  CHECK(MotionReader(dir.path.string()).read(0).poses == f.poses);
  std::ofstream(dir.path / "motion.h5") << "nothing of the kind";
  CHECK_THROWS_WITH(MotionReader(dir.path.string()), Catch::Contains("motion.h5") && Catch::Contains("run the scene again"));
  std::filesystem::remove(dir.path / "motion.h5");
  CHECK_THROWS_WITH(MotionReader(dir.path.string()), Catch::Contains("no such motion file"));
}

TEST_CASE("a motion file of another run is refused beside the results of this one", "[record][motion_file][bad_input]") {
  const Folder dir;
  MotionWriter(dir.path.string(), two_blocks()).write(frame_at(0));
  const auto ended_with = [&](int blocks, int joints) {
    std::ofstream(dir.path / "metrics.json") << fmt::format("{{\"blocks\": {}, \"joints\": {}}}", blocks, joints);
  };
  ended_with(2, 1);
  CHECK(MotionReader(dir.path.string()).times().size() == 1);
  for (const auto& [blocks, joints] : {std::pair(3, 1), {2, 0}, {20, 18}}) {
    ended_with(blocks, joints);
    CHECK_THROWS_WITH(MotionReader(dir.path.string()),
                      Catch::Contains("it has 2 blocks and 1 joints") && Catch::Contains("of another run") && Catch::Contains("motion.h5"));
  }
}

TEST_CASE("a motion file carries the hash of scene and params, and is refused beside those of another run",
          "[record][motion_file][bad_input]") {
  const Folder dir;
  const std::string path = dir.path.string();
  Manifest manifest;
  manifest.version = "1.2.3", manifest.git_hash = "abc", manifest.scene_name = "pier", manifest.scene_hash = "0123456789abcdef";
  manifest.params = {{"peak", 0.1 + 0.2, 1, "", "", {}}};
  manifest.inputs = {{"a/record.txt", "11"}, {"b/record.txt", "22"}};
  write_manifest(path, manifest);
  MotionWriter(path, two_blocks()).write(frame_at(0));
  const SceneIdentity own = identity_in(path).value();
  CHECK(h5::File(path + "/motion.h5", h5::File::Mode::read).get_text("scene") == "pier");
  CHECK(h5::File(path + "/motion.h5", h5::File::Mode::read).get_text("scene_hash") == own.hash);
  CHECK(h5::File(path + "/motion.h5", h5::File::Mode::read).get_text("program") == "1.2.3 (abc)");

  const auto beside = [&](const Manifest& other) {
    write_manifest(path, other);
    return MotionReader(path).times().size();
  };
  Manifest moved = manifest, other_params = manifest, other_script = manifest, other_file = manifest;
  moved.inputs = {{"elsewhere/record.txt", "22"}, {"elsewhere/another.txt", "11"}};
  moved.scene_file = "elsewhere.lua", moved.threads = 7, moved.version = "1.2.4";
  CHECK(beside(moved) == 1);
  MotionWriter(path, 1).write(frame_at(1));  // a resumed run keeps what the file carries
  CHECK(h5::File(path + "/motion.h5", h5::File::Mode::read).get_text("program") == "1.2.3 (abc)");
  CHECK(beside(manifest) == 2);
  other_params.params[0].value = 0.3;
  other_script.scene_hash = "0123456789abcdee";
  other_file.inputs.begin()->second = "12";
  for (const Manifest& other : {other_params, other_script, other_file}) {
    CHECK_THROWS_WITH(beside(other), Catch::Contains("motion.h5") && Catch::Contains("of another run") && Catch::Contains(own.hash) &&
                                         Catch::Contains("run the scene again"));
    CHECK_THROWS_WITH(MotionWriter(path, 1), Catch::Contains("of another run") && Catch::Contains("--force"));
  }
  std::filesystem::remove(dir.path / "manifest.json");
  MotionWriter(path, two_blocks()).write(frame_at(0));  // as earlier versions left it
  CHECK_FALSE(h5::File(path + "/motion.h5", h5::File::Mode::read).get_text("scene_hash"));
  CHECK(beside(manifest) == 1);
}
