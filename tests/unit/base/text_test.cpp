// Untrusted text on its way to terminals and files.
#include "engine/base/text.h"

#include <catch2/catch.hpp>

using namespace erbs;
using namespace std::string_literals;

TEST_CASE("plain text is UTF-8 without what controls a terminal", "[text]") {
  for (const std::string good : {"", "brick 7", "Mörtel \xE2\x82\xAC", "it's \"so\" <b> ]]> $(x) `y` %s"}) CHECK(is_plain(good));
  for (const std::string& bad : {"a\nb"s, "a\0b"s, "\x1b[31m"s, "\x7f"s, "\xff"s, "\xc3"s, "\xc0\xaf"s, "\xed\xa0\x80"s, "\xc2\x9b"s,
                                 "\xe2\x80\xae"s, "\xf4\x90\x80\x80"s}) {
    INFO(shown(bad));
    CHECK_FALSE(is_plain(bad));
    CHECK(is_plain(shown(bad)));
    CHECK(is_plain(printable(bad)) == (bad != "a\nb"));
    CHECK(is_plain(for_files(bad)));
  }
}

TEST_CASE("text in a message is escaped and cut between letters", "[text]") {
  CHECK(shown("a\n\x1b[1m\0z"s) == "a\\n\\x1b[1m\\0z");
  CHECK(shown("ääää", 5) == "ää...");
  CHECK(shown(std::string(1000000, 'x'), 10) == "xxxxxxxxxx...");
  CHECK(printable("two\nlines\r") == "two\nlines\\r");
  CHECK(for_files("a\nb\xff") == "a b\xEF\xBF\xBD");
}

TEST_CASE("a file is named after a scene in any language", "[text]") {
  CHECK(file_stem("Häuschen 'Süd' 1.2") == "Häuschen__Süd__1_2");
  CHECK(file_stem("../a b;c") == "___a_b_c");
  CHECK(file_stem("\xff") == "\xEF\xBF\xBD");
  CHECK(file_stem("from_+x") == "from_+x");  // not the name of from_-x less a sign
  CHECK(file_stem("") == "run");
}

TEST_CASE("a name is letters and digits", "[text]") {
  for (const char* good : {"a", "kn_1e-09", "x+1", "7"}) CHECK(is_name(good));
  for (const char* bad : {"", "-a", "a b", "a/b", "a.b", "ä", "a'", "a\n", "<"}) CHECK_FALSE(is_name(bad));
}
