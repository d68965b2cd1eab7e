// checkpoint.bin: the complete state of a run, from which it continues bit for bit.
// A new checkpoint is written to a temporary file and then renamed, so one whole checkpoint always exists.
// It is read only for the same scene, parameters and time step, and only if its checksum holds.
#pragma once
#include <cstdint>
#include <fstream>
#include <functional>
#include <string>

#include "engine/record/folder/archive.h"
#include "engine/scene/scene.h"

namespace erbs {

// The run a checkpoint belongs to. A checkpoint with another key is refused.
struct CheckpointKey {
  std::uint64_t scene = 0;               // scene_hash
  double dt = 0;                         // s, chosen at the start of the run
  std::uint64_t override_arguments = 0;  // hash of the command-line overrides of the scene
};

// Hash of the script, the files it reads, the parameters, and every property of the blocks.
std::uint64_t scene_hash(const Scene& scene, const std::string& script);

bool has_checkpoint(const std::string& dir);
// `parts` gives its bytes to the archive. It is called twice, first to count the bytes and then to write them, and must give the same bytes
// each time. The bytes are never all in memory.
void commit_checkpoint(const std::string& dir, const CheckpointKey& key, const std::function<void(ArchiveOut&)>& parts);
// A validated checkpoint: its content is the `size` bytes from the position of `in`. Otherwise Error with reason and remedy.
struct CheckpointBytes {
  std::ifstream in;
  std::uint64_t size = 0;
};
CheckpointBytes open_checkpoint(const std::string& dir, const CheckpointKey& key);

// Each part is a struct with an `each()` visitor: `State`, the contacts, `WriterProgress`, `Collapse`, ... Reading must name the same parts
// in the same order.
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

// 16 hex digits: hash of positions, velocities and histories of the parts, in fixed order. The hash is equal for any thread count, and for
// a run that was stopped and resumed.
template <class... Parts>
std::string state_hash(const Parts&... parts) {
  ResultHash hash;
  (visit_each(parts, hash), ...);
  return fmt::format("{:016x}", hash.value);
}

}  // namespace erbs
