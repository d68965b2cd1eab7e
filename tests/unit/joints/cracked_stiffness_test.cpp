// A cracking joint softens in every direction, for every rule, damage and neutral line. The default time step relies on it.
#include <catch2/catch.hpp>

#include <random>

#include "engine/joints/response.h"
#include "engine/solve/linear/stiffness.h"
#include "tests/support/small_wall.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

Mat6 intact_form(const Joint& joint) {
  Mat6 k = Mat6::Zero();
  for (int i = 0; i < 6; ++i) k(i, i) = joint.type->stiffness[i];
  return k;
}

// Tangent by central differences at fixed history: displacements are too small to cause damage.
Mat6 tangent(const Model& m, int j, const std::vector<PointHistory>& history, const Vec6& q, double length) {
  const Joint& joint = m.joint[std::size_t(j)];
  Mat6 k;
  for (int c = 0; c < 6; ++c) {
    Vec6 f[2];
    const double h = 1e-6 * length / (c < 3 ? 1 : joint.type->radius);
    for (int side = 0; side < 2; ++side) {
      Vec6 at = q;
      at[c] += side == 0 ? -h : h;
      std::vector<PointHistory> copy = history;
      JointEnergy e;
      respond(m, j, false, q.data(), at.data(), &copy[std::size_t(joint.first_point)], f[side].data(), e);
    }
    k.col(c) = (f[1] - f[0]) / (2 * h);
  }
  return k;
}

// Largest eigenvalue of the cracked tangent relative to a stiffness that should bound it; expected: at most 1.
double against(const Mat6& k, const Mat6& bound) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Mat6>(Mat6(0.5 * (k + k.transpose())), bound).eigenvalues()[5];
}

const char* cohesive_mortar = "mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=5*MPa, mu=0.6, Gf1=1}";  // too much cohesion to slide here

Scene two_blocks(const std::string& rule, const std::string& shape) {
  Script script(Script::Options{.quiet = true});
  return script.load_text(R"(
    material{name="brick", density=1800}
    joint{law=)" + std::string(cohesive_mortar) +
                              R"(, thickness=10*mm, tolerance=0.1*mm, )" + rule + R"(}
    box{name="foot", size={.5,.5,.1}, at={-.1,-.1,-.11}, material="brick", fixed=true}
    analysis{duration=1}
  )" + shape,
                          "two_blocks.lua");
}

}  // namespace

TEST_CASE("a cracked joint is nowhere stiffer than a sound one", "[solve][cracked]") {
  const std::string rule = GENERATE("rule=\"simpson\", points={3,3}", "rule=\"simpson\", points={5,4}", "rule=\"gauss\", points={2,2}",
                                    "rule=\"gauss\", points={1,3}", "rule=\"trapezoid\", points={3,2}", "rule=\"midpoint\", points={2,1}",
                                    "rule=\"midpoint\", points={4,4}", "rule=\"trapezoid\", points={2,2}, pressure=\"points\"");
  const std::string shape = GENERATE("box{name=\"b\", size={.25,.125,.1}, at={0,0,0}, material=\"brick\"}",
                                     "prism{name=\"b\", polygon={{0,0},{.3,0},{.25,.2},{.05,.15}}, height=.1, material=\"brick\"}");
  const Prepared run = prepare(two_blocks(rule, shape), false);
  const Model& m = run.model;
  REQUIRE(m.njoint == 1);
  const Joint& joint = m.joint[0];
  const PointLaw& point_law = m.laws[std::size_t(joint.type->law)];
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  double worst = 0;
  for (int turn = 0; turn < 300; ++turn) {
    const double length = 0.2 * point_law.opening_peak;
    Vec6 q = Vec6::Zero();
    q[2] = turn % 3 == 0 ? 0 : length * any(random);
    q[3] = length * any(random) / joint.type->half_t, q[4] = length * any(random) / joint.type->half_s;
    std::vector<PointHistory> history(std::size_t(m.npoint));
    for (PointHistory& h : history) {
      const double kind = any(random);
      scalar::Bond<double> bond{0, 0, 0};
      scalar::damage_to(point_law, bond, kind < 0.3, kind < -0.3 ? 1 : 0.5 + 0.5 * any(random));
      h.damage = bond.damage, h.secant = bond.secant, h.kappa = bond.kappa;
    }
    worst = std::max(worst, against(tangent(m, 0, history, q, length), stiffest(joint)));
  }
  INFO(rule << " " << shape);
  CHECK(worst <= 1 + 1e-6);
  CHECK(worst > 0.5);
}

TEST_CASE("cells of sound points and the closed compression make the sound joint", "[solve][cracked]") {
  const std::string rule = GENERATE("rule=\"simpson\", points={3,3}", "rule=\"simpson\", points={6,5}", "rule=\"gauss\", points={2,3}",
                                    "rule=\"trapezoid\", points={2,2}, pressure=\"points\"");
  const std::string shape = GENERATE("box{name=\"b\", size={.25,.125,.1}, at={0,0,0}, material=\"brick\"}",
                                     "prism{name=\"b\", polygon={{0,0},{.3,0},{.25,.2},{.05,.15}}, height=.1, material=\"brick\"}");
  const Prepared run = prepare(two_blocks(rule, shape), false);
  const Model& m = run.model;
  const Joint& joint = m.joint[0];
  const double length = 0.2 * m.laws[std::size_t(joint.type->law)].opening_peak;
  for (int turn = 0; turn < 50; ++turn) {
    Vec6 q, f;
    for (int i = 0; i < 6; ++i) q[i] = length * std::sin(2.3 * turn + 1.7 * i) / (i < 3 ? 1 : joint.type->radius);
    std::vector<PointHistory> history(std::size_t(m.npoint));
    JointEnergy e;
    respond(m, 0, false, q.data(), q.data(), history.data(), f.data(), e);
    const Vec6 intact = intact_form(joint) * q;
    INFO(rule << " " << shape);
    for (int i = 0; i < 6; ++i)
      CHECK(std::fabs(f[i] - intact[i]) * (i < 3 ? 1 : 1 / joint.type->radius) < 1e-12 * joint.type->stiffness[2] * length);
    CHECK(e.elastic == Approx(0.5 * intact.dot(q)).epsilon(1e-12));
    CHECK(e.fracture == 0);
  }
}

TEST_CASE("over a crack the work of a joint is stored or booked", "[solve][cracked][energy]") {
  // Bending and tension grow until all points have failed. Steps are small compared to the opening at peak stress.
  const std::string kind = GENERATE("", ", Gf1=1");
  Script script(Script::Options{.quiet = true});
  const Prepared run = prepare(script.load_text(R"(
    material{name="brick", density=1800}
    joint{law=mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=5*MPa, mu=0.6)" +
                                                    kind + R"(}, thickness=10*mm, tolerance=0.1*mm}
    box{name="foot", size={.5,.5,.1}, at={-.1,-.1,-.11}, material="brick", fixed=true}
    box{name="b", size={.25,.125,.1}, at={0,0,0}, material="brick"} analysis{duration=1})",
                                                "crack.lua"),
                               false);
  const Model& m = run.model;
  const Joint& joint = m.joint[0];
  const double peak = m.laws[std::size_t(joint.type->law)].opening_peak, end = kind.empty() ? 10 : 90;
  std::vector<PointHistory> history(std::size_t(m.npoint));
  Vec6 before = Vec6::Zero(), f_before = Vec6::Zero();
  double work = 0, booked = 0, elastic = 0;
  bool intact = true;
  const int steps = 20000;
  for (int step = 1; step <= steps; ++step) {
    const double x = end * peak * step / steps;
    Vec6 q = Vec6::Zero(), f;
    q[2] = 0.3 * x, q[3] = 0.4 * x / joint.type->half_t, q[4] = x / joint.type->half_s;
    JointEnergy e;
    intact = respond(m, 0, intact, before.data(), q.data(), history.data(), f.data(), e) && intact;
    work += 0.5 * (f + f_before).dot(q - before);
    booked += e.fracture + e.friction;
    elastic = e.elastic;
    before = q, f_before = f;
  }
  CHECK(!intact);
  CHECK(booked > 0);
  CHECK(std::fabs(work - elastic - booked) < 1e-5 * work);
}

TEST_CASE("a joint that was crushed is nowhere stiffer than a sound one, and past its ultimate closing bears no tension",
          "[solve][cracked]") {
  Script script(Script::Options{.quiet = true});
  const Prepared run = prepare(script.load_text(R"(
    material{name="brick", density=1800}
    joint{law=mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=5*MPa, mu=0.6, Gf1=1, fc=200*kPa, uc_ultimate=8e-6}, thickness=10*mm, tolerance=0.1*mm}
    box{name="foot", size={.5,.5,.1}, at={-.1,-.1,-.11}, material="brick", fixed=true}
    prism{name="b", polygon={{0,0},{.3,0},{.25,.2},{.05,.15}}, height=.1, material="brick"} analysis{duration=1})",
                                                "crushed.lua"),
                               false);
  const Model& m = run.model;
  const Joint& joint = m.joint[0];
  const double limit = 2e-6;  // fc / kn
  std::vector<PointHistory> history(std::size_t(m.npoint));
  CrushedFace crushed;
  const auto answer = [&](const Vec6& from, const Vec6& to, CrushedFace& face, std::vector<PointHistory>& points) {
    Vec6 f;
    JointEnergy e;
    respond(m, 0, false, from.data(), to.data(), {points.data(), &face}, f.data(), e);
    return f;
  };
  Vec6 rest = Vec6::Zero(), pressed = rest, pulled = rest;
  pressed[2] = -2 * limit, pressed[3] = 0.8 * limit / joint.type->half_t, pressed[4] = -0.4 * limit / joint.type->half_s;
  pulled[2] = 0.1 * limit;
  answer(rest, pressed, crushed, history);
  REQUIRE(crushed.planes == 1);
  for (int turn = 0; turn < 40; ++turn) {
    Vec6 at = pressed * (0.9 - 0.02 * turn);
    at[4] += 0.3 * limit * std::sin(turn) / joint.type->half_s;
    Mat6 k;
    for (int c = 0; c < 6; ++c) {
      const double h = 1e-5 * limit / (c < 3 ? 1 : joint.type->radius);
      Vec6 f[2];
      for (int side = 0; side < 2; ++side) {
        CrushedFace face = crushed;
        std::vector<PointHistory> points = history;
        Vec6 to = at;
        to[c] += side == 0 ? -h : h;
        f[side] = answer(at, to, face, points);
      }
      k.col(c) = (f[1] - f[0]) / (2 * h);
    }
    CHECK(against(k, stiffest(joint)) <= 1 + 1e-6);
  }
  CHECK(answer(pressed, pulled, crushed, history)[2] > 0.9 * joint.type->stiffness[2] * pulled[2]);
  Vec6 deep = rest;
  deep[2] = -5 * limit;
  answer(pulled, deep, crushed, history);
  CHECK(answer(deep, pulled, crushed, history)[2] == 0);
}

TEST_CASE("friction of a joint follows the pressure of its springs and of their dashpots", "[cracked]") {
  const Prepared run = prepare(test::small_wall("analysis{duration=1}", "dry{kn=1e10, mu=0.5}"), false);
  const Model& m = run.model;
  const Joint& joint = m.joint[0];
  for (const double closing : {-2e-7, 0.0, 2e-7}) {  // m, in the step
    std::array<double, 6> before{0, 0, -1e-6 + closing, 0, 0, 0}, now{1e-4, 0, -1e-6, 0, 0, 0}, f{}, drag{};
    std::vector<PointHistory> history(std::size_t(joint.type->points)), first = history;
    std::vector<double> limit(history.size());
    JointPast past(history.data());
    past.rate = 0.8;
    JointEnergy e;
    respond(m, 0, false, before.data(), now.data(), past, f.data(), e, limit.data());
    viscous_response(m, 0, before.data(), now.data(), first.data(), past, limit.data(), past.rate, drag.data());
    CHECK(std::hypot(f[0], f[1]) == Approx(0.5 * -(f[2] + drag[2])).epsilon(1e-12));
    CHECK(drag[2] * closing <= 0);
  }
}
