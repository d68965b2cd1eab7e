// Standard streams and signals of a program that others start: in scripts, in pipes, with a full disk or a closed terminal.
#pragma once

namespace erbs {

// Call first. Opens descriptors 0 to 2 if they are closed; otherwise the next file opened would receive the printed text. A closed pipe
// or a file at its size limit then fails the single write and does not end the program.
void prepare_streams();

// Call last. Returns `code`. If printed text was lost, prints a message and returns `failed` in place of a `code` of 0.
int finish_streams(int code, int failed);

}  // namespace erbs
