// The reader of listings: what it understands, and what it refuses.
#include "checker/code/listing.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "checker/document/json_tree.hpp"
#include "tests/checker/code/code_design.hpp"

namespace veritrack::checker {
namespace {

const std::string kListing =
    "veritrack listing 1\n"
    "file 0 a file.c\n"
    "sample r0 f32 y\n"
    "state r1 f64:-0x1.8p+1 x\n"
    "state r2 i8:3 mode\n"
    "table t0 3f800000 0\n"
    "r3 = fpext.f64 r0 @0:12:3\n"
    "r4 = fadd.f64 r1 r3\n"
    "r5 = fcmp.ult.f64 r4 f64:bits7ff0000000000000\n"
    "r6 = select.f64 r5 r4 r1\n"
    "r7 = add.i8 r2 i8:1\n"
    "r8 = icmp.ugt.i8 r7 i8:200\n"
    "r9 = zext.i32 r8\n"
    "r10 = table.f32.t0 r9\n"
    "next r1 r6\n"
    "next r2 r7\n"
    "frequency r1\n"
    "must-be-zero r8 @0:1:2 an index is inside its table\n";

TEST_CASE("a listing is read") {
  const CodeListing listing = read_listing(kListing);
  CHECK(listing.samples.size() == 1);
  CHECK(listing.sample_names == std::vector<std::string>{"y"});
  REQUIRE(listing.states.size() == 2);
  CHECK(listing.states[0].name == "x");
  CHECK(listing.states[0].start == -3.0);
  CHECK(listing.at(listing.states[0].next).name == "select");
  CHECK(listing.frequency == listing.states[0].input);
  REQUIRE(listing.obligations.size() == 1);
  CHECK(listing.obligations[0].why == "an index is inside its table");
}

TEST_CASE("anything else is malformed") {
  for (const auto& change : std::vector<std::pair<std::string, std::string>>{
           {"listing 1", "listing 2"},
           {"file 0", "file 1"},
           {"r4 = ", "r5 = "},                                        // registers in order
           {"r4 = fadd.f64 r1 r3\n", ""},                             // one is missing
           {"r6 = select.f64 r5 r4 r1", "r6 = select.f64 r5 r7 r1"},  // defined later
           {"r6 = ", "r4 = "},                                        // a register twice
           {"fadd.f64", "fpow.f64"},
           {"fadd.f64", "fadd.f16"},
           {"fadd.f64", "fadd"},
           {"fadd.f64 r1 r3", "fadd.f64 r1"},
           {"fadd.f64 r1 r3", "fadd.f64 r1 r3 r3"},
           {"fadd.f64 r1 r3", "fadd.f64 r1 r0"},  // of two formats
           {"fadd.f64 r1 r3", "fadd.f32 r1 r3"},
           {"fadd.f64 r1 r3", "fadd.f64  r1 r3"},
           {"fpext.f64", "fptrunc.f64"},
           {"fcmp.ult", "fcmp.slt"},
           {"icmp.ugt", "icmp.ogt"},
           {"fcmp.ult.f64", "fcmp.f64"},
           {"select.f64 r5 r4 r1", "select.f64 r2 r4 r1"},
           {"select.f64 r5 r4 r1", "select.f64 r5 r4 r0"},
           {"i8:200", "i8:256"},
           {"i8:200", "i8:0200"},
           {"i8:200", "i8:-1"},
           {"zext.i32", "trunc.i32"},
           {"table.f32.t0", "table.f32.t1"},
           {"f64:-0x1.8p+1", "f64:-3"},
           {"f64:-0x1.8p+1", "f64:nan"},
           {"f64:-0x1.8p+1", "f64:-0x1.8p+1024"},
           {"f64:-0x1.8p+1", "f64: -0x1.8p+1"},
           {"f64:-0x1.8p+1", "f32:0x1.000001p+0"},  // no binary32
           {"f64:bits7ff0000000000000", "f64:bits3ff0000000000000"},
           {"next r1 r6\nnext r2 r7", "next r2 r7\nnext r1 r6"},
           {"next r2 r7\n", ""},
           {"next r2 r7\n", "next r2 r6\n"},  // of another format
           {"next r2 r7\n", "next r2 r7\nnext r2 r7\n"},
           {"frequency r1\n", ""},
           {"frequency r1\n", "frequency r1\nfrequency r1\n"},
           {"frequency r1", "frequency r2"},  // an integer
           {"frequency r1", "frequency r3"},  // depends on a sample
           {"frequency r1", "frequency r4"},
           {"must-be-zero r8", "must-be-zero r7"},
           {" an index is inside its table", ""},
           {"@0:12:3", "@1:12:3"},
           {"@0:12:3", "@0:12"},
           {"sample r0 f32 y\n", ""},
           {"its table\n", "its table"},
           {"its table\n", "its table\n\n"},
           {"its table\n", "its table\ntrailing\n"},
           {"its table\n", "its table\nr11 = fneg.f64 r1\n"},  // behind what belongs at the end
           {"its table\n", "its \x01 table\n"}}) {
    CAPTURE(change.first);
    CAPTURE(change.second);
    CHECK_THROWS_AS((void)read_listing(test::replaced(kListing, change.first, change.second)), Malformed);
  }
}

}  // namespace
}  // namespace veritrack::checker
