#include "papers/experiments/oscillator_observers.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace veritrack::experiments {
namespace {

TEST_CASE(
    "the paper's observer errs as the captions of Figures 4 to 6 say: 0.1164, 0.0142, 0.0014 about 3 rad/s") {
  const ObserverPerformance performance = kkl_performance(1.0);
  CHECK(performance.error[0] == doctest::Approx(0.1164).epsilon(0.02));
  CHECK(performance.error[1] == doctest::Approx(0.0142).epsilon(0.02));
  CHECK(performance.error[2] == doctest::Approx(0.0014).epsilon(0.02));
  CHECK(performance.settling == doctest::Approx(kkl_settling(1.0, {})));
}

TEST_CASE("faster rates settle faster and err more") {
  const ObserverPerformance slow = kkl_performance(1.0);
  const ObserverPerformance fast = kkl_performance(2.0);
  CHECK(fast.settling < slow.settling);
  CHECK(fast.error[0] > slow.error[0]);
}

TEST_CASE("the new observer settles in the same time whatever the amplitude; a tuned adaptive one does not") {
  CHECK(kkl_settling(1.0, {1.0, 3.0}) == doctest::Approx(kkl_settling(1.0, {4.0, 3.0})));
  const trackers::AdaptiveObserverDesign tuned{6.37, 3.11, Eigen::Vector3d(64.0, 0.0498, 0.788)};
  CHECK(hou_settling(tuned, {2.0, 3.0}) < 7.0);
  CHECK(hou_settling(tuned, {1.0, 3.0}) > 20.0);
  CHECK(hou_performance(tuned).error[0] < kkl_performance(1.0).error[0]);
}

TEST_CASE("statistics are those of the window") {
  const HouSetting setting = hou_caption_setting();
  const WindowStatistics found = hou_statistics(setting, 100.0);
  CHECK(found.error * found.error ==
        doctest::Approx(found.deviation * found.deviation + (found.mean - 3.0) * (found.mean - 3.0)));
  CHECK(hou_trace(setting, 100.0).time.back() <= setting.from + 20.0 + 1e-9);
}

}  // namespace
}  // namespace veritrack::experiments
