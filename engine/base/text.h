// Foreign text: file names, words of scripts, cells of records, arguments. None of its control characters reaches a terminal, a file or
// another program.
#pragma once
#include <concepts>
#include <cstdio>
#include <string>
#include <string_view>

namespace erbs {

// Whether `text` is valid UTF-8 without control characters, line separators or marks of writing direction.
bool is_plain(std::string_view text);

// Whether `text` may name a file, a metric or a param: letters, digits, _, + and -, not starting with a sign.
bool is_name(std::string_view text);

// `text` on one line of a message. Characters that are not plain become escapes (\n, \x1b). Beyond `most` bytes it ends in "...".
std::string shown(std::string_view text, std::size_t most = 200);

// A whole message for a terminal: like shown(), but line ends and tabs stay, and nothing is cut.
std::string printable(std::string_view text);

// Writes printable(text) and a line end to stderr or stdout. A closed or full stream does not end a run: stderr is ignored, an error of
// stdout is reported by main() at the end. A line of more than 4000 bytes is cut.
void tell(std::FILE* to, std::string_view text);

// From now on each message to stderr is one line {"message": text}, for programs that read it beside the lines of progress.
void tell_as_json();

// "1 block", "3 blocks".
template <std::integral Count>
std::string counted(Count n, std::string_view noun) {
  return std::to_string(n).append(" ").append(noun).append(n == 1 ? "" : "s");
}

// Valid UTF-8 on one line for files. Control characters become spaces, invalid bytes the character U+FFFD.
std::string for_files(std::string_view text);

// `text` between the quotes or the tags of XML.
std::string for_xml(std::string_view text);

// The name of a scene, camera or group as the name of a file: letters of any language, digits, -, + and _; other characters become _.
std::string file_stem(std::string_view name);

}  // namespace erbs
