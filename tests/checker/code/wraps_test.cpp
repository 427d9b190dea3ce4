// Wraps between half a turn more and half a turn less, and forgeries of them; others are in
// listing_match_test.
#include "checker/code/wraps.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "checker/code/listing.hpp"
#include "tests/checker/code/code_design.hpp"

namespace veritrack::checker {
namespace {

using test::replaced;

/// w = fmod(y + pi, 2 pi); if (w < 0) w += 2 pi; w -= pi.
const std::string kCentred =
    "veritrack listing 1\n"
    "sample r0 f32 y\n"
    "state r1 f32:0x0p+0 w\n"
    "r2 = fadd.f32 r0 f32:0x1.921fb6p+1\n"
    "r3 = fmod.f32 r2 f32:0x1.921fb6p+2\n"
    "r4 = fcmp.olt.f32 r3 f32:0x0p+0\n"
    "r5 = fadd.f32 r3 f32:0x1.921fb6p+2\n"
    "r6 = select.f32 r4 r5 r3\n"
    "r7 = fadd.f32 r6 f32:-0x1.921fb6p+1\n"
    "next r1 r7\n"
    "frequency r1\n";

/// The register that the next w leads to, -1 where it is not wrapped; the sample is 0.
int base_of(const std::string& text) {
  const CodeListing listing = read_listing(text);
  return Wraps(listing).base_of(listing.states[0].next);
}

}  // namespace

TEST_CASE("a wrap between half a turn more and half a turn less leads to what it wraps") {
  CHECK(base_of(kCentred) == 0);
  const CodeListing listing = read_listing(kCentred);
  const Wraps wraps(listing);
  const int next = listing.states[0].next;
  const auto range = wraps.range(next, 0, {-6.6, 6.6});
  REQUIRE(range.has_value());
  CHECK(std::fabs(range->low + std::numbers::pi) < 2e-5);
  CHECK(std::fabs(range->high - std::numbers::pi) < 2e-5);
  const auto shifts = wraps.shifts(next, 0, {-6.6, 6.6});
  REQUIRE(shifts.has_value());
  for (const ListedShift& shift : *shifts) {
    CHECK(std::fabs(std::remainder(shift.by, 2.0 * std::numbers::pi)) < 1e-6);
    CHECK(shift.roundings >= 0x1p-23);
  }
}

TEST_CASE("what is not half a turn more and less is no such wrap") {
  CHECK(base_of(replaced(kCentred, "r6 f32:-0x1.921fb6p+1", "r6 f32:-0x1.9p+1")) == -1);
  CHECK(base_of(replaced(kCentred, "r6 f32:-0x1.921fb6p+1", "r6 f32:-0x1.921fb6p+0")) == -1);
  CHECK(base_of(replaced(kCentred, "r0 f32:0x1.921fb6p+1", "r0 f32:0x1.9p+1")) == -1);
  CHECK(base_of(replaced(kCentred, "r3 = fmod.f32 r2 f32:0x1.921fb6p+2", "r3 = fmod.f32 r2 f32:0x1p+2")) ==
        -1);
  CHECK(base_of(replaced(kCentred, "r6 = select.f32 r4 r5 r3", "r6 = select.f32 r4 r5 r2")) ==
        0);  // whole turns, too
  CHECK(base_of(replaced(kCentred, "r6 = select.f32 r4 r5 r3", "r6 = select.f32 r4 r5 r0")) == -1);
  // Another half turn is as good: both together are a whole one.
  CHECK(base_of(replaced(kCentred, "r6 f32:-0x1.921fb6p+1", "r6 f32:0x1.921fb6p+1")) == 0);
}

}  // namespace veritrack::checker
