#include "engine/record/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/base/hash.h"

namespace erbs {
namespace {

// The file: this head, then the bytes, then FNV-1a of both.
struct Head {
  char magic[8] = {'E', 'R', 'B', 'S', 'C', 'K', 'P', 'T'};
  std::uint64_t format = 1;  // raised when the meaning of the bytes changes and their names and sizes do not
  std::uint64_t scene = 0;
  double dt = 0;
  std::uint64_t size = 0;
};
static_assert(sizeof(Head) == 40, "no padding: its bytes are part of the checksum");

std::string path_of(const std::string& dir) { return dir + "/checkpoint.bin"; }

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw Error(fmt::format("{}: {}; the checkpoint before it is intact", what, std::strerror(errno)), {path, 0});
}

// Closes what it opened, whatever happens.
struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

void write_synced(const std::string& path, const std::string& text) {
  const Descriptor file{::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)};
  if (file.fd < 0) fail(path, "cannot be written");
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file.fd, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(path, "cannot be written");
    done += std::size_t(n);
  }
  if (::fsync(file.fd) != 0) fail(path, "cannot be written");
}

// Feeds numbers and words to FNV-1a; lengths too, so that "ab","c" differs from "a","bc".
struct Feed {
  std::uint64_t value = fnv1a("");
  void operator()(std::string_view text) {
    (*this)(double(text.size()));
    value = fnv1a(text, value);
  }
  void operator()(double number) { value = fnv1a({reinterpret_cast<const char*>(&number), sizeof number}, value); }
  void operator()(const Vec3& v) {
    for (int i = 0; i < 3; ++i) (*this)(v[i]);
  }
};

}  // namespace

std::uint64_t scene_hash(const Scene& scene, const std::string& script) {
  Feed feed;
  feed(script);
  for (const auto& [path, hash] : scene.inputs) feed(hash);  // the path may change: the same folder moved elsewhere
  for (const Param& param : scene.params) feed(param.name), feed(param.value);
  feed(scene.gravity);
  for (const Block& block : scene.blocks) {
    feed(block.name);
    feed(double(block.material));
    feed(block.fixed ? 1.0 : 0.0);
    feed(block.initial().position), feed(block.initial().rotation), feed(block.initial().velocity), feed(block.initial().spin);
    for (const Polyhedron& part : block.parts)
      for (const Vec3& vertex : part.vertices) feed(vertex);
  }
  return feed.value;
}

bool has_checkpoint(const std::string& dir) { return std::filesystem::is_regular_file(path_of(dir)); }

void commit_checkpoint(const std::string& dir, const CheckpointKey& key, const std::string& bytes) {
  Head head;
  head.scene = key.scene;
  head.dt = key.dt;
  head.size = bytes.size();
  std::string text(sizeof head, '\0');
  std::memcpy(text.data(), &head, sizeof head);
  text += bytes;
  const std::uint64_t sum = fnv1a(text);
  text.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  const std::string path = path_of(dir), beside = path + ".tmp";
  try {
    write_synced(beside, text);
    if (std::rename(beside.c_str(), path.c_str()) != 0) fail(path, "cannot be replaced");
  } catch (const Error&) {
    std::remove(beside.c_str());
    throw;
  }
  // The folder too: the new name must survive a power cut.
  const Descriptor folder{::open(dir.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (folder.fd >= 0) ::fsync(folder.fd);
}

std::string open_checkpoint(const std::string& dir, const CheckpointKey& key) {
  const std::string path = path_of(dir);
  const Place place{path, 0};
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("there is no checkpoint to resume from; start anew with --force", place);
  std::stringstream stream;
  stream << in.rdbuf();
  std::string text = stream.str();
  Head head;
  std::uint64_t sum = 0;
  if (text.size() < sizeof head + sizeof sum || std::memcmp(text.data(), head.magic, sizeof head.magic) != 0)
    throw Error("is no checkpoint of erbs, or was cut short; start anew with --force", place);
  const std::uint64_t format = head.format;
  std::memcpy(&head, text.data(), sizeof head);
  if (head.format != format)
    throw Error(fmt::format("has format {}, this program reads {}; resume with the program that wrote it, or start anew with --force",
                            head.format, format),
                place);
  const std::size_t whole = text.size() - sizeof sum;
  if (head.size != whole - sizeof head)
    throw Error(fmt::format("was cut short: {} bytes of {}; start anew with --force", text.size(), head.size + sizeof head + sizeof sum),
                place);
  std::memcpy(&sum, text.data() + whole, sizeof sum);
  if (fnv1a({text.data(), whole}) != sum) throw Error("is damaged: its checksum does not hold; start anew with --force", place);
  if (head.scene != key.scene)
    throw Error(
        "belongs to another scene: the script, a file it reads or a parameter (-D) has changed; resume with those of the run "
        "(scene.lua and manifest.json beside it), or start anew with --force",
        place);
  if (head.dt != key.dt)
    throw Error(fmt::format("was written with dt = {} s, this run has dt = {} s; resume with the same, or start anew with --force", head.dt,
                            key.dt),
                place);
  text.erase(whole);
  text.erase(0, sizeof head);
  return text;
}

}  // namespace erbs
