// The Scene: the content of a script as plain data in SI units, without behaviour. Each item stores the script line that made it.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/field.h"
#include "engine/base/units.h"
#include "engine/base/vec.h"
#include "engine/geometry/polyhedron.h"
#include "engine/laws/laws.h"
#include "engine/loads/loads.h"
#include "engine/scene/performance.h"
#include "engine/scene/push.h"

namespace erbs {

// Material of a block, with its contact properties as debris (contacts that are not joints, or no longer).
struct Material {
  std::string name;
  double density = 0;            // kg/m3
  double kn = 5e10;              // Pa/m, contact stiffness of debris
  double ks = 2e10;              // Pa/m
  double friction = 0.6;         // coefficient of friction of debris
  double restitution = 0.3;      // of an impact through the centre, 0..1
  Vec3 color{0.70, 0.35, 0.25};  // sRGB 0..1 for the pictures
  Place place;
  std::vector<std::pair<std::string, double>> friction_with;  // coefficients against other materials or its own, by their names

  static Fields<Material> fields() {
    return {
        {"name", &Material::name, "", "name by which blocks refer to it", 0, 0, true},
        {"density", &Material::density, "kg/m3", "mass per volume of the block", 0.01, 1e5, true},
        {"kn", &Material::kn, "Pa/m", "normal stiffness of debris contacts", 1e3, 1e16},
        {"ks", &Material::ks, "Pa/m", "shear stiffness of debris contacts: 0.4 kn unless given", 0, 1e16},
        {"friction", &Material::friction, "", "coefficient of friction of debris contacts", 0, 10},
        {"restitution", &Material::restitution, "", "restitution of a central impact: speed after over before, at least 0.02", 0, 1},
        {"color", &Material::color, "", "red, green, blue for the pictures", 0, 1},
    };
  }
};

// Initial pose and motion of a block, relative to its rest pose. Joints are found in the rest pose.
struct Initial {
  Vec3 position = Vec3::Zero();  // m, added after the rotation
  Vec3 rotation = Vec3::Zero();  // rad, rotation vector, about `about`
  Vec3 velocity = Vec3::Zero();  // m/s, of the centroid
  Vec3 spin = Vec3::Zero();      // rad/s, world axes
  Vec3 about = Vec3::Zero();     // m, point in the rest pose; the centroid if has_about is false
  bool has_about = false;
  bool given = false;

  static Fields<Initial> fields() {
    return {
        {"position", &Initial::position, "m", "displacement from rest", -1e6, 1e6},
        {"rotation", &Initial::rotation, "rad", "rotation vector (axis times angle) from rest", -100, 100},
        {"velocity", &Initial::velocity, "m/s", "velocity of the centroid", -1e4, 1e4},
        {"spin", &Initial::spin, "rad/s", "angular velocity, world axes", -1e5, 1e5},
        {"about", &Initial::about, "m", "point at rest the rotation is about (default the centroid)", -1e6, 1e6},
    };
  }
};

struct Block {
  std::string name;
  std::string group;                       // for joint rules and recorders, e.g. "wall_south"
  Parts parts;                             // m, world axes at rest; usually one; several convex parts are one rigid block
  int material = -1;                       // index into Scene::materials
  bool fixed = false;                      // part of the ground
  bool free = false;                       // allowed to have no joint, or none that leads to the ground
  std::shared_ptr<const Initial> started;  // null: at rest, as built
  // m, joint width of the masonry it was laid in, and the widest joint beside it if the masonry widened one to fill its length; 0: none
  double joint = 0, widest_joint = 0;
  Place place;

  const Initial& initial() const {
    static const Initial rest;
    return started ? *started : rest;
  }

  static Fields<Block> fields() {  // keys common to all kinds of block; each constructor reads its own shape
    return {
        {"name", &Block::name, "", "name, unique (default from the group and a number)"},
        {"group", &Block::group, "", "group, for joint rules and recorders"},
        {"fixed", &Block::fixed, "", "part of the ground"},
        {"free", &Block::free, "", "allowed to have no joint, or no joined path to the ground"},
    };
  }
};

// Joins faces of blocks of group_a and group_b ("" is any) by `law`, if they face each other at rest across at most thickness + tolerance.
// The last rule that matches a pair of blocks wins.
struct JointRule {
  std::string name;
  std::string group_a, group_b;
  Law law;
  double thickness = 0;                   // m, nominal gap at rest
  bool has_thickness = false;             // from the script; else the thickness of the law
  double tolerance = 1e-4;                // m
  std::string rule = "simpson";           // simpson | midpoint | trapezoid | gauss
  int points_long = 3, points_short = 3;  // contact points along the longer and the shorter side of a rectangle
  std::string pressure = "face";          // face: integrated over the face | points: each contact point bears its share of it
  bool none = false;                      // matching pairs get no joint
  bool optional = false;                  // a group may have no blocks in this variant of the scene
  Place place;

  static Fields<JointRule> fields() {
    return {
        {"name", &JointRule::name, "", "name of the rule, for reports"},
        {"thickness", &JointRule::thickness, "m",
         "nominal gap at rest: faces that touch or lie no further apart are joined (default the thickness of the law)", 0, 1},
        {"tolerance", &JointRule::tolerance, "m",
         "largest excess of a gap over `thickness`; a gap that is narrower by more is joined with a warning", 0, 1},
        {"rule", &JointRule::rule, "", "quadrature rule of the contact points", 0, 0, false, "simpson|midpoint|trapezoid|gauss"},
        {"pressure", &JointRule::pressure, "",
         "what bears: the face, its pressure integrated in closed form, or the contact points, each with its share of the area, as the "
         "sub-contacts of point-contact models do (rule = \"trapezoid\", points = 4: the corners); they let a block hinge on its very edge",
         0, 0, false, "face|points"},
        {"none", &JointRule::none, "", "pairs that match get no joint"},
        {"optional", &JointRule::optional, "", "a group it names may have no blocks in this variant of the scene"},
    };
  }
};

struct Damping {
  double mass = 0;               // 1/s, coefficient a of c = a m
  std::string scope = "bonded";  // bonded | all | none
  std::string form = "centred";  // centred | explicit
  double stiffness = 0;          // s, coefficient b of the dashpots of joints, c = b k
  double joint_ratio = 0;        // viscous ratio of joints: of each joint's critical value, or at the frequency `at`
  double at = 0;                 // Hz; 0: each joint's own frequency
  Place place;

  static Fields<Damping> fields() {
    return {
        {"mass", &Damping::mass, "1/s", "coefficient a of the mass damping c = a m", 0, 1e7},
        {"scope", &Damping::scope, "", "blocks that mass damping acts on", 0, 0, false, "bonded|all|none"},
        {"form", &Damping::form, "", "velocity that mass damping uses: the mean over the step, or the one before it", 0, 0, false,
         "centred|explicit"},
        {"stiffness", &Damping::stiffness, "s", "coefficient b of the dashpots of joints, c = b k", 0, 1e3},
        {"joint_ratio", &Damping::joint_ratio, "",
         "viscous ratio of joints: relative to each joint's critical value, or at the frequency `at`", 0, 10},
        {"at", &Damping::at, "Hz", "frequency at which motions have the ratio joint_ratio (b = joint_ratio / (pi at))", 0, 1e6},
    };
  }
};

struct Analysis {
  double duration = 0;                // s; must be given
  double dt = 0;                      // s; 0: from dt_rule
  double dt_fraction = 0.9;           // of the limit in force
  std::string dt_rule = "limit";      // limit | period_tenth (3) | hart (4) | hakuno (5) | hakuno_half
  bool unstable = false;              // allow a dt beyond the limit; divergence is then expected and detected
  std::string kernel = "fast";        // fast | reference
  std::string solver = "leapfrog";    // leapfrog | sequential: one block at a time as Gu and Miao, to study that scheme
  std::string variant = "literal";    // of the sequential solver: literal | centred
  std::string order = "random";       // order of its blocks: random | fixed | coloured
  int iterations = 1;                 // sweeps per step, each over its share of dt
  int seed = 1;                       // of the random order
  std::string start = "equilibrium";  // equilibrium | ramp | rest: how gravity is applied
  double ramp_time = 0;               // s, of each ramp at the start; 0: chosen
  std::string overlap = "error";      // error | stress_free
  double collapse_fraction = 0.05;    // fallen share of the mass that counts as collapse
  double stop_after_collapse = -1;    // s of simulated time after collapse; -1: run to duration
  double stop_when_moved = 0;         // m; a block displaced this far from rest ends the run; 0: off
  double energy_tolerance = 0;        // relative energy tolerance; 0: by the kind of run (1e-6 elastic, 1e-3 bonded, 1e-2 collapse)
  bool debris = true;                 // contacts of loose blocks; false only to measure their cost
  bool sleep = false;                 // debris at rest is not computed until something disturbs it
  bool ledger = true;                 // the energy ledger between rows; false only to measure its cost
  int levels = 0;                     // contacts of loose blocks act once in 2^(levels - 1) steps at most; 0: not given (model/levels.h)
  double lazy_rotation = 1e-4;        // rad, block rotation between updates of joint frames
  bool gyroscopic = true;             // false: the scalar Euler equation of Gu and Miao eq. (1), for comparison only
  double output_dt = 0.01;            // s, rows of histories.csv and energy.csv
  double frame_dt = 0.04;             // s, poses for pictures
  bool frame_stress = false;          // with the mean stresses and the resultants of the joints
  Place place;

  int contact_levels() const { return levels > 0 ? levels : 4; }

  static Fields<Analysis> fields() {
    return {
        {"duration", &Analysis::duration, "s", "simulated time", 1e-9, 1e6},
        {"dt", &Analysis::dt, "s", "time step (0: from dt_rule); { value, unstable = true } allows a step beyond the limit", 0, 1},
        {"dt_fraction", &Analysis::dt_fraction, "", "share of the limit in force", 1e-6, 1},
        {"dt_rule", &Analysis::dt_rule, "", "rule that gives dt", 0, 0, false, "limit|period_tenth|hart|hakuno|hakuno_half"},
        {"unstable", &Analysis::unstable, "", "allow a dt beyond the limit, or a sequential solver that feeds energy"},
        {"kernel", &Analysis::kernel, "", "step kernel", 0, 0, false, "fast|reference"},
        {"solver", &Analysis::solver, "",
         "all blocks at once, or one after the other by Gu and Miao's scheme (it feeds energy: for studies)", 0, 0, false,
         "leapfrog|sequential"},
        {"variant", &Analysis::variant, "", "sequential: forces where a block is, or half a step ahead on its path", 0, 0, false,
         "literal|centred"},
        {"order", &Analysis::order, "", "sequential: order of the blocks", 0, 0, false, "random|fixed|coloured"},
        {"iterations", &Analysis::iterations, "", "sequential: sweeps per step, each over its share of dt", 1, 1e6},
        {"seed", &Analysis::seed, "", "sequential: seed of the random order", 0, 2147483647},
        {"start", &Analysis::start, "", "how gravity is applied", 0, 0, false, "equilibrium|ramp|rest"},
        {"ramp_time", &Analysis::ramp_time, "s",
         "length of the gravity ramp, and of the lowering of what rests without a joint (0: automatic)", 0, 1e6},
        {"overlap", &Analysis::overlap, "", "treatment of blocks that overlap at rest", 0, 0, false, "error|stress_free"},
        {"collapse_fraction", &Analysis::collapse_fraction, "",
         "share of the mass whose fall counts as a collapse; what is thrown at the structure (free, with an initial velocity) is left out",
         0, 1},
        {"stop_after_collapse", &Analysis::stop_after_collapse, "s", "time to go on after a collapse (-1: to the end)", -1, 1e6},
        {"stop_when_moved", &Analysis::stop_when_moved, "m",
         "displacement of a block of the structure from rest that ends the run, collapse.moved (0: none)", 0, 1e6},
        {"sleep", &Analysis::sleep, "", "debris at rest is skipped until something moves it"},
        {"energy_gate", &Analysis::energy_tolerance, "", "largest relative energy residual of an accurate run (0: by the kind of run)", 0,
         1e6},
        {"levels", &Analysis::levels, "",
         "time levels: contacts of loose blocks act once in 2^(levels - 1) steps at most, where a few other blocks keep the step short; 1: "
         "in every step (default 4)",
         1, 8},
        {"lazy_rotation", &Analysis::lazy_rotation, "rad", "block rotation between updates of joint frames", 0, 0.1},
        {"gyroscopic", &Analysis::gyroscopic, "", "the gyroscopic term w x (I w)"},
        {"output_dt", &Analysis::output_dt, "s", "time between rows of histories.csv and energy.csv", 1e-9, 1e6},
        {"frame_dt", &Analysis::frame_dt, "s", "time between poses for pictures", 1e-9, 1e6},
        {"frame_stress", &Analysis::frame_stress, "",
         "keep the mean stresses and the resultant of each joint with the poses, for colours, histograms and lines of thrust"},
    };
  }
};

// One column of histories.csv, or three.
struct Recorder {
  std::string name;                 // column stem, e.g. "floor3"
  std::string quantity;             // a name from engine/record/recorders/recorders.h, e.g. displacement, velocity, acceleration, reaction
  std::vector<std::string> blocks;  // block names; the quantity is averaged over them, forces are summed
  std::vector<std::string> others;  // block names, for joint quantities: only joints between `blocks` and these (empty: all)
  std::string axis = "xyz";         // which components
  std::string frame = "rel";        // rel (to the ground) | abs
  bool has_point = false;
  Vec3 point = Vec3::Zero();  // m at rest: material point of the quantity, instead of the centroid
  Place place;

  static Fields<Recorder> fields() {
    return {
        {"name", &Recorder::name, "", "stem of its columns in histories.csv", 0, 0, true},
        {"quantity", &Recorder::quantity, "", "quantity to write", 0, 0, true},
        {"axis", &Recorder::axis, "", "components to write", 0, 0, false, "x|y|z|xy|xz|yz|xyz"},
        {"frame", &Recorder::frame, "", "relative to the ground, or absolute", 0, 0, false, "rel|abs"},
        {"point", &Recorder::point, "m", "material point at rest (default the centroid)", -1e6, 1e6},
    };
  }
};

struct Camera {
  std::string name;
  Vec3 eye{8, -8, 5}, target{0, 0, 1}, up{0, 0, 1};
  double fov = 35 * pi / 180;  // rad, vertical
  Place place;

  static Fields<Camera> fields() {
    return {
        {"name", &Camera::name, "", "name of the pictures", 0, 0, true},
        {"eye", &Camera::eye, "m", "position of the camera", -1e6, 1e6},
        {"target", &Camera::target, "m", "point at the centre of the picture", -1e6, 1e6},
        {"up", &Camera::up, "", "upward direction", -1, 1},
        {"fov", &Camera::fov, "rad", "vertical angle of view", 0.001, 3.1},
    };
  }
};

struct Param {
  std::string name;
  double value = 0, fallback = 0;
  std::string text;  // assumption or meaning
  std::string unit;
  Place place;
};

// expect(key, value, {...}): the scene is its own test.
struct Expectation {
  std::string key;         // dotted key of metrics.json
  double value = 0;        // for rel and abs
  std::string text_value;  // for status and other texts
  enum class Kind { rel, abs, below, above, between, equal } kind = Kind::rel;
  double tolerance = 0;      // rel or abs; the bound for below and above
  double low = 0, high = 0;  // between
  bool stored = false;       // the value is kept in a file beside the scene, and not a number yet
  std::string source;
  Place place;
};

// expect_image(camera, t, {...}): the picture looks like the one kept beside the scene.
struct PictureExpectation {
  std::string camera;
  double t = 0;                    // s
  double pixels = 0.01;            // largest share of pixels that differ by more than 4/255 in a channel
  double ssim = 0.98;              // least structural similarity
  int width = 480, height = 270;   // pixels
  std::string color = "material";  // of blocks
  std::string source;
  Place place;

  static Fields<PictureExpectation> fields() {
    return {
        {"pixels", &PictureExpectation::pixels, "", "largest share of pixels that differ by more than 4/255 in a channel", 0, 1},
        {"ssim", &PictureExpectation::ssim, "", "least structural similarity (Wang et al. 2004); 1: equal", 0, 1},
        {"width", &PictureExpectation::width, "", "width of the picture, pixels", 64, 4096},
        {"height", &PictureExpectation::height, "", "height of the picture, pixels", 64, 4096},
        {"color", &PictureExpectation::color, "", "color of blocks", 0, 0, false,
         "material|damage|displacement|speed|opening|energy|joint_state|normal_stress|shear_stress"},
        {"source", &PictureExpectation::source, "", "what sets the tolerance"},
    };
  }
};

// Limits beyond which a scene is not valid, with the reason. A coarser run is refused.
struct UseLimit {
  double dt_fraction = 1;  // largest dt over dt_critical
  int points = 1;          // fewest contact points of a joint
  std::string reason;
  Place place;

  static Fields<UseLimit> fields() {
    return {
        {"dt_fraction", &UseLimit::dt_fraction, "", "largest dt, as a share of dt_critical", 1e-6, 1},
        {"points", &UseLimit::points, "", "fewest contact points of a joint", 1, 1000},
        {"reason", &UseLimit::reason, "", "the error that appears beyond the limits", 0, 0, true},
    };
  }
};

// A load on the ground or on a block.
struct Load {
  enum class Kind { ground, force, moment, tilt, motion, turning } kind = Kind::ground;
  // ground          acceleration of the ground (m/s2) along direction
  // force, moment   on a block (N, N m)
  // tilt            angle (rad) by which gravity rotates about direction
  // motion          displacement (m) of a block along direction, its other degrees of freedom held
  // turning         rotation (rad) of a block about direction
  Wave wave;
  Vec3 direction{1, 0, 0};
  std::string block;
  Vec3 point = Vec3::Zero();  // m at rest: where a force acts (it moves with the block), or the centre of a rotation
  bool has_point = false;
  std::string name;
  Place place;
};

struct Scene {
  std::string name;  // file name without folder and ending
  std::string file;
  std::vector<std::string> labels;  // to select scenes by: quick, fixed_dt, ...
  UseLimit use_limit;
  Vec3 gravity{0, 0, -standard_g};
  std::vector<Material> materials;
  std::vector<JointRule> joint_rules;
  std::vector<Block> blocks;
  std::vector<std::string> empty_groups;  // groups of blocks that a builder would have made, such as lintels: they may have no block
  std::vector<Load> loads;
  Damping damping;
  Analysis analysis;
  PushSettings push;
  PerformanceDemand performance;  // of a pushover
  std::vector<Recorder> recorders;
  std::vector<Camera> cameras;
  std::vector<Param> params;
  std::vector<std::string> notes;     // sentences on numbers that functions of the language have derived
  std::vector<std::string> warnings;  // what those functions doubt
  std::vector<Expectation> expectations;
  std::vector<PictureExpectation> pictures;
  std::vector<std::pair<std::string, std::string>> metric_units;  // of the scene's own metrics: name, unit
  std::map<std::string, std::string> inputs;                      // path of each file read -> its hash
  int most_blocks = 300000, most_points = 20000000;               // limits, checked before memory is allocated
};

// All mistakes that can be found without building a model; empty if there are none. Each message names place and remedy.
std::vector<std::string> check(const Scene& scene);
// Doubtful but legal input that the user should know of before the run.
std::vector<std::string> warnings(const Scene& scene);

}  // namespace erbs
