#include "engine/record/folder/checkpoint.h"

#include <sys/mman.h>
#include <catch2/catch.hpp>

#include <fstream>

#include "engine/base/error.h"
#include "engine/model/contact_pair.h"
#include "engine/record/folder/run_writer.h"
#include "engine/record/results/collapse.h"
#include "tests/support/text_of.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;

namespace {

State moved() {
  State s = test::two_bricks().state;
  s.time.step = 7, s.time.t = 0.1, s.time.dt = 1e-4, s.observed.joints_broken = 1;
  s.pose.u[1] = Vec3(1.0 / 3, 2, 3);
  s.pose.q[1] = rotation(Vec3(0.1, 0.2, 0.3));
  s.joints.history[2].damage = 0.5;
  s.joints.stage[0] = JointStage::cracked;
  s.joints.memory[0].resultant[2] = 12;
  s.joints.pack[0].rotation[2][7] = 0.25;
  s.cache.pose_row.assign(3, 2.5);
  s.energy.friction = 4;
  s.energy.largest_jump_joint = 3;
  return s;
}

struct NestedThing {
  std::vector<std::vector<double>> lists;
  std::string word;
  std::vector<WriterProgress> parts;
};
struct Pairs {
  std::vector<ContactPair> pairs;
};
template <class F>
void each(Pairs& p, F&& f) {
  f("pairs", p.pairs, Part::history);
}

template <class T, class F>
requires std::is_same_v<std::remove_const_t<T>, NestedThing>
void each(T& t, F&& f) {
  f("lists", t.lists, Part::history);
  f("word", t.word);
  f("parts", t.parts);
}

}  // namespace

TEST_CASE("contact pairs are carried and hashed as history", "[record][checkpoint]") {
  const test::Scratch scratch("pairs");
  std::filesystem::create_directories(scratch.path);
  Pairs pairs;
  pairs.pairs.resize(3);
  pairs.pairs[1].u = Vec3(1, 2, 3);
  pairs.pairs[1].friction.moment_b = Vec3(0, 0, 1.0 / 3);
  write_checkpoint(scratch.path, {1, 1}, pairs);
  Pairs back;
  read_checkpoint(scratch.path, {1, 1}, back);
  REQUIRE(back.pairs.size() == 3);
  CHECK(back.pairs[1].u == Vec3(1, 2, 3));
  CHECK(back.pairs[1].friction.moment_b.z() == 1.0 / 3);
  CHECK(state_hash(back) == state_hash(pairs));
  back.pairs[1].friction.moment_b.x() = 1e-300;
  CHECK(state_hash(back) != state_hash(pairs));
}

TEST_CASE("a checkpoint brings everything back", "[record][checkpoint]") {
  const test::Scratch scratch("checkpoint");
  std::filesystem::create_directories(scratch.path);
  const CheckpointKey key{42, 1e-4};
  const State s = moved();
  const NestedThing nested{{{1, 2}, {}, {3}}, "words", {{1, 2, 3, 4}, {5, 6, 7, 8}}};
  write_checkpoint(scratch.path, key, s, nested);
  CHECK(has_checkpoint(scratch.path));
  CHECK_FALSE(std::filesystem::exists(scratch.path + "/checkpoint.bin.tmp"));
  State back;
  NestedThing again;
  read_checkpoint(scratch.path, key, back, again);
  // A second write gives the same file: nothing that the visitor names was lost.
  const std::string first = test::text_of(scratch.path + "/checkpoint.bin");
  write_checkpoint(scratch.path, key, back, again);
  CHECK(test::text_of(scratch.path + "/checkpoint.bin") == first);
  CHECK(back.pose.u[1] == s.pose.u[1]);
  CHECK(back.pose.q[1].coeffs() == s.pose.q[1].coeffs());
  CHECK(back.joints.pack[0].rotation[2][7] == 0.25);
  CHECK(back.energy.largest_jump_joint == 3);
  CHECK(again.lists == nested.lists);
  CHECK(again.word == "words");
  CHECK(again.parts[1].frames == 8);
  CHECK(state_hash(back, again) == state_hash(s, nested));
}

TEST_CASE("what is longer than the writer's pieces comes back, and zeros stay unwritten", "[record][checkpoint]") {
  const test::Scratch scratch("long");
  std::filesystem::create_directories(scratch.path);
  State s = moved();
  s.joints.history.clear(300000);
  s.joints.history[123456].damage = 0.25;
  s.joints.history[299999].kappa = 3;
  s.joints.slot.assign(50001, 7);
  write_checkpoint(scratch.path, {1, 1}, s);
  State back;
  read_checkpoint(scratch.path, {1, 1}, back);
  unsigned char there[3] = {};  // residency in memory of the pages around a zero item
  const auto page = reinterpret_cast<std::uintptr_t>(&back.joints.history[60000]) / 4096 * 4096;
  REQUIRE(mincore(reinterpret_cast<void*>(page), 3 * 4096, there) == 0);
  CHECK((there[0] & 1) == 0);
  CHECK(state_hash(back) == state_hash(s));
  CHECK(back.joints.slot == s.joints.slot);
  CHECK(back.joints.history[299999].kappa == 3);
}

TEST_CASE("a checkpoint of another scene or step, cut short or damaged, is refused", "[record][checkpoint]") {
  const test::Scratch scratch("refused");
  std::filesystem::create_directories(scratch.path);
  const std::string path = scratch.path + "/checkpoint.bin";
  const CheckpointKey key{42, 1e-4};
  State back;
  CHECK_THROWS_WITH(read_checkpoint(scratch.path, key, back), Catch::Contains("no checkpoint"));
  write_checkpoint(scratch.path, key, moved());
  CHECK_THROWS_WITH(read_checkpoint(scratch.path, {43, 1e-4}, back), Catch::Contains("another scene") && Catch::Contains("--force"));
  CHECK_THROWS_WITH(read_checkpoint(scratch.path, {42, 2e-4}, back), Catch::Contains("0.0001") && Catch::Contains("0.0002"));
  const std::string whole = test::text_of(path);
  for (const std::size_t length : {std::size_t(0), std::size_t(20), whole.size() / 2, whole.size() - 1}) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    CHECK_THROWS_WITH(read_checkpoint(scratch.path, key, back), Catch::Contains("checkpoint.bin") && Catch::Contains("cut short"));
  }
  std::string damaged = whole;
  damaged[whole.size() / 2] = char(damaged[whole.size() / 2] ^ 1);
  std::ofstream(path, std::ios::binary) << damaged;
  CHECK_THROWS_WITH(read_checkpoint(scratch.path, key, back), Catch::Contains("checksum"));
  std::ofstream(path, std::ios::binary) << whole;
  WriterProgress extra;
  CHECK_THROWS_WITH(read_checkpoint(scratch.path, key, back, extra), Catch::Contains("too early"));
  CHECK_THROWS_WITH(read_checkpoint(scratch.path, key, extra), Catch::Contains("another version"));
}

TEST_CASE("a failed checkpoint leaves the one before it", "[record][checkpoint]") {
  const test::Scratch scratch("failed");
  std::filesystem::create_directories(scratch.path);
  const CheckpointKey key{42, 1e-4};
  write_checkpoint(scratch.path, key, moved());
  std::filesystem::create_directories(scratch.path + "/checkpoint.bin.tmp");  // blocks the temporary file
  CHECK_THROWS_AS(write_checkpoint(scratch.path, key, State()), Error);
  State back;
  read_checkpoint(scratch.path, key, back);
  CHECK(back.time.step == 7);
}

TEST_CASE("state_hash sees positions, velocities and histories, not caches", "[record][checkpoint]") {
  const std::string before = state_hash(moved());
  CHECK(before.size() == 16);
  const auto changed = [&](auto&& change) {
    State s = moved();
    change(s);
    return state_hash(s) != before;
  };
  CHECK(changed([](State& s) { s.pose.u[1].x() = std::nextafter(s.pose.u[1].x(), 1); }));
  CHECK(changed([](State& s) { s.pose.q[1] = Quat(s.pose.q[1].w(), s.pose.q[1].x(), s.pose.q[1].y(), s.pose.q[1].z() + 1e-16); }));
  CHECK(changed([](State& s) { s.motion.v[2].y() = 1e-300; }));
  CHECK(changed([](State& s) { s.motion.spin_momentum[2].y() = 1e-300; }));
  CHECK(changed([](State& s) { s.joints.history[0].slip_t = 1e-20; }));
  CHECK(changed([](State& s) { s.joints.stage[0] = JointStage::contact; }));
  CHECK_FALSE(changed([](State& s) { s.joints.pack[0].gap[0][0] = 1; }));
  CHECK_FALSE(changed([](State& s) { s.energy.kinetic = 1; }));
}

TEST_CASE("the scene's hash follows script, inputs, parameters and blocks", "[record][checkpoint]") {
  const Scene scene = test::two_bricks().scene;
  const std::uint64_t before = scene_hash(scene, "a");
  CHECK(scene_hash(scene, "b") != before);
  Scene other = scene;
  other.params.push_back({"pga", 1, 1, "", "", {}});
  const std::uint64_t with_param = scene_hash(other, "a");
  CHECK(with_param != before);
  other.params[0].value = 2;
  CHECK(scene_hash(other, "a") != with_param);
  other = scene;
  other.blocks[1].parts.edit()[0].vertices[0].x() += 1e-12;
  CHECK(scene_hash(other, "a") != before);
  other = scene;
  other.inputs["r.csv"] = "1234";
  CHECK(scene_hash(other, "a") != before);
}
