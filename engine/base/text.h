// Text that comes from others: file names, words of scripts, cells of records, arguments. No control character of theirs reaches a
// terminal, a file or another program.
#pragma once
#include <cstdio>
#include <string>
#include <string_view>

namespace erbs {

// Valid UTF-8 without control characters, nor the signs that turn the direction of writing or end a line.
bool is_plain(std::string_view text);

// Letters, digits, _, + and -, the first no sign: what may be the name of a file, of a metric, of a param.
bool is_name(std::string_view text);

// `text` for a message, on one line: what is not plain is written as an escape (\n, \x1b). Longer than `most` bytes it ends in "...".
std::string shown(std::string_view text, std::size_t most = 200);

// Whole messages for a terminal: as shown(), but lines and tabs stay, and nothing is cut.
std::string printable(std::string_view text);

// printable() and the end of the line, to stderr or stdout. A stream that is closed or full is no reason to end a run: stderr is let be,
// stdout keeps its mark, which main() asks for at the end. A line of more than 4000 bytes is cut.
void tell(std::FILE* to, std::string_view text);

// Valid UTF-8 on one line for files: control characters become spaces, bytes that are no UTF-8 the sign U+FFFD.
std::string for_files(std::string_view text);

}  // namespace erbs
