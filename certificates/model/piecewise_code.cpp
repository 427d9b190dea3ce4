#include "certificates/model/piecewise_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace veritrack::certificates {

namespace {

/// A function with a kink or a jump, as code.
struct Helper {
  trackers::Operation operation;
  std::string_view c, python, octave;
};

constexpr std::array kHelpers{
    Helper{trackers::Operation::minimum,
           "static inline double minimum(double a, double b) { return b < a ? b : a; }\n",
           "def minimum(a, b):\n    return b if b < a else a\n\n",
           "function x = minimum(a, b)\n  x = a;\n  if b < a\n    x = b;\n  end\nend\n"},
    Helper{trackers::Operation::maximum,
           "static inline double maximum(double a, double b) { return a < b ? b : a; }\n",
           "def maximum(a, b):\n    return b if a < b else a\n\n",
           "function x = maximum(a, b)\n  x = a;\n  if a < b\n    x = b;\n  end\nend\n"},
    Helper{trackers::Operation::absolute, "static inline double absolute(double x) { return fabs(x); }\n",
           "def absolute(x):\n    return math.fabs(x)\n\n", "function x = absolute(x)\n  x = abs(x);\nend\n"},
    Helper{trackers::Operation::sign,
           "static inline double sign_of(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x; }\n",
           "def sign_of(x):\n    return 1.0 if x > 0.0 else -1.0 if x < 0.0 else x\n\n",
           "function x = sign_of(x)\n  x = sign(x);\nend\n"},
    Helper{
        trackers::Operation::clamp,
        "static inline double clamped(double x, double low, double high) {\n"
        "  return x < low ? low : high < x ? high : x;\n}\n",
        "def clamped(x, low, high):\n    return low if x < low else high if high < x else x\n\n",
        "function x = clamped(x, low, high)\n  if x < low\n    x = low;\n  elseif high < x\n    x = high;\n"
        "  end\nend\n"},
    Helper{trackers::Operation::choose,
           "/* a where the first number is above 0, else b. */\n"
           "static inline double chosen(double positive, double a, double b) {\n"
           "  return positive > 0.0 ? a : b;\n}\n",
           "def chosen(positive, a, b):\n    \"\"\"a where the first number is above 0, else b.\"\"\"\n"
           "    return a if positive > 0.0 else b\n\n",
           "function x = chosen(positive, a, b)  % a where the first number is above 0, else b\n  x = b;\n"
           "  if positive > 0\n    x = a;\n  end\nend\n"},
};

}  // namespace

std::string piecewise_code(const std::vector<const trackers::StraightLineProgram*>& programs,
                           CodeLanguage language) {
  std::string text;
  for (const Helper& helper : kHelpers) {
    const bool is_called =
        std::any_of(programs.begin(), programs.end(), [&](const trackers::StraightLineProgram* program) {
          const auto& made = program->instructions();
          return std::any_of(made.begin(), made.end(), [&](const trackers::Instruction& each) {
            return each.operation == helper.operation;
          });
        });
    const std::string_view of_language = language == CodeLanguage::c        ? helper.c
                                         : language == CodeLanguage::python ? helper.python
                                                                            : helper.octave;
    text += is_called ? fmt::format("{}\n", of_language) : std::string();
  }
  return text;
}

}  // namespace veritrack::certificates
