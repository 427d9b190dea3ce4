// The text of a listing is read as it is written, and in no other way.
#include "certificates/code/listing_text.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/support/random.hpp"

namespace veritrack::certificates::code {

namespace {

const std::string kText =
    "veritrack listing 1\n"
    "file 0 my  pll.c\n"
    "steps-before 3\n"
    "sample r0 f32 y\n"
    "state r1 f32:0x1.8p-2 pll.w\n"
    "state r2 i32:7 pll.phase\n"
    "table t0 0 3f800000\n"
    "library-table t1 1 2 3\n"
    "r3 = fadd.f32 r0 r1 @0:7:3\n"
    "r4 = fcmp.olt.f32 r3 f32:bits7fc00000\n"
    "r5 = and.i32 r2 i32:1 @0:8:3\n"
    "r6 = table.f32.t0 r5\n"
    "r7 = select.f32 r4 r6 r3\n"
    "r8 = add.i32 r2 i32:4294967295\n"
    "r9 = table.i32.t1 r5\n"
    "r10 = icmp.uge.i32 r9 i32:2\n"
    "next r1 r7\n"
    "next r2 r8\n"
    "frequency r1\n"
    "must-be-zero r10 @0:8:3 an index is inside its table\n"
    "must-be-zero r4 a loop has ended\n";

std::string replaced(const std::string& from, const std::string& to) {
  const std::size_t at = kText.find(from);
  REQUIRE(at != std::string::npos);
  return kText.substr(0, at) + to + kText.substr(at + from.size());
}

std::string error_of(const std::string& text) {
  try {
    (void)parse_listing(text);
    return "";
  } catch (const ListingError& error) {
    return error.what();
  }
}

struct Changed {
  const char* from;
  const char* to;
  const char* line;  ///< that the error names
};

}  // namespace

TEST_CASE("A listing is read as it is written") {
  const trackers::code::Listing listing = parse_listing(kText);
  CHECK(listing_text(listing) == kText);
  CHECK(listing.files == std::vector<std::string>{"my  pll.c"});
  CHECK(listing.steps_before == 3);
  CHECK(listing.library_tables == std::vector<int>{1});
  CHECK(listing.states.at(1).start_bits == 7);
  CHECK(listing.obligations.at(0).place.line == 8);
}

TEST_CASE("Lines that no listing has are errors that name the line") {
  for (const Changed& changed : std::vector<Changed>{
           {"listing 1", "listing 2", "line 1 "},
           {"fadd.f32", "fade.f32", "line 9 "},           // no operation
           {"fadd.f32 r0 r1", "fadd.f32 r0", "line 9 "},  // operands
           {"fadd.f32 r0 r1", "fadd.f32 r0 r1 r1", "line 9 "},
           {"fadd.f32 r0 r1", "fadd.f32 r0 r5", "line 9 "},  // not there yet
           {"fadd.f32 r0 r1", "fadd.f32 r0 r3", "line 9 "},
           {"fadd.f32 r0 r1", "fadd.f32 r0 r2", "line 9 "},  // formats
           {"fadd.f32 r0 r1", "fadd.f64 r0 r1", "line 9 "},
           {"fadd.f32 r0 r1", "add.f32 r0 r1", "line 9 "},
           {"fadd.f32 r0 r1", "fadd.f33 r0 r1", "line 9 "},
           {"fadd.f32 r0 r1", "", "line 9 "},
           {"r3 = fadd", "r4 = fadd", "line 9 "},  // names in order
           {"r3 = fadd", "r2 = fadd", "line 9 "},
           {"@0:7:3", "@1:7:3", "line 9 "},  // no such file
           {"@0:7:3", "@0:7", "line 9 "},
           {"@0:7:3", "@0:99999999999:3", "line 9 "},
           {"fcmp.olt.f32", "fcmp.slt.f32", "line 10 "},
           {"fcmp.olt.f32", "fcmp.f32", "line 10 "},
           {"bits7fc00000", "bits7fc000000", "line 10 "},
           {"f32:bits7fc00000", "f32:0x1.8", "line 10 "},
           {"f32:bits7fc00000", "f32:1.5", "line 10 "},
           {"f32:bits7fc00000", "f32:0x1.000001p+0", "line 10 "},  // no number of the format
           {"f32:bits7fc00000", "f32:nan", "line 10 "},
           {"and.i32 r2 i32:1", "and.i32 r2 i64:1", "line 11 "},
           {"and.i32 r2 i32:1", "and.i32 r2 i32:4294967296", "line 11 "},
           {"and.i32 r2 i32:1", "and.i32 r2 i32:-1", "line 11 "},
           {"and.i32 r2 i32:1", "and.i32 r2 i32:01", "line 11 "},
           {"table.f32.t0 r5", "table.f32.t2 r5", "line 12 "},
           {"table.f32.t0 r5", "table.f32.t0 r3", "line 12 "},
           {"table.f32.t0 r5", "table.i8.t0 r5", "line 12 "},
           {"select.f32 r4", "select.f32 r5", "line 13 "},
           {"icmp.uge", "icmp.oeq", "line 16 "},
           {"next r1 r7", "next r1 r8", "line 21 "},  // at the end: the formats of all
           {"next r1 r7\n", "", "line 20 "},
           {"next r1 r7\n", "next r1 r7\nnext r1 r7\n", "line 18 "},
           {"next r1 r7", "next r3 r7", "line 17 "},
           {"frequency r1\n", "", "line 20 "},
           {"frequency r1\n", "frequency r1\nfrequency r1\n", "line 20 "},
           {"frequency r1", "frequency r2", "line 21 "},
           {"must-be-zero r4 ", "must-be-zero r3 ", "line 21 "},
           {"must-be-zero r4 a loop has ended", "must-be-zero r4", "line 21 "},
           {"state r1 f32:0x1.8p-2 pll.w", "state r1 f32 pll.w", "line 5 "},
           {"sample r0 f32 y", "sample r0 f32", "line 4 "},
           {"sample r0 f32 y\n", "", "line 4 "},
           {"table t0", "table t1", "line 7 "},
           {"3f800000\n", "3f800000 x\n", "line 7 "},
           {"3f800000\n", "10000000000000000\n", "line 7 "},
           {"steps-before 3", "steps-before 03", "line 3 "},
           {"steps-before 3\n", "steps-before 3\nsteps-before 4\n", "line 4 "},
           {"file 0", "file 1", "line 2 "},
           {"r4 = fcmp", "r4  = fcmp", "line 10 "},
           {"r4 r6 r3\n", "r4 r6 r3 \n", "line 13 "},
           {"next r1 r7\nnext r2 r8\n", "next r2 r8\nnext r1 r7\n", "line 17 "},  // another order
           {"r9 = table.i32.t1 r5\n", "\n", "line 15 "},
           {"a loop has ended\n", "a loop has ended", "line 20 "}}) {
    CAPTURE(std::string(changed.from));
    CAPTURE(std::string(changed.to));
    const std::string error = error_of(replaced(changed.from, changed.to));
    CAPTURE(error);
    CHECK(error.substr(0, std::string(changed.line).size()) == changed.line);
  }
}

TEST_CASE("Texts with bytes changed are read as written, or refused") {
  test::Random random;
  int read = 0;
  for (int i = 0; i < test::effort(20000); ++i) {
    std::string text = kText;
    for (std::uint64_t k = 0; k <= random.below(3); ++k) {
      const std::size_t at = random.below(text.size());
      constexpr std::string_view kLetters = "0123456789abcdefirt.:@ =-\n";
      switch (random.below(3)) {
        case 0:
          text[at] = kLetters[random.below(kLetters.size())];
          break;
        case 1:
          text.erase(at, 1 + random.below(4));
          break;
        default:
          text.insert(at, text.substr(random.below(text.size()), random.below(12)));
      }
    }
    trackers::code::Listing listing;
    try {
      listing = parse_listing(text);
    } catch (const ListingError&) {
      continue;
    }
    CHECK(listing_text(listing) == text);
    ++read;
  }
  CHECK(read > 0);
}

}  // namespace veritrack::certificates::code
