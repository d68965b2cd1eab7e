// checkpoint.bin: all that is needed to go on as if nothing had happened. Written beside and renamed, so that there is always one
// whole checkpoint; read back only for the same scene, parameters and step, and only if its checksum holds.
#pragma once
#include <cstdint>
#include <fstream>
#include <functional>
#include <string>

#include "engine/record/archive.h"
#include "engine/scene/scene.h"

namespace erbs {

// What a checkpoint belongs to. Another key is refused.
struct CheckpointKey {
  std::uint64_t scene = 0;  // scene_hash
  double dt = 0;            // s, chosen at the start of the run
  std::uint64_t departures = 0;  // of the words of the command line by which the run departs from its scene
};

// Script, files read, parameters, and all that the blocks are made of.
std::uint64_t scene_hash(const Scene& scene, const std::string& script);

bool has_checkpoint(const std::string& dir);
// `parts` gives its bytes to the archive, the same ones each time: they are counted first, then written. They never stand in memory.
void commit_checkpoint(const std::string& dir, const CheckpointKey& key, const std::function<void(ArchiveOut&)>& parts);
// A whole checkpoint whose bytes are `size` from where `in` is. Error with reason and remedy.
struct CheckpointBytes {
  std::ifstream in;
  std::uint64_t size = 0;
};
CheckpointBytes open_checkpoint(const std::string& dir, const CheckpointKey& key);

// Each part is a struct with an each() visitor: State, the contacts, WriterProgress, Collapse, ...; same parts in the same order
// when read.
template <class... Parts>
void write_checkpoint(const std::string& dir, const CheckpointKey& key, const Parts&... parts) {
  commit_checkpoint(dir, key, [&](ArchiveOut& out) { (visit_each(parts, out), ...); });
}

template <class... Parts>
void read_checkpoint(const std::string& dir, const CheckpointKey& key, Parts&... parts) {
  CheckpointBytes bytes = open_checkpoint(dir, key);
  ArchiveIn in(bytes.in, bytes.size, dir + "/checkpoint.bin");
  (each(parts, in), ...);
  in.finish();
}

// 16 hex digits over positions, velocities and histories of the parts, in fixed order. Equal for any thread count, and for a run
// against the same run stopped and resumed.
template <class... Parts>
std::string state_hash(const Parts&... parts) {
  ResultHash hash;
  (visit_each(parts, hash), ...);
  return fmt::format("{:016x}", hash.value);
}

}  // namespace erbs
