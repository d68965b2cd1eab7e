#include "engine/record/folder/run_writer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>

#include "engine/base/text.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/recorders/joint_stress.h"
#include "engine/record/results/metrics.h"

namespace erbs {
namespace {

constexpr double flush_every = 1;  // s, wall clock: the most a killed run can lose

double wall_clock() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::vector<std::string> energy_columns() {
  std::vector<std::string> names{"time_s"};
  for (const auto& [name, value] : energy_terms(Energy{})) names.push_back(name);
  names.insert(names.end(), {"residual_J", "residual_relative"});
  return names;
}

CsvWriter table(const std::string& path, const std::vector<std::string>& names, bool resume, long keep_rows, std::uint64_t sum) {
  return resume ? CsvWriter(path, names, keep_rows, sum) : CsvWriter(path, names);
}

MotionShape shape_of(const Polyhedron& part) {
  MotionShape shape;
  for (const Vec3& vertex : part.vertices)
    for (int i = 0; i < 3; ++i) shape.vertices.push_back(float(vertex[i]));
  shape.faces = part.faces.list();
  return shape;
}

MotionJoint joint_of(const Scene& scene, const Model& model, const Joint& joint) {
  MotionJoint drawn;
  drawn.a = joint.a;
  drawn.b = joint.b;
  drawn.normal = joint.type->frame.col(2);
  // Each joint rule gives one law. A dry joint has no mortar to draw.
  if (model.laws[std::size_t(joint.type->law)].has_bond() && std::size_t(joint.type->rule) < scene.joint_rules.size())
    drawn.thickness = scene.joint_rules[std::size_t(joint.type->rule)].thickness;
  drawn.polygon.reserve(std::size_t(joint.type->corners));
  for (int i = joint.type->first_corner; i < joint.type->first_corner + joint.type->corners; ++i) {
    const Eigen::Vector2d& corner = model.overlap_corner[std::size_t(i)];
    drawn.polygon.push_back(joint.arm_a + joint.type->frame.col(0) * corner.x() + joint.type->frame.col(1) * corner.y());
  }
  return drawn;
}

bool shakes(const Scene& scene) {
  return std::ranges::any_of(scene.loads, [](const Load& load) { return load.kind == Load::Kind::ground; });
}

}  // namespace

MotionScene motion_scene(const Scene& scene, const Model& model) {
  MotionScene drawn;
  drawn.blocks.reserve(model.block_name.size());
  drawn.joints.reserve(model.joint.size());
  for (int i = 0; i < model.nblock; ++i) {
    const auto b = std::size_t(i);
    MotionBlock block;
    block.name = model.block_name[b];
    block.group = scene.blocks[b].group;
    block.material = model.material[b];
    block.fixed = model.kind[b] == Kind::fixed;
    block.rest = model.rest[b];
    for (const Polyhedron& part : model.parts[b]) block.parts.push_back(share_shape(drawn, shape_of(translated(part, -model.rest[b]))));
    drawn.blocks.push_back(std::move(block));
  }
  for (const Joint& joint : model.joint) drawn.joints.push_back(joint_of(scene, model, joint));
  return drawn;
}

RunWriter::RunWriter(const std::string& dir, const Scene& scene, const Model& model, const WriterProgress* resume)
    : dir_(dir),
      recorders_(scene, model),
      histories_(table(run_file(dir, "histories.csv"), recorders_.columns(), resume, resume ? resume->history_rows : 0,
                       resume ? resume->history_sum : 0)),
      energy_(
          table(run_file(dir, "energy.csv"), energy_columns(), resume, resume ? resume->energy_rows : 0, resume ? resume->energy_sum : 0)),
      events_(table(run_file(dir, "events.csv"), {"time_s", "event", "name", "value", "unit"}, resume, resume ? resume->event_rows : 0,
                    resume ? resume->event_sum : 0)),
      motion_(resume ? MotionWriter(dir, resume->frames)
                     : MotionWriter(dir, motion_scene(scene, model), scene.analysis.frame_stress, shakes(scene))),
      flushed_(wall_clock()) {
  frame_.poses.resize(std::size_t(model.nblock) * 7);
  frame_.damage.resize(std::size_t(model.njoint));
  frame_.opening.resize(std::size_t(model.njoint));
  if (scene.analysis.frame_stress) {
    frame_.normal_stress.resize(frame_.opening.size()), frame_.shear_stress.resize(frame_.opening.size());
    frame_.force.resize(3 * frame_.opening.size()), frame_.force_at.resize(3 * frame_.opening.size());
  }
  if (!resume) write_text_atomically(run_file(dir, "log.txt"), "");
}

void RunWriter::row(const Snapshot& snapshot) {
  histories_.row(recorders_.sample(snapshot));
  const Energy& energy = snapshot.energy;
  std::vector<double> values{snapshot.t};
  for (const auto& [name, value] : energy_terms(energy)) values.push_back(value);
  values.push_back(energy.residual);
  values.push_back(energy.residual_relative);
  energy_.row(values);
  if (wall_clock() - flushed_ > flush_every) flush();
}

void RunWriter::frame(const Snapshot& snapshot) {
  const Model& model = snapshot.model;
  frame_.t = snapshot.t;
  float* pose = frame_.poses.data();
  for (std::size_t b = 0; b < std::size_t(model.nblock); ++b) {
    const Vec3 centre = model.rest[b] + snapshot.pose.u[b];
    const Quat& q = snapshot.pose.q[b];
    for (const double value : {centre.x(), centre.y(), centre.z(), q.w(), q.x(), q.y(), q.z()}) *pose++ = float(value);
  }
  for (int j = 0; j < model.njoint; ++j) {
    const JointCondition condition = joint_condition(model, snapshot.joints, snapshot.pose, j);
    // Rounded up: a joint with any damage is not drawn as intact.
    frame_.damage[std::size_t(j)] = std::uint8_t(std::ceil(255 * std::clamp(condition.damage, 0.0, 1.0)));
    frame_.opening[std::size_t(j)] = float(condition.opening);
    if (frame_.normal_stress.empty()) continue;
    const JointStress stress = joint_stress(model, snapshot.joints, snapshot.pose, j);
    frame_.normal_stress[std::size_t(j)] = float(stress.normal);
    frame_.shear_stress[std::size_t(j)] = float(stress.shear);
    const JointThrust thrust = joint_thrust(model, snapshot.joints, snapshot.pose, j);
    for (int i = 0; i < 3; ++i) {
      frame_.force[std::size_t(3 * j + i)] = float(thrust.force[i]);
      frame_.force_at[std::size_t(3 * j + i)] = float(thrust.at[i]);
    }
  }
  frame_.ground = {snapshot.ground_u.x(), snapshot.ground_u.y(), snapshot.ground_u.z()};
  motion_.write(frame_);
}

void RunWriter::event(double t, std::string_view what, std::string_view name, double value, std::string_view unit) {
  const std::string number = std::isnan(value) ? "nan" : fmt::format("{}", value);
  events_.text_row({fmt::format("{}", t), std::string(what), std::string(name), number, std::string(unit)});
}

void RunWriter::log(std::string_view line) {
  std::ofstream out(run_file(dir_, "log.txt"), std::ios::app);
  out << printable(line) << '\n' << std::flush;
  if (!out) throw WriteError("cannot be written", {run_file(dir_, "log.txt"), 0});
}

void RunWriter::log_once(std::string_view line) {
  std::ifstream in(run_file(dir_, "log.txt"));
  const std::string text = printable(line);
  for (std::string known; std::getline(in, known);)
    if (known == text) return;
  log(line);
}

WriterProgress RunWriter::progress() {
  histories_.sync();
  energy_.sync();
  events_.sync();
  return {histories_.rows(), energy_.rows(), events_.rows(), motion_.frames(), histories_.sum(), energy_.sum(), events_.sum()};
}

void RunWriter::flush() {
  histories_.flush();
  energy_.flush();
  events_.flush();
  flushed_ = wall_clock();
}

void RunWriter::close() {
  flush();
  motion_.close();
}

}  // namespace erbs
