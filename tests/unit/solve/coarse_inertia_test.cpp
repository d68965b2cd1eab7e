// The coarse inertia of relaxations: what it does to a motion of its pieces and to one that is not, and that its work is accounted for.
#include "engine/solve/coarse_inertia.h"

#include <catch2/catch.hpp>

#include "engine/analysis/quasi_static/push_run.h"
#include "engine/analysis/start/prepare.h"
#include "engine/base/units.h"
#include "engine/record/format/csv.h"
#include "engine/solve/linear/stiffness.h"
#include "engine/solve/step.h"
#include "tests/unit/lua/load.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

std::string tower(int courses, const std::string& more, double kn = 1e12) {
  return fmt::format(R"(
    local kn = {:g}
    material{{ name = "stone", density = 2000, kn = kn, ks = .4 * kn }}
    box{{ name = "floor", size = {{6, 6, .5}}, at = {{-3, -3, -.5}}, fixed = true }}
    wall{{ brick = {{ length = .4, width = .2, height = .2 }}, length = 1.6, courses = {}, joint = 0, at = {{-.8, -.1, 0}}, material = "stone",
      quiet = true }}
    joint{{ law = dry{{ kn = kn, ks = .4 * kn, mu = .6 }} }}
  )",
                     kn, courses) +
         more;
}

Prepared prepared(int courses) {
  Script script(quiet());
  return prepare(script.load_text(tower(courses, "analysis{ duration = 1 }"), "tower.lua", {}), false);
}

Metrics pushed(const std::string& text, const std::string& dir, int threads) {
  Script script(quiet());
  RunOptions options;
  options.directory = dir, options.threads = threads;
  return run_push(script.load_text(text, "tower.lua", {}), text, options).metrics;
}

}  // namespace

TEST_CASE("a motion of rigid pieces takes part in the coarse inertia as a whole, any other in part", "[solve][coarse]") {
  const Prepared run = prepared(30);
  const Freedom f = grounded_freedoms(run.model, run.state);
  const Sparse k = stiffness(run.model, run.state, f);
  for (const int size : {10, 40, 1000}) {
    CAPTURE(size);
    const CoarseInertia inertia(run.model, run.state, f, size);
    REQUIRE(inertia.definite());
    const RigidPieces pieces(run.model, run.state, f, size);
    std::srand(1);
    VecX rigid(f.count), free = VecX::Random(f.count), of_piece = VecX::Random(6 * pieces.count());
    for (int i = 0; 6 * i < f.count; ++i) rigid.segment<6>(6 * i) = pieces.carried(i, of_piece.segment<6>(6 * pieces.of(i)));
    const auto force = [&](const VecX& x) { return VecX(k.selfadjointView<Eigen::Lower>() * x); };
    CHECK(inertia.share(force(rigid), rigid) == Approx(1).epsilon(1e-9));
    const double share = inertia.share(force(free), free);
    CHECK(share > 0);
    CHECK(share < 0.5);
  }
}

// Its acceleration is rate R K^-1 R^T f: a symmetric and positive form of any two fields of forces.
TEST_CASE("the coarse inertia is symmetric and positive", "[solve][coarse]") {
  const Prepared run = prepared(30);
  const Model& m = run.model;
  CoarseInertia inertia(m, run.state, grounded_freedoms(m, run.state), 20);
  inertia.set_rate(1e4);
  const int groups = int(block_groups(m.nblock));
  const std::size_t count = block_groups(m.nblock);
  std::vector<BlockSums> sums(count);
  const auto field = [&](unsigned seed) {
    std::srand(seed);
    std::vector<VectorPack<6>> out(block_groups(m.nblock), VectorPack<6>{});
    for (int b = 0; b < m.nblock; ++b)
      for (int i = 0; i < 6; ++i)
        if (m.kind[std::size_t(b)] == Kind::moving)
          out[std::size_t(b / pack_size)].x[i][b % pack_size] = std::rand() / double(RAND_MAX) - 0.5;
    return out;
  };
  const auto answer = [&](const std::vector<VectorPack<6>>& force) {  // accelerations
    inertia.gather(force.data(), {0, groups});
    inertia.solve();
    inertia.scatter(run.state, {0, groups}, sums);
    std::vector<Vec6> out;
    for (int b = 0; b < m.nblock; ++b) {
      Vec6 x = Eigen::Map<const Vec6>(inertia.rows() + 8 * b);
      if (m.kind[std::size_t(b)] != Kind::moving) CHECK(x.norm() == 0);
      else x.head<3>() /= m.mass[std::size_t(b)], x.tail<3>() = Vec3(m.inertia[std::size_t(b)].inverse() * Vec3(x.tail<3>()));
      out.push_back(x);
    }
    return out;
  };
  const auto times = [&](const std::vector<VectorPack<6>>& force, const std::vector<Vec6>& x) {
    double sum = 0;
    for (int b = 0; b < m.nblock; ++b)
      for (int i = 0; i < 6; ++i) sum += force[std::size_t(b / pack_size)].x[i][b % pack_size] * x[std::size_t(b)][i];
    return sum;
  };
  const auto f = field(1), g = field(2);
  const auto of_f = answer(f), of_g = answer(g);
  CHECK(times(f, of_f) > 0);
  CHECK(times(g, of_f) == Approx(times(f, of_g)).epsilon(1e-9));
}

// Rigid, a wall of 30 courses overturns at thickness over height, 1/30. Its toe and its sway cost a little: 2.78 million steps without a
// coarse inertia end between .031531 and .031547 g.
TEST_CASE("a slender wall has its capacity by a coarse inertia, with a closed ledger and the same bits on two threads", "[solve][coarse]") {
  const std::string text = tower(30, "analysis{ kind = 'pushover', direction = 'y', step = .008, bracket = .004 }");
  const test::Scratch one("coarse_one"), two("coarse_two");
  const Metrics a = pushed(text, one.path, 1), b = pushed(text, two.path, 2);
  REQUIRE(a.status == "completed");
  CHECK(a.capacity->peak.multiplier == Approx(0.031531).epsilon(0.004));  // the bracket
  CHECK(a.residual_relative < 1e-5);
  CHECK(a.state_hash == b.state_hash);
  CHECK(a.capacity->relaxation_steps < 100000);
}

// The loading machine stiffens what it controls, the more the softer the structure.
TEST_CASE("a slender wall follows a loading machine by a coarse inertia", "[solve][coarse]") {
  const std::string text =
      tower(30, "analysis{ kind = 'pushover', direction = 'y', control = 'displacement', displacement = 1*mm, displacement_step = 1*mm }");
  const test::Scratch folder("coarse_machine");
  const Metrics m = pushed(text, folder.path, 2);
  REQUIRE(m.status == "completed");
  CHECK(m.residual_relative < 1e-5);
  const CsvTable curve = read_csv(folder.path + "/curve.csv");
  // without a coarse inertia: .0299494 and .0301992 g at .8775 and .9900 mm
  const double slope = (0.030199161 - 0.029949438) / (0.990042 - 0.877528), at = 1000 * curve.column("displacement_m").back();
  CHECK(curve.column("multiplier_g").back() == Approx(0.029949438 + slope * (at - 0.877528)).epsilon(1e-3));
}

// A contact that comes or goes changes the step while the pieces swing.
TEST_CASE("the ledger of a coarse inertia closes where the step changes", "[solve][coarse]") {
  for (const double mass_damping : {0.0, 5.0})
    for (const double local : {0.0, 0.02})
      for (const double shorter : {0.9, 0.5, 0.02}) {
        CAPTURE(mass_damping, local, shorter);
        Prepared run = prepared(20);
        Model& m = run.model;
        State& s = run.state;
        m.damping_all = true, m.damping.mass = mass_damping, m.local_damping = local;
        const double dt = s.time.dt *= 0.8;
        CoarseInertia inertia(m, s, grounded_freedoms(m, s), 20);
        inertia.set_rate(std::pow(2 * pi / (40 * dt), 2));
        for (std::size_t b = 0; b < m.kind.size(); ++b)
          if (m.kind[b] == Kind::moving) s.motion.v[b] = Vec3(0.002 * m.rest[b].z(), 0, 0);
        Solver solver(m, s, run.range, 1);
        solver.use(inertia);
        for (int change = 0; change < 20; ++change) {
          for (int step = 0; step < 5; ++step) solver.advance({.next = s.time.t});
          s.time.start_t = s.time.t, s.time.start_step = s.time.step;
          s.time.dt = change % 2 == 0 ? shorter * dt : dt;
        }
        CHECK(s.energy.largest_moving > 1e-3);  // J
        CHECK(s.energy.residual_worst < 1e-8);  // 2e-7 to 8e-7 if the change is not booked
      }
}

// On soft beds a collapse ends in fast motion: all of its work has to be in the ledger all the same. The capacities are those of true
// masses.
TEST_CASE("the ledger of a coarse inertia closes on soft beds too", "[solve][coarse]") {
  for (const auto& [courses, kn, capacity] : {std::tuple{20, 1e9, 0.021250}, {20, 1e10, 0.038867}, {12, 1e10, 0.0}}) {
    const test::Scratch folder("coarse_soft");
    const Metrics m =
        pushed(tower(courses, "analysis{ kind = 'pushover', direction = 'y', step = .01, limit = 'never' }", kn), folder.path, 1);
    CAPTURE(courses, kn);
    REQUIRE(m.status == "completed");
    if (capacity > 0) CHECK(m.capacity->peak.multiplier == Approx(capacity).epsilon(0.002));  // the bracket
    CHECK(m.residual_relative < 1e-5);
  }
}
