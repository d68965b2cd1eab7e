#include "engine/analysis/resting.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/contact/broad/search.h"
#include "engine/solve/contacts/bodies.h"

namespace erbs::analysis {
namespace {

constexpr double near = 1e-3;        // of the thinner block: so far a block may fall first, or start within the other
constexpr double least_slope = 0.1;  // cosine between the common normal and the vertical; on steeper faces blocks stand side by side
std::size_t z(int i) { return std::size_t(i); }

}  // namespace

std::vector<int> resting_on_structure(const Model& model, const State& state) {
  const auto moves = [&](int b, bool grounded) {
    return model.kind[z(b)] == Kind::moving && bool(state.topology.grounded[z(b)]) == grounded;
  };
  std::vector<std::uint8_t> loose(z(model.nblock));
  for (int b = 0; b < model.nblock; ++b) loose[z(b)] = moves(b, false);
  const double gravity = model.gravity.norm();
  if (!(gravity > 0) || model.njoint == 0 || std::ranges::none_of(loose, [](std::uint8_t is) { return is != 0; })) return {};
  ContactBodies bodies(model);
  bodies.initialise();
  for (std::size_t b = 0; b < bodies.block.size(); ++b) {
    bodies.block[b].u = state.pose.u[b];
    bodies.block[b].rotation = Quat(state.pose.q[b]).toRotationMatrix() * bodies.axes_of(int(b));
  }
  std::vector<int> out;
  const double margin = near * *std::ranges::max_element(model.smallest_edge);
  for (const PartPair& of : close_parts(margin, {}, bodies.shapes, bodies.block, loose, {})) {
    const int upper = loose[z(of.a)] != 0 ? of.a : of.b, lower = upper == of.a ? of.b : of.a;
    if (!moves(lower, true)) continue;
    const ContactBlock &a = bodies.block[z(of.a)], &b = bodies.block[z(of.b)];
    const PairFrame s = part_frame(shape_of(bodies.shapes, of.a, of.part_a), shape_of(bodies.shapes, of.b, of.part_b), a, b);
    const FaceGap face = std::ranges::max(face_gaps(s), {}, &FaceGap::gap);
    const double down = (a.rotation * face.n).dot(model.gravity) / gravity * (upper == of.a ? 1 : -1);
    const double tolerance = near * std::min(model.smallest_edge[z(upper)], model.smallest_edge[z(lower)]);
    if (down > least_slope && std::fabs(face.gap) <= tolerance) out.push_back(upper);
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::string warning_of_resting(const Model& model, const State& state) {
  const std::vector<int> blocks = resting_on_structure(model, state);
  if (blocks.empty()) return "";
  return "no joint ties what rests on the structure to it, so that its weight comes upon it at once, with up to twice its static effect; "
         "join it by dry{}, or say analysis{ start = \"ramp\" }: " +
         names_of(model, blocks);
}

std::string names_of(const Model& model, const std::vector<int>& blocks) {
  constexpr std::size_t most = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(most, blocks.size()); ++i) names += (i == 0 ? "" : ", ") + model.block_name[z(blocks[i])];
  return blocks.size() > most ? names + fmt::format(" and {} more", blocks.size() - most) : names;
}

}  // namespace erbs::analysis
