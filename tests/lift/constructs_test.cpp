// Small programs with one construct each, from which a listing could differ without an error.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "tests/lift/lifting.hpp"
#include "tests/lift/same_bits.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::Listing;

const std::string kHead =
    "#include <math.h>\n#include <stdbool.h>\n#include <stdint.h>\n#include <stdlib.h>\n#include <string.h>\n"
    "static float w = 0.3f, a = 0.5f, b = 0.25f;\nfloat frequency(void) { return w; }\n";
const std::string kNoSetup = "void setup(void) {}\n";

Listing check_step(const std::string& text, const std::map<std::string, std::string>& expressions = {}) {
  return check_same_bits(kHead + text, "step.c", expressions);
}

bool has_obligation(const Listing& listing, const std::string& why) {
  return std::any_of(listing.obligations.begin(), listing.obligations.end(),
                     [&](const auto& each) { return each.why == why; });
}

}  // namespace

TEST_CASE("Memory that is reached in several ways") {
  // One of two addresses, which may be the same.
  (void)check_step(kNoSetup +
                   "void step(float y) { float* p = y > w ? &a : &b; float* q = y > 0 ? p : &a; *q += y; *p "
                   "*= 0.5f; w = a - b; }");
  // Swaps, through pointers.
  (void)check_step(
      kNoSetup +
      "static void swap(float* x, float* z) { float t = *x; *x = *z; *z = t; }\n"
      "void step(float y) { if (y > w) swap(&a, &b); swap(&b, &b); w = 0.9f * a + y; a = b * y; }");
  // Zeros of four bytes, then numbers of eight, on one way only.
  (void)check_step(
      "static struct { double x; float z; bool is_on; double v[2]; } s;\n"
      "void setup(void) { memset(&s, 0, sizeof s); w = 0.1f; }\n"
      "void step(float y) { if (y > w) { s.x = 0.5 * y + s.v[1]; s.is_on = !s.is_on; } else s.v[1] += y;\n"
      "  s.z += s.is_on ? 0.1f : -0.1f; w = (float)(0.5 * w + s.x) + s.z; }");
  // The bits of numbers.
  (void)check_step(
      kNoSetup +
      "static float fast(float x) { union { float f; uint32_t u; } k = {x}; k.u = 0x5f3759dfu - (k.u >> 1);\n"
      "  return k.f * (1.5f - 0.5f * x * k.f * k.f); }\n"
      "void step(float y) { w = 0.5f * w + y * fast(1.0f + y * y); uint32_t u; memcpy(&u, &w, 4); "
      "u &= 0x7fffffffu; memcpy(&a, &u, 4); w += 0.1f * a; }");
  // Structures by value.
  (void)check_step(
      "typedef struct { float re, im; } z_t; typedef struct { float k[6]; double d; } large_t;\n"
      "static z_t z; static large_t l;\n"
      "static __attribute__((noinline)) z_t times(z_t p, z_t q) { z_t r = {p.re * q.re - p.im * q.im, p.re * "
      "q.im + p.im * q.re}; return r; }\n"
      "static __attribute__((noinline)) large_t next(large_t p, float y) { p.k[5] += y; p.d *= 0.5; p.k[0] = "
      "p.k[5]; return p; }\n"
      "void setup(void) { z.re = 1.0f; l.d = 2.0; }\n"
      "void step(float y) { z_t q = {cosf(w), sinf(w)}; z = times(z, q); l = next(l, y); w += 0.01f * z.im * "
      "y + l.k[0] + (float)l.d; }");
}

TEST_CASE("Integers of all widths and signs") {
  (void)check_step(
      kNoSetup +
      "static int8_t s8; static uint8_t u8; static int16_t s16; static uint64_t u64;\n"
      "void step(float y) { int k = (int)(y * 50.0f); s8 = (int8_t)(s8 + k); u8 = (uint8_t)(u8 - k);\n"
      "  s16 = (int16_t)((s8 * u8) >> 3); u64 = u64 * 6364136223846793005ull + (uint64_t)(int64_t)k;\n"
      "  w = 0.5f * w + (float)s8 * 0.01f + (float)(u8 / 7) + (float)(s16 % 13) + (float)(u64 >> 40) * "
      "1e-8f; }");
  (void)check_step(
      kNoSetup +
          "static struct { unsigned on : 1; int few : 5; unsigned more : 26; } f; static bool is_on;\n"
          "void step(float y) { f.on ^= y > w; f.few += f.on ? 1 : -1; f.more += 3u; is_on = is_on != (y < "
          "0);\n"
          "  w = 0.9f * w + y * (float)f.few + (is_on ? 0.5f : -0.5f) + (float)f.more; }",
      {{"f.on", "*(unsigned*)&f"}});
  (void)check_step(kNoSetup +
                   "void step(float y) { int k = (int)(y * 10.0f); unsigned s = (unsigned)abs(k); int t = k "
                   "> 3 ? 3 : k < -2 ? -2 : k;\n"
                   "  w = 0.5f * w + (float)(1u << (s & 31u)) * 1e-9f + (float)(t << 2) + (float)(-77 >> (s "
                   "& 7u)) + (float)(k * k * k); }");
}

TEST_CASE("Loops that a number ends") {
  const Listing search = check_step(kNoSetup +
                                    "static const float ends[6] = {-1.0f, -0.5f, 0.0f, 0.5f, 1.0f, 2.0f};\n"
                                    "void step(float y) { int i; for (i = 0; i < 5; ++i) if (y < ends[i]) "
                                    "break; w = 0.5f * w + y * (float)i; }");
  CHECK(search.obligations.empty());
  const Listing wraps = check_step(
      kNoSetup +
      "static float x[4]; void step(float y) { for (int i = 0; i < 4; ++i) { x[i] += y * (float)(i + 1);\n"
      "  while (x[i] > 3.0f) x[i] -= 6.0f; while (x[i] < -3.0f) x[i] += 6.0f; w = 0.5f * w + x[i]; } }");
  CHECK(wraps.obligations.size() == 8);
  CHECK(has_obligation(wraps, "a loop has ended"));
}

TEST_CASE("What is undefined is an obligation, where it is used") {
  const Listing guarded = check_step(kNoSetup +
                                     "void step(float y) { int k = y * 1e9f > 1e9f ? 7 : y < -1.0f ? 3 : "
                                     "(int)(y * 1e9f); w = 0.5f * w + (float)k * 1e-9f; }");
  CHECK(has_obligation(guarded, "a number that becomes an integer is in its range"));
  const Listing sum = check_step(kNoSetup +
                                 "static int k; void step(float y) { k += (int)(y * 4.0f); if (k > 100) k = "
                                 "100; w = 0.5f * w + (float)k; }");
  CHECK(has_obligation(sum, "an operation on signed integers does not overflow"));
  const Listing quotient = check_step(kNoSetup +
                                      "void step(float y) { int k = (int)(y * 4.0f); w = 0.5f * w + (k != 0 "
                                      "? (float)(100 / k) : 1.0f) + (float)(77 % (k + 20)); }");
  CHECK(has_obligation(quotient, "an integer is not divided by 0"));
  const Listing shift = check_step(
      kNoSetup +
      "void step(float y) { int k = (int)(y * 4.0f) + 8; w = 0.5f * w + (float)(3 << k) * 1e-6f; }");
  CHECK(has_obligation(shift, "an integer is shifted by less than its bits"));
  const Listing table = check_step(kNoSetup +
                                   "static const float t[4] = {1, 2, 4, 7}; void step(float y) { w = 0.5f * "
                                   "w + y * t[(int)(y + 2.0f)]; }");
  CHECK(has_obligation(table, "an index is inside its table"));
  // A counter that nothing depends on may overflow.
  const Listing counter =
      check_step(kNoSetup + "static int ticks; void step(float y) { ++ticks; w = 0.5f * w + y; }");
  CHECK(counter.obligations.empty());
  CHECK(counter.states.size() == 1);
}

TEST_CASE("Rings of past values, at each position of their index") {
  const std::string rings =
      "static float x[3], z[4], sum; static int i; static unsigned char k = 3;\n"
      "void step(float y) { sum += y - x[i]; x[i] = y; i = i == 2 ? 0 : i + 1; w = 0.5f * w + z[k] * 0.1f + "
      "sum; z[k] = w; k = (k - 1) & 3; }";
  std::map<std::string, std::string> ages;
  for (int age = 1; age <= 4; ++age) {
    ages[fmt::format("x_{}_ago", age)] = fmt::format("x[(i + 3 - {}) % 3]", age);
    ages[fmt::format("z_{}_ago", age)] = fmt::format("z[(k + {}) & 3]", age);
  }
  CHECK(check_step(kNoSetup + rings, ages).states.size() == 9);
  // The head is a pointer.
  const std::string pointer =
      "static float x[5]; static float* head = x;\n"
      "void step(float y) { w = 0.5f * w + *head; *head = y; if (++head == x + 5) head = x; }";
  std::map<std::string, std::string> behind;
  for (int age = 1; age <= 5; ++age) {
    behind[fmt::format("x_{}_ago", age)] = fmt::format("x[(head - x + 5 - {}) % 5]", age);
  }
  CHECK(check_step(kNoSetup + pointer, behind).states.size() == 6);
  const auto length = [](int count) {
    return kHead + kNoSetup +
           fmt::format(
               "static float x[{0}]; static int i; void step(float y) {{ w = 0.5f * w + x[i]; x[i] = y; i = "
               "(i + 1) % {0}; }}",
               count);
  };
  CHECK(lift_text(length(64)).error == "");
  CHECK(lift_text(length(65)).error.find("at an index that depends on the state") != std::string::npos);
}

TEST_CASE("Modes, and steps that differ by a counter") {
  const Listing decimated = check_step(
      kNoSetup +
      "static int n; void step(float y) { a += y; if (++n == 4) { n = 0; w = 0.5f * w + a; a = 0.0f; } }");
  CHECK(decimated.states.size() == 3);
  const Listing settled = check_step(
      "static int n; static float gain; void setup(void) {}\n"
      "void step(float y) { w += gain * y; if (n < 10) { n++; gain = 0.5f; } else gain = 0.25f; }");
  CHECK(settled.states.size() == 1);
  CHECK(settled.steps_before == 11);
  // A mode that a number decides is a state, also if it has never changed before.
  const Listing late = check_step(kNoSetup +
                                  "static int is_late; void step(float y) { if (w > 2.0f) is_late = 1; w += "
                                  "is_late ? 0.25f * y : 0.5f * y; }");
  CHECK(late.states.size() == 2);
  // A library's result decides in setup: that it does so everywhere is an obligation.
  const Listing chosen = check_step(
      "static float k; void setup(void) { k = expf(-0.1f); if (k > 0.9f) a = expf(k); }\n"
      "void step(float y) { w += a * y * k; }");
  CHECK(has_obligation(chosen, "a comparison of results of the library in the set-up"));
}

TEST_CASE("Constructs of C++") {
  const std::string begin =
      "#include <cmath>\n#include <complex>\n#include <algorithm>\n#include <optional>\n"
      "static float w = 0.3f;\nfloat frequency() { return w; }\nvoid setup() {}\n";
  const auto check = [&](const std::string& text,
                         const std::map<std::string, std::string>& expressions = {}) {
    return check_same_bits(begin + text, "step.cpp", expressions);
  };
  // A variable of a function that is set where it is called first.
  (void)check(
      "struct f { explicit f(float v) : x(v) {} float x; }; static float of(float v) { return std::sqrt(v); "
      "}\n"
      "static f& get() { static f k(of(0.25f)); return k; }\n"
      "void step(float y) { get().x = 0.5f * get().x + y; w = get().x * 0.5f + w * 0.25f; }",
      {{"get()::k.x", "get().x"}, {"k.x", "get().x"}});
  (void)check(
      "static float p = 0.1f, q = 0.2f; void step(float y) { (p > q ? p : q) += y; std::swap(p, q); w = "
      "std::min(p, q) + 0.5f * w; }");
  (void)check(
      "static std::complex<float> z(1.0f, 0.0f);\n"
      "void step(float y) { z *= std::complex<float>(std::cos(w), std::sin(w)); w += 0.01f * y * z.imag(); }",
      {{"z._M_value", "reinterpret_cast<float(&)[2]>(z)[0]"},
       {"z._M_value_4", "reinterpret_cast<float(&)[2]>(z)[1]"}});
}

}  // namespace veritrack::lift
