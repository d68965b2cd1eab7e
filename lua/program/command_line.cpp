#include "lua/program/command_line.h"

#include <algorithm>

#include "engine/record/results/limits.h"

namespace erbs::lua {
namespace {

void add_run(CLI::App& app, RunCommand& command) {
  CLI::App& run = *app.add_subcommand("run", "run a scene into a folder of results");
  SceneChanges& changes = command.changes;
  run.add_option("SCENE.lua|DIR", command.words, "the scene, or with --resume the folder of its run")->required()->expected(1);
  add_output(run, command.output);
  add_scene(run, command.scene);
  run.add_option("--threads", command.threads, "threads (default: as many as the machine has, 1 for few blocks)")->check(within(1, 1024));
  run.add_option("-j", command.jobs, "runs of its studies at once (default: --threads, else one per processor)")->check(within(1, 1024));
  add_time(run, "--until", command.until, "stop at this simulated time, with a checkpoint", "T");
  run.add_flag("--resume", command.resume, "continue from the checkpoint in the folder; erbs run DIR --resume needs no other option");
  add_max_wall(run, command.max_wall, "stop after this wall-clock time, with a checkpoint", "30m");
  add_time(run, "--checkpoint-every", command.checkpoint_every, "wall-clock time between checkpoints (default 60s)", "60s");
  run.add_option("--dt-fraction", changes.dt_fraction, "time step as a share of dt_critical, whatever the scene says")
      ->check(within(1e-6, 1e3));
  run.add_option("--points", changes.points, "contact points of every joint: 4, 9, 16, 25 (a square on each face)")
      ->check(within(1, 10000));
  run.add_option("--rule", changes.rule, "quadrature rule of the contact points of every joint")
      ->check(CLI::IsMember({"simpson", "midpoint", "trapezoid", "gauss"}));
  run.add_option("--set", changes.settings, "another value for a key of analysis{}, with units: --set output_dt=2*ms")
      ->type_name("key=value")
      ->expected(1)
      ->take_all();
  run.add_option("--stiffness", changes.stiffness, "factor on the stiffness of every joint")->check(within(1e-6, 1e6));
  run.add_option("--damping", changes.damping, "mass damping c/m instead of the scene's, 1/s")->check(within(0.0, 1e7));
  run.add_option("--damping-form", changes.damping_form, "velocity that mass damping uses: the mean over the step, or the one before it")
      ->check(CLI::IsMember({"centred", "explicit"}));
  add_time(run, "--from", changes.from, "start the loads at this time, with the structure at rest: a window of a long record", "T");
  run.add_option(
         "--noise", changes.noise,
         "perturb the initial state of every free block by up to this (m and rad), with the same seed unless --noise-seed says another")
      ->check(within(0.0, 1.0));
  run.add_option("--noise-seed", changes.noise_seed, "seed of --noise (default: 1)")->check(within(1, 1000000))->needs("--noise");
  run.add_option("--push-to", changes.push_to,
                 "push to this displacement of the monitored point (m) and no further, such as the one of the performance point")
      ->check(within(1e-9, 1e3));
  run.add_option("--twin-noise", command.twin_noise)->group("");  // of the twin run that --twin starts
  run.add_flag("--twin", command.twin, "also run a twin perturbed by 1e-9, and report when the two differ by 1 mm (the chaos horizon)");
  run.add_flag_callback(
      "--no-figures", [&command] { command.figures = false; }, "draw no curves");
  run.add_flag("--figure-scripts", command.figure_scripts)->group("");  // of the runs that erbs test starts
  run.add_flag("--video", command.video, "draw the run and make its video at the end");
  run.add_option("--study", command.study)->group("");                                        // of the runs that a study starts
  run.add_flag_callback("--no-studies", [&command] { command.studies = false; })->group("");  // of the runs of erbs sweep
  run.add_option("--without", changes.without, "run without an effect of the scene, by its name in erbs check")
      ->type_name("EFFECT")
      ->take_all();
  run.add_flag("--profile", command.profile, "print where the time went, and what kept the steps short");
  run.add_flag_callback(
      "--log-json", [&command] { command.log_json = true, tell_as_json(); },
      "print progress, warnings and errors to stderr as lines of JSON");
  run.add_flag("--fail-on-collapse", command.fail_on_collapse, "exit with 4 when the structure collapses");
}

void add_plot(CLI::App& app, PlotCommand& command) {
  CLI::App& plot = *app.add_subcommand(
      "plot", "draw columns of histories.csv and energy.csv, or of the curve.csv of a push, of several runs over each other");
  plot.add_option("DIR", command.words, "the run folders")->required();
  plot.add_option("--y", command.y, "columns to draw: names, their beginnings, or patterns with * and ?")
      ->delimiter(',')
      ->check(filled())
      ->type_name("COL,COL");
  plot.add_option("--x", command.x, "column of the horizontal axis (default time_s)")->check(filled())->type_name("COL");
  plot.add_flag("--list", command.list, "list the columns with their units, and draw nothing");
  plot.add_flag("--spectrum", command.spectrum, "Fourier amplitudes over frequency");
  plot.add_flag("--response", command.response, "pseudo-acceleration response spectrum of accelerations over period");
  const auto read_damping = [&command](const std::string& value) { command.damping = share_of(value, "--damping"); };
  plot.add_option_function<std::string>("--damping", read_damping, "damping ratio of --response (default 0.05)")
      ->check(filled())
      ->type_name("0.05");
  plot.add_flag("--envelope", command.envelope, "running maximum of the absolute value");
  plot.add_flag("--drift", command.drift,
                "instead of columns: displacement and drift over the height of the structure, until it collapses");
  plot.add_option("--histogram", command.histogram,
                  "instead of columns: distribution of the mean normal_stress or shear_stress of the joints over their area, at --time")
      ->check(CLI::IsMember({"normal_stress", "shear_stress"}))
      ->type_name("STRESS");
  plot.add_option("--group", command.group, "blocks of this group alone, such as a wall, of --drift")->check(filled())->type_name("GROUP");
  plot.add_option("--levels", command.levels, "levels of --drift at most, each of as many courses (default 24)")->check(within(2, 1000));
  plot.add_option("--time", command.time, "only this span, s; of --histogram one time (default the last frame)")
      ->check(filled())
      ->type_name("T0:T1");
  plot.add_option("-o", command.output.directory, "the picture, SVG or PNG by its ending (default DIR/plot.svg)")
      ->check(filled())
      ->type_name("FILE");
  plot.add_flag("--png", command.png, "a PNG, DIR/plot.png by default");
  plot.add_flag("--force", command.output.force, "replace an earlier picture");
  plot.add_flag("-q,--quiet", command.output.quiet, "print warnings and errors only");
}

void add_report(CLI::App& app, ReportCommand& command) {
  CLI::App& report = *app.add_subcommand(
      "report", "write a run as one web page: verdict, replay in 3D, curves, events, parameters; or a study: its answer, charts, rows");
  report.add_option("DIR", command.words, "the folder of a run, of erbs sweep or of erbs accuracy")->required();
  report.add_option("-o", command.output.directory, "the page (default DIR/report.html)")->check(filled())->type_name("FILE");
  report.add_flag("--force", command.output.force, "replace an earlier page");
  report.add_flag("-q,--quiet", command.output.quiet, "print warnings and errors only");
}

void add_limit(CLI::App& app, LimitCommand& command) {
  CLI::App& limit = *app.add_subcommand(
      "limit", "limit analysis: the multiplier of a load at which the blocks become a mechanism, with its bracket, without a run");
  limit.add_option("SCENE.lua", command.words, "the scene")->required()->expected(1);
  limit.add_option("-o", command.output.directory, "folder for limit.json, mechanism.csv, thrust.csv and the figure (default: none)")
      ->check(filled())
      ->type_name("DIR");
  limit.add_flag("--force", command.output.force, "replace an earlier analysis there");
  limit.add_flag("-q,--quiet", command.output.quiet, "print warnings and errors only");
  add_scene(limit, command.scene);
  limit
      .add_option("--direction", command.direction,
                  "of an acceleration on all masses, instead of the scene's load: x, -x, y, -y, z, -z or x,y,z (default: analysis{} of the "
                  "scene, else x)")
      ->check(filled())
      ->type_name("x|-x|x,y,z");
  limit
      .add_option("--facets", command.facets,
                  "friction cones with this many facets, inscribed and circumscribed, as two linear programs (default: round cones)")
      ->check(within(4, 256));
  limit.add_flag("--no-tension", command.no_tension, "without tensile strength and cohesion of the joints");
  limit.add_flag("--associated", command.associated, "only with dilatancy equal to friction, without the non-associated iteration");
}

void add_compare(CLI::App& app, CompareCommand& command) {
  CLI::App& compare = *app.add_subcommand("compare", "errors of a run against another run, measured displacements or a film");
  compare
      .add_option("DIR REFERENCE", command.words,
                  "the run folder; another one, a CSV file with time_s and columns named alike, a film, or a folder of PNG frames")
      ->required();
  compare.add_option("--align", command.align, "how times are brought together (default none for a run, otherwise correlation)")
      ->check(CLI::IsMember({"none", "first-motion", "correlation"}));
  add_time(compare, "--reach", command.reach, "the largest lag that is searched (default 5s)", "5s");
  compare.add_option("--time", command.time, "only this span, in the time of the reference, s (default: what both have)")
      ->check(filled())
      ->type_name("T0:T1");
  compare.add_option("--columns", command.columns, "further pairs of columns of the two")
      ->delimiter(',')
      ->check(filled())
      ->type_name("RUN=REF");
  compare
      .add_option(
          "--expect", command.expect,
          "limits such as peak<5%,correlation>.9; exit code 4 beyond, and where a run is unfinished or the two have less than 95 % of "
          "their time in common, unless --time says the part. Of runs: " +
              compared_names(false) + "; of a film: " + compared_names(true))
      ->check(filled())
      ->type_name("'peak<5%,lag<.01'");
  for (const auto& [name, text] : film_options()) {
    const auto pass = [&command, name = name](const std::string& value) { command.film.insert(command.film.end(), {name, value}); };
    compare.add_option_function<std::string>(name, pass, "of a film: " + text)->check(filled());
  }
  compare.footer(
      "A film of erbs render must be made with --no-overlay: its title, legend and strip are taken for the structure otherwise, and they\n"
      "leave it less room. e.g. erbs render runs/a --no-overlay && erbs compare runs/b runs/a/a_corner.mp4 --film-background drawn");
  add_output(compare, command.output, "DIR/compare");
}

void add_capacity(CLI::App& app, CapacityCommand& command) {
  CLI::App& capacity = *app.add_subcommand("capacity", "performance point of a finished pushover, for its spectrum or another one");
  capacity
      .add_option("DIR", command.words, "the run folder, and the keys of another spectrum{}: 'kind = \"TBSC 2018\", SDS = 0.9, SD1 = 0.25'")
      ->required()
      ->expected(1, 2);
  capacity.add_flag_callback(
      "--no-figures", [&command] { command.figures = false; }, "do not draw the performance point");
  capacity.add_option("-o", command.output.directory, "the results for another spectrum, JSON (default DIR/performance_<spectrum>.json)")
      ->check(filled())
      ->type_name("FILE");
  capacity.add_flag("--force", command.output.force, "replace earlier results for that spectrum");
  capacity.add_flag("-q,--quiet", command.output.quiet, "print warnings and errors only");
}

void add_others(CLI::App& app, CommandLine& line) {
  CLI::App& check = *app.add_subcommand("check", "report all mistakes of a scene, and the size and cost of a run, without running it");
  check.add_option("SCENE.lua", line.check.words, "the scenes")->required();
  check.add_flag("-q,--quiet", line.check.quiet, "print warnings and errors only");
  add_scene(check, line.check.scene);

  CLI::App& render = *app.add_subcommand("render", "draw a run: frames, video, curves (options: erbs-render --help)");
  render.set_help_flag();  // erbs-render explains its own options
  render.prefix_command();

  CLI::App& exported = *app.add_subcommand("export", "write a run for other programs: glTF, VTU, XDMF, HDF5, OBJ, CSV");
  exported.add_option("DIR", line.exported.words, "the run folder")->required();
  exported
      .add_option(
          "--format", line.exported.formats,
          "gltf: animated blocks, and a script that loads them in Blender; vtu or xdmf: blocks with damage and velocity, joints with "
          "tractions (of a scene with frame_stress), for ParaView; hdf5: the same for scripts, with units; obj: one instant; csv: all "
          "poses")
      ->delimiter(',')
      ->check(CLI::IsMember({"gltf", "vtu", "xdmf", "hdf5", "obj", "csv"}));
  for (const auto& [flag, format] : {std::pair{"--glb", "gltf"}, {"--vtk", "vtu"}, {"--csv", "csv"}})
    exported.add_flag_callback(
        flag, [&line, format = format] { line.exported.short_forms.emplace_back(format); }, fmt::format("short for --format {}", format));
  exported.add_option("--time", line.exported.time, "only this span, s")->type_name("T0:T1");
  exported.add_option("--every", line.exported.every, "every N-th frame, and the last")->check(within(1, 1000000));
  exported.add_option("--at", line.exported.at, "the instant of an OBJ, s (default: the last frame)")->check(within(-1e9, 1e9));
  add_output(exported, line.exported.output, "DIR/export");

  CLI::App& record = *app.add_subcommand("record", "report a ground motion: points, dt, peaks, end values, Arias intensity, spectrum");
  record.add_option("FILE", line.record.words, "PEER AT2, ESM, COSMOS or CSMIP V2, CSV or text of columns")->required();
  add_output(record, line.record.output, "runs/<file name>");
  record.add_option("--dt", line.record.record.dt, "time step of a file that has values only, s")->check(within(1e-6, 1e3));
  record.add_option(
      "--unit", line.record.record.unit,
      "unit of the values, if the file does not give one: g, mg, m/s2, cm/s2, gal, mm/s2, ft/s2, in/s2; m/s, ... or m, ... by quantity");
  record.add_option("--column", line.record.record.column, "column of the values, from 1")->check(within(1, 1000));
  record.add_option("--decimal", line.record.record.decimal, "decimal mark of the file (default: auto)")
      ->check(CLI::IsMember({"auto", "point", "comma"}));
  record.add_option("--quantity", line.record.record.quantity, "what the file holds (default: acceleration)")
      ->check(CLI::IsMember({"acceleration", "velocity", "displacement"}));
  record.add_option("--smoothing", line.record.record.smoothing, "corner of the spline that differentiates a velocity or displacement, Hz")
      ->check(within(1e-6, 1e4));
  record.add_option("--baseline", line.record.record.baseline, "polynomial taken from the acceleration (default: none)")
      ->check(CLI::IsMember({"none", "constant", "linear", "quadratic", "cubic"}));
  record.add_option("--low", line.record.record.low, "lower corner of a Butterworth band-pass of zero phase, Hz")->check(within(1e-6, 1e4));
  record.add_option("--high", line.record.record.high, "its upper corner, Hz")->check(within(1e-6, 1e4));
  record.add_option("--band-order", line.record.record.band_order, "its order in each of two passes (default: 4)")->check(within(1, 10));

  CLI::App& test = *app.add_subcommand("test", "run scenes with expectations, and print the table of results");
  test.add_option("DIR|SCENE.lua", line.test.words, "folders and scenes")->required();
  test.add_option("-j", line.test.batch.jobs, "number of runs at once (default: one per processor)")->check(within(1, 1024));
  test.add_option("--threads", line.test.batch.threads, "threads of each run")->check(within(1, 1024));
  add_max_wall(test, line.test.batch.max_wall, "stop a run after this wall-clock time", "10m");
  add_scene(test, line.test.scene);
  test.add_option("-o", line.test.directory, "folder for the runs (default runs/test)")->check(filled())->type_name("DIR");
  test.add_flag("-q,--quiet", line.test.batch.quiet, "no progress");
  test.add_flag("--quick", line.test.quick, "only scenes with label(\"quick\")");
  test.add_flag("--bless", line.test.bless,
                "after the table: keep the pictures and values of these runs as those that expect_image and expect_stored ask for");
  test.add_option("--book", line.test.book, "write the verification book to this file, with its figures and its summary in README.md")
      ->type_name("FILE.md");
  test.add_flag("--grid", line.test.grid,
                "run every scene at dt 0.2, 0.5, 0.9 of the limit, with 4, 9, 25 points per joint and noise, or over its family{}; report "
                "the worst value of each invariant");
  test.add_option(
          "--seeds", line.test.seeds,
          "run every scene with its param seed at 1, 2, ... N; report the worst value of each invariant, and the seeds that fail it")
      ->type_name("N")
      ->check(within(1, 1000000));
  test.add_flag("--resume", line.test.batch.resume, "with --grid or --seeds: keep finished runs");
  add_time(test, "--budget", line.test.batch.budget, "wall-clock time of all runs together; no run starts after it (--grid: 60m)", "60m");

  CLI::App& sweep = *app.add_subcommand("sweep", "run a study: many runs of a scene, and a table of their results (erbs help study)");
  sweep.add_option("STUDY.lua", line.sweep.words, "the study")->required()->expected(1);
  add_output(sweep, line.sweep.output, "runs/<study name>");
  add_scene(sweep, line.sweep.scene);
  sweep
      .add_option("-j", line.sweep.jobs,
                  "number of runs at once (default: one per processor; one under mpirun, whose ranks share the study); with --slurm: tasks")
      ->check(within(1, 100000));
  sweep.add_flag("--resume", line.sweep.resume, "keep finished runs, or join a sweep that is under way");
  sweep.add_flag("--slurm", line.sweep.slurm, "run nothing; write DIR/job.sh, a job array for sbatch");

  CLI::App& calibrate =
      *app.add_subcommand("calibrate", "fit params of a scene to known values by least squares, and draw it (erbs help calibration)");
  calibrate.add_option("STUDY.lua", line.calibrate.words, "the file with calibration{}")->required()->expected(1);
  add_output(calibrate, line.calibrate.output, "runs/<study name>");
  add_scene(calibrate, line.calibrate.scene);
  calibrate.add_option("-j", line.calibrate.jobs, "number of runs at once (default: one per processor)")->check(within(1, 1024));
  calibrate.add_flag("--resume", line.calibrate.resume, "keep finished runs of a calibration that was interrupted");

  CLI::App& accuracy =
      *app.add_subcommand("accuracy", "the cost of accuracy: run a scene with one setting changed at a time, errors over cost");
  accuracy.add_option("SCENE.lua", line.accuracy.words, "the scene; with --study, the folder of the problems (default scenes/accuracy)");
  add_output(accuracy, line.accuracy.output);
  add_scene(accuracy, line.accuracy.scene);
  accuracy.add_option("-j", line.accuracy.batch.jobs, "number of runs at once (default: one per processor)")->check(within(1, 1024));
  accuracy.add_flag("--resume", line.accuracy.batch.resume, "keep finished runs");
  const auto read_target = [&line](const std::string& value) { line.accuracy.target = share_of(value, "--target"); };
  accuracy
      .add_option_function<std::string>("--target", read_target,
                                        "find the cheapest setting with this error, and the line to write into the scene")
      ->check(filled())
      ->type_name("1%");
  add_time(accuracy, "--budget", line.accuracy.budget,
           "find the most accurate setting that runs within this time; with --map: wall-clock time of all runs together (default 60m)",
           "60s");
  accuracy.add_option("--quantity", line.accuracy.quantity,
                      "the metric to measure (default: the first with an expectation, otherwise the first)");
  add_max_wall(accuracy, line.accuracy.batch.max_wall, "wall-clock time of each run (default 5m)", "5m");
  add_time(accuracy, "--within", line.accuracy.within,
           "wall-clock time of all runs of the scene, cheap ones first; runs that do not fit are reported, and --resume makes them "
           "(default 2m; 0: no limit, as with --study)",
           "2m");
  accuracy
      .add_option("--knob", line.accuracy.knobs,
                  "only this knob, such as \"time step\" or one of accuracy{}; or vary this param of the scene, values from coarse to fine")
      ->check(filled())
      ->type_name("NAME|PARAM=V1,V2")
      ->expected(1)
      ->take_all();
  accuracy.add_flag("--study", line.accuracy.whole_study,
                    "every problem of the folder, media/accuracy.png and the tables of its README.md");

  accuracy.add_flag("--map", line.accuracy.map,
                    "instead: find the time steps, stiffnesses and dampings at which both solvers converge, over a window around the peak");
  add_time(accuracy, "--window", line.accuracy.window, "with --map: length of the window (default 2s)", "2s");

  CLI::App& bench = *app.add_subcommand("bench", "time the step kernel against the reference and the limits of the machine");
  bench.add_option("SCENE.lua", line.bench.words, "scenes to time (default: the scenes of scenes/bench, into a folder)");
  add_output(bench, line.bench.output);
  add_scene(bench, line.bench.scene);

  CLI::App& effects = *app.add_subcommand("effects", "the cost of each effect of a scene, and the change of the results without it");
  effects.add_option("SCENE.lua", line.effects.words, "the scene")->required()->expected(1);
  add_output(effects, line.effects.output, "runs/<scene name>_effects");
  add_scene(effects, line.effects.scene);
  effects.add_option("-j", line.effects.batch.jobs, "number of runs at once (default 1: runs at once disturb each other's times)")
      ->check(within(1, 1024));
  effects.add_flag("--resume", line.effects.batch.resume, "keep finished runs");
  add_max_wall(effects, line.effects.batch.max_wall, "end a run after this wall-clock time (default: never)", "30m");

  CLI::App& help = *app.add_subcommand("help", "this text, or the help of a verb or of a scene function");
  help.add_option("VERB|FUNCTION", line.words, "verb or function to explain");
  help.prefix_command();
  app.add_subcommand("version", "the version and the commit it was built from");
}

}  // namespace

void add_verbs(CLI::App& app, CommandLine& line) {
  add_run(app, line.run);
  add_others(app, line);
  add_plot(app, line.plot);
  add_report(app, line.report);
  add_compare(app, line.compare);
  add_limit(app, line.limit);
  add_capacity(app, line.capacity);
}

RunCommand read_run(std::vector<std::string> words) {
  RunCommand command;
  CLI::App app;
  add_run(app, command);
  std::ranges::reverse(words);  // CLI11 takes them from the back
  app.parse(std::move(words));
  return command;
}

}  // namespace erbs::lua
