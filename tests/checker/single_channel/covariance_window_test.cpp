// What the checker accepts of a window, against the covariance of the tracker that runs.
#include "checker/single_channel/covariance_window.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/checker/single_channel/window_support.hpp"

namespace {

using namespace veritrack;
using namespace veritrack::test::window;

bool is_proved(const WindowStatement& statement, const checker::SingleChannelDesign& design) {
  std::int64_t cells = 0;
  return window_is_proved(statement, design, cells);
}

TEST_CASE("what is true of the tracker that runs is accepted, what is not is refused") {
  const Extremes seen = along_a_tone();
  const checker::SingleChannelDesign design = design_of_the_tone();
  const WindowStatement statement = true_statement(seen);
  REQUIRE(is_proved(statement, design));
  const auto refused = [&](Ball WindowStatement::*number, double value) {
    WindowStatement changed = statement;
    changed.*number = Ball(value);
    return !is_proved(changed, design);
  };
  CHECK(refused(&WindowStatement::frequency_variance, 0.999 * seen.most_p33));
  CHECK(refused(&WindowStatement::signal_variance, 0.999 * seen.most_signal));
  CHECK(refused(&WindowStatement::signal_uncertainty, 1.001 * seen.least_predicted));
  CHECK(refused(&WindowStatement::least_p33, 1.001 * seen.least_p33));
  CHECK(refused(&WindowStatement::start_frequency, 1.001 / seen.most_inverse));
  CHECK(refused(&WindowStatement::curvature, 1e-4));
  CHECK(refused(&WindowStatement::radius, 0.1));
  CHECK(refused(&WindowStatement::radius, -1e-3));
  CHECK(refused(&WindowStatement::loosening, 1.0));
  CHECK(refused(&WindowStatement::slew, 0.1));
  CHECK(refused(&WindowStatement::least_p11, 1e3));
  CHECK(refused(&WindowStatement::least_p22, 1e3));
  CHECK_FALSE(refused(&WindowStatement::covariance_rounding, 1e-7));
  CHECK(refused(&WindowStatement::covariance_rounding, 0.05));
  CHECK(refused(&WindowStatement::covariance_rounding, 1.0));
  // Of these the proof uses squares, or what they leave of 1.
  CHECK(refused(&WindowStatement::covariance_rounding, -1e-9));
  CHECK(refused(&WindowStatement::slew, -1e-9));
  CHECK(refused(&WindowStatement::start_signal, -1e-6));
  CHECK(refused(&WindowStatement::start_frequency, 0.0));
  WindowStatement negative_share = statement;
  negative_share.shares[2] = Ball(-0.05);
  CHECK(!is_proved(negative_share, design));
  WindowStatement all_forgotten = statement;
  all_forgotten.shares = {Ball(0.9)};
  CHECK(!is_proved(all_forgotten, design));
  WindowStatement more_than_all = statement;
  more_than_all.shares.back() = Ball(1.5);
  CHECK(!is_proved(more_than_all, design));
  CHECK(refused(&WindowStatement::loosening, 2.0));
  WindowStatement empty = statement;
  empty.shares.clear();
  CHECK(!is_proved(empty, design));
}

TEST_CASE("rounding makes the upper bounds larger and the lower ones smaller") {
  const Extremes seen = along_a_tone();
  const checker::SingleChannelDesign design = design_of_the_tone();
  const auto proved = [&](WindowStatement statement, double rounding) {
    statement.covariance_rounding = Ball(rounding);
    return is_proved(statement, design);
  };
  // Nothing but the variances is close to what is true.
  WindowStatement from_above = true_statement(seen);
  from_above.has_least = from_above.has_starts = false;
  from_above.shares = {Ball(1e-6), Ball(1e-6), Ball(1e-6), Ball(1e-6), Ball(1e-6)};
  from_above.signal_uncertainty = Ball(1e-6);
  from_above.curvature = Ball(10.0);
  CHECK(proved(from_above, 1e-4));
  CHECK_FALSE(proved(from_above, 0.1));
  // Nothing but the least variance.
  WindowStatement from_below = from_above;
  from_below.frequency_variance = Ball(3.0 * seen.most_p33);
  from_below.signal_variance = Ball(3.0 * seen.most_signal);
  from_below.radius = Ball(1e-4);
  CHECK(proved(from_below, 0.1));
  from_below.has_least = true;
  from_below.least_p33 = Ball(0.9 * seen.least_p33);
  CHECK(proved(from_below, 1e-4));
  CHECK_FALSE(proved(from_below, 0.1));
}

TEST_CASE("a window is only for a tracker without a leak, with process noise in the amplitude") {
  const WindowStatement statement = true_statement(along_a_tone());
  checker::SingleChannelDesign leaking = design_of_the_tone();
  leaking.epsilon = Ball(1e-6);
  CHECK(!is_proved(statement, leaking));
  checker::SingleChannelDesign undriven = design_of_the_tone();
  undriven.q1 = Ball(0.0);
  CHECK(!is_proved(statement, undriven));
}

TEST_CASE("a loosening of 1 or more turns a bound around, and is refused") {
  WindowStatement statement = true_statement(along_a_tone());
  statement.frequency_variance = Ball(10.0) * statement.frequency_variance;
  statement.signal_variance = Ball(10.0) * statement.signal_variance;
  statement.curvature = Ball(1e3);
  statement.signal_uncertainty = statement.radius = Ball(1e-9);
  statement.shares = {Ball(1e-9), Ball(1e-9)};
  statement.has_least = statement.has_starts = false;
  statement.loosening = Ball(0.99);
  CHECK(is_proved(statement, design_of_the_tone()));
  statement.loosening = Ball(1.01);
  CHECK(!is_proved(statement, design_of_the_tone()));
}

TEST_CASE("a frequency and pi less it are the same to the covariance") {
  const Extremes seen = along_a_tone();
  checker::SingleChannelDesign mirrored = design_of_the_tone();
  mirrored.lowest = mirrored.highest = checker::pi() - Ball(kFrequency);
  WindowStatement statement = true_statement(seen);
  CHECK(is_proved(statement, mirrored));
  statement.frequency_variance = Ball(0.999 * seen.most_p33);
  CHECK(!is_proved(statement, mirrored));
}

}  // namespace
