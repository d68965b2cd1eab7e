#include "engine/record/folder/motion_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/record/folder/identity.h"
#include "engine/record/folder/motion_scene.h"
#include "engine/record/format/h5.h"
#include "engine/record/format/json.h"

namespace erbs {
namespace {

std::string in(const std::string& dir, const char* name) { return (std::filesystem::path(dir) / name).string(); }

void put_identity(const h5::File& file, const std::string& dir) {
  const std::optional<SceneIdentity> own = identity_in(dir);
  if (!own) return;
  file.put_text("scene", own->name);
  file.put_text("scene_hash", own->hash);
  file.put_text("program", own->program);
}

// A file of another run would be drawn under the title and verdict of this one.
void check_identity(const h5::File& file, const std::string& dir, const char* remedy) {
  const std::optional<std::string> hash = file.get_text("scene_hash");
  const std::optional<SceneIdentity> own = hash ? identity_in(dir) : std::nullopt;
  if (!own || own->hash == *hash) return;
  const std::string name = file.get_text("scene").value_or("");
  throw Error(
      fmt::format("it is of another run, by its hash: scene {} ({}), while manifest.json is of {} ({}); the scripts, files or params "
                  "differ; {}",
                  shown(name, 60), *hash, shown(own->name, 60), own->hash, remedy),
      {file.path(), 0});
}

}  // namespace

// Arrays of the frames. The time is written last: a frame is complete if its time exists.
struct MotionFrames {
  std::optional<h5::Rows<float>> poses, opening;  // absent without blocks or joints
  std::optional<h5::Rows<float>> normal_stress, shear_stress, force, force_at;
  std::optional<h5::Rows<std::uint8_t>> damage;
  std::optional<h5::Rows<double>> ground, time;

  void create(const h5::File& file, std::size_t nblock, std::size_t njoint, bool stress, bool moving_ground) {
    using Row = std::vector<std::size_t>;
    if (nblock > 0) poses.emplace(file, "/poses", Row{nblock, 7}, 1);
    if (njoint > 0) damage.emplace(file, "/joint_damage", Row{njoint}, 1);
    if (njoint > 0) opening.emplace(file, "/joint_opening", Row{njoint}, 1);
    if (stress && njoint > 0) {
      normal_stress.emplace(file, "/joint_normal_stress", Row{njoint}, 1);
      shear_stress.emplace(file, "/joint_shear_stress", Row{njoint}, 1);
      force.emplace(file, "/joint_force", Row{njoint, 3}, 1);
      force_at.emplace(file, "/joint_force_at", Row{njoint, 3}, 1);
    }
    if (moving_ground) ground.emplace(file, "/ground_displacement", Row{3}, 512);
    time.emplace(file, "/time", Row{}, 512);
  }
  void open(const h5::File& file) {
    if (file.has("/poses")) poses.emplace(file, "/poses");
    if (file.has("/joint_damage")) damage.emplace(file, "/joint_damage");
    if (file.has("/joint_opening")) opening.emplace(file, "/joint_opening");
    if (file.has("/joint_normal_stress") && file.has("/joint_shear_stress")) {
      normal_stress.emplace(file, "/joint_normal_stress");
      shear_stress.emplace(file, "/joint_shear_stress");
    }
    if (file.has("/joint_force") && file.has("/joint_force_at")) {
      force.emplace(file, "/joint_force");
      force_at.emplace(file, "/joint_force_at");
    }
    if (file.has("/ground_displacement")) ground.emplace(file, "/ground_displacement");
    time.emplace(file, "/time");
  }
  std::size_t nblock() const { return poses ? poses->row().front() : 0; }
  std::size_t njoint() const { return damage ? damage->row_items() : 0; }
  std::size_t size() const {
    std::size_t n = time->size();
    if (poses) n = std::min(n, poses->size());
    if (damage) n = std::min(n, damage->size());
    if (opening) n = std::min(n, opening->size());
    if (normal_stress) n = std::min({n, normal_stress->size(), shear_stress->size()});
    if (force) n = std::min({n, force->size(), force_at->size()});
    if (ground) n = std::min(n, ground->size());
    return n;
  }
  void resize(std::size_t frames) {
    if (poses) poses->resize(frames);
    if (damage) damage->resize(frames);
    if (opening) opening->resize(frames);
    if (normal_stress) normal_stress->resize(frames), shear_stress->resize(frames);
    if (force) force->resize(frames), force_at->resize(frames);
    if (ground) ground->resize(frames);
    time->resize(frames);
  }
};

// motion.xdmf: a list of frames that is always complete. Each new frame overwrites the closing tags and writes them anew.
class MotionSidecar {
 public:
  MotionSidecar(const std::string& path, std::size_t nblock) : out_(path, std::ios::binary | std::ios::trunc), path_(path), n_(nblock) {
    out_ << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n"
            "<Grid Name=\"blocks\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    end_ = out_.tellp();
    finish();
  }
  void frame(std::size_t index, double t) {
    out_.seekp(end_);
    out_ << fmt::format(
        "<Grid Name=\"frame{0}\"><Time Value=\"{1}\"/><Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{2}\"/>"
        "<Geometry GeometryType=\"XYZ\">{3}</Geometry>"
        "<Attribute Name=\"rotation\" Center=\"Node\" AttributeType=\"Vector\">{4}</Attribute>"
        "<Attribute Name=\"size\" Center=\"Node\" AttributeType=\"Vector\">{5}</Attribute>"
        "<Attribute Name=\"material\" Center=\"Node\">{6}</Attribute></Grid>\n",
        index, t, n_, slab(index, 0, 3), slab(index, 3, 4), fixed("block_size", 3), fixed("block_material", 1));
    end_ = out_.tellp();
    finish();
  }

 private:
  // Columns [first, first + columns) of /poses, for one frame.
  std::string slab(std::size_t frame, int first, int columns) const {
    return fmt::format(
        "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{0} {3}\"><DataItem Dimensions=\"3 3\" Format=\"XML\">{1} 0 {2} 1 1 1 1 {0} {3}"
        "</DataItem><DataItem Format=\"HDF\" Precision=\"4\" Dimensions=\"{4} {0} 7\">motion.h5:/poses</DataItem></DataItem>",
        n_, frame, first, columns, frame + 1);
  }
  std::string fixed(const char* name, int columns) const {
    const std::string type = columns == 1 ? "NumberType=\"Int\" Precision=\"4\"" : "Precision=\"4\"";
    return fmt::format("<DataItem Format=\"HDF\" {} Dimensions=\"{}{}\">motion.h5:/{}</DataItem>", type, n_, columns == 1 ? "" : " 3",
                       name);
  }
  void finish() {
    out_ << "</Grid></Domain></Xdmf>\n" << std::flush;
    if (!out_) throw WriteError(fmt::format("the file cannot be written: {}", std::strerror(errno)), {path_, 0});
  }

  std::ofstream out_;
  std::string path_;
  std::size_t n_;
  std::streampos end_;
};

struct MotionWriter::File {
  h5::File file;
  MotionFrames frames;
  std::optional<MotionSidecar> sidecar;
};

MotionWriter::MotionWriter(const std::string& dir, const MotionScene& scene, bool stress, bool ground)
    : file_(new File{h5::File(in(dir, "motion.h5"), h5::File::Mode::create), {}, {}}) {
  put_identity(file_->file, dir);
  put_scene(file_->file, scene);
  file_->frames.create(file_->file, scene.blocks.size(), scene.joints.size(), stress, ground);
  file_->file.single_writer();
  file_->sidecar.emplace(in(dir, "motion.xdmf"), scene.blocks.size());
}

MotionWriter::MotionWriter(const std::string& dir, int keep_frames)
    : file_(new File{h5::File(in(dir, "motion.h5"), h5::File::Mode::extend), {}, {}}) {
  MotionFrames& frames = file_->frames;
  check_identity(file_->file, dir, "start it anew with --force");
  frames.open(file_->file);
  if (keep_frames < 0 || static_cast<std::size_t>(keep_frames) > frames.size())
    throw Error(fmt::format("{} frames are to be kept but the file has {}; it is not of this run, start it anew with --force", keep_frames,
                            frames.size()),
                {file_->file.path(), 0});
  frames.resize(static_cast<std::size_t>(keep_frames));
  file_->file.single_writer();
  file_->sidecar.emplace(in(dir, "motion.xdmf"), frames.nblock());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    double t = 0;
    frames.time->read(f, &t);
    file_->sidecar->frame(f, t);
  }
}

MotionWriter::~MotionWriter() = default;
MotionWriter::MotionWriter(MotionWriter&&) noexcept = default;
MotionWriter& MotionWriter::operator=(MotionWriter&&) noexcept = default;

void MotionWriter::write(const MotionFrame& frame) {
  ERBS_ASSERT(file_);
  MotionFrames& frames = file_->frames;
  ERBS_ASSERT(frame.poses.size() == 7 * frames.nblock());
  ERBS_ASSERT(frame.damage.size() == frames.njoint() && frame.opening.size() == frames.njoint());
  if (frames.poses) frames.poses->append(frame.poses.data());
  if (frames.damage) frames.damage->append(frame.damage.data());
  if (frames.opening) frames.opening->append(frame.opening.data());
  if (frames.normal_stress) {
    ERBS_ASSERT(frame.normal_stress.size() == frames.njoint() && frame.shear_stress.size() == frames.njoint());
    frames.normal_stress->append(frame.normal_stress.data());
    frames.shear_stress->append(frame.shear_stress.data());
  }
  if (frames.force) {
    ERBS_ASSERT(frame.force.size() == 3 * frames.njoint() && frame.force_at.size() == 3 * frames.njoint());
    frames.force->append(frame.force.data());
    frames.force_at->append(frame.force_at.data());
  }
  if (frames.ground) {
    ERBS_ASSERT(frame.ground.size() == 3);
    frames.ground->append(frame.ground.data());
  }
  frames.time->append(&frame.t);
  file_->file.flush();
  file_->sidecar->frame(frames.size() - 1, frame.t);
}

int MotionWriter::frames() const { return file_ ? static_cast<int>(file_->frames.size()) : 0; }
void MotionWriter::close() { file_.reset(); }

struct MotionReader::File {
  h5::File file;
  MotionScene scene;
  MotionFrames frames;
  std::vector<double> times;
  bool beside_the_ground = false;
};

namespace {

// The same for files without an identity, as far as the number of blocks and joints tells.
void check_counts(const std::string& dir, const MotionScene& scene) {
  if (!std::filesystem::exists(in(dir, "metrics.json"))) return;  // the run has not ended
  const Json metrics = read_json(in(dir, "metrics.json"));
  const auto count = [&](const char* key, std::size_t own) {
    const Json* value = find_key(metrics, key);
    return value && value->is_number_unsigned() ? value->get<std::size_t>() : own;
  };
  const std::size_t blocks = count("blocks", scene.blocks.size()), joints = count("joints", scene.joints.size());
  if (blocks == scene.blocks.size() && joints == scene.joints.size()) return;
  throw Error(fmt::format("it has {} blocks and {} joints, the run of this folder has {} and {}: it is of another run; run the scene again",
                          scene.blocks.size(), scene.joints.size(), blocks, joints),
              {in(dir, "motion.h5"), 0});
}

}  // namespace

MotionReader::MotionReader(const std::string& dir)
    : file_(new File{h5::File(in(dir, "motion.h5"), h5::File::Mode::read), {}, {}, {}, false}) {
  file_->scene = get_scene(file_->file);
  file_->frames.open(file_->file);
  if (file_->frames.nblock() != file_->scene.blocks.size()) file_->file.unreadable("/poses");
  if (file_->frames.njoint() != file_->scene.joints.size()) file_->file.unreadable("/joint_damage");
  file_->times = file_->file.get<double>("/time");
  file_->times.resize(file_->frames.size());
  check_identity(file_->file, dir, "run the scene again");
  check_counts(dir, file_->scene);
}

MotionReader::~MotionReader() = default;
MotionReader::MotionReader(MotionReader&&) noexcept = default;
MotionReader& MotionReader::operator=(MotionReader&&) noexcept = default;

const MotionScene& MotionReader::scene() const { return file_->scene; }
const std::vector<double>& MotionReader::times() const { return file_->times; }
bool MotionReader::has_stress() const { return file_->frames.normal_stress.has_value(); }
void MotionReader::stand_beside_the_ground() {
  if (!file_->frames.ground)
    throw Error("it holds no displacement of the ground: the scene has no ground_motion, or the run is of an earlier version; run it again",
                {file_->file.path(), 0});
  file_->beside_the_ground = true;
}
bool MotionReader::has_forces() const { return file_->frames.force.has_value(); }

MotionFrame MotionReader::read(int frame) const {
  const auto at = static_cast<std::size_t>(frame);
  ERBS_ASSERT(at < file_->times.size());
  const MotionFrames& frames = file_->frames;
  MotionFrame f{file_->times[at], std::vector<float>(7 * frames.nblock()), std::vector<std::uint8_t>(frames.njoint()),
                std::vector<float>(frames.njoint())};
  if (frames.poses) frames.poses->read(at, f.poses.data());
  if (frames.damage) frames.damage->read(at, f.damage.data());
  if (frames.opening) frames.opening->read(at, f.opening.data());
  if (frames.normal_stress) {
    f.normal_stress.resize(frames.njoint()), f.shear_stress.resize(frames.njoint());
    frames.normal_stress->read(at, f.normal_stress.data());
    frames.shear_stress->read(at, f.shear_stress.data());
  }
  if (frames.force) {
    f.force.resize(3 * frames.njoint()), f.force_at.resize(3 * frames.njoint());
    frames.force->read(at, f.force.data());
    frames.force_at->read(at, f.force_at.data());
  }
  if (frames.ground) f.ground.resize(3), frames.ground->read(at, f.ground.data());
  if (file_->beside_the_ground)
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = i; k < f.poses.size(); k += 7) f.poses[k] += float(f.ground[i]);
      for (std::size_t k = i; k < f.force_at.size(); k += 3) f.force_at[k] += float(f.ground[i]);
    }
  return f;
}

}  // namespace erbs
