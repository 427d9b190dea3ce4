// Formulas as IEEE operations, against the same expressions in C++, to the bit.
#include "certificates/model/language/written_listing.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/model/language/written_out.hpp"
#include "tests/support/random.hpp"
#include "trackers/code/listing_run.hpp"

namespace veritrack::certificates::language {
namespace {

Expression as_formula(const std::string& text) {
  return parse_expression({text, {1, 1}});
}

/// With the states theta, an angle, and w, the samples a and b, and the parameter k = 0.1/3.
WrittenListing written(const std::string& step, trackers::code::Format format) {
  const rigor::UpwardRounding upward;
  std::vector<Definition> lines = parse_definitions({step, {1, 1}});
  leave_out_outer_wraps(lines, {"theta"});
  return written_listing(
      {{{"k", {1, 1}, as_formula("0.1/3")}}, lines, {"theta", "w"}, {"a", "b"}, {"theta"}, as_formula("w")},
      format);
}

/// What a step makes of the states, in single precision.
std::vector<float> after(const std::string& step, const std::vector<float>& values) {
  const trackers::code::Listing listing = with_constants(written(step, trackers::code::kSingle));
  std::vector<std::uint64_t> bits;
  for (const float value : values) {
    bits.push_back(trackers::code::bits_of(trackers::code::kSingle, static_cast<double>(value)));
  }
  const auto registers = trackers::code::run(listing, std::span(bits).first(2), std::span(bits).subspan(2));
  std::vector<float> next;
  for (const trackers::code::State& state : listing.states) {
    next.push_back(static_cast<float>(
        trackers::code::number_of(trackers::code::kSingle, registers[static_cast<std::size_t>(state.next)])));
  }
  return next;
}

}  // namespace

TEST_CASE("operations stand in the order of the text: the same bits as in C++") {
  test::Random random;
  const auto drawn = [&] { return static_cast<float>(random.uniform(-1.5, 1.5)); };
  for (std::int64_t i = 0; i < test::effort(300); ++i) {
    const float theta = drawn();
    const float w = drawn();
    const float a = drawn();
    const float b = drawn();
    const float k = 0.1F / 3.0F;
    const std::vector<float> values{theta, w, a, b};
    const auto next_of_w = [&](const char* formula) {
      return after("theta' = theta\nw' = " + std::string(formula), values)[1];
    };
    CHECK(next_of_w("a + b - w*k + 0.3") == a + b - w * k + 0.3F);
    CHECK(next_of_w("a - (b - w) - a/b/w") == a - (b - w) - a / b / w);
    CHECK(next_of_w("-a^3*b + 2*w^5") == -(a * a * a) * b + 2.0F * (w * w * w * w * w));
    CHECK(next_of_w("clamp(a, -0.5, 0.25) + max(a, b)*min(w, b)") ==
          std::fmin(std::fmax(a, -0.5F), 0.25F) + std::fmax(a, b) * std::fmin(w, b));
    CHECK(next_of_w("if(a < b, sign(w), abs(w))") == (a < b ? (w > 0.0F   ? 1.0F
                                                               : w < 0.0F ? -1.0F
                                                                          : 0.0F)
                                                            : std::fabs(w)));
    CHECK(next_of_w("if(a >= b, w, a) + if(a <= w, b, 0) + if(w > b, 1, 2)") ==
          (a >= b ? w : a) + (a <= w ? b : 0.0F) + (w > b ? 1.0F : 2.0F));
    CHECK(next_of_w("hypot(a, b)*sin(w) + cos(theta)") ==
          std::sqrt(a * a + b * b) * std::sin(w) + std::cos(theta));
    CHECK(next_of_w("stays_within(a*b, -3, 3) + atan2(a, b)") == a * b + std::atan2(a, b));
    CHECK(next_of_w("wrap(3*w)") == std::atan2(std::sin(3.0F * w), std::cos(3.0F * w)));
    CHECK(next_of_w("tanh(w)") == 1.0F - 2.0F / (std::exp(2.0F * w) + 1.0F));
    const float turn = 6.2831853F;
    const float base = theta + 3.0F * w;
    CHECK(after("theta' = wrap(theta + 3*w)\nw' = w", values)[0] ==
          base - turn * std::nearbyint(base * 0.15915494F));
  }
}

TEST_CASE("numbers are the nearest ones of the format, and what they are off is known") {
  const WrittenListing single = written("theta' = theta\nw' = w + 0.1 + pi", trackers::code::kSingle);
  const WrittenListing twice = written("theta' = theta\nw' = w + 0.1 + pi", trackers::code::kDouble);
  const auto has = [](const WrittenListing& each, double value) {
    for (const auto& entry : each.facts.numbers) {
      if (entry.second.value == value) {
        return rigor::magnitude(rigor::Interval(value) - entry.second.exact) <=
               1.3 * std::fabs(value) *
                   (value == static_cast<double>(static_cast<float>(value)) ? 0x1p-24 : 0x1p-52);
      }
    }
    return false;
  };
  const rigor::UpwardRounding upward;
  CHECK(has(single, static_cast<double>(0.1F)));
  CHECK(has(single, static_cast<double>(3.14159265F)));
  CHECK(has(single, 3.0));  // of the parameter
  CHECK(has(twice, 0.1));
  CHECK(has(twice, 3.141592653589793));
}

TEST_CASE("a line that is a limit is one of the facts where it is between numbers") {
  const auto limits = [](const std::string& line) {
    return written(line + "\ntheta' = theta\nw' = w", trackers::code::kSingle).facts.limits.size();
  };
  CHECK(limits("x = stays_within(a*b, -3*k, 1/3)") == 1);
  CHECK(limits("x = stays_within(a*b, -w, 1)") == 0);
  CHECK(limits("x = stays_within(a*b, -1, b)") == 0);
}

}  // namespace veritrack::certificates::language
