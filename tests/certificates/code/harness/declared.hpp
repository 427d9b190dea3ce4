// Declarations of a text of C or C++, read by clang.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "certificates/code/harness/declarations.hpp"
#include "certificates/code/harness/syntax_tree.hpp"
#include "tests/support/scratch_folder.hpp"

namespace veritrack::certificates::code {

/// A file in a folder of its own.
class WrittenCode {
 public:
  explicit WrittenCode(const std::string& text, const std::string& name = "loop.c")
      : file_((folder_ / name).string()) {
    std::ofstream(file_) << text;
  }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] Declarations declarations() const { return declarations_in(own_declarations(file_, {})); }

 private:
  test::ScratchFolder folder_;
  std::string file_;
};

inline const Function& function_named(const Declarations& declarations, const std::string& name) {
  for (const Function& function : declarations.functions) {
    if (function.full_name() == name && function.has_body) {
      return function;
    }
  }
  throw std::out_of_range(name);
}

inline constexpr const char* kLoop =
    "typedef struct { float phase, speed; /* rad, rad/s */ float kp, dt; } pll_t;\n"
    "static float wrap(float x) { return x > 3.14159265f ? x - 6.28318531f : x; }\n"
    "void pll_init(pll_t* p, float kp, float dt) { p->kp = kp; p->dt = dt; p->speed = 3.0f; }\n"
    "void pll_run(pll_t* p, float a, float b) {\n"
    "  const float e = wrap(b * p->phase - a);\n"
    "  p->phase = wrap(p->phase + (p->speed + p->kp * e) * p->dt);\n"
    "  p->speed += e * p->dt;\n"
    "}\n";

}  // namespace veritrack::certificates::code
