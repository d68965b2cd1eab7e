// The standard streams and the signals of a program that others start: in scripts, pipes, with a full disk or a closed terminal.
#pragma once

namespace erbs {

// To be called first: descriptors 0 to 2 are open, or else the next file opened would take what is printed; a pipe that is closed or a
// file that reaches its limit is an error of the one write, and does not end the program.
void prepare_streams();

// To be called last: `code`, but where it is 0 and what was printed did not arrive, `failed`, with a message.
int finish_streams(int code, int failed);

}  // namespace erbs
