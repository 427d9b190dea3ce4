#include "certificates/design/input_error.hpp"

#include <doctest/doctest.h>

#include <string>

namespace {

using veritrack::certificates::InputError;
using veritrack::certificates::printable;
using veritrack::certificates::utf8_length;

constexpr std::size_t kPlenty = 1000;

}  // namespace

TEST_CASE("an InputError says where and what") {
  const InputError error("folder/x.toml", {3, 14}, "q1 is wrong; allowed: right");
  CHECK(std::string(error.what()) == "folder/x.toml:3:14: q1 is wrong; allowed: right");
  CHECK(error.file() == "folder/x.toml");
  CHECK(error.line() == 3);
  CHECK(error.column() == 14);
  CHECK(error.message() == "q1 is wrong; allowed: right");
  CHECK(std::string(InputError("x.toml", {}, "is a directory").what()) == "x.toml: is a directory");
}

TEST_CASE("an InputError is one printable line of limited length") {
  const InputError error("a\nb", {1, 1}, "tab\t bell\a " + std::string(10'000, 'x'));
  const std::string what = error.what();
  CHECK(what.starts_with("a\\x0Ab:1:1: tab\\x09 bell\\x07 xxx"));
  CHECK(what.ends_with("xxx..."));
  CHECK(error.message().size() == InputError::kMessageLimit);
}

TEST_CASE("printable keeps text and escapes the rest") {
  CHECK(printable("ω = 2π, größer, 周波数, 🎵", kPlenty) == "ω = 2π, größer, 周波数, 🎵");
  CHECK(printable(std::string("\0\x1B\x7F", 3), kPlenty) == "\\x00\\x1B\\x7F");
  CHECK(printable("\xC2\x85", kPlenty) == "\\u0085");            // next line
  CHECK(printable("\xE2\x80\xA8", kPlenty) == "\\u2028");        // line separator
  CHECK(printable("a\xE2\x80\xAE z", kPlenty) == "a\\u202E z");  // right-to-left override
  CHECK(printable("\xEF\xBB\xBF", kPlenty) == "\\uFEFF");
  CHECK(printable("\xFFz\xC3", kPlenty) == "\\xFFz\\xC3");
}

TEST_CASE("printable cuts between characters") {
  CHECK(printable("abcdef", 6) == "abcdef");
  CHECK(printable("abcdefg", 6) == "abc...");
  CHECK(printable("ωωωω", 7) == "ωω...");
  CHECK(printable("\n\n", 7) == "\\x0A...");
}

TEST_CASE("UTF-8 is what the Unicode standard says, table 3-7") {
  for (const char* valid : {"a", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
                            "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"}) {
    CHECK(utf8_length(valid) == std::string(valid).size());
  }
  for (const char* invalid : {"\x80", "\xBF", "\xC0\xAF", "\xC1\xBF", "\xC2", "\xC2z", "\xE0\x9F\xBF",
                              "\xED\xA0\x80", "\xED\xBF\xBF", "\xE2\x82", "\xF0\x8F\xBF\xBF",
                              "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF", "\xF0\x90\x80"}) {
    CHECK_FALSE(utf8_length(invalid));
  }
  CHECK_FALSE(utf8_length(""));
}
