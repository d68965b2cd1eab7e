---@meta
-- The scene language of ERBS for editors (LuaCATS). Written by `erbs help --editor > lua/erbs.meta.lua` from the table of the
-- program; a test compares the two. All numbers are SI; units are factors: 5*mm, 0.2*MPa, 30*deg, 0.4*g.

---@alias erbs.vec3 number[] x, y, z
---@class erbs.law a joint law
---@class erbs.wave a function of time; wave(t) is its value
---@operator call(number): number
---@class erbs.axes what a study varies

---@class erbs.run argument of a metric function: the keys of metrics.json, and
---@field metrics table metrics.json
---@field time number[] times of the rows of histories.csv [s]
---@field columns string[] names of the columns of histories.csv
---@field history fun(column: string): number[] values, one per row
---@field peak fun(column: string): number largest magnitude
---@field peak_time fun(column: string): number time of the largest magnitude [s]
---@field max fun(column: string): number
---@field min fun(column: string): number
---@field mean fun(column: string): number
---@field rms fun(column: string): number
---@field first fun(column: string): number
---@field last fun(column: string): number
---@field at fun(column: string, t: number): number value at time t [s], linear between rows
---@field frequency fun(column: string, from?: number, to?: number): number dominant frequency, in a band if one is given [Hz]
---@field period fun(column: string): number mean time between rising crossings of zero [s]
---@field crossings fun(column: string, level?: number, rising?: boolean): number[] times of crossing the level [s]
---@field events { time: number, event: string, name: string, value: number }[] events.csv
---@field first_crack { time: number, name: string }? the first crack

m, cm, mm, km = 1, 1e-2, 1e-3, 1e3 -- m
s, ms = 1, 1e-3 -- s
kg, t = 1, 1e3 -- kg; t is the tonne
N, kN, MN = 1, 1e3, 1e6 -- N
Pa, kPa, MPa, GPa = 1, 1e3, 1e6, 1e9 -- Pa
J, Hz = 1, 1 -- J, 1/s
pi, deg = math.pi, math.pi / 180 -- rad
g = 9.81 -- m/s2
start_noise = 0 -- noise in the initial state of every free block: erbs run --noise, erbs test --grid [m and rad]

---@alias erbs.quantity "displacement"|"velocity"|"acceleration"|"rotation"|"spin"|"momentum"|"angular_momentum"|"reaction"|"reaction_moment"|"load"|"load_moment"|"opening"|"slip"|"normal_force"|"shear_force"|"joint_moment"|"damage"|"broken"|"normal_stress"|"shear_stress"|"crushing"|"ground_acceleration"|"ground_velocity"|"ground_displacement"|"gravity"|"contact_points"|"joints_broken"

---@class erbs.part
---@field vertices erbs.vec3[] corners [m; -1e+06 to 1e+06]
---@field faces? integer[][] loops of vertex numbers, counter-clockwise seen from outside (default: the hull)

---@class erbs.tolerance
---@field rel? number largest relative error [0 to 1e+09]
---@field abs? number largest absolute error [at least 0]
---@field below? boolean the value is an upper bound
---@field above? boolean the value is a lower bound
---@field between? number[] { lowest, highest }
---@field source? string where the number is from

---@class erbs.stored
---@field rel? number largest relative change [0 to 1e+09]
---@field abs? number largest absolute change [at least 0]
---@field source? string what sets the tolerance

---@class erbs.picture
---@field pixels? number largest share of pixels that differ by more than 4/255 in a channel [0 to 1; default 0.01]
---@field ssim? number least structural similarity (Wang et al. 2004); 1: equal [0 to 1; default 0.98]
---@field width? integer width of the picture, pixels [64 to 4096; default 480]
---@field height? integer height of the picture, pixels [64 to 4096; default 270]
---@field color? "material"|"damage"|"displacement"|"speed"|"opening"|"energy"|"joint_state"|"normal_stress"|"shear_stress" color of blocks [default material]
---@field source? string what sets the tolerance

---@class erbs.material_keys
---@field name string name by which blocks refer to it
---@field density number mass per volume of the block [kg/m3; 0.01 to 100000]
---@field kn? number normal stiffness of debris contacts [Pa/m; 1000 to 1e+16; default 5e+10]
---@field ks? number shear stiffness of debris contacts: 0.4 kn unless given [Pa/m; 0 to 1e+16; default 2e+10]
---@field friction? number coefficient of friction of debris contacts [0 to 10; default 0.6]
---@field restitution? number restitution of a central impact: speed after over before, at least 0.02 [0 to 1; default 0.3]
---@field color? erbs.vec3 red, green, blue for the pictures [0 to 1; default { 0.7, 0.35, 0.25 }]
---@field friction_with? table<string, number> coefficients against other materials, or its own, by their names: { stone = 0.3 }

---A material of blocks, and its behaviour as debris. Between two materials the smaller friction and the smaller restitution apply, unless one says its friction_with the other.
---@param keys erbs.material_keys
---@return string # its name
function material(keys) end

---@class erbs.box_keys
---@field size erbs.vec3 lengths along x, y, z [m; 1e-06 to 1e+06]
---@field at? erbs.vec3 its lower corner [m; -1e+06 to 1e+06; default { 0, 0, 0 }]
---@field center? erbs.vec3 its centre, instead of at [m; -1e+06 to 1e+06]
---@field name? string name, unique (default from the group and a number)
---@field group? string group, for joint rules and recorders
---@field fixed? boolean part of the ground [default false]
---@field free? boolean allowed to have no joint, or no joined path to the ground [default false]
---@field material? string name of its material (default: the only one there is)
---@field rotation? erbs.vec3 rotation vector about the centroid [rad; -100 to 100; default { 0, 0, 0 }]
---@field initial? { position?: erbs.vec3, rotation?: erbs.vec3, velocity?: erbs.vec3, spin?: erbs.vec3, about?: erbs.vec3 } initial state

---A rectangular block.
---@param keys erbs.box_keys
---@return string # the name of the block
function box(keys) end

---@class erbs.block_keys
---@field vertices? erbs.vec3[] corners of a single part [m; -1e+06 to 1e+06]
---@field faces? integer[][] loops of vertex numbers, counter-clockwise seen from outside (default: the hull)
---@field parts? erbs.part[] several convex parts: { { vertices = ..., faces = ... }, ... }
---@field at? erbs.vec3 displacement of the shape [m; -1e+06 to 1e+06; default { 0, 0, 0 }]
---@field name? string name, unique (default from the group and a number)
---@field group? string group, for joint rules and recorders
---@field fixed? boolean part of the ground [default false]
---@field free? boolean allowed to have no joint, or no joined path to the ground [default false]
---@field material? string name of its material (default: the only one there is)
---@field rotation? erbs.vec3 rotation vector about the centroid [rad; -100 to 100; default { 0, 0, 0 }]
---@field initial? { position?: erbs.vec3, rotation?: erbs.vec3, velocity?: erbs.vec3, spin?: erbs.vec3, about?: erbs.vec3 } initial state

---A convex polyhedron, or several convex parts that are one rigid block.
---@param keys erbs.block_keys
---@return string # the name of the block
function block(keys) end

---@class erbs.prism_keys
---@field polygon number[][] corners { u, v }; u and v are the axes after `axis` in the order x, y, z, x, ... [m; -1e+06 to 1e+06]
---@field height number length along the axis [m; 1e-06 to 1e+06]
---@field axis? "x"|"y"|"z" direction of extrusion [default z]
---@field at? erbs.vec3 displacement of the shape [m; -1e+06 to 1e+06; default { 0, 0, 0 }]
---@field name? string name, unique (default from the group and a number)
---@field group? string group, for joint rules and recorders
---@field fixed? boolean part of the ground [default false]
---@field free? boolean allowed to have no joint, or no joined path to the ground [default false]
---@field material? string name of its material (default: the only one there is)
---@field rotation? erbs.vec3 rotation vector about the centroid [rad; -100 to 100; default { 0, 0, 0 }]
---@field initial? { position?: erbs.vec3, rotation?: erbs.vec3, velocity?: erbs.vec3, spin?: erbs.vec3, about?: erbs.vec3 } initial state

---A convex polygon extruded along an axis.
---@param keys erbs.prism_keys
---@return string # the name of the block
function prism(keys) end

---@class erbs.mesh_keys
---@field file string path, in the folder of the scene or in a folder of --allow
---@field scale? number factor that converts its coordinates to metres [1e-09 to 1e+09; default 1]
---@field at? erbs.vec3 displacement of the shape [m; -1e+06 to 1e+06; default { 0, 0, 0 }]
---@field name? string name, unique (default from the group and a number)
---@field group? string group, for joint rules and recorders
---@field fixed? boolean part of the ground [default false]
---@field free? boolean allowed to have no joint, or no joined path to the ground [default false]
---@field material? string name of its material (default: the only one there is)
---@field rotation? erbs.vec3 rotation vector about the centroid [rad; -100 to 100; default { 0, 0, 0 }]
---@field initial? { position?: erbs.vec3, rotation?: erbs.vec3, velocity?: erbs.vec3, spin?: erbs.vec3, about?: erbs.vec3 } initial state

---A block from a file (OBJ, STL, PLY, glTF); each mesh in it is one convex part.
---@param keys erbs.mesh_keys
---@return string # the name of the block
function mesh(keys) end

---@class erbs.ground_keys
---@field z? number height of its top [m; -1e+06 to 1e+06; default 0]
---@field size? number length of its sides; blocks that fall beyond them never land [m; 0.001 to 1e+06; default 20]
---@field depth? number thickness of the plate [m; 0.001 to 1e+06; default 1]
---@field material? string name of its material (default: its own, with the defaults of material)
---@field friction? number coefficient of friction, instead of its material's [0 to 10]
---@field name? string its name [default ground]
---@field group? string its group [default ground]

---A fixed plate as the ground.
---@param keys erbs.ground_keys
---@return string # the name of the block
function ground(keys) end

---@class erbs.transform_keys
---@field [1] fun(): any function that builds; it is called immediately
---@field at? erbs.vec3 shift, after the rotation [m; -1e+06 to 1e+06; default { 0, 0, 0 }]
---@field rotation? erbs.vec3 rotation vector [rad; -100 to 100; default { 0, 0, 0 }]
---@field about? erbs.vec3 centre of the rotation [m; -1e+06 to 1e+06; default { 0, 0, 0 }]

---Moves everything that is built inside the function as a rigid body: x -> about + rotation (x - about) + at. Initial velocities, spins and directions of loads rotate with it.
---@param keys erbs.transform_keys
---@return any # what the function returns
function transform(keys) end

---@class erbs.dry_keys
---@field kn number normal stiffness of the joint [Pa/m; 1000 to 1e+16]
---@field ks? number shear stiffness of the joint (default 0.4 kn) [Pa/m; 0 to 1e+16]
---@field mu number coefficient of friction [0 to 10]
---@field damping? number viscous ratio of a joint that has opened or slid, relative to its critical value [0 to 1; default 0.3]
---@field interlock? number 1: friction of slowly sliding faces follows their mean pressure; 0: the momentary pressure, as in theory [0 to 1; default 1]

---A dry joint: linear in compression, no tension, Coulomb friction.
---@param keys erbs.dry_keys
---@return erbs.law # for joint{ law = ... }
function dry(keys) end

---@class erbs.mortar_keys
---@field E? number Young's modulus of the mortar [Pa; 0 to 1e+14; default 0]
---@field nu? number Poisson's ratio, G = E / (2 (1 + nu)) [-0.99 to 0.5; default 0.2]
---@field G? number shear modulus of the mortar (default from E and nu) [Pa; 0 to 1e+14]
---@field thickness? number thickness of the bed; kn = E / thickness, ks = G / thickness [m; 0 to 1; default 0]
---@field kn? number normal stiffness of the joint, instead of E / thickness [Pa/m; 0 to 1e+16; default 0]
---@field ks? number shear stiffness of the joint, instead of G / thickness (default with neither G nor E: 0.4 kn) [Pa/m; 0 to 1e+16]
---@field ft number tensile strength [Pa; 0 to 1e+09]
---@field c number cohesion [Pa; 0 to 1e+09]
---@field mu number coefficient of friction [0 to 10]
---@field mu_residual? number coefficient of friction after failure (default mu) [-1 to 10]
---@field Gf1? number fracture energy in tension (0: brittle) [J/m2; 0 to 1e+07; default 0]
---@field Gf2? number fracture energy in shear (0: brittle) [J/m2; 0 to 1e+07; default 0]
---@field un_ultimate? number opening at which tensile strength is lost (default from Gf1) [m; 0 to 1]
---@field us_ultimate? number slip at which cohesion is lost (default from Gf2) [m; 0 to 1]
---@field fc? number compressive strength, a plateau without Gc (0: unlimited) [Pa; 0 to 1e+10; default 0]
---@field Gc? number compressive fracture energy: the strength falls linearly to zero over a crushed depth of 2 Gc / fc, where the bond is lost too (usual: Gc = 1.6 mm fc; 0: a plateau) [J/m2; 0 to 1e+09; default 0]
---@field uc_ultimate? number closing at which the mortar is crushed and its bond lost (0: never; with Gc: 2 Gc / fc) [m; 0 to 1; default 0]
---@field kn_cracked? number normal stiffness once no bond is left and the bed bears by its asperities; it fades to this value within some 0.03 s (default kn) [Pa/m; 0 to 1e+16]
---@field ks_cracked? number shear stiffness once no bond is left (default kn_cracked ks / kn) [Pa/m; 0 to 1e+16]
---@field damping? number viscous ratio of the cracked joint, relative to its critical value [0 to 1; default 0]
---@field coupling? "coulomb"|"linear"|"ellipse" tension-shear coupling: coulomb, linear or ellipse [default coulomb]
---@field scatter? { cv: number, length?: number, seed?: integer } lognormal scatter of the bond from joint to joint (default: none)

---A mortar joint: linear, with tension cut-off, Coulomb shear with cohesion, and optional softening.
---@param keys erbs.mortar_keys
---@return erbs.law # for joint{ law = ... }
function mortar(keys) end

---@class erbs.dilatant_keys
---@field kn number normal stiffness of the joint [Pa/m; 1000 to 1e+16]
---@field ks? number shear stiffness of the joint (default 0.4 kn) [Pa/m; 0 to 1e+16]
---@field mu number coefficient of friction, asperities included [0 to 10]
---@field psi number dilation angle of the unworn faces; its tangent must be below mu [rad; 0 to 0.8]
---@field wear_slip number slip at which the asperities are worn off [m; 1e-06 to 1]
---@field damping? number viscous ratio of a joint that has opened or slid, relative to its critical value [0 to 1; default 0.3]
---@field interlock? number as in dry{} [0 to 1; default 1]

---A dry joint of rough faces: sliding lifts them at the angle psi, which falls to zero over the slip `wear_slip`.
---@param keys erbs.dilatant_keys
---@return erbs.law # for joint{ law = ... }
function dilatant(keys) end

---@class erbs.masonry_stiffness_keys
---@field E number Young's modulus of the masonry, units and mortar together [Pa; 1 to 1e+14]
---@field nu? number Poisson's ratio of the masonry [-0.99 to 0.5; default 0.2]
---@field spacing number distance h from joint to joint, across them [m; 1e-06 to 1000]

---Stiffness of the joints of rigid blocks from that of masonry: kn = E / spacing, ks = kn / (2 (1 + nu)). Log and manifest tell what it did.
---@param keys erbs.masonry_stiffness_keys
---@return table # kn, ks (Pa/m), for mortar{ kn = k.kn, ks = k.ks, ... }
function masonry_stiffness(keys) end

---@class erbs.joint_keys
---@field law? erbs.law a law value: dry{ ... }, mortar{ ... } or dilatant{ ... }
---@field between? string|string[] two groups, { "wall", "slab" }; "" is any group (default: any two groups)
---@field name? string name of the rule, for reports
---@field thickness? number nominal gap at rest: faces that touch or lie no further apart are joined (default the thickness of the law) [m; 0 to 1]
---@field tolerance? number largest excess of a gap over `thickness`; a gap that is narrower by more is joined with a warning [m; 0 to 1; default 0.0001]
---@field rule? "simpson"|"midpoint"|"trapezoid"|"gauss" quadrature rule of the contact points [default simpson]
---@field pressure? "face"|"points" what bears: the face, its pressure integrated in closed form, or the contact points, each with its share of the area, as the sub-contacts of point-contact models do (rule = "trapezoid", points = 4: the corners); they let a block hinge on its very edge [default face]
---@field none? boolean pairs that match get no joint [default false]
---@field optional? boolean a group it names may have no blocks in this variant of the scene [default false]
---@field points? integer|integer[] contact points: { along the longer side, along the shorter side }, or one square number; with rule = "simpson", 2 along a side are those of gauss, .289 of the side from its middle: with pressure = "points" a block then hinges inside its edge [1 to 64; default { 3, 3 }]

---Joins faces that face each other at rest by a law. The last rule that matches a pair of blocks applies.
---@param keys erbs.joint_keys
function joint(keys) end

---@class erbs.sine_keys
---@field amplitude number peak value, in the unit of the load
---@field frequency number cycles per second [Hz; 1e-09 to 1e+09]
---@field phase? number phase at the start [rad; -1000 to 1000; default 0]
---@field start? number time of the first value [s; -1e+09 to 1e+09; default 0]
---@field duration? number duration (default: for ever) [s; at least 0]

---A sine from `start` on, for `duration`: amplitude sin(2 pi frequency (t - start) + phase).
---@param keys erbs.sine_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function sine(keys) end

---@class erbs.half_sine_keys
---@field amplitude number peak value, in the unit of the load
---@field frequency number frequency of the whole sine; the lobe lasts 1 / (2 frequency) [Hz; 1e-09 to 1e+09]
---@field phase? number phase at the start; the pulse ends at pi [rad; 0 to 3.14159; default 0]
---@field start? number time of the first value [s; -1e+09 to 1e+09; default 0]

---One lobe of a sine, from any phase to its zero at pi. From phase 0 it leaves the ground at the velocity amplitude / (pi frequency).
---@param keys erbs.half_sine_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function half_sine(keys) end

---@class erbs.full_sine_keys
---@field amplitude number peak value, in the unit of the load
---@field frequency number frequency; the cycle lasts 1 / frequency [Hz; 1e-09 to 1e+09]
---@field phase? number phase at the start; the pulse ends at 2 pi [rad; 0 to 6.28319; default 0]
---@field start? number time of the first value [s; -1e+09 to 1e+09; default 0]

---One cycle of a sine, from any phase to its zero at 2 pi. From phase 0 it leaves the ground at rest, displaced by amplitude / (2 pi frequency^2).
---@param keys erbs.full_sine_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function full_sine(keys) end

---@class erbs.pulse_keys
---@field amplitude number value inside, in the unit of the load
---@field start? number time of the rising edge [s; -1e+09 to 1e+09; default 0]
---@field duration? number duration (default: for ever, a step) [s; at least 0]

---A rectangular pulse, exact at its edges whatever the time step.
---@param keys erbs.pulse_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function pulse(keys) end

---@class erbs.table_wave_keys
---@field times number[] increasing, at least two [s; -1e+09 to 1e+09]
---@field values number[] one for each time, in the unit of the load
---@field hold? boolean outside the table the nearest value holds (default: zero; of motion, turning and tilt: it holds)

---Given values at given times, linear in between.
---@param keys erbs.table_wave_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function table_wave(keys) end

---@class erbs.curve_wave_keys
---@field times number[] increasing, at least two [s; -1e+09 to 1e+09]
---@field values number[] one for each time, in the unit of the load
---@field hold? boolean outside the curve the nearest value holds (default: zero; of motion, turning and tilt: it holds)

---A smooth curve through given values at given times.
---@param keys erbs.curve_wave_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function curve_wave(keys) end

---@class erbs.record_keys
---@field file string PEER AT2, ESM, COSMOS or CSMIP V2, CSV or text of columns
---@field peak? number largest absolute acceleration after scaling (default: as recorded) [m/s2; 0 to 10000]
---@field scale? number factor on the acceleration, instead of peak [-1e+06 to 1e+06; default 1]
---@field time_factor? number factor on time [0.001 to 1000; default 1]
---@field start? number simulated time of time 0 in the file [s; -1e+09 to 1e+09; default 0]
---@field column? integer column of the values, counted from 1 (default: the one after time) [0 to 1000]
---@field dt? number time step, for a file with one column of values [s; 0 to 1000; default 0]
---@field first_time? number time of the first value of such a file [s; 0 to 1000; default 0]
---@field unit? string unit of the values, if the file does not give one: g, mg, m/s2, cm/s2, gal, mm/s2, ft/s2, in/s2; m/s, ... or m, ... by quantity
---@field decimal? "auto"|"point"|"comma" decimal mark of the file (auto: a comma where commas cannot part columns) [default auto]
---@field quantity? "acceleration"|"velocity"|"displacement" what the file holds; all but an acceleration needs `smoothing` [default acceleration]
---@field smoothing? number corner at which the spline that differentiates a velocity or displacement halves its amplitude [Hz; 0 to 10000; default 0]
---@field baseline? "none"|"constant"|"linear"|"quadratic"|"cubic" polynomial taken from the acceleration, by the best fit of its integral to the velocity [default none]
---@field low? number lower corner of a Butterworth band-pass without phase lag (0: none) [Hz; 0 to 10000; default 0]
---@field high? number its upper corner, below half the sampling rate (0: none) [Hz; 0 to 10000; default 0]
---@field band_order? integer order of the band-pass in each of its two passes, forwards and backwards [1 to 10; default 4]

---A ground-motion record from a file, scaled in amplitude and time.
---@param keys erbs.record_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function record(keys) end

---@class erbs.ricker_keys
---@field amplitude number peak value, in the unit of the load
---@field frequency number frequency at which the spectrum peaks [Hz; 1e-09 to 1e+09]
---@field start? number time of the first value, 6 / (pi frequency) before the peak [s; -1e+09 to 1e+09; default 0]

---A Ricker wavelet: a smooth pulse between two lobes, its peak 6 / (pi frequency) after `start`.
---@param keys erbs.ricker_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function ricker(keys) end

---@class erbs.full_cosine_keys
---@field amplitude number peak value, in the unit of the load
---@field frequency number frequency; the cycle lasts 1 / frequency [Hz; 1e-09 to 1e+09]
---@field start? number time of the first value [s; -1e+09 to 1e+09; default 0]

---One cycle of a cosine, from peak to peak. It leaves the ground at rest at its place.
---@param keys erbs.full_cosine_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function full_cosine(keys) end

---@class erbs.mp_pulse_keys
---@field amplitude number amplitude A of the velocity's envelope [m/s]
---@field frequency number prevailing frequency f_p [Hz; 1e-09 to 1e+09]
---@field phase? number phase nu: 0 for a symmetric velocity, 90 deg for an antisymmetric one [rad; -1000 to 1000; default 0]
---@field gamma number oscillatory character: the pulse lasts gamma / f_p [1.0001 to 1000]
---@field start? number time of the first value; the envelope peaks gamma / (2 f_p) later [s; -1e+09 to 1e+09; default 0]

---The near-fault pulse of Mavroeidis and Papageorgiou (2003), given by its velocity, as an acceleration. It leaves the ground at rest, displaced by -amplitude cos(phase) sin(pi gamma) / (2 pi frequency (gamma^2 - 1)).
---@param keys erbs.mp_pulse_keys
---@return erbs.wave # for a load; wave(t) is its value at time t
function mp_pulse(keys) end

---@class erbs.spectral_acceleration_keys
---@field wave erbs.wave|number|fun(t: number): number the acceleration of the ground [m/s2]
---@field period number period of the oscillator [s; 0.001 to 1000]
---@field damping? number its damping ratio [0 to 0.99; default 0.05]

---Pseudo-acceleration of an oscillator under a wave as the acceleration of the ground: Sa(T), a measure of intensity.
---@param keys erbs.spectral_acceleration_keys
---@return number # m/s2
function spectral_acceleration(keys) end

---@class erbs.ground_motion_keys
---@field wave erbs.wave|number|fun(t: number): number a wave, a number, or a function of time [m/s2]
---@field direction? "x"|"y"|"z"|erbs.vec3 "x", "y", "z" or a vector [-1e+09 to 1e+09; default "x"]
---@field sample? number sampling step of a Lua function [s; 1e-06 to 10; default 0.001]
---@field name? string name, for reports

---Shakes the ground by an acceleration; several ground motions add up. A positive acceleration moves the ground along its direction and pushes the structure the other way.
---@param keys erbs.ground_motion_keys
function ground_motion(keys) end

---@class erbs.ground_records_keys
---@field x? string file of the component along x
---@field y? string file of the component along y
---@field z? string file of the component along z, upwards
---@field of? "strongest"|"x"|"y"|"z" component whose peak becomes `peak`; all components have one scale [default strongest]
---@field peak? number largest absolute acceleration after scaling (default: as recorded) [m/s2; 0 to 10000]
---@field scale? number factor on the acceleration, instead of peak [-1e+06 to 1e+06; default 1]
---@field time_factor? number factor on time [0.001 to 1000; default 1]
---@field start? number simulated time of time 0 in the file [s; -1e+09 to 1e+09; default 0]
---@field column? integer column of the values, counted from 1 (default: the one after time) [0 to 1000]
---@field dt? number time step, for a file with one column of values [s; 0 to 1000; default 0]
---@field first_time? number time of the first value of such a file [s; 0 to 1000; default 0]
---@field unit? string unit of the values, if the file does not give one: g, mg, m/s2, cm/s2, gal, mm/s2, ft/s2, in/s2; m/s, ... or m, ... by quantity
---@field decimal? "auto"|"point"|"comma" decimal mark of the file (auto: a comma where commas cannot part columns) [default auto]
---@field quantity? "acceleration"|"velocity"|"displacement" what the file holds; all but an acceleration needs `smoothing` [default acceleration]
---@field smoothing? number corner at which the spline that differentiates a velocity or displacement halves its amplitude [Hz; 0 to 10000; default 0]
---@field baseline? "none"|"constant"|"linear"|"quadratic"|"cubic" polynomial taken from the acceleration, by the best fit of its integral to the velocity [default none]
---@field low? number lower corner of a Butterworth band-pass without phase lag (0: none) [Hz; 0 to 10000; default 0]
---@field high? number its upper corner, below half the sampling rate (0: none) [Hz; 0 to 10000; default 0]
---@field band_order? integer order of the band-pass in each of its two passes, forwards and backwards [1 to 10; default 4]

---Shakes the ground by up to three components of one recorded motion, along x, y and z: one time axis and one scale. The other keys are those of record{}.
---@param keys erbs.ground_records_keys
function ground_records(keys) end

---@class erbs.force_keys
---@field block string name of the block
---@field wave erbs.wave|number|fun(t: number): number a wave, a number, or a function of time [N]
---@field direction? "x"|"y"|"z"|erbs.vec3 "x", "y", "z" or a vector [-1e+09 to 1e+09; default "x"]
---@field sample? number sampling step of a Lua function [s; 1e-06 to 10; default 0.001]
---@field name? string name, for reports
---@field point? erbs.vec3 point of application on the block at rest (default the centroid) [m; -1e+06 to 1e+06]

---A force on a block.
---@param keys erbs.force_keys
function force(keys) end

---@class erbs.moment_keys
---@field block string name of the block
---@field wave erbs.wave|number|fun(t: number): number a wave, a number, or a function of time [N m]
---@field direction? "x"|"y"|"z"|erbs.vec3 axis of the moment: "x", "y", "z" or a vector [-1e+09 to 1e+09; default "x"]
---@field sample? number sampling step of a Lua function [s; 1e-06 to 10; default 0.001]
---@field name? string name, for reports

---A moment on a block.
---@param keys erbs.moment_keys
function moment(keys) end

---@class erbs.tilt_keys
---@field wave erbs.wave|number|fun(t: number): number a wave, a number, or a function of time [rad]
---@field axis? "x"|"y"|"z"|erbs.vec3 "x", "y", "z" or a vector [-1e+09 to 1e+09; default "x"]
---@field sample? number sampling step of a Lua function [s; 1e-06 to 10; default 0.001]
---@field name? string name, for reports

---Rotates gravity by an angle about an axis, like a tilting table. The rotation is right-handed: a positive angle about x pulls towards +y, about y towards -x.
---@param keys erbs.tilt_keys
function tilt(keys) end

---@class erbs.motion_keys
---@field block string name of the block
---@field wave erbs.wave|number|fun(t: number): number a wave, a number, or a function of time [m]
---@field direction? "x"|"y"|"z"|erbs.vec3 "x", "y", "z" or a vector [-1e+09 to 1e+09; default "x"]
---@field sample? number sampling step of a Lua function [s; 1e-06 to 10; default 0.001]
---@field name? string name, for reports

---Prescribes the displacement of a block along a direction; its other degrees of freedom are fixed. A function is followed smoothly; the corners of a table_wave are jolts; a curve_wave has none, and starts and ends at rest. Both keep their last value.
---@param keys erbs.motion_keys
function motion(keys) end

---@class erbs.turning_keys
---@field block string name of the block
---@field wave erbs.wave|number|fun(t: number): number a wave, a number, or a function of time [rad]
---@field axis? "x"|"y"|"z"|erbs.vec3 "x", "y", "z" or a vector [-1e+09 to 1e+09; default "x"]
---@field sample? number sampling step of a Lua function [s; 1e-06 to 10; default 0.001]
---@field name? string name, for reports
---@field about? erbs.vec3 centre of the rotation, at rest (default the centroid) [m; -1e+06 to 1e+06]

---Prescribes the rotation of a block about an axis. Its position is fixed, unless motion{} prescribes it.
---@param keys erbs.turning_keys
function turning(keys) end

---@class erbs.gravity_keys
---@field [1] number along x (or the one number: downwards) [m/s2; -1000 to 1000]
---@field [2] number along y [m/s2; -1000 to 1000]
---@field [3] number along z [m/s2; -1000 to 1000]

---Gravity as gravity(9.81), downwards, or gravity{ 0, 0, -9.81 }.
---@param keys erbs.gravity_keys
function gravity(keys) end

---@class erbs.settle_keys
---@field supports string|string[] names of fixed blocks, or of groups of them; each entry moves as one; they are built before
---@field by number distance [m; -1e+06 to 1e+06]
---@field direction? "x"|"y"|"z"|erbs.vec3 "x", "y", "z" or a vector [-1e+09 to 1e+09; default { 0, 0, -1 }]
---@field start? number time at which they begin to move [s; 0 to 1e+06; default 0]
---@field duration? number time they take; speed and acceleration begin and end at zero [s; 0.001 to 1e+06; default 1]
---@field name? string name, for reports

---Moves supports together, downwards unless a direction is given, along a smooth ramp.
---@param keys erbs.settle_keys
function settle(keys) end

---@class erbs.spread_keys
---@field supports string|string[] names of fixed blocks, or of groups of them; each entry moves as one; they are built before
---@field by number how much farther apart the first and the last are in the end; negative: closer [m; -1e+06 to 1e+06]
---@field direction? "x"|"y"|"z"|erbs.vec3 "x", "y", "z" or a vector [-1e+09 to 1e+09; default "x"]
---@field start? number time at which they begin to move [s; 0 to 1e+06; default 0]
---@field duration? number time they take; speed and acceleration begin and end at zero [s; 0.001 to 1e+06; default 1]
---@field name? string name, for reports
---@field ends? "both"|"first"|"last" which of them move: both by half of it, or only the first or the last along the direction [default both]

---Moves supports apart along a smooth ramp, each in proportion to its place between the first and the last along the direction.
---@param keys erbs.spread_keys
function spread(keys) end

---@class erbs.damping_keys
---@field mass? number coefficient a of the mass damping c = a m [1/s; 0 to 1e+07; default 0]
---@field scope? "bonded"|"all"|"none" blocks that mass damping acts on [default bonded]
---@field form? "centred"|"explicit" velocity that mass damping uses: the mean over the step, or the one before it [default centred]
---@field stiffness? number coefficient b of the dashpots of joints, c = b k [s; 0 to 1000; default 0]
---@field joint_ratio? number viscous ratio of joints: relative to each joint's critical value, or at the frequency `at` [0 to 10; default 0]
---@field at? number frequency at which motions have the ratio joint_ratio (b = joint_ratio / (pi at)) [Hz; 0 to 1e+06; default 0]

---Damping of blocks and of joints.
---@param keys erbs.damping_keys
function damping(keys) end

---@class erbs.analysis_keys
---@field duration? number simulated time [s; 1e-09 to 1e+06; default 0]
---@field dt? number time step (0: from dt_rule); { value, unstable = true } allows a step beyond the limit [s; 0 to 1; default 0]
---@field dt_fraction? number share of the limit in force [1e-06 to 1; default 0.9]
---@field dt_rule? "limit"|"period_tenth"|"hart"|"hakuno"|"hakuno_half" rule that gives dt [default limit]
---@field unstable? boolean allow a dt beyond the limit, or a sequential solver that feeds energy [default false]
---@field kernel? "fast"|"reference" step kernel [default fast]
---@field solver? "leapfrog"|"sequential" all blocks at once, or one after the other by Gu and Miao's scheme (it feeds energy: for studies) [default leapfrog]
---@field variant? "literal"|"centred" sequential: forces where a block is, or half a step ahead on its path [default literal]
---@field order? "random"|"fixed"|"coloured" sequential: order of the blocks [default random]
---@field iterations? integer sequential: sweeps per step, each over its share of dt [1 to 1e+06; default 1]
---@field seed? integer sequential: seed of the random order [0 to 2.14748e+09; default 1]
---@field start? "equilibrium"|"ramp"|"rest" how gravity is applied [default equilibrium]
---@field ramp_time? number length of the gravity ramp, and of the lowering of what rests without a joint (0: automatic) [s; 0 to 1e+06; default 0]
---@field overlap? "error"|"stress_free" treatment of blocks that overlap at rest [default error]
---@field collapse_fraction? number share of the mass whose fall counts as a collapse; what is thrown at the structure (free, with an initial velocity) is left out [0 to 1; default 0.05]
---@field stop_after_collapse? number time to go on after a collapse (-1: to the end) [s; -1 to 1e+06; default -1]
---@field stop_when_moved? number displacement of a block of the structure from rest that ends the run, collapse.moved (0: none) [m; 0 to 1e+06; default 0]
---@field sleep? boolean debris at rest is skipped until something moves it [default false]
---@field energy_gate? number largest relative energy residual of an accurate run (0: by the kind of run) [0 to 1e+06; default 0]
---@field levels? integer time levels: contacts of loose blocks act once in 2^(levels - 1) steps at most, where a few other blocks keep the step short; 1: in every step (default 4) [1 to 8]
---@field lazy_rotation? number block rotation between updates of joint frames [rad; 0 to 0.1; default 0.0001]
---@field gyroscopic? boolean the gyroscopic term w x (I w) [default true]
---@field output_dt? number time between rows of histories.csv and energy.csv [s; 1e-09 to 1e+06; default 0.01]
---@field frame_dt? number time between poses for pictures [s; 1e-09 to 1e+06; default 0.04]
---@field frame_stress? boolean keep the mean stresses and the resultant of each joint with the poses, for colours, histograms and lines of thrust [default false]
---@field kind? "dynamic"|"tilt"|"pushover" time history, or a push through states of equilibrium until the structure collapses [default dynamic]
---@field step? number tilt, pushover: first step of the multiplier, a share of g or of the pattern; of a tilt in rad (0: 0.01; 0.5 deg) [0 to 1e+06; default 0]
---@field up_to? number tilt, pushover: largest multiplier; of a tilt in rad (0: 2; 60 deg) [0 to 1e+06; default 0]
---@field bracket? number tilt, pushover: width of the bracket of the capacity, relative [1e-06 to 0.5; default 0.002]
---@field control? "load"|"displacement" pushover: steps of the multiplier, or of the displacement of the monitored point, past the peak [default load]
---@field displacement? number control by displacement: where the push ends [m; 0 to 1e+06; default 0]
---@field displacement_step? number control by displacement: step (0: a fiftieth of displacement) [m; 0 to 1e+06; default 0]
---@field relaxation? "critical"|"kinetic"|"adaptive"|"local" tilt, pushover: damping on the way to equilibrium [default critical]
---@field inertia? "scaled"|"true" tilt, pushover: masses on the way to equilibrium, scaled to one time step or true [default scaled]
---@field unbalanced? number tilt, pushover: mean unbalanced force over mean applied force in equilibrium [1e-09 to 0.01; default 1e-05]
---@field limit? "auto"|"always"|"never" tilt, pushover: limit analysis beside the capacity; auto: up to 12000 contact points of the limit problem, where it takes seconds [default auto]
---@field fall? number tilt, pushover: the longest time of the fall that is drawn after the capacity is known (0: none; the mechanism is named all the same) [s; 0 to 1000; default 4]
---@field direction? "x"|"y"|"z"|erbs.vec3 tilt: side that goes down; pushover: direction of the acceleration on the masses (default "x"; with a pattern that of its resultant) [-1e+09 to 1e+09]
---@field path? number[] tilt, pushover: multipliers (tilt: rad) to visit in turn before the push to the end
---@field pattern? { block?: string, group?: string, force: erbs.vec3 }[] pushover: forces at the multiplier 1 (default: g times the mass of each block, along direction)
---@field monitor? { block?: string, point?: erbs.vec3 } point whose displacement along direction is the abscissa of the curve
---@field quality? "draft"|"standard"|"reference" a measured pair of step (over its limit) and contact points, for values that the scene leaves open: 0.9 and 2 x 2, 0.9 and 3 x 3, 0.25 and 5 x 5

---Kind, duration, time step and end of the run. A later call changes the keys that it gives.
---@param keys erbs.analysis_keys
function analysis(keys) end

---@class erbs.spectrum_keys
---@field kind? "EN 1998-1 type 1"|"EN 1998-1 type 2"|"TBSC 2018"|"table" code of the elastic spectrum (default with `table`: table)
---@field ground? "A"|"B"|"C"|"D"|"E" EN 1998-1: ground type, which gives S, TB, TC and TD
---@field ag? number EN 1998-1: design ground acceleration on ground A [m/s2; 0 to 50; default 0]
---@field damping? number EN 1998-1: viscous damping ratio [0.001 to 0.5; default 0.05]
---@field S? number EN 1998-1: soil factor of a national annex (0: of the ground type) [0 to 5; default 0]
---@field TB? number EN 1998-1: where the plateau begins (0: of the ground type) [s; 0 to 10; default 0]
---@field TC? number where the plateau ends; needed with `table` (0: of the ground type) [s; 0 to 10; default 0]
---@field TD? number EN 1998-1: where the displacement becomes constant (0: of the ground type) [s; 0 to 20; default 0]
---@field SDS? number TBSC 2018: design coefficient of short periods, a share of g: 0.9, not 0.9*g [0 to 4; default 0]
---@field SD1? number TBSC 2018: design coefficient of the period of 1 s, a share of g [0 to 4; default 0]
---@field table? { T: number, Sa: number }[] rows { T = ..., Sa = ... } of another spectrum, from T = 0 on
---@field shape? "peak"|"elastic" displaced shape of the mass nodes: of the state with the largest load, or of the first state under load [default peak]
---@field nodes? integer mass nodes, levels of equal height (0: each block is one) [0 to 10000; default 0]
---@field group? string blocks that give the displaced shape, such as a pier (default: all)
---@field iterate? boolean repeat the bilinear curve up to the target displacement until both agree, instead of up to the largest load [default false]
---@field blocks? string|string[] names of the blocks that give the displaced shape, instead of a group

---Elastic spectrum whose performance point on the curve of the pushover is computed: capacity.performance, performance.svg.
---@param keys erbs.spectrum_keys
function spectrum(keys) end

---@class erbs.recorder_keys
---@field name string stem of its columns in histories.csv
---@field quantity erbs.quantity quantity to write
---@field axis? "x"|"y"|"z"|"xy"|"xz"|"yz"|"xyz" components to write [default xyz]
---@field frame? "rel"|"abs" relative to the ground, or absolute [default rel]
---@field point? erbs.vec3 material point at rest (default the centroid) [m; -1e+06 to 1e+06]
---@field block? string|string[] name of the block
---@field blocks? string|string[] names of several blocks
---@field group? string all blocks of a group
---@field others? string|string[] for joint quantities: names of the blocks on the other side (default: any)
---@field other_group? string for joint quantities: all blocks of a group on the other side

---Writes a quantity of a block to histories.csv; for several blocks their mean, for forces their sum.
---@param keys erbs.recorder_keys
function recorder(keys) end

---@class erbs.camera_keys
---@field name string name of the pictures
---@field eye? erbs.vec3 position of the camera [m; -1e+06 to 1e+06; default { 8, -8, 5 }]
---@field target? erbs.vec3 point at the centre of the picture [m; -1e+06 to 1e+06; default { 0, 0, 1 }]
---@field up? erbs.vec3 upward direction [-1 to 1; default { 0, 0, 1 }]
---@field fov? number vertical angle of view [rad; 0.001 to 3.1; default 0.610865]

---A view for the pictures.
---@param keys erbs.camera_keys
function camera(keys) end

---Declares a number, or a word such as the name of a record, that -D and studies may change.
---@param name string its name
---@param default number its value unless -D gives one; or a word: -D motion=b.AT2
---@param text? string meaning or assumption, with the unit at the end: "density of brick, assumed [kg/m3]"
---@return number # the default, or the value of -D name=value
function param(name, default, text) end

---Adds a number to metrics.json; a function is called after the run with a table `run`.
---@param name string key under "metrics"
---@param unit string its unit, "" for none
---@param value number|fun(run: erbs.run): number? a number, or function(run) that returns one
function metric(name, unit, value) end

---States the expected value of a key of metrics.json; erbs test checks it.
---@param key string dotted key: "metrics.x", "energy.residual_relative", "status"
---@param value number|string|boolean? a number, a word, true or false
---@param how? erbs.tolerance { rel = | abs = | below = true | above = true | between = { lo, hi }, source = "..." }
function expect(key, value, how) end

---Labels that select scenes: erbs test --quick runs scenes with "quick"; a scene with "fixed_dt" keeps its time step in erbs test --grid and erbs accuracy. The smallest step of erbs accuracy is 1/32 of the limit, 1/8 with "coarse_study", 1/512 with "fine_study".
---@param ... string one label or several
function label(...) end

---@class erbs.use_limit_keys
---@field dt_fraction? number largest dt, as a share of dt_critical [1e-06 to 1; default 1]
---@field points? integer fewest contact points of a joint [1 to 1000; default 1]
---@field reason string the error that appears beyond the limits

---Limits of use of the scene; erbs check and erbs run refuse a coarser one.
---@param keys erbs.use_limit_keys
function use_limit(keys) end

---Runs another script of the scene's folder in the same scene.
---@param file string path, relative to the scene
---@return any # what the file returns
function include(file) end

---States that a key of metrics.json keeps the value that is stored beside the scene; erbs test --bless stores it anew.
---@param key string dotted key of a number: "metrics.x", "collapse.time_s"
---@param how erbs.stored { rel = | abs =, source = "..." }
function expect_stored(key, how) end

---States that the picture at the time t looks like the one stored beside the scene; erbs test --bless stores it anew.
---@param camera string a camera of the scene, or from_-x, from_+x, from_-y, from_+y, from_above
---@param t number time of the picture [s; 0 to 1e+06]
---@param how? erbs.picture { pixels = 0.01, ssim = 0.98, width = 480, height = 270, source = "..." }
function expect_image(camera, t, how) end

---@class erbs.bisect_keys
---@field param string name of the param that the runs change
---@field lo number value at which the structure stands (it may be the larger one) [-1e+300 to 1e+300]
---@field hi number value at which it collapses [-1e+300 to 1e+300]
---@field collapsed_when? fun(run: erbs.run): number|boolean? function(run) that returns true or false (default: collapse.collapsed of the run)
---@field rel? number width of the last bracket over its larger end, or over a thousandth of hi - lo if that is more [1e-12 to 1; default 0.01]
---@field points? integer runs between the ends in each round; where the verdict comes and goes, as with rocking, many find its first yes [1 to 1000; default 3]
---@field name? string stem of its metrics (default collapse_PARAM)

---Finds the value of a param at which the scene collapses, by runs side by side; metrics NAME, NAME_lo, NAME_hi, NAME_runs, NAME_failed.
---@param keys erbs.bisect_keys
function bisect(keys) end

---@class erbs.converge_keys
---@field param string name of the param that the runs change
---@field values number[] values of the param, all above zero
---@field error? fun(run: erbs.run): number|boolean? function(run) that returns the error against the known value
---@field value? fun(run: erbs.run): number|boolean? function(run) that returns a number; its error is the difference from the run with the smallest value
---@field slope? number least expected slope of ln error over ln value (default: no expectation) [0 to 100]
---@field name? string stem of its metrics (default converge_PARAM)

---Runs the scene with a param at several values and fits the order of its error; metrics NAME_slope, NAME_error (at the smallest), NAME_least and NAME_most (results), NAME_runs, NAME_failed.
---@param keys erbs.converge_keys
function converge(keys) end

---@class erbs.ensemble_keys
---@field n integer number of runs [1 to 100000]
---@field seed number seed from which the seeds of the runs are drawn; equal seeds give equal studies [-1e+300 to 1e+300]
---@field value fun(run: erbs.run): number|boolean? function(run) that returns a number; the study reports its scatter
---@field param? string name of the param that takes the seeds (whole numbers below 2^31) [default seed]
---@field name? string stem of its metrics [default ensemble]

---Runs the scene n times, each time with another seed in a param; metrics NAME_mean, NAME_deviation, NAME_least, NAME_most, NAME_median, NAME_error (standard error of the mean), NAME_runs, NAME_failed.
---@param keys erbs.ensemble_keys
function ensemble(keys) end

---Params that erbs test --grid varies: each value alone, and some combinations. erbs run ignores the family.
---@param params table<string, number[]> lists of values by the names of params given above
---@param how? { combinations?: integer, seed?: number } { combinations = their number (default 4), seed = seed of their draw (default 1) }
function family(params, how) end

---@class erbs.accuracy_keys
---@field param string name of a param given above
---@field values number[] its values from coarse to fine, above zero
---@field name? string its name in tables and figures (default the param)
---@field error? string metric that is itself the error of a run, such as NAME_error of ensemble (default: none)

---Declares a param whose values decide how large the error of the scene is, such as the stiffness of a bed. erbs accuracy varies it, with the other such params at their finest values, and all of them together; erbs run ignores it.
---@param keys erbs.accuracy_keys
function accuracy(keys) end

---@class erbs.figure_keys
---@field name string name of the file
---@field title string title of the figure
---@field x string label of the horizontal axis: quantity and unit
---@field y string label of the vertical axis: quantity and unit
---@field curves { label: string, study?: string, x?: number[], y?: number[], metrics?: string|string[] }[] one table per curve

---Draws results of studies beside known values: figures/NAME.svg of the run, also in the book of erbs test.
---@param keys erbs.figure_keys
function figure(keys) end

---@class erbs.study_keys
---@field scene string the scene, a path from the folder of the study
---@field vary? erbs.axes|erbs.axes[] { grid{}, list{}, latin{}, random{}, records{}, perturbations{} }: every combination, the last changing fastest
---@field bisect? { param: string, lo: number, hi: number, rel?: number, points?: integer, key?: string, above?: number } threshold of a param at each of these points
---@field collect? string|string[] keys of metrics.json for the columns; of a bisection, from its run at the upper end
---@field max_wall? number|string longest time of a run: seconds, or "5m"; beyond it the run is ended [default 1h]
---@field memory? number|string most memory of a run: bytes, or "2GB" (default: that of the machine over the runs at once)
---@field keep? "none"|"metrics"|"all" what stays of each run in runs/ [default metrics]
---@field title? string title of results.svg, the figure of the bisected param or the first of collect, and of the page of erbs report
---@field x? string label of its horizontal axis: quantity and unit (default the column)
---@field y? string label of its vertical axis (default the column)
---@field split? string a varied param; each of its values has a figure of its own, such as results_method_1.svg
---@field curves? { label: string, x: number[], y: number[] }[] known curves for the figure
---@field fragility? { im: string, collapse?: string, above?: number, along?: string, falls?: boolean, damage?: string|string[], by?: string|string[] } lognormal fragility and fractiles of damage from these runs: fragility.csv and others, with figures

---Many runs of a scene, by erbs sweep: what varies, what is bisected, and the columns of results.csv.
---@param keys erbs.study_keys
function study(keys) end

---@class erbs.grid_keys
---@field PARAM? number|string|(number|string)[] values of each param: numbers, or words

---In a study: every combination of the values; params change in the order in which the scene declares them.
---@param keys erbs.grid_keys
---@return erbs.axes # for vary of study
function grid(keys) end

---@class erbs.list_keys
---@field [1] list tables of values by the names of the params, all of the same params

---In a study: points one by one.
---@param keys erbs.list_keys
---@return erbs.axes # for vary of study
function list(keys) end

---@class erbs.latin_keys
---@field n integer number of points [1 to 1e+06]
---@field seed? number seed of the draw; equal seeds give equal points [-1e+15 to 1e+15; default 1]
---@field PARAM? number[] range of each param: { lowest, highest }, uniform in its logarithm with log = true

---In a study: a Latin hypercube: each of n equal parts of each range holds one of the n points.
---@param keys erbs.latin_keys
---@return erbs.axes # for vary of study
function latin(keys) end

---@class erbs.random_keys
---@field n integer number of points [1 to 1e+06]
---@field seed? number seed of the draw; equal seeds give equal points [-1e+15 to 1e+15; default 1]
---@field PARAM? number[] range of each param: { lowest, highest }, uniform in its logarithm with log = true

---In a study: random points, independent of each other.
---@param keys erbs.random_keys
---@return erbs.axes # for vary of study
function random(keys) end

---@class erbs.perturbations_keys
---@field n integer number of runs, each with its own seed [1 to 1e+06]
---@field size? number largest shift and turn of each free block at the start [m and rad; 0 to 1; default 1e-09]

---In a study: the same run n times, each free block displaced and turned a little at random at the start (erbs run --noise).
---@param keys erbs.perturbations_keys
---@return erbs.axes # for vary of study
function perturbations(keys) end

---@class erbs.records_keys
---@field param string name of the param that takes the file, such as param("motion", "a.AT2")
---@field files string|string[] the records, named as in the scene
---@field scale? string name of the param that takes the peak acceleration
---@field scales? number[] peak accelerations (m/s2)

---In a study: ground motions by peak accelerations: incremental dynamic analysis.
---@param keys erbs.records_keys
---@return erbs.axes # for vary of study
function records(keys) end

---@class erbs.calibration_keys
---@field scene string the scene, a path from the folder of this file
---@field stages { fit?: table, raise?: table, key?: string, below?: number }[] one after the other, each with what those before it have found
---@field targets { label: string, keys: string|string[], values: number[], scale?: number }[] known values of metrics
---@field history? { column: string, label: string, known?: string, t: number[], values: number[] } a known history to draw beside that of the fitted run
---@field title? string title of calibration.svg
---@field rel? number smallest step of a fit and last bracket of a raise (0.02 without rel), shares of the range of a param [1e-09 to 0.5; default 0.001]
---@field rounds? integer steps of a stage, at most [1 to 1000; default 20]
---@field max_wall? number longest time of a run [s; 0.001 to 1e+07; default 3600]

---Fits params of a scene to known values by least squares, by erbs calibrate.
---@param keys erbs.calibration_keys
function calibration(keys) end

---@class erbs.rocking_keys
---@field width? number base of the block; with `height` it gives alpha, p and mu of a homogeneous block [m; 1e-06 to 1e+06]
---@field height? number height of the block [m; 1e-06 to 1e+06]
---@field alpha? number slenderness, atan(width / height) (default from width and height) [rad; 1e-06 to 1.5]
---@field p? number sqrt(m g R / I0) (default from width and height: sqrt(3 g / (4 R))) [rad/s; 1e-06 to 1e+06]
---@field mu? number spin after an impact over the spin before (default Housner's: 1 - 3/2 sin^2 alpha) [0 to 1]
---@field gravity? number strength of gravity (default: the scene's) [m/s2; 1e-06 to 1000]
---@field linear? boolean small angles: sin x = x, cos x = 1 [default false]
---@field wave? erbs.wave|number|fun(t: number): number acceleration of the ground (default: none, free rocking) [m/s2]
---@field sample? number sampling step of a Lua function [s; 1e-06 to 10; default 0.001]
---@field theta? number tilt at the start [rad; -1.5 to 1.5; default 0]
---@field spin? number spin at the start [rad/s; -1000 to 1000; default 0]
---@field kn? number stiffness of a bed, of which erbs check and the log then tell what it does to this block [Pa/m; 1000 to 1e+16]
---@field density? number of the block on the bed [kg/m3; 0.01 to 100000]
---@field restitution? number of the block on the bed [0 to 1; default 0.3]
---@field duration number simulated time [s; 1e-09 to 100000]

---Solution of Housner's equations for a rigid rocking block, to compare with a scene of one block.
---@param keys erbs.rocking_keys
---@return table # alpha, p, mu, threshold (m/s2), t, theta (rad), impacts (s), amplitudes (over alpha, before each impact), overturned, overturned_at; with kn: bed = { toe, inwards (m, from the edge to the line about which the block turns), alpha, p, mu, threshold }, as the bed changes them
function rocking(keys) end

---@class erbs.rocking_overturning_keys
---@field width? number base of the block; with `height` it gives alpha, p and mu of a homogeneous block [m; 1e-06 to 1e+06]
---@field height? number height of the block [m; 1e-06 to 1e+06]
---@field alpha? number slenderness, atan(width / height) (default from width and height) [rad; 1e-06 to 1.5]
---@field p? number sqrt(m g R / I0) (default from width and height: sqrt(3 g / (4 R))) [rad/s; 1e-06 to 1e+06]
---@field mu? number spin after an impact over the spin before (default Housner's: 1 - 3/2 sin^2 alpha) [0 to 1]
---@field gravity? number strength of gravity (default: the scene's) [m/s2; 1e-06 to 1000]
---@field linear? boolean small angles: sin x = x, cos x = 1 [default false]
---@field wave erbs.wave|number|fun(t: number): number acceleration of the ground for a factor of 1 [m/s2]
---@field sample? number sampling step of a Lua function [s; 1e-06 to 10; default 0.001]
---@field criterion? "overturning"|"alpha_at_end" overturning: it falls; alpha_at_end: |theta| has reached alpha when the wave ends [default overturning]
---@field from? number smallest factor tried [0 to 1e+09; default 0.9]
---@field to? number largest factor tried [0 to 1e+09; default 20]
---@field points? integer number of factors tried in between; narrower safe islands are not found [1 to 100000; default 1000]
---@field duration? number simulated time (default: until 12 / p after the wave; required for a Lua function) [s; 1e-09 to 100000]

---Factors on a wave at which a rigid rocking block overturns from rest.
---@param keys erbs.rocking_overturning_keys
---@return table # alpha, p, mu, threshold (m/s2), lowest (factor), bands { { from, to, impacts }, ... } whose gaps are safe islands
function rocking_overturning(keys) end

---@class erbs.wall_keys
---@field name? string first word of the names of its blocks, and their group [default wall]
---@field group? string group of the bricks; default the name
---@field length number length from end to end [m; at least 0]
---@field axis? "x"|"y" direction of the wall [default x]
---@field courses? integer number of courses; or give height [at least 1]
---@field height? number height instead of courses; rounded to whole courses [m; at least 0]
---@field at? erbs.vec3 position of the plan's origin; z is the top of the support [m; default { 0, 0, 0 }]
---@field brick { length: number, width: number, height: number } size of a whole brick: { length*, width*, height* }
---@field joint number thickness of bed and head joints; 0 is dry masonry [m; at least 0]
---@field closer? number shortest piece that may be cut [m; at least 0; default 0.04]
---@field joint_max? number widest head joint; default 1.5 joints [m; at least 0]
---@field shift? integer 1: start with the other of the two alternating courses [0 to 1; default 0]
---@field openings? { wall?: string, name?: string, kind?: "window"|"door", storey?: any, at?: number, centre?: number, width: number, sill?: number, height: number, lintel?: boolean }[] doors and windows: a list of { wall, name, kind, storey, at, centre, width*, sill, height*, lintel } [default {  }]
---@field lintel? { bearing?: number, courses?: integer, material?: string, group?: string } the pieces over openings: { bearing, courses, material, group } [default {  }]
---@field base? { thickness: number, margin?: number, material?: string, group?: string } a fixed plate below; default none (stand on ground{} or another block): { thickness*, margin, material, group }
---@field material? string material of the bricks [default brick]
---@field quiet? boolean true: do not print the summary [default false]

---A free-standing straight wall in running bond, both ends plain.
---@param keys erbs.wall_keys
---@return table # blocks (names), walls (groups), slabs, lintels, base, height (m), volume (m3), tops (m, of each storey), top (names: the slab or the last course), storey_top (the same of each storey), openings (by name, of a building as south.window1: kind, storey, lo, hi, sill, width, height, at, size, center (m); left, right, above, below (names), lintel), report, summary
function wall(keys) end

---@class erbs.building_keys
---@field name? string first word of all block names; default none
---@field group? string groups of the walls are <group>_<wall> [default wall]
---@field plan table outer size {x, y}, or outer corners {{x,y}, ...} counter-clockwise [m]
---@field closed? boolean false: the last corner is not joined to the first [default true]
---@field walls? table names of the walls; default south, east, north, west for a rectangle, else wall1, ...
---@field storeys? integer number of storeys [at least 1; default 1]
---@field courses any courses per storey: a number, or a list with one for each storey
---@field slab? { thickness: number, overhang?: number, material?: string, group?: string } a rigid plate on the walls of every storey; default none: { thickness*, overhang, material, group }
---@field at? erbs.vec3 position of the plan's origin; z is the top of the support [m; default { 0, 0, 0 }]
---@field brick { length: number, width: number, height: number } size of a whole brick: { length*, width*, height* }
---@field joint number thickness of bed and head joints; 0 is dry masonry [m; at least 0]
---@field closer? number shortest piece that may be cut [m; at least 0; default 0.04]
---@field joint_max? number widest head joint; default 1.5 joints [m; at least 0]
---@field shift? integer 1: start with the other of the two alternating courses [0 to 1; default 0]
---@field openings? { wall?: string, name?: string, kind?: "window"|"door", storey?: any, at?: number, centre?: number, width: number, sill?: number, height: number, lintel?: boolean }[] doors and windows: a list of { wall, name, kind, storey, at, centre, width*, sill, height*, lintel } [default {  }]
---@field lintel? { bearing?: number, courses?: integer, material?: string, group?: string } the pieces over openings: { bearing, courses, material, group } [default {  }]
---@field base? { thickness: number, margin?: number, material?: string, group?: string } a fixed plate below; default none (stand on ground{} or another block): { thickness*, margin, material, group }
---@field material? string material of the bricks [default brick]
---@field quiet? boolean true: do not print the summary [default false]

---Walls along a plan with interlocked corners, storey on storey, with openings, lintels and slabs.
---@param keys erbs.building_keys
---@return table # blocks (names), walls (groups), slabs, lintels, base, height (m), volume (m3), tops (m, of each storey), top (names: the slab or the last course), storey_top (the same of each storey), openings (by name, of a building as south.window1: kind, storey, lo, hi, sill, width, height, at, size, center (m); left, right, above, below (names), lintel), report, summary
function building(keys) end

---@class erbs.arch_keys
---@field name? string first word of the names of its blocks [default arch]
---@field group? string group of the voussoirs; default the name; abutments are in <group>_abutment
---@field at? erbs.vec3 middle of the span, at the height of the centre of the circle [m; default { 0, 0, 0 }]
---@field radius number radius of the centre line [m; at least 0]
---@field thickness number radial thickness of the ring [m; at least 0]
---@field width number width across the span [m; at least 0]
---@field voussoirs integer number of voussoirs (even for a pointed arch) [at least 1]
---@field embrace? number angle of a round arch from springing to springing [rad; 0 to 4.71239; default 3.14159]
---@field offset? number pointed arch: distance of the centres of its two arcs from the middle; 0: round arch [m; at least 0; default 0]
---@field axis? "x"|"y" direction of the span [default x]
---@field abutments? boolean fixed blocks at the springings [default true]
---@field material? string material of all its blocks; default: the only one there is

---An arch of voussoirs with radial joints and straight sides, round or pointed (two arcs). Blocks are called arch.v01, ... from the left.
---@param keys erbs.arch_keys
---@return table # blocks (names), abutments (names), crown (names of the blocks at the crown), span (m, clear), height (m, of the crown's back above at), volume (m3), centre_line (m)
function arch(keys) end

---@class erbs.barrel_keys
---@field name? string first word of the names of its blocks [default barrel]
---@field group? string group of the voussoirs; default the name; abutments are in <group>_abutment
---@field at? erbs.vec3 middle of the span, at the height of the centre of the circle [m; default { 0, 0, 0 }]
---@field radius number radius of the centre line [m; at least 0]
---@field thickness number radial thickness of the ring [m; at least 0]
---@field width number width across the span [m; at least 0]
---@field voussoirs integer number of voussoirs (even for a pointed arch) [at least 1]
---@field embrace? number angle of a round arch from springing to springing [rad; 0 to 4.71239; default 3.14159]
---@field offset? number pointed arch: distance of the centres of its two arcs from the middle; 0: round arch [m; at least 0; default 0]
---@field axis? "x"|"y" direction of the span [default x]
---@field abutments? boolean fixed blocks at the springings [default true]
---@field material? string material of all its blocks; default: the only one there is
---@field rows integer blocks across the width; in every other voussoir shifted by half a block [at least 2]

---A barrel vault in bond: an arch of several blocks across its width, staggered from voussoir to voussoir. Blocks are called barrel.v01.r1, ... (voussoir from the left, row across).
---@param keys erbs.barrel_keys
---@return table # blocks (names), abutments (names), crown (names of the blocks at the crown), span (m, clear), height (m, of the crown's back above at), volume (m3), centre_line (m)
function barrel(keys) end

---@class erbs.column_keys
---@field name? string first word of the names of its blocks, and their group [default column]
---@field group? string group of the blocks; default the name
---@field at? erbs.vec3 middle of its foot [m; default { 0, 0, 0 }]
---@field blocks integer number of blocks [at least 1]
---@field size? erbs.vec3 size of one block along x, y, z [m]
---@field diameter? number diameter of round drums, instead of size [m; at least 0]
---@field height? number height of one drum [m; at least 0]
---@field sides? integer number of sides of a drum; its corners lie on the circle [at least 3; default 24]
---@field joint? number thickness of the joints, also below the first block; 0 is dry [m; at least 0; default 0]
---@field material? string material of all its blocks; default: the only one there is

---A stack of equal blocks, square or round (a prism of many sides). Blocks are called column.b01, ... from the bottom.
---@param keys erbs.column_keys
---@return table # blocks (names), top (names of the last), height (m), volume (m3)
function column(keys) end

---@class erbs.arcade_keys
---@field name? string first word of the names of its blocks [default arcade]
---@field group? string first word of its groups; default the name
---@field at? erbs.vec3 left end of its foot, in the middle of its width [m; default { 0, 0, 0 }]
---@field axis? "x"|"y" direction it runs in [default x]
---@field spans any clear width between the piers: a number, or a list with one for each arch [m]
---@field piers any width of the piers: a number, or a list with one for each pier [m]
---@field feet? any where the ground is not level: height of the foot of the piers above that of the arcade, rounded to courses: a number, or a list with one for each pier; default 0 [m]
---@field bays? integer number of arches, where spans is one number [at least 1]
---@field ends? "pier"|"half" half: the first and the last arch are cut at their crown [default pier]
---@field width number width across the axis [m; at least 0]
---@field rows? integer blocks across the width; in every other course shifted by half a block [at least 1; default 1]
---@field block { length: number, height: number } size of a block: { length*, height* }
---@field least? number narrowest piece that a perpend may leave; default 0.4 of the length [m; at least 0]
---@field tiers { springing: number, top: number, thickness: number, crown?: integer }[] from the bottom up: a list of { springing*, top*, thickness*, crown }
---@field fixed_courses? integer courses at the foot of a pier that are part of the ground [at least 0; default 0]
---@field material? string material of its blocks; default: the only one there is
---@field ring_material? string material of the voussoirs; default that of the blocks
---@field quiet? boolean true: do not print the summary [default false]

---Piers, round arches of voussoirs and the courses above them, cut along the arches, in one tier or several. Blocks meet without gaps; they are called arcade.c012.b003.r1 (course, number, row across) and arcade.t1.a02.v05.r1 (tier, arch, voussoir, row). Groups are <group>_pier, <group>_ring and <group>_spandrel.
---@param keys erbs.arcade_keys
---@return table # blocks (names), base (names of the fixed ones), top (names of the last course), tops (m, of each tier), height, length (m), volume (m3), openings (by name, as t1.a02: tier, bay, span, thickness, springing, crown, center (m); ring, left, right (names)), piers (axis, width, foot (m); courses: names at its axis, by course from the foot of the arcade), summary
function arcade(keys) end

---@class erbs.footed_block_keys
---@field name? string name of the block [default block]
---@field group? string group of the block
---@field size erbs.vec3 size along x, y, z, feet included [m]
---@field at? erbs.vec3 middle of its lower face, on the bed [m; default { 0, 0, 0 }]
---@field rocks? "x"|"y"|"xy" direction in which it rocks: feet along both edges across it; xy: four feet at the corners [default x]
---@field foot? number width of a foot over that of the block [0 to 0.5; default 0.008]
---@field hollow? number height of the feet over that of the block [0 to 0.5; default 0.001]
---@field material? string material of the block; default: the only one there is
---@field free? boolean allowed to have no joint: its feet are contacts from the start [default false]
---@field initial? table initial state, as in block{}

---A block that stands on small feet along its lower edges instead of its whole face, like test blocks with a slightly hollow base. An impact then acts at its edges, as Housner assumes.
---@param keys erbs.footed_block_keys
---@return table # name, width and height of a foot (m), share of the feet in the face: a joint or contact presses them like the whole face if its kn is divided by it
function footed_block(keys) end

---@class erbs.buttress_keys
---@field name? string first word of the names of its blocks, and their group [default buttress]
---@field group? string group of the blocks; default the name
---@field at? erbs.vec3 point of the wall's face in the middle of its width, at the foot [m; default { 0, 0, 0 }]
---@field towards? "x"|"-x"|"y"|"-y" direction away from the wall [default x]
---@field width number width along the wall [m; at least 0]
---@field depth number projection from the wall at the foot [m; at least 0]
---@field top_depth? number projection at the top; default that at the foot [m; at least 0]
---@field steps? integer 0: the outer face leans evenly; else the number of set-backs between foot and top [at least 0; default 0]
---@field courses integer number of courses [at least 1]
---@field block { length: number, height: number } size of a block: { length*, height* }
---@field rows? integer blocks along the wall; in every other course shifted by half a block [at least 1; default 1]
---@field joint? number thickness of bed joints, and of the joint to the wall; 0 is dry [m; at least 0; default 0]
---@field least? number narrowest piece that a perpend may leave; default 0.4 of the length [m; at least 0]
---@field material? string material of its blocks; default: the only one there is

---A pier against a wall, in bond: battered (its outer face leans), stepped, or upright. Blocks are called buttress.c03.b02.r1 (course, number from the wall, row along the wall).
---@param keys erbs.buttress_keys
---@return table # blocks (names), foot, top, back (names of the first course, of the last, and of the blocks at the wall), depths (m, of each course at its middle), height (m), volume (m3)
function buttress(keys) end

