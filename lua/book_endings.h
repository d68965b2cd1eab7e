// Table of the verification book: how a run ends.
#pragma once

namespace erbs {

inline constexpr const char* endings_table = R"(## How a run ends
What can go wrong about a run, what it makes of that, and what is lost. Each line is a test in `tests/unit/lua/endings_test.cpp` or was
tried by hand.

| what happens | how it ends | code | what is lost |
|---|---|---|---|
| Ctrl-C, SIGTERM, SIGHUP (a closed terminal) | a checkpoint is written, `status` is `interrupted`; runs that it started are told and end likewise; a second signal ends at once | 130 | nothing: `--resume` ends with the same bits |
| `kill -9`, a power cut | the files up to the last flush of rows, the last whole checkpoint; runs and drawing processes that it started end too | 137 | what was simulated since the last checkpoint (`--checkpoint-every`, 60 s) |
| the disk, a quota or `ulimit -f` is full | the file and the system's reason; no half file stays | 3 with a checkpoint, else 2 | since the last checkpoint; after making room `--resume`, else `--force` |
| a limit of memory, threads or open files | what the system refuses | 2 | the run; before the first step nothing is written |
| a folder that is read-only, no folder, or another's | refused before the run | 2 | nothing; other files are left alone, `--force` or not |
| another run is at work in the folder | the second is refused, whatever its options | 2 | nothing |
| `--resume` with another scene, `-D`, options, files or a changed row | refused, with what differs | 2 | nothing |
| manifest.json is damaged | `--resume` and `--force` work all the same; `--resume` writes it anew | | nothing |
| checkpoint.bin or motion.h5 is damaged or gone | `--resume` is refused with the reason | 2 | the run: `--force` starts it anew |
| stdout is full or closed | the run is carried through; then a message on stderr | 2 where all else was well | what was printed; the files are whole |
| a pipe that is closed (`erbs help \| head`) | nothing more is printed | as else | nothing |
| gnuplot is missing or fails | a warning; the run counts | as else | the curves; `erbs render DIR --figures` draws them |
| ffmpeg or erbs-render is missing, with `--video` | refused before the run | 2 | nothing |
| a film is stopped halfway | there is no film of that name; pictures that are drawn stay, each whole | 130 | the film; `erbs render DIR --force` draws it anew |
| the time of a script (10 s), of memory (512 MiB, 2 GiB with what is built), of print (1 MiB), of blocks or points | the line, the limit, the remedy | 2 | nothing was begun |
| `--max-wall`, `--until`, `--budget` is reached | a checkpoint; cases that found no time are `not run`, none is called failed | 3 | nothing: `--resume` |
| a run of a study, of `accuracy`, a grid or a map is killed | a row with its reason; the others count | as else | that run: `--resume` makes it again |
| motion.h5 is damaged, and drawn | refused within some seconds, or drawn where the damage is not in what is drawn | 2 | the run: `--force` starts it anew |

## Sanitizers
`cmake --workflow --preset asan-clang` (clang++ 14: `apt-get install clang libclang-rt-14-dev`; address, undefined behaviour, leaks but those of
OpenGL's drivers), `asan` (the same by g++), `tsan` (the threaded tests). At -O1 on two busy cores: all 406 tests by clang++ took 21 min, the
longest 53 s; the threaded tests under `tsan` 12 min, the longest 3 min. `ERBS_ISA=sse2` or `avx2` before a command takes the other paths.
)";

}  // namespace erbs
