#include "analysis/rigor/self_test.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "analysis/rigor/rounding.hpp"

using namespace veritrack;

namespace {

bool mentions(const rigor::SelfTestReport& report, const std::string& words) {
  return std::any_of(report.failures.begin(), report.failures.end(),
                     [&](const std::string& failure) { return failure.find(words) != std::string::npos; });
}

/// Runs the self-test with the control register changed, and puts it back.
rigor::SelfTestReport run_with_control(unsigned int set, unsigned int clear = 0) {
  const unsigned int control = rigor::detail::read_control();
  rigor::detail::write_control((control | set) & ~clear);
  rigor::SelfTestReport report = rigor::run_self_test();
  const bool kept = (rigor::detail::read_control() & ~rigor::detail::kExceptionFlags) ==
                    (((control | set) & ~clear) & ~rigor::detail::kExceptionFlags);
  rigor::detail::write_control(control);
  CHECK_MESSAGE(kept, "the self-test must leave the processor as it found it");
  return report;
}

}  // namespace

TEST_CASE("this build passes the self-test") {
  const rigor::SelfTestReport report = rigor::run_self_test();
  for (const std::string& failure : report.failures) {
    MESSAGE(failure);
  }
  CHECK(report.passed());
  CHECK_NOTHROW(rigor::require_sound_arithmetic());
}

TEST_CASE("flush-to-zero and denormals-are-zero are found out, each by itself") {
  CHECK(mentions(run_with_control(0x8000), "flushed to zero"));
  CHECK(mentions(run_with_control(0x0040), "flushed to zero"));
}

TEST_CASE("a process that does not round to nearest is found out") {
  CHECK(mentions(run_with_control(0x2000), "not to-nearest"));
  CHECK(mentions(run_with_control(0x4000), "not to-nearest"));
  CHECK(mentions(run_with_control(0x6000), "not to-nearest"));
}

TEST_CASE("a failed self-test is an ArithmeticError that says why") {
  const rigor::UpwardRounding mode;  // the self-test belongs outside of every scope
  CHECK_FALSE(rigor::run_self_test().passed());
  CHECK_THROWS_AS(rigor::require_sound_arithmetic(), rigor::ArithmeticError);
  try {
    rigor::require_sound_arithmetic();
  } catch (const rigor::ArithmeticError& error) {
    CHECK(std::string(error.what()).find("not to-nearest") != std::string::npos);
  }
}
