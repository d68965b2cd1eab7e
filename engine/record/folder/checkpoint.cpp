#include "engine/record/folder/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "engine/base/hash.h"

namespace erbs {
namespace {

// Layout of the file: this head, the content, then the FNV-1a hash of both.
struct Head {
  char magic[8] = {'E', 'R', 'B', 'S', 'C', 'K', 'P', 'T'};
  std::uint64_t format = 3;  // raised if the meaning of the bytes changes while their names and sizes do not
  std::uint64_t scene = 0;
  double dt = 0;
  std::uint64_t override_arguments = 0;
  std::uint64_t size = 0;
};
static_assert(sizeof(Head) == 48, "no padding: its bytes are part of the checksum");

std::string path_of(const std::string& dir) { return dir + "/checkpoint.bin"; }

[[noreturn]] void fail(const std::string& path, const char* what) {
  const std::string why = std::strerror(errno);
  const bool before = ::access(path.substr(0, path.rfind(".tmp")).c_str(), F_OK) == 0;
  throw WriteError(fmt::format("{}: {}{}", what, why, before ? "; a checkpoint before it is intact" : ""), {path, 0});
}

// Closes the file it opened, on every way out.
struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

// A file, and the FNV-1a hash of the bytes written to it.
class SummedFile {
 public:
  explicit SummedFile(const std::string& path) : path_(path), file_{::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)} {
    if (file_.fd < 0) fail(path, "cannot be written");
    waiting_.reserve(most);
  }
  void write(std::string_view bytes) {
    sum_ = fnv1a(bytes, sum_);
    if (waiting_.size() + bytes.size() > most) flush();
    if (bytes.size() < most) waiting_ += bytes;
    else put(bytes);
  }
  std::uint64_t sum() const { return sum_; }
  void sync() {
    flush();
    if (::fsync(file_.fd) != 0) fail(path_, "cannot be written");
  }

 private:
  static constexpr std::size_t most = 1 << 16;
  void flush() {
    put(waiting_);
    waiting_.clear();
  }
  void put(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(file_.fd, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail(path_, "cannot be written");
      bytes.remove_prefix(std::size_t(n));
    }
  }
  std::string path_, waiting_;
  Descriptor file_;
  std::uint64_t sum_ = fnv1a("");
};

template <class T>
std::string_view bytes_of(const T& item) {
  return {reinterpret_cast<const char*>(&item), sizeof item};
}

// Feeds numbers and strings to FNV-1a. Lengths are fed too, so that "ab","c" differs from "a","bc".
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
  // Paths are left out, and hashes are sorted: the same folder may be moved, or be named from another folder.
  std::vector<std::string> inputs;
  for (const auto& [path, hash] : scene.inputs) inputs.push_back(hash);
  std::sort(inputs.begin(), inputs.end());
  for (const std::string& hash : inputs) feed(hash);
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

void commit_checkpoint(const std::string& dir, const CheckpointKey& key, const std::function<void(ArchiveOut&)>& parts) {
  Head head;
  head.scene = key.scene;
  head.dt = key.dt;
  head.override_arguments = key.override_arguments;
  ArchiveOut counted([&](std::string_view bytes) { head.size += bytes.size(); });
  parts(counted);
  const std::string path = path_of(dir), beside = path + ".tmp";
  try {
    SummedFile file(beside);
    file.write(bytes_of(head));
    ArchiveOut written([&](std::string_view bytes) { file.write(bytes); });
    parts(written);
    const std::uint64_t sum = file.sum();
    file.write(bytes_of(sum));
    file.sync();
    if (std::rename(beside.c_str(), path.c_str()) != 0) fail(path, "cannot be replaced");
  } catch (const Error&) {
    std::remove(beside.c_str());
    throw;
  }
  // The folder is synchronised too: the new name must survive a power cut.
  const Descriptor folder{::open(dir.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (folder.fd >= 0) ::fsync(folder.fd);
}

CheckpointBytes open_checkpoint(const std::string& dir, const CheckpointKey& key) {
  const std::string path = path_of(dir);
  const Place place{path, 0};
  CheckpointBytes out{std::ifstream(path, std::ios::binary | std::ios::ate), 0};
  std::ifstream& in = out.in;
  if (!in) throw Error("there is no checkpoint to resume from; start anew with --force", place);
  const auto length = std::uint64_t(in.tellg());
  in.seekg(0);
  Head head;
  const Head own;
  std::uint64_t sum = 0, stored = 0;
  if (length < sizeof head + sizeof sum || !in.read(reinterpret_cast<char*>(&head), sizeof head) ||
      std::memcmp(head.magic, own.magic, sizeof head.magic) != 0)
    throw Error("is no checkpoint of erbs, or was cut short; start anew with --force", place);
  if (head.format != own.format)
    throw Error(fmt::format("has format {}, this program reads {}; resume with the program that wrote it, or start anew with --force",
                            head.format, own.format),
                place);
  if (head.size != length - sizeof sum - sizeof head)
    throw Error(fmt::format("was cut short: {} bytes of {}; start anew with --force", length, head.size + sizeof head + sizeof sum), place);
  sum = fnv1a(bytes_of(head));
  std::string piece(std::min<std::uint64_t>(head.size, 1 << 16), '\0');
  for (std::uint64_t left = head.size; left > 0; left -= piece.size()) {
    piece.resize(std::min<std::uint64_t>(left, piece.size()));
    in.read(piece.data(), std::streamsize(piece.size()));
    sum = fnv1a(piece, sum);
  }
  in.read(reinterpret_cast<char*>(&stored), sizeof stored);
  if (!in || stored != sum) throw Error("is damaged: its checksum does not hold; start anew with --force", place);
  if (head.scene != key.scene)
    throw Error(
        "belongs to another scene: the script, a file it reads or a parameter (-D) has changed; resume with those of the run "
        "(scene.lua and manifest.json beside it), or start anew with --force",
        place);
  if (head.override_arguments != key.override_arguments)
    throw Error(
        "was written by a run with other options (--set, --without, --points, ...); resume with those of the run, which stand in "
        "manifest.json (\"departures\"), or start anew with --force",
        place);
  if (head.dt != key.dt)
    throw Error(fmt::format("was written with dt = {} s, this run has dt = {} s; resume with the same, or start anew with --force", head.dt,
                            key.dt),
                place);
  in.seekg(sizeof head);
  out.size = head.size;
  return out;
}

}  // namespace erbs
