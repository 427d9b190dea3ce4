// Examples 1 and 2 of S. Bittanti and S. M. Savaresi, IEEE Trans. Automatic Control 45(9), 2000, simulated in
// double: the statements of the printed text and figures, and how often each reading of Q reproduces them.
// Simulations prove nothing; there is no certificate here.
//
// Example 1: cos of a frequency of pi/6 up to t = 300, then rising linearly to 2 pi/3 at t = 700, then
// constant up to t = 1000; noise variance 0.01; q = 0.005, r = 0.01; epsilon = 0.05 or 0. Example 2: pi/6 up
// to t = 500, then 2 pi/3; tracker (15), q = 1, r = lambda = 0, 1 or 10, epsilon = 0. The paper says neither
// the start of the tracker nor the phase of the signal at its jump; ours are in example_starts() and a
// continuous phase.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace veritrack::single_channel {

/// Where the tracker starts: state, and P(0|0) = variance I.
struct ExampleStart {
  std::string words;
  double in_phase, quadrature, frequency, variance;
};

/// Plausible starts: nothing known, a guess of the frequency, and the exact state, with a large and a small
/// P(0|0).
[[nodiscard]] std::vector<ExampleStart> example_starts();

enum class ProcessNoiseReading { frequency_only, identity };
enum class Example { one, two };

/// Where F of P(t+1) = F (P - K H P) F' + Q is evaluated. The EKF: at x(t|t), from which the state is
/// predicted. The paper defines F(t), below (2b) and again below (14), at x(t-1|t-1), one sample late.
enum class LinearizationPoint { latest_estimate, as_printed };

struct ExampleSetting {
  Example example = Example::one;
  ProcessNoiseReading reading = ProcessNoiseReading::identity;
  double q = 1.0, r = 1.0, epsilon = 0.0;
  ExampleStart start;
  LinearizationPoint linearization = LinearizationPoint::latest_estimate;
};

/// One run, samples t = 1, ..., 1000 at index t - 1.
struct ExampleRun {
  std::vector<double> true_frequency;  ///< rad/sample
  std::vector<double> frequency;       ///< estimate, rad/sample
  std::vector<double> quadrature;      ///< estimate of x2, signal units
  bool completed = true;               ///< false when an innovation variance was exactly zero; then shorter
};

[[nodiscard]] ExampleRun run_example(const ExampleSetting& setting, std::uint64_t seed);

/// The estimate over the last 100 samples before the frequency first changes, or the last 100 of the run.
struct WindowSummary {
  double mean_error = 0.0;  ///< rad/sample
  double deviation = 0.0;   ///< root mean square about the mean, rad/sample
  bool locked = false;      ///< |mean error| < 0.35 and deviation < 0.5 rad/sample
  bool near_zero = false;   ///< |mean estimate| < 0.1 and deviation < 0.5 rad/sample
};

struct RunSummary {
  WindowSummary first, last;
};

/// Summaries of the runs with seeds 1, ..., seeds, in that order, whatever the number of threads.
[[nodiscard]] std::vector<RunSummary> summarize_runs(const ExampleSetting& setting, int seeds);

/// How many of the seeds 1, ..., seeds lock on both frequencies of Example 1 with F at that point (q = 0.005,
/// r = 0.01).
[[nodiscard]] int locked_runs(ProcessNoiseReading reading, double epsilon, const ExampleStart& start,
                              LinearizationPoint linearization, int seeds);

/// A statement of the text or of a figure, and the share of the seeds for which it came out.
struct StatementRate {
  std::string statement;
  double rate = 0.0;
};

/// Every statement of both examples, for one reading and start. The same statements in the same order for
/// all.
[[nodiscard]] std::vector<StatementRate> statement_rates(ProcessNoiseReading reading,
                                                         const ExampleStart& start, int seeds);

}  // namespace veritrack::single_channel
