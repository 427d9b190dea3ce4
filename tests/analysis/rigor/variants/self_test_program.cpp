// Ends like veritrack itself: with 3 when the arithmetic of this process failed the self-test.
#include <cstdio>

#include "analysis/rigor/self_test.hpp"

int main() {
  const veritrack::rigor::SelfTestReport report = veritrack::rigor::run_self_test();
  for (const std::string& failure : report.failures) {
    std::fprintf(stderr, "%s\n", failure.c_str());
  }
  return report.passed() ? 0 : 3;
}
