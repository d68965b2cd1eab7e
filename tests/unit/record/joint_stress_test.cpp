// Stresses of one joint, intact and cracked, against its own resultants and formulas on paper.
#include "engine/record/recorders/joint_stress.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/analysis/start/prepare.h"
#include "engine/joints/response.h"
#include "engine/record/recorders/joint_condition.h"
#include "lua/language/script.h"

using namespace erbs;
using namespace erbs::lua;
using analysis::Prepared;

namespace {

constexpr double bed_length = 0.3, bed_width = 0.2, face = bed_length * bed_width;  // m, m, m2: length along the bending

Prepared bed(const std::string& law, const std::string& rule = "simpson") {
  Script script(Script::Options{.quiet = true});
  return analysis::prepare(script.load_text("material{name='brick', density=1800}\njoint{law=" + law + ", rule='" + rule +
                                                "', points={3,3}}\n"
                                                "box{name='foot', size={.3,.2,.1}, at={0,0,-.1}, material='brick', fixed=true}\n"
                                                "box{name='b', size={.3,.2,.1}, at={0,0,0}, material='brick'}\nanalysis{duration=1}",
                                            "bed.lua"),
                           false);
}

// The joint at rotation `turn` about the axis across the longer side, closing `down` at its centre and slip `slip` along that side.
struct Bent {
  Prepared run;
  std::array<double, 6> force{};
  Bent(const std::string& law, const std::string& rule = "simpson") : run(bed(law, rule)) {}
  JointStress at(double down, double turn, double slip = 0) {
    const Model& m = run.model;
    const Joint& joint = m.joint[0];
    const bool long_s = joint.type->half_s > joint.type->half_t;
    State& s = run.state;
    JointMemory& memory = s.joints.memory[0];
    double gap[6] = {long_s ? slip : 0, long_s ? 0 : slip, -down, long_s ? 0 : turn, long_s ? turn : 0, 0};
    JointEnergy energy;
    const bool intact = s.joints.stage[0] == JointStage::intact;
    s.joints.stage[0] = JointStage::cracked;
    respond(m, 0, intact && stays_intact(m, joint, gap), memory.gap, gap, past_of(m, s, 0), memory.resultant, energy);
    std::copy_n(gap, 6, memory.gap);
    force = joint_resultant(m, s.joints, s.pose, 0);
    return joint_stress(m, s.joints, s.pose, 0);
  }
  double moment() const { return std::hypot(force[3], force[4]); }
};

const std::string dry_bed = "dry{kn=1e10, mu=0.6}";

}  // namespace

TEST_CASE("the edge of a bed has N / A + 6 M / (t b^2) while closed, 2 N / (3 t (b / 2 - e)) once open", "[record][joint_stress]") {
  const std::string law =
      GENERATE(as<std::string>{}, dry_bed, "mortar{kn=1e10, ft=0, c=0, mu=0.6}", "mortar{kn=1e10, ft=5*MPa, c=9*MPa, mu=.6}");
  const std::string rule = GENERATE(as<std::string>{}, "simpson", "gauss");
  const double b = bed_length, t = bed_width;
  const bool bonded = law.find("5*MPa") != std::string::npos;
  for (const double turn : {0.0, 2e-4, 5e-4, 1e-3, 3e-3}) {
    Bent joint(law, rule);
    const JointStress s = joint.at(1e-4, turn);
    const double N = -joint.force[2], M = joint.moment(), e = M / N;
    CHECK(s.normal == Approx(-N / face));
    if (bonded || e <= b / 6) {
      CHECK(s.least == Approx(-N / face - 6 * M / (t * b * b)));
      CHECK(s.greatest == Approx(-N / face + 6 * M / (t * b * b)).margin(1));
    } else {
      CHECK(s.least == Approx(-2 * N / (3 * t * (b / 2 - e))));
      CHECK(s.greatest == 0);
    }
  }
}

TEST_CASE("shear stress is the shear force over the area, at most the bond and friction of a point", "[record][joint_stress]") {
  Bent intact("mortar{kn=1e10, ks=4e9, ft=5*MPa, c=9*MPa, mu=.6}"), slides(dry_bed);
  const JointStress s = intact.at(1e-4, 0, 1e-5);
  CHECK(s.shear == Approx(4e9 * 1e-5));
  CHECK(s.greatest_shear == Approx(4e9 * 1e-5));
  slides.at(1e-4, 0, 0);
  const JointStress d = slides.at(1e-4, 0, 1e-2);
  CHECK(d.shear == Approx(0.6 * 1e6));
  CHECK(d.greatest_shear == Approx(0.6 * 1e6).epsilon(0.35));  // a point bears its share of N by Simpson's weights
}

TEST_CASE("the tension of a bond that softens lies below its strength", "[record][joint_stress]") {
  Bent joint("mortar{kn=1e10, ft=0.2*MPa, c=0.5*MPa, mu=.6, Gf1=20}");
  double most = 0;
  for (const double opening : {1e-5, 2e-5, 4e-5, 8e-5, 1.5e-4, 1.9e-4, 2.2e-4}) {
    const JointStress s = joint.at(-opening, 0);
    CHECK(s.normal == Approx(s.greatest));
    CHECK(s.greatest == Approx(std::max(0.0, 0.2e6 * std::min(opening / 2e-5, (2e-4 - opening) / (2e-4 - 2e-5)))).margin(1));
    most = std::max(most, s.greatest);
  }
  CHECK(most == Approx(0.2e6));
}

TEST_CASE("a crushed bed shows fc on a plateau, what is left of it with a fracture energy, and its damage", "[record][joint_stress]") {
  Bent plateau("mortar{kn=1e10, ft=0, c=0, mu=.6, fc=2*MPa}"), soft("mortar{kn=1e10, ft=0, c=0, mu=.6, fc=2*MPa, Gc=3200}");
  const double elastic = 2e-4, spent = 3.2e-3;  // m, fc / kn; 2 Gc / fc
  CHECK(plateau.at(0.5 * elastic, 0).least == Approx(-1e6));
  CHECK(joint_damage(soft.run.model, soft.run.state.joints, 0) == 0);
  for (const double closing : {2e-4, 5e-4, 1e-3, 2e-3, 3e-3}) {
    CHECK(plateau.at(closing, 0).least == Approx(-2e6));
    const JointStress s = soft.at(closing, 0);
    const double lost = (closing - elastic) / (spent - elastic);
    CHECK(s.normal == Approx(-2e6 * (1 - lost)));
    CHECK(s.least == Approx(s.normal));
    CHECK(joint_crushing(soft.run.model, soft.run.state.joints, 0) == Approx(lost).margin(1e-9));
    CHECK(joint_damage(soft.run.model, soft.run.state.joints, 0) == (closing > elastic ? 1 : 0));
  }
  CHECK(soft.at(3.3e-3, 0).least == 0);
  CHECK(joint_crushing(plateau.run.model, plateau.run.state.joints, 0) == 0);
  CHECK(joint_damage(plateau.run.model, plateau.run.state.joints, 0) == 0);  // nothing is lost on a plateau
  // A toe that is crushed: the strength is lost from its edge, the rest bears.
  Bent toe("mortar{kn=1e10, ft=0, c=0, mu=.6, fc=2*MPa, Gc=3200}");
  JointStress s;
  for (const double part : {0.2, 0.4, 0.6, 0.8, 1.0}) s = toe.at(part * 1e-4, part * 4e-3);
  CHECK(s.least >= -2e6 * (1 + 1e-9));
  const double crushing = joint_crushing(toe.run.model, toe.run.state.joints, 0);
  CHECK(crushing > 0);
  CHECK(crushing < 0.2);
  soft.run.state.joints.stage[0] = JointStage::contact;
  CHECK(joint_stress(soft.run.model, soft.run.state.joints, soft.run.state.pose, 0).least == 0);
}
