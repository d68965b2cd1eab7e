// The texts of the verification book that no run writes: how to write a case, and how a run ends.
#pragma once

namespace erbs::lua {

inline constexpr const char* how_to_write_a_case = R"(## How to write a case
1. A case is a scene in `scenes/verify` (v01 to v46 by problem) or `scenes/hard` (h and m). Its name decides its family below.
2. The first line of the head is its title. Then come the event, the source with author, year and equation, the command, and the numbers to look at.
3. Take the smallest scene whose answer is a number on paper. Compute the geometry. What may vary is a `param`.
4. `metric("fallen_m", "m", function(run) return -run.last("block1_uz_rel_m") end)` makes the number.
5. `expect("metrics.fallen_m", 4.905, { rel = 1e-12, source = "g t^2 / 2" })` states it; `rel`, `abs`, `below`, `above` and `between` are tolerances.
6. The comment above it names the cause of the tolerance: round-off, order of the step, stiffness of a bed. It is not tuned until it passes.
7. `expect("energy.residual_relative", 1e-6, { below = true })` holds the ledger as well.
8. `label("quick")` puts the case into the test preset, `family{ ... }` into the grid.
9. `erbs test scenes/verify/v01_free_fall.lua` prints the verdict, `erbs test scenes/verify scenes/hard --book tests/README.md` writes this book.

)";

inline constexpr const char* endings_table = R"(## How a run ends
What can go wrong with a run, how it then ends, and what is lost. Each line is a test in `tests/unit/lua/commands/endings_test.cpp` or was tried by
hand.

| cause | how the run ends | code | loss |
|---|---|---|---|
| Ctrl-C, SIGTERM, SIGHUP (a closed terminal) | it writes a checkpoint, `status` is `interrupted`; runs that it started end likewise; a second signal ends it at once | 130 | nothing: `--resume` ends with the same bits |
| `kill -9`, a power cut | the files remain up to the last flush of rows and the last complete checkpoint; runs and drawing processes that it started end too | 137 | the time simulated since the last checkpoint (`--checkpoint-every`, 60 s) |
| the disk, a quota or `ulimit -f` is full | a message with the file and the reason of the system; no partial file remains | 3 with a checkpoint, otherwise 2 | the time since the last checkpoint; make room, then `--resume` or `--force` |
| a limit of memory, threads or open files | a message with the limit | 2 | the run; before the first step nothing is written |
| a folder that is read-only, is no folder, or belongs to something else | refused before the run | 2 | nothing; other files stay untouched, with `--force` too |
| another run works in the folder | the second run is refused, whatever its options | 2 | nothing |
| `--resume` with another scene, `-D`, options, files or a changed row | refused, with the difference | 2 | nothing |
| manifest.json is damaged | `--resume` and `--force` work; `--resume` writes it anew | | nothing |
| checkpoint.bin or motion.h5 is damaged or missing | `--resume` is refused with the reason | 2 | the run: `--force` starts it anew |
| stdout is full or closed | the run continues to its end; then a message on stderr | 2 if all else succeeded | the printed text; the files are complete |
| a closed pipe (`erbs help \| head`) | printing stops | unchanged | nothing |
| gnuplot is missing or fails | a warning; the run is valid | unchanged | the curves; `erbs render DIR --figures` draws them |
| ffmpeg or erbs-render is missing, with `--video` | refused before the run | 2 | nothing |
| a film is stopped halfway | no film of that name exists; the finished pictures remain, each complete | 130 | the film; `erbs render DIR --force` draws it anew |
| a script exceeds its time (10 s), memory (512 MiB, 2 GiB with the model), print (1 MiB), blocks or points | a message with line, limit and remedy | 2 | nothing was begun |
| `--max-wall`, `--until`, `--budget` is reached | a checkpoint; cases without time are `not run`, and none counts as failed | 3 | nothing: `--resume` |
| a run of a study, of `accuracy`, a grid or a map is killed | a row with the reason; the other runs count | unchanged | that run: `--resume` repeats it |
| motion.h5 is damaged, and drawn | refused within some seconds, or drawn if the damage is outside the drawn part | 2 | the run: `--force` starts it anew |

## Sanitizers
`cmake --workflow --preset asan-clang` (clang++ 14: `apt-get install clang libclang-rt-14-dev`; address, undefined behaviour, leaks except those of
OpenGL's drivers), `asan` (the same by g++), `tsan` (the threaded tests). At -O1 on two busy cores: by clang++ 17 min to build, then
1,011 tests in 30 min, one at a time, the longest 110 s; the threaded tests under `tsan` 12 min, the longest 3 min. `ERBS_ISA=sse2` or `avx2`
before a command selects the other kernels.
)";

}  // namespace erbs::lua
