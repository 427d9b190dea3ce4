// What no listing can say is an error, with its place and what is allowed.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/lift/lifting.hpp"

namespace veritrack::lift {

namespace {

struct Refused {
  const char* message;  ///< begins with the line and the column
  const char* text;
  const char* flags = "";
};

/// Lines 1 to 3 of every text.
const std::string kBegin =
    "#include <math.h>\n"
    "float w = 0.3f, x[8], y_before; int n; void setup(void) { w = 0.2f; }\n"
    "float frequency(void) { return w; }\n";

std::string error_of(const Refused& refused) {
  const LiftResult result = lift_text(kBegin + refused.text, "step.c", refused.flags);
  return result.error;
}

void check_all(const std::vector<Refused>& all) {
  for (const Refused& refused : all) {
    CAPTURE(std::string(refused.text));
    CAPTURE(std::string(refused.message));
    const std::string error = error_of(refused);
    CAPTURE(error);
    CHECK(error.substr(0, std::string("step.c:").size()) == "step.c:");
    CHECK(error.find(refused.message) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("Operations that compilers may compute otherwise, or that nobody knows, are refused") {
  check_all({
      {"4:28: an operation under -ffast-math, which may be computed in another order; allowed: the file",
       "void step(float y) { w = w + y; }", "-ffast-math"},
      {"4:26: a call under -ffast-math; allowed", "void step(float y) { w = sinf(y); }", "-ffast-math"},
      {"4:22: assembly in the function", "void step(float y) { __asm__ volatile(\"nop\"); w += y; }"},
      {"4:47: a volatile variable is read, whose value nobody knows",
       "volatile float v; void step(float y) { w += y*v; }"},
      {"volatile memory is copied or filled",
       "struct s { float a[40]; }; volatile struct s v; struct s k;\n"
       "void step(float y) { k = v; w += y * k.a[0]; }"},
      {"4:46: a call of other, which is neither defined in the files nor a function of the library",
       "float other(float); void step(float y) { w = other(y); }"},
      {"a call of umax, which is neither", "int umax(int, int); void step(float y) { w = umax((int)y, 3); }"},
      {"a call of tan, which is neither", "typedef int i; i tan(i); void step(float y) { w = tan((int)y); }",
       "-fno-builtin -Wno-incompatible-library-redeclaration -include stddef.h -D_MATH_H=1"},
      {"numbers in half, extended or quadruple precision (long double); allowed: float and double",
       "void step(float y) { w = (float)((long double)w * y + 1e-3L); }"},
      {"integers of more than 64 bits",
       "void step(float y) { w = (float)(((__int128)(long)(y * 1e3f) * (long)(w * 1e9f)) >> 70); }"},
      {"an operation that is not followed: atomicrmw",
       "_Atomic int k; void step(float y) { k += (int)y; w = (float)k; }"},
  });
}

TEST_CASE("Memory that is not known is refused") {
  check_all({
      {"a write to x at an index that depends on the state",
       "void step(float y) { x[(int)w & 7] = y; w = x[0]; }"},
      {"an element of x is read at an index that depends on the state, and the table is not made of "
       "constants",
       "void step(float y) { x[0] = y; w = x[(int)w & 7]; }"},
      {"the pointer p changes from step to step; allowed: pointers that setup has set",
       "float* p = x; void step(float y) { p = y > w ? x + 1 : x + 2; w = *p + y; }"},
      {"a read through a null or an unknown pointer", "float* p; void step(float y) { w = *p + y; }"},
      {"a write outside of x", "void step(float y) { x[n + 9] = y; w += x[0]; }"},
      {"a read outside of x", "void step(float y) { w = y + *(x - 1 + n); }"},
      {"of a variable of inner, which is not there any more",
       "static float* __attribute__((noinline)) inner(float y) { volatile float k[2]; k[0] = y; return "
       "(float*)k; }\n"
       "void step(float y) { w = *inner(y); }"},
      {"of memory of line 4, which is not there any more",
       "#include <stdlib.h>\n#line 4\nvoid step(float y) { volatile float* p = malloc(8); *p = y; "
       "free((void*)p); "
       "w = *(float*)p + y; }"},
      {"memory is given back where the state decides",
       "#include <stdlib.h>\nvoid step(float y) { float* p = malloc(8); if (y > w) free(p); w += y; }"},
      {"more than a million bytes of memory are asked for",
       "#include <stdlib.h>\nfloat* q; void step(float y) { q = malloc(1u << 24); *q = y; w += y; }"},
      {"memory is filled with bytes that are not zeros",
       "#include <string.h>\nvoid step(float y) { memset(x, 1, sizeof x); w = y * x[0]; }"},
      {"a call through a pointer that is not known",
       "static float a(float v) { return v; } static float b(float v) { return 2 * v; }\n"
       "void step(float y) { float (*f)(float) = y > w ? a : b; w = f(y); }",
       "-O0"},
      {"a value of 2 bytes is read in pieces, or of pieces",
       "void step(float y) { w += y; n = ((unsigned short*)&w)[1]; w += (float)n; }"},
      {"a part of a value of 4 bytes is written",
       "void step(float y) { w += y; ((volatile unsigned char*)&w)[1] = 7; }"},
      {"a read of z, which no file defines", "extern float z; void step(float y) { w = y > 0 ? z : w; }"},
      {"a read of z, whose first value is not understood",
       "struct { long double x; float k; } z = {1.0L, 0.5f}; void step(float y) { w = 0.5f * w + z.k * y; }"},
      {"an array whose length is not a constant",
       "void step(float y) { volatile float k[(n & 3) + 1]; k[0] = y; w += y; n++; }"},
  });
}

TEST_CASE("Ways that cannot be followed are refused") {
  check_all({
      {"more than 2,000,000 instructions are executed: a loop that does not end, or too much work",
       "void step(float y) { for (;;) { n = 5 - n; if (n == 17) break; x[n & 7] = 1.0f; } w += y; }"},
      {"functions call each other more than 200 deep",
       "static float __attribute__((noinline)) f(float v) { return v > 1.0f ? 1.0f + f(v * 0.5f) * v : v; }\n"
       "void step(float y) { w = f(y); }"},
      {"a switch on the state decides whether a loop ends; allowed: if",
       "void step(float y) { for (;;) { unsigned k = (unsigned)(w = w * 0.5f + y); switch (k) {\n"
       "case 0: case 7: case 19: return; case 3: w += 1; break; case 1: case 55: w += 5.0f; break; default: "
       "w -= 3; } } }"},
      {"a value that is not defined is used",
       "#include <stdlib.h>\nvoid step(float y) { int* k = malloc(8); if (k[1]) x[n] += y; w += y; }"},
      {"what a step computes depends on an index or a mode that changes from step to step",
       "void step(float y) { w += (n == 0 ? y : 2 * y) * x[n]; x[n] = y; n = (n + 1) & 3; }"},
      {"the function ends the program", "#include <stdlib.h>\nvoid step(float y) { w += y; abort(); }"},
  });
}

TEST_CASE("Functions that are missing or of other types are refused") {
  const auto error = [](const std::string& text) { return lift_text(text).error; };
  const std::string step = "void step(float y) { w += y; }\n";
  const std::string setup = "float w; void setup(void) {}\n";
  CHECK(error(setup + step).find("no function is called frequency; allowed: files that define setup, step") !=
        std::string::npos);
  CHECK(error("float w; float frequency(void) { return w; }" + step).find("no function is called setup") !=
        std::string::npos);
  CHECK(error(setup + "float frequency(void) { return w; }").find("no function is called step") !=
        std::string::npos);
  CHECK(lift_text("static float w; void setup() {} void step(float y) { w += y; } void step(double y) { w -= "
                  "(float)y; }"
                  "float frequency() { return w; }",
                  "step.cpp")
            .error.find("several functions are called step; allowed: one") != std::string::npos);
  CHECK(error(setup + step + "int frequency(void) { return (int)w; }").find("frequency returns no number") !=
        std::string::npos);
  CHECK(error(setup + step + "float frequency(void) { w += 1; return w; }").find("frequency changes w") !=
        std::string::npos);
  CHECK(error(setup + "void step(int y) { w += y; } float frequency(void) { return w; }")
            .find("an argument of step that is no number; allowed: one or two of float or double") !=
        std::string::npos);
  CHECK(error(setup + "void step(void) { w += 1; } float frequency(void) { return w; }")
            .find("step has 0 arguments; allowed: one sample or two") != std::string::npos);
  CHECK(error(setup + step + "float frequency(void) { return 0.1f; }")
            .find("the frequency does not depend on anything that step changes") != std::string::npos);
}

TEST_CASE("A state that nothing has set is refused") {
  const std::string text =
      "#include <stdlib.h>\nstruct s { float w, before; }; struct s* s;\n"
      "void setup(void) { s = malloc(sizeof *s); s->w = 0.2f; }\n"
      "void step(float y) { s->w = y > 0 ? s->before : s->w; s->before = y; }\n"
      "float frequency(void) { return s->w; }\n";
  CHECK(lift_text(text).error.find("is read before anything has set it; allowed: all states set in setup") !=
        std::string::npos);
}

}  // namespace veritrack::lift
