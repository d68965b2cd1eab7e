#include "engine/solve/contacts/contacts.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/count.h"
#include "engine/contact/broad/search.h"
#include "engine/joints/event_bound.h"
#include "engine/model/build/add_joints.h"
#include "engine/model/columns.h"
#include "engine/model/levels.h"

namespace erbs {
namespace {

// m, of the list, which gets it first.
double margin_of(PairList& list, const Model& model) {
  if (!list.u.empty()) return list.margin;
  std::vector<double> thickness;
  each_contact_part(model, [&](int, const Polyhedron& part) { thickness.push_back(contact_shape(part).thickness); });
  return list.margin = suggested_margin(std::move(thickness));
}

}  // namespace

Contacts::Contacts(const Model& model, State& state, const StepRange& range, int threads)
    : model_(model),
      state_(state),
      bodies_(model),
      motion_(model, state, bodies_, threads),
      former_(model, state, bodies_),
      forces_(model, state, bodies_, motion_, threads),
      sleep_(model, state),
      bound_(model, state, range, bodies_, sleep_),
      sums_({model, state, bodies_, motion_, former_, forces_, sleep_, bound_}, threads),
      block_levels_(model, state),
      watch_(model, state, bodies_, margin_of(state.contacts.list, model)),
      may_have_levels_(may_have_levels(model)) {
  list_involved();
}

void Contacts::initialise() {
  if (initialised_) return;
  initialised_ = true;
  bodies_.initialise();
  motion_.initialise();
  bound_.initialise();
  state_.contacts.list.contact_count.resize(z(model_.nblock));
}

// After a search nothing is known about the listed pairs.
void Contacts::rebuild_lists() {
  SeparationState& separation = state_.contacts.separation;
  separation.pair.clear();
  std::fill(separation.rotation_travel.begin(), separation.rotation_travel.end(), 0.0);
  list_involved();
}

void Contacts::list_involved() {
  std::vector<std::uint8_t> in(state_.topology.loose.begin(), state_.topology.loose.end());
  for (const ContactPair& p : state_.contacts.list.pair) in[z(p.a)] = in[z(p.b)] = 1;
  involved_.clear();
  for (int b = 0; b < model_.nblock; ++b)
    if (in[z(b)]) involved_.push_back(b);
  unsorted_ = true;
  jointed_.clear();
  if (!active()) return;
  initialise();
  jointed_ = jointed_pairs(model_, state_);
  former_.list_pairs();
  motion_.list_pairs();
  forces_.list_pairs();
}

void Contacts::activate_loose_blocks(double time) {
  std::vector<std::uint8_t>& loose = state_.topology.loose;
  bool changed = false;
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] == Kind::fixed || loose[z(b)] || state_.topology.grounded[z(b)]) continue;
    loose[z(b)] = 1;
    changed = true;
  }
  if (time > 0) {
    bodies_.initialise();
    changed = watch_.find(time, loose) || changed;
  }
  if (!changed) return;
  state_.contacts.list.valid = false;
  list_involved();
}

void Contacts::prepare(double budget) {
  forces_.set(budget);
  const bool due = motion_.prepare(involved_, unsorted_);
  if (!state_.contacts.list.valid || due) update();
  if (unsorted_) sort();
  forces_.prepare();
}

void Contacts::find_columns() {
  std::vector<ContactPair>& pairs = state_.contacts.list.pair;
  const auto lasts = [](const ContactPair& p) { return p.touching != 0 || p.mean_normal_force > 0; };  // hops of a trembling column
  const auto lies = [&](const ContactPair& p) {
    return lie_on_each_other(model_, bodies_.block[z(p.b_is_reference ? p.b : p.a)].rotation * p.n);
  };
  Columns columns(model_, state_);
  for (const ContactPair& p : pairs)
    if (lasts(p) && lies(p)) columns.link(p.a, p.b);
  columns.find();
  for (ContactPair& p : pairs)
    if (lasts(p)) p.law.hop = lies(p) ? columns.through(p.a, p.b) : columns.beside(p.a, p.b);
}

void Contacts::prepare_substep() {
  forces_.set(0);
  if (unsorted_) {  // in a resumed run, or after a release at the start of this macro step
    motion_.place(involved_);
    sort();
    list_fast_pairs();
    block_levels_.resume(blocks_with_slow_pair());
  }
  motion_.prepare_substep();
  forces_.book_after_kick(sleep_.live());
  forces_.prepare();
}

// Updates the poses of all blocks, since `track()` leaves out blocks without a live pair, and searches for pairs if necessary.
void Contacts::update() {
  PairList& list = state_.contacts.list;
  motion_.update_all(&sleep_);
  former_.forget_displaced();
  if (unsorted_) find_still();
  if (list.valid && !needs_search(list, bodies_.shapes, bodies_.block, still_)) return;
  const bool came_loose = !list.valid && state_.time.step > 0;
  std::vector<int> fresh = search_pairs(state_.energy.reset, still_);
  if (came_loose) state_.energy.reset -= former_.start_fresh(fresh);
  if (state_.time.step == 0) {  // overlaps at rest are free of force; those of blocks that the scene moves there are meant to press
    std::erase_if(fresh, [this](int i) { return !overlap_at_rest(state_.contacts.list.pair[z(i)]); });
    former_.start_fresh(fresh);
  }
  rebuild_lists();
  find_still();
}

bool Contacts::overlap_at_rest(const ContactPair& pair) const {
  constexpr double round_off = 1e-9;  // of the reach
  const auto moved = [this](int b) { return !state_.pose.u[z(b)].isZero(0) || state_.pose.q[z(b)].vec() != Vec3::Zero(); };
  if (moved(pair.a) || moved(pair.b)) return false;
  const PairFrame s = pair_frame(pair, bodies_.shapes, bodies_.block[z(pair.a)], bodies_.block[z(pair.b)]);
  return greatest_gap(s) < -round_off * (s.reference->reach + s.other->reach);
}

// Returns the new pairs. `reset`: J, receives the energy of pairs that are dropped.
std::vector<int> Contacts::search_pairs(double& reset, std::span<const std::uint8_t> still) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point began = Clock::now();
  std::vector<int> fresh;
  // A blow is predicted once its pair is evaluated, look_ahead steps before it (`MotionBounds`), in one step of foresee_every. A pair that
  // is listed later meets it at whatever step there is. The list lasts until half of the time has passed.
  const double ahead = 2 * (1.5 * look_ahead + foresee_every) * std::max(macro_dt(state_.time), state_.time.last_dt);
  reset += search(
      state_.contacts.list, bodies_.shapes, bodies_.block, state_.topology.loose, jointed_,
      [this](int a, int b) { return bodies_.law(a, b); }, ahead, still, &fresh);
  searched_ += std::chrono::duration<double>(Clock::now() - began).count();
  return fresh;
}

// Pairs of two sleepers, or of a sleeper and a fixed block, are evaluated once more, without dashpots, and then skipped.
void Contacts::sort() {
  OverlapRoom room;
  sleep_.sort(involved_, [&](int i) {
    ContactPair& pair = state_.contacts.list.pair[z(i)];
    pair.damping = PairWrench{}, pair.lag = 0;
    ContactPair copy = pair;
    PairResult r;
    pair_force(copy, bodies_.shapes, bodies_.block[z(pair.a)], bodies_.block[z(pair.b)], forces_.settings(), 0.0, true, room, r);
    return r;
  });
  motion_.select(sleep_);
  find_still();
  bound_.bound_elsewhere();
  unsorted_ = false;
  sums_.list_pairs();
}

// Finds sleepers with the pose of the last search: the list has all their neighbours.
void Contacts::find_still() {
  const PairList& list = state_.contacts.list;
  const std::vector<ContactBlock>& block = bodies_.block;
  still_.clear();
  if (state_.sleep.count == 0 || list.u.size() != block.size()) return;
  still_.assign(block.size(), 0);
  for (int b = 0; b < model_.nblock; ++b)
    still_[z(b)] = sleep_.asleep(b) && block[z(b)].u == list.u[z(b)] && block[z(b)].rotation == list.rotation[z(b)];
}

bool Contacts::sleep(const Excitation& now, const double* contact_wrench) {
  const bool changed = sleep_.update(now, contact_wrench, bodies_.shapes, bodies_.block);
  unsorted_ = unsorted_ || changed;
  return changed;
}

void Contacts::end_sums(bool levels, const StepLoads& loads) {
  sums_.end();
  if (levels) start_macro_step();
  forces_.balance_threads();
  bound_.end(forces_, former_, sleep_, motion_, loads, may_have_levels_ && divides(state_.time));
}

std::vector<std::uint8_t> Contacts::blocks_with_slow_pair() const {
  std::vector<std::uint8_t> out(z(model_.nblock), 0);
  for (int i = 0; i < int(state_.contacts.list.pair.size()); ++i)
    if (forces_.slow(i)) out[z(motion_.pair(i).a)] = out[z(motion_.pair(i).b)] = 1;
  return out;
}

void Contacts::list_fast_pairs() {
  fast_.clear();
  for (const int i : sleep_.live())
    if (!forces_.slow(i)) fast_.push_back(i);
  motion_.select_fast(fast_);
  forces_.share_fast(fast_);
  fast_blocks_.clear();
  for (const int i : fast_) fast_blocks_.push_back(motion_.pair(i).a), fast_blocks_.push_back(motion_.pair(i).b);
  std::ranges::sort(fast_blocks_);
  fast_blocks_.erase(std::unique(fast_blocks_.begin(), fast_blocks_.end()), fast_blocks_.end());
}

// Pairs become slow or fast for this macro step.
void Contacts::start_macro_step() {
  std::vector<std::uint8_t> was_slow(z(model_.nblock), 0), is_slow = was_slow;
  for (int i = 0; i < int(state_.contacts.list.pair.size()); ++i) {
    const MotionBounds::PairBound& pair = motion_.pair(i);
    const bool slow = state_.time.substeps > 1 && bound_.loose(pair.a, pair.b);
    if (forces_.slow(i)) was_slow[z(pair.a)] = was_slow[z(pair.b)] = 1;
    if (slow) is_slow[z(pair.a)] = is_slow[z(pair.b)] = 1;
    if (slow != forces_.slow(i)) forces_.set_slow(i, slow);
  }
  block_levels_.start_macro_step(was_slow, std::move(is_slow));
  list_fast_pairs();
}

void Contacts::add_up_substep(double* kick) {
  block_levels_.substep();
  sums_.add_up_substep(fast_blocks_, kick);
}

void Contacts::soften_former_joints(double most, bool find, double dt) {
  const ContactSettings& settings = forces_.settings();
  const bool changed = find ? former_.find_softening(settings, sleep_, most, dt) : former_.soften(settings, sleep_, most, dt);
  if (changed) forces_.mark_changed();
}

// Joints of one pair of blocks are adjacent. They are released together, once none is intact and one is beyond its range.
std::vector<int> Contacts::ready_joints(const Cracked& cracked) const {
  std::vector<int> ready;
  const std::vector<JointStage>& stage = state_.joints.stage;
  for (int j = 0; j < model_.njoint;) {
    const Joint& one = model_.joint[z(j)];
    int end = j + 1;
    while (end < model_.njoint && model_.joint[z(end)].a == one.a && model_.joint[z(end)].b == one.b) ++end;
    bool any = false, holds = false;
    for (int k = j; k < end; ++k) {
      any = any || (stage[z(k)] == JointStage::cracked && cracked.ready_for_contact(k));
      holds = holds || stage[z(k)] == JointStage::intact;
    }
    for (int k = j; any && !holds && k < end; ++k)
      if (stage[z(k)] == JointStage::cracked) ready.push_back(k);
    j = end;
  }
  return ready;
}

std::vector<int> Contacts::release_joints(Cracked& cracked) {
  if (cracked.none_ready_for_contact()) return {};
  const std::vector<int> released = ready_joints(cracked);
  if (released.empty()) return released;
  cracked.store();
  for (const int j : released) {
    state_.joints.stage[z(j)] = JointStage::contact;
    for (const int b : {model_.joint[z(j)].a, model_.joint[z(j)].b}) state_.topology.loose[z(b)] = model_.kind[z(b)] != Kind::fixed;
  }
  initialise();
  list_involved();
  // All poses, because the last update depends on when this run was started or resumed.
  motion_.update_all(nullptr);
  // Only the blocks of these joints have new neighbours, unless a search of all is due.
  std::vector<std::uint8_t> others(state_.contacts.list.valid ? z(model_.nblock) : 0, 1);
  for (const int j : released)
    for (const int b : {model_.joint[z(j)].a, model_.joint[z(j)].b})
      if (!others.empty()) others[z(b)] = 0;
  double reset = 0;
  std::vector<int> fresh = search_pairs(reset, others);
  former_.add_reset(reset);
  former_.release(released);
  std::erase_if(fresh, [this](int i) { return state_.contacts.list.pair[z(i)].former_joint != 0; });
  former_.add_reset(-former_.start_fresh(fresh));
  rebuild_lists();
  return released;
}

}  // namespace erbs
