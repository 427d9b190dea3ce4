#include "reports/recording/track_run.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "certificates/design/design_reader.hpp"
#include "certificates/document/tracker_kind.hpp"
#include "tests/reports/recording/recorded_tone.hpp"
#include "tests/support/random.hpp"

namespace veritrack::reports {
namespace {

constexpr const char* kQuadratureDesign = R"(
name = "test"
tracker = "quadrature-ekf"
[design]
q1 = 1e-4
q2 = 1e-6
r = 0.01
epsilon = 0
[assume]
frequency = [0.1, 3.0]
noise = 0.5
initial_frequency_error = 0.01
initial_phase_error = 0.01
initial_amplitude_error = 0.01
)";

certificates::TrackerOnSamples tracker_of(const std::string& text) {
  const certificates::Design design = certificates::read_design(text, "test.toml");
  return certificates::kind_of(design).track(design);
}

certificates::TrackerOnSamples tracker_of_file(const std::string& name) {
  const certificates::Design design =
      certificates::read_design_file(std::filesystem::path(VERITRACK_SOURCE_DIR) / "designs" / name);
  return certificates::kind_of(design).track(design);
}

TrackResult run(certificates::TrackerOnSamples tracker, std::vector<RecordedSample> recording,
                const TrackSettings& settings = {}, const EachSample& each = {}) {
  test::MemorySource source(std::move(recording), tracker.tracker->channels());
  return track_recording(source, tracker, settings, each, {});
}

/// A recording from the very model that the filter believes in: the tone takes Gaussian steps in phase space
/// and in frequency, and is measured with noise of variance r.
std::vector<RecordedSample> believed_recording(std::size_t samples, double q1, double q2, double r) {
  trackers::RandomStream random(test::kSeed);
  std::vector<RecordedSample> recording;
  double x1 = 1.0;
  double x2 = 0.0;
  double frequency = 0.7;
  for (std::size_t k = 0; k < samples; ++k) {
    recording.push_back({x1 + std::sqrt(r) * random.normal(), x2 + std::sqrt(r) * random.normal(), true});
    const double turned = x1 * std::cos(frequency) - x2 * std::sin(frequency);
    x2 = x1 * std::sin(frequency) + x2 * std::cos(frequency) + std::sqrt(q1) * random.normal();
    x1 = turned + std::sqrt(q1) * random.normal();
    frequency += std::sqrt(q2) * random.normal();
  }
  return recording;
}

TEST_CASE("the NIS of a filter whose belief is right is within its band, and not when it is wrong") {
  const auto mean_nis = [](const TrackResult& result) {
    return result.nis.sum / static_cast<double>(result.nis.count);
  };
  const auto count = static_cast<std::size_t>(test::effort(4000));
  const TrackResult right = run(tracker_of(kQuadratureDesign), believed_recording(count, 1e-4, 1e-6, 0.01));
  // Two degrees of freedom: the deviation of the mean is 2 / sqrt(n).
  CHECK(std::fabs(mean_nis(right) - 2.0) < 4.0 * 2.0 / std::sqrt(static_cast<double>(count)));
  CHECK(right.nis.too_large.count() == 0);

  const TrackResult bold = run(tracker_of(kQuadratureDesign), believed_recording(count, 1e-4, 1e-6, 0.04));
  CHECK(verdict_on(bold.nis, 2) == NisFindings::Verdict::over_confident);
  CHECK(bold.nis.too_large.count() > 0);
  const TrackResult timid = run(tracker_of(kQuadratureDesign), believed_recording(count, 1e-4, 1e-6, 0.001));
  CHECK(verdict_on(timid.nis, 2) == NisFindings::Verdict::cautious);
  CHECK(timid.nis.too_large.count() == 0);
}

TEST_CASE("the same filter as a model has the same estimates, innovations, NIS and deviations") {
  std::vector<TrackedSample> own;
  std::vector<TrackedSample> model;
  const auto recording = test::recorded_tone(500, 2, 0.01, [](std::size_t) { return 0.7; });
  (void)run(tracker_of_file("la-scala-1994-figure-3.5-without-leak.toml"), recording, {},
            [&](const TrackedSample& sample) { own.push_back(sample); });
  (void)run(tracker_of_file("models/quadrature-ekf.toml"), recording, {},
            [&](const TrackedSample& sample) { model.push_back(sample); });
  REQUIRE(own.size() == model.size());
  for (std::size_t k = 100; k < own.size(); ++k) {  // the starts differ
    CHECK(model[k].output.frequency == doctest::Approx(own[k].output.frequency).epsilon(1e-8));
    CHECK(model[k].output.innovation[0] == doctest::Approx(own[k].output.innovation[0]).epsilon(1e-6));
    CHECK(model[k].output.innovation[1] == doctest::Approx(own[k].output.innovation[1]).epsilon(1e-6));
    CHECK(model[k].output.nis == doctest::Approx(own[k].output.nis).epsilon(1e-6));
    CHECK(model[k].output.frequency_deviation ==
          doctest::Approx(own[k].output.frequency_deviation).epsilon(1e-6));
  }
}

TEST_CASE("one channel: the filter and its model agree, too") {
  std::vector<TrackedSample> own;
  std::vector<TrackedSample> model;
  const auto recording = test::recorded_tone(1500, 1, 0.01, [](std::size_t) { return 1.5; });
  constexpr const char* kDesign = R"(
name = "test"
tracker = "single-channel-ekf"
[design]
q = 0.005
r = 0.01
process_noise = "identity"
[assume]
frequency = [1.4, 1.6]
noise = 0.003
initial_frequency_error = 0.01
initial_phase_error = 0.01
initial_amplitude_error = 0.01
)";
  (void)run(tracker_of(kDesign), recording, {}, [&](const TrackedSample& s) { own.push_back(s); });
  (void)run(tracker_of_file("models/single-channel-ekf.toml"), recording, {},
            [&](const TrackedSample& s) { model.push_back(s); });
  for (std::size_t k = 500; k < own.size(); ++k) {
    CHECK(model[k].output.frequency == doctest::Approx(own[k].output.frequency).epsilon(1e-6));
    CHECK(model[k].output.nis == doctest::Approx(own[k].output.nis).epsilon(1e-4));
  }
}

TEST_CASE("every tracker follows a clean tone from its first sample") {
  for (const char* name :
       {"la-scala-1994-figure-3.5-without-leak.toml", "bittanti-savaresi-2000-example-1-quiet.toml",
        "models/sogi-fll.toml", "models/type-2-pll.toml", "models/kalmanf.toml", "models/aranovskiy.toml",
        "models/pei-tseng-notch.toml", "models/quadrature-notch.toml", "models/single-channel-ekf.toml"}) {
    INFO(name);
    certificates::TrackerOnSamples tracker = tracker_of_file(name);
    const double frequency = 0.5 * (tracker.assume.frequency[0] + tracker.assume.frequency[1]);
    const auto recording =
        test::recorded_tone(20000, tracker.tracker->channels(), 0.0, [&](std::size_t) { return frequency; });
    const TrackResult result = run(std::move(tracker), recording);
    CHECK(result.first_lock.has_value());
    CHECK_FALSE(result.lost_lock.has_value());
    CHECK(std::fabs(result.frequency.mean() - frequency) < 0.02);
    CHECK(result.assumptions.frequency_exceeded.count() == 0);
  }
}

TEST_CASE("a tone that ends is a lost lock, near where it ends") {
  auto recording = test::recorded_tone(20000, 2, 0.05, [](std::size_t) { return 0.7; });
  trackers::RandomStream random(5);
  for (std::size_t k = 12000; k < recording.size(); ++k) {
    recording[k] = {0.05 * random.normal(), 0.05 * random.normal(), true};
  }
  const TrackResult result = run(tracker_of(kQuadratureDesign), recording);
  REQUIRE(result.lost_lock.has_value());
  CHECK(*result.lost_lock >= 12000);
  CHECK(*result.lost_lock <= 12200);
  CHECK_FALSE(result.ends_in_lock);
}

TEST_CASE("in a gap a filter predicts, and a recursion is started anew behind it") {
  auto recording = test::recorded_tone(3000, 2, 1e-4, [](std::size_t) { return 0.7; });
  for (std::size_t k = 1500; k < 1520; ++k) {
    recording[k] = {0.0, 0.0, false};
  }
  std::vector<TrackedSample> rows;
  const TrackResult filter =
      run(tracker_of(kQuadratureDesign), recording, {}, [&](const TrackedSample& s) { rows.push_back(s); });
  CHECK(filter.start_count == 1);
  CHECK_FALSE(filter.lost_lock.has_value());
  CHECK(filter.has_gap_between);
  CHECK(filter.gaps.samples() == 20);
  CHECK(rows[1510].state == TrackState::gap);
  CHECK(rows[1510].output.frequency == doctest::Approx(0.7).epsilon(1e-3));
  CHECK(rows[1519].output.frequency_deviation > rows[1499].output.frequency_deviation);
  CHECK(std::isnan(rows[1510].output.nis));

  auto one = test::recorded_tone(6000, 1, 1e-4, [](std::size_t) { return 1.5; });
  for (std::size_t k = 1500; k < 1520; ++k) {
    one[k] = {0.0, 0.0, false};
  }
  const TrackResult model = run(tracker_of_file("models/single-channel-ekf.toml"), one);
  CHECK(model.start_count == 2);
  CHECK(model.starts[1].sample == 1520);
  CHECK_FALSE(model.lost_lock.has_value());
}

TEST_CASE("only the samples asked for are used, and the scale is what makes the amplitude fit") {
  auto recording = test::recorded_tone(3000, 2, 1e-3, [](std::size_t) { return 0.7; });
  for (RecordedSample& sample : recording) {
    sample.in_phase *= 0.01;
    sample.quadrature *= 0.01;
  }
  TrackSettings settings;
  settings.from = 1000;
  settings.to = 2500;
  settings.scale.reset();
  const TrackResult result = run(tracker_of(kQuadratureDesign), recording, settings);
  CHECK(result.first == 1000);
  CHECK(result.samples == 1500);
  CHECK(result.scale == doctest::Approx(100.0).epsilon(1e-2));
  CHECK(result.series.rows().front().first == 1000);
  settings.start_frequency = 0.75;
  CHECK(run(tracker_of(kQuadratureDesign), recording, settings).starts.front().tone.frequency == 0.75);
}

TEST_CASE("silence, and no samples at all, start no tracker") {
  const TrackResult silent =
      run(tracker_of(kQuadratureDesign), std::vector<RecordedSample>(5000, RecordedSample{0.0, 0.0, true}));
  CHECK(silent.start_count == 0);
  CHECK(silent.untracked.samples() == 5000);
  CHECK(run(tracker_of(kQuadratureDesign), {}).samples == 0);
}

}  // namespace
}  // namespace veritrack::reports
