// The law of a pair is written once, for a number and for a pack: both give the same bits, at states of all kinds.
#include "engine/contact/law/pair_law.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <memory>
#include <random>

#include "engine/base/rotation.h"
#include "engine/contact/law/frame.h"
#include "engine/contact/law/pair.h"
#include "engine/contact/law/point_friction.h"
#include "engine/contact/overlap/ramp.h"

using namespace erbs;

namespace {

struct Draw {
  std::mt19937 random{11};
  double operator()(double a = 1) { return a * (2 * std::uniform_real_distribution<double>()(random) - 1); }
  double positive(double a = 1) { return a * std::uniform_real_distribution<double>()(random); }
  Vec3 vec(double a = 1) { return {(*this)(a), (*this)(a), (*this)(a)}; }
  bool one_in(int n) { return random() % unsigned(n) == 0; }
};

ContactBlock random_block(Draw& draw) {
  ContactBlock b;
  b.u = draw.vec(0.01), b.v = draw.vec(), b.w = draw.vec(3), b.rest = draw.vec(0.3);
  b.rotation = rotation(draw.vec(2)).toRotationMatrix();
  b.inverse_mass = draw.one_in(9) ? 0 : 0.1 + draw.positive();
  const Vec3 inertia(draw.positive(100), draw.positive(100), draw.one_in(3) ? 1e5 : draw.positive(100));  // some are slender
  b.inverse_tensor = b.inverse_mass * (b.rotation * inertia.asDiagonal() * b.rotation.transpose());
  b.inverse_inertia = b.inverse_mass * inertia.maxCoeff();
  return b;
}

// A pair whose springs pull with about its limit, and the sums of its patch: a rectangle, sometimes a line or a point.
void random_pair(Draw& draw, const ContactBlock& reference, const ContactBlock& other, ContactPair& pair, OverlapSums& sums) {
  const double a = draw.one_in(6) ? 0 : draw.positive(0.3), b = draw.one_in(6) ? 0 : draw.positive(0.1), area = 0.01 + a * b,
               phi = draw.positive(1e-4);
  const Mat3 axes = rotation(draw.vec(3)).toRotationMatrix();
  const Vec3 n = axes.col(2), x = draw.vec(0.1), centre = x + axes.col(0) * draw(a / 4), force = area * phi * n;
  const Mat3 second = area * (axes * Vec3(a * a / 12, b * b / 12, 0).asDiagonal() * axes.transpose() + x * x.transpose());
  sums = {};
  sums.total = draw.one_in(20) ? 0 : area * phi, sums.area = area;
  const double six[6] = {second(0, 0), second(1, 1), second(2, 2), second(0, 1), second(1, 2), second(2, 0)};
  std::copy_n(six, 6, sums.second);
  const Vec3 pressure = sums.total * centre, first = area * x, moment = centre.cross(force);
  for (int i = 0; i < 3; ++i)
    sums.pressure[i] = pressure[i], sums.centroid[i] = first[i], sums.force[i] = force[i], sums.moment[i] = moment[i];
  pair.law = {1e10, 4e9, draw.one_in(8) ? 0 : draw.positive(), 0.3, draw.one_in(4) ? Hop{} : Hop{draw.positive(1e-3), draw.positive(1e-3)}};
  pair.impact = draw.positive(3);
  const Mat3 back = reference.rotation.transpose();
  pair.rotation = rotation(draw.vec(1e-6)).toRotationMatrix() * back * other.rotation;
  pair.shift = back * (other.rest - reference.rest + other.u - reference.u) + draw.vec(1e-7);
  pair.n = (n + draw.vec(draw.one_in(9) ? 3 : 1e-3)).normalized();
  pair.c = x + pair.shift + draw.vec(1e-3);
  pair.area = area * draw.positive(2), pair.gyration = draw.positive(0.2);
  const double reach = pair.law.mu * pair.law.kn * force.norm() / (pair.law.ks * area);
  pair.u = draw.vec(2 * reach), pair.psi = draw(20 * reach);
  pair.peak_closing_speed = draw.one_in(3) ? 0 : draw.positive(2);
  pair.tangential = draw.positive(1e-3);
  pair.lag = draw.one_in(2) ? 0 : draw(1e4 * area);
  pair.mean_normal_force = draw.one_in(3) ? 0 : draw.positive(2e6 * area);
  pair.lent = draw.one_in(3) ? 0 : draw.positive(1e-4 * pair.mean_normal_force);
  for (PairWrench* w : {&pair.friction, &pair.damping}) *w = {draw.vec(100), draw.vec(10), draw.vec(10)};
  pair.b_is_reference = draw.one_in(2);
  pair.touching = 1;
}

// Number `row` of lane l.
template <int n>
double number(const PairPackOf<n>& w, std::size_t row, int l) {
  double x;
  std::memcpy(&x, reinterpret_cast<const char*>(&w) + (row * std::size_t(n) + std::size_t(l)) * sizeof x, sizeof x);
  return x;
}
template <int n>
std::size_t row_of(const PairPackOf<n>& w, const double* of) {
  return std::size_t(of - reinterpret_cast<const double*>(&w)) / std::size_t(n);
}

// Numbers that differ between lane l and a pair alone, of the rows from `first` of `count`.
int different(const PairPack& w, const OnePair& one, int l, const double* first, const double* first_one, std::size_t count) {
  int sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = number(w, row_of(w, first) + i, l), y = number(one, row_of(one, first_one) + i, 0);
    sum += std::memcmp(&x, &y, sizeof x) != 0;
  }
  return sum;
}

template <class T>
void until_friction(scalar::PairPackFor<T>& w, const PairSettings& settings) {
  scalar::patch<T>(w, settings);
  scalar::dashpot<T>(w, settings);
  scalar::lagging<T>(w);
  scalar::springs<T>(w, settings);
}

}  // namespace

TEST_CASE("a number and a pack obey one law of a pair, to the last bit", "[contact]") {
  Draw draw;
  const auto pack = std::make_unique<PairPack>(), other = std::make_unique<PairPack>();
  const auto alone = std::make_unique<OnePair[]>(8);
  int sure = 0, sticking = 0, slipping = 0, braking = 0, lagging = 0, points = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    ContactPair pair[8];
    ContactBlock block[8][2];
    const PairSettings settings = pair_settings({.falling_mass = 100, .gravity = 9.81}, trial % 10 == 0 ? 0 : 1e-5);
    *pack = {}, *other = {};
    for (int l = 0; l < 8; ++l) {
      OnePair& one = alone[std::size_t(l)];
      one = {};
      for (ContactBlock& b : block[l]) b = random_block(draw);
      random_pair(draw, block[l][0], block[l][1], pair[l], one.sums[0]);
      pack->sums[l] = one.sums[0];
      const double contacts = 1 + double(l % 4);
      set_lane(*pack, l, pair[l], block[l][0], block[l][1], contacts);
      set_lane(one, 0, pair[l], block[l][0], block[l][1], contacts);
      pack->max_depth[l] = one.max_depth[0] = draw.positive(1e-4);
      pack->closing_speed[l] = one.closing_speed[0] = draw();
      for (int i = 0; i < 4; ++i) pack->damping[i][l] = one.damping[i][0] = draw(1e-7);
      scalar::gather_pairs<double>(one);
      until_friction<double>(one, settings);
    }
    scalar::gather_pairs<scalar::Pack>(*pack);
    until_friction<scalar::Pack>(*pack, settings);
    for (int l = 0; l < 8; ++l) sure += pack->holds[l] > 0;
    scalar::return_map<scalar::Pack>(*pack, *other);
    for (int l = 0; l < 8; ++l) {
      OnePair& one = alone[std::size_t(l)];
      scalar::return_map<double>(one);
      REQUIRE(one.holds[0] == pack->holds[l]);
      if (!(one.holds[0] > 0)) return_point(one), return_point(*pack, l), ++points;
      scalar::finish<double>(one, settings);
      slipping += one.slips[0] > 0, sticking += !(one.slips[0] > 0), braking += one.share[0] > 0 && one.share[0] < 1;
      lagging += one.lag_stiffness[0] > 0;
    }
    scalar::finish<scalar::Pack>(*pack, settings);
    for (int l = 0; l < 8; ++l) {
      const OnePair& one = alone[std::size_t(l)];
      INFO("trial " << trial << " lane " << l);
      const std::size_t before = row_of(one, one.shift[2]) + 1 - row_of(one, one.p[0]),
                        after = row_of(one, one.result[0]) + 8 * result_rows - row_of(one, one.max_depth);
      CHECK(different(*pack, one, l, pack->p[0], one.p[0], before) == 0);
      CHECK(different(*pack, one, l, pack->max_depth, one.max_depth, after) == 0);
    }
  }
  INFO("sure " << sure << " sticking " << sticking << " slipping " << slipping << " braking " << braking << " lagging " << lagging
               << " points " << points);
  CHECK(sure > 500);
  CHECK(sticking > 2000);
  CHECK(slipping > 2000);
  CHECK(braking > 100);
  CHECK(lagging > 100);
  CHECK(points > 500);
}

TEST_CASE("a number and a pack clamp a dashpot alike, to the last bit", "[contact]") {
  Draw draw;
  int changed = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    double f[3][8], s[3][8], x[3][3][8], size[8], change[4][8];
    scalar::Pack pf[3], ps[3], px[3][3], out[4];
    for (int l = 0; l < 8; ++l) {
      size[l] = draw.positive();
      for (int k = 0; k < 3; ++k) {
        f[k][l] = draw.positive(), s[k][l] = draw(3);
        for (int i = 0; i < 3; ++i) x[k][i][l] = draw();
      }
    }
    for (int k = 0; k < 3; ++k) {
      pf[k] = scalar::load(f[k]), ps[k] = scalar::load(s[k]);
      for (int i = 0; i < 3; ++i) px[k][i] = scalar::load(x[k][i]);
    }
    scalar::clamp_change<scalar::Pack>(pf, ps, px, scalar::load(size), 1, scalar::Mask::of_bits(0xff), out);
    for (int k = 0; k < 4; ++k) scalar::store(change[k], out[k]);
    for (int l = 0; l < 8; ++l) {
      double of[3], os[3], ox[3][3], one[4];
      for (int k = 0; k < 3; ++k) {
        of[k] = f[k][l], os[k] = s[k][l];
        for (int i = 0; i < 3; ++i) ox[k][i] = x[k][i][l];
      }
      scalar::clamp_change<double>(of, os, ox, size[l], 1, true, one);
      for (int k = 0; k < 4; ++k) CHECK(one[k] == change[k][l]);
      changed += one[0] != 0;
    }
  }
  CHECK(changed > 1000);
}
