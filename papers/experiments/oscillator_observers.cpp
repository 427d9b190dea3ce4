#include "papers/experiments/oscillator_observers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/search/maximize.hpp"
#include "analysis/search/running_statistics.hpp"
#include "papers/experiments/repeated_runs.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::experiments {

namespace {

using trackers::AdaptiveObserverDesign;
using trackers::AdaptiveOscillatorObserver;

constexpr double kLongestStep = 0.005;              // s
constexpr double kStepsAPeriod = 20.0;              // of the disturbance
constexpr double kCaptionWindow = 20.0;             // s
constexpr double kLong = 40.0;                      // s
constexpr double kSteady = 4.0 * std::numbers::pi;  // s: a period of the disturbed signal, twice
constexpr double kFirstFrequency = 2.0;             // rad/s
constexpr double kSettledPart = 0.02;               // of the frequency

double step_for(double disturbance) {
  return std::min(kLongestStep, 2.0 * std::numbers::pi / (kStepsAPeriod * disturbance));
}

/// The input of an observer.
struct Input {
  double disturbance = kDisturbances[0];  ///< rad/s
  double amplitude = 0.2;                 ///< of the disturbance, signal units
  Sinusoid sinusoid = {};

  [[nodiscard]] double at(double time) const {
    return sinusoid.amplitude * std::sin(sinusoid.frequency * time) +
           amplitude * std::sin(disturbance * time);
  }
};

/// Steps an observer to `seconds`; `visit(time, frequency)` after each.
template <typename Step, typename Frequency, typename Visit>
void run_observer(const Input& input, double seconds, const Step& step, const Frequency& frequency,
                  const Visit& visit) {
  const double interval = step_for(input.disturbance);
  const long steps = std::lround(seconds / interval);
  double before = 0.0;
  for (long k = 1; k <= steps; ++k) {
    const double time = interval * static_cast<double>(k);
    const double now = input.at(time);
    step(before, now);
    before = now;
    visit(time, frequency());
  }
}

template <typename Visit>
void run_hou(const AdaptiveObserverDesign& design, double start, const Input& input, double seconds,
             const Visit& visit) {
  AdaptiveOscillatorObserver observer(design, start, step_for(input.disturbance));
  run_observer(
      input, seconds, [&](double first, double last) { observer.step(first, last); },
      [&] {
        const double frequency = observer.frequency();
        return std::isfinite(frequency) ? frequency : 0.0;
      },
      visit);
}

template <typename Visit>
void run_kkl(double scale, const Input& input, double seconds, const Visit& visit) {
  constexpr double kSmallEll = 1e-9;  // so small that mu vanishes along these runs
  trackers::KklObserver<double> observer({scale * Eigen::Vector4d(1.0, 2.0, 3.0, 4.0), kSmallEll},
                                         step_for(input.disturbance));
  run_observer(
      input, seconds, [&](double first, double last) { observer.step_interpolated(first, last); },
      [&] {
        const auto state = observer.state();
        return state(2) > 0.0 ? std::sqrt(state(2)) : 0.0;
      },
      visit);
}

/// Mean, deviation and error of what comes in.
class Window {
 public:
  void add(double value) {
    statistics_.add(value);
    errors_ += (value - kTrueFrequency) * (value - kTrueFrequency);
  }
  [[nodiscard]] WindowStatistics result() const {
    return {statistics_.mean(), statistics_.deviation(), std::sqrt(errors_ / statistics_.count())};
  }

 private:
  search::RunningStatistics statistics_;
  double errors_ = 0.0;
};

/// `run(input, seconds, visit)`.
template <typename Run>
double settling_of(const Run& run, const Sinusoid& sinusoid) {
  double settling = 0.0;
  run(Input{kDisturbances[0], 0.0, sinusoid}, kLong, [&](double time, double frequency) {
    if (!(std::fabs(frequency - sinusoid.frequency) <= kSettledPart * sinusoid.frequency)) {
      settling = time;
    }
  });
  return settling;
}

template <typename Run>
double error_of(const Run& run, double disturbance) {
  Window window;
  run(Input{disturbance}, kLong, [&](double time, double frequency) {
    if (time > kLong - kSteady) {
      window.add(frequency);
    }
  });
  return window.result().error;
}

template <typename Run>
ObserverPerformance performance_of(const Run& run) {
  const rigor::NearestRounding nearest;
  ObserverPerformance result;
  result.settling = settling_of(run, {});
  for (std::size_t i = 0; i < kDisturbances.size(); ++i) {
    result.error.at(i) = error_of(run, kDisturbances.at(i));
  }
  return result;
}

auto hou_runner(const AdaptiveObserverDesign& design) {
  return [&design](const Input& input, double seconds, const auto& visit) {
    run_hou(design, kFirstFrequency, input, seconds, visit);
  };
}

auto kkl_runner(double scale) {
  return [scale](const Input& input, double seconds, const auto& visit) {
    run_kkl(scale, input, seconds, visit);
  };
}

AdaptiveObserverDesign design_at(const Eigen::VectorXd& point) {
  return {std::exp(point(0)), std::exp(point(1)),
          Eigen::Vector3d(std::exp(point(2)), std::exp(point(3)), std::exp(point(4)))};
}

}  // namespace

HouSetting hou_caption_setting() {
  return {{17.377, 24.796, Eigen::Vector3d(20.836, 129.626, 116.964)}, 0.0, 39.381};
}

WindowStatistics hou_statistics(const HouSetting& setting, double disturbance) {
  const rigor::NearestRounding nearest;
  Window window;
  run_hou(setting.design, setting.start, {disturbance}, setting.from + kCaptionWindow,
          [&](double time, double frequency) {
            if (time > setting.from) {
              window.add(frequency);
            }
          });
  return window.result();
}

ObserverTrace hou_trace(const HouSetting& setting, double disturbance) {
  const rigor::NearestRounding nearest;
  constexpr double kEvery = 0.05;  // s
  ObserverTrace trace;
  double next = 0.0;
  run_hou(setting.design, setting.start, {disturbance}, setting.from + kCaptionWindow,
          [&](double time, double frequency) {
            if (time >= next) {
              trace.time.push_back(time);
              trace.frequency.push_back(frequency);
              next += kEvery;
            }
          });
  return trace;
}

ObserverPerformance kkl_performance(double scale) {
  return performance_of(kkl_runner(scale));
}

double kkl_settling(double scale, const Sinusoid& sinusoid) {
  const rigor::NearestRounding nearest;
  return settling_of(kkl_runner(scale), sinusoid);
}

double hou_settling(const AdaptiveObserverDesign& design, const Sinusoid& sinusoid) {
  const rigor::NearestRounding nearest;
  return settling_of(hou_runner(design), sinusoid);
}

ObserverPerformance hou_performance(const AdaptiveObserverDesign& design) {
  return performance_of(hou_runner(design));
}

AdaptiveObserverDesign best_hou(double settling, int starts) {
  constexpr int kDrawn = 40;
  constexpr int kEvaluations = 200;
  constexpr double kPenalty = 5.0;  // per factor e of settling time beyond the allowed
  const auto objective = [settling](const Eigen::VectorXd& point) {
    const rigor::NearestRounding nearest;
    const AdaptiveObserverDesign design = design_at(point);
    if (!(1.0 + design.alpha * design.lambda > design.lambda)) {
      return -std::numeric_limits<double>::infinity();
    }
    const auto run = hou_runner(design);
    const double late = std::max(0.0, std::log(settling_of(run, {}) / settling));
    const double errors =
        std::log(error_of(run, kDisturbances[0])) + std::log(error_of(run, kDisturbances[1]));
    return -errors - (late > 0.0 ? kPenalty * (1.0 + late) : 0.0);
  };
  const auto found = repeat(starts, [&](std::uint64_t seed) {
    trackers::RandomStream random(seed);
    search::BestPoint start{{}, -std::numeric_limits<double>::infinity()};
    for (int i = 0; i < kDrawn; ++i) {
      Eigen::VectorXd point(5);
      point << 3.5 * random.uniform(), 3.5 * random.uniform(), 7.0 * random.uniform(),
          7.0 * random.uniform() - 1.0, 7.0 * random.uniform() - 1.0;
      const double value = objective(point);
      if (start.point.size() == 0 || value > start.value) {
        start = {point, value};
      }
    }
    search::SearchSpace space;
    space.start = start.point;
    space.step = Eigen::VectorXd::Constant(5, 0.4);
    space.lower = Eigen::VectorXd::Constant(5, -3.0);
    space.upper = Eigen::VectorXd::Constant(5, 9.0);
    space.evaluations = kEvaluations;
    return search::maximize(objective, space);
  });
  return design_at(std::max_element(found.begin(), found.end(), [](const auto& a, const auto& b) {
                     return a.value < b.value;
                   })->point);
}

}  // namespace veritrack::experiments
