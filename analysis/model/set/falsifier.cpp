#include "analysis/model/set/falsifier.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "analysis/model/set/amplitude_parts.hpp"
#include "analysis/rigor/rounding.hpp"

namespace veritrack::model {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Noise of this length in the directions that are tried; one without noise.
std::vector<Eigen::VectorXd> attack_directions(int channels, double noise) {
  if (!(noise > 0.0)) {
    return {Eigen::VectorXd::Zero(channels)};
  }
  if (channels == 1) {
    return {Eigen::VectorXd::Constant(1, noise), Eigen::VectorXd::Constant(1, -noise)};
  }
  constexpr int kDirections = 16;
  std::vector<Eigen::VectorXd> directions(kDirections, Eigen::VectorXd::Zero(channels));
  for (int i = 0; i < kDirections; ++i) {
    directions[static_cast<std::size_t>(i)].head<2>() << noise * std::cos(i * kTurn / kDirections),
        noise * std::sin(i * kTurn / kDirections);
  }
  return directions;
}

/// A tracker in a tube, one sample after the other.
class AttackRun {
 public:
  AttackRun(const TrackerModel& model, const Tube& tube, const AttackedTone& tone)
      : tracker_(model),
        low_(tube.frequency - tube.half_width),
        high_(tube.frequency + tube.half_width),
        tubes_(tone.slew > 0.0 ? 2 : 1, PointTube(tube, tone.frequency)),
        tone_(tone),
        directions_(attack_directions(model.recursion->samples, tone.noise)),
        amplitudes_(model.amplitude_varies ? std::vector<double>{0.0, 1.0} : std::vector<double>{0.5}),
        nexts_(directions_.size() * amplitudes_.size()) {}

  /// The start of a filter's covariance between its bounds: see PointTracker::state.
  void begin_with_covariance(Eigen::MatrixXd place) { place_ = std::move(place); }

  void begin(const Eigen::VectorXd& coordinates) {
    phase_ = tone_.phase;
    frequency_ = tone_.frequency;
    tubes_.front().move_to(frequency_);
    tubes_.front().at(phase_, frame_);
    state_ = tracker_.state(frame_, coordinates, place_);
    level_ = coordinates.norm();
  }
  /// The coordinates after the next sample, under the worst disturbances.
  const Eigen::VectorXd& step() {
    phase_ += frequency_;
    auto to = nexts_.begin();
    for (const double place : amplitudes_) {
      const Eigen::VectorXd samples = tracker_.samples(phase_, place);
      for (const Eigen::VectorXd& direction : directions_) {
        *to++ = tracker_.next(state_, samples + direction);
      }
    }
    level_ = -1.0;
    const double before = frequency_;
    for (std::size_t side = 0; side < tubes_.size(); ++side) {
      const double frequency = std::clamp(before + (side == 0 ? tone_.slew : -tone_.slew), low_, high_);
      tubes_[side].move_to(frequency);
      tubes_[side].at(phase_, frame_);
      for (const Eigen::VectorXd& next : nexts_) {
        const Eigen::VectorXd coordinates = frame_.coordinates(next);
        const double level = coordinates.norm();
        if (!std::isfinite(level)) {
          level_ = std::numeric_limits<double>::infinity();
          return coordinates_;
        }
        if (level > level_) {
          level_ = level;
          coordinates_ = coordinates;
          state_ = next;
          frequency_ = frequency;
        }
      }
    }
    return coordinates_;
  }

  [[nodiscard]] bool is_finite() const { return std::isfinite(level_); }
  [[nodiscard]] AttackedSample now() {
    const double error = tracker_.frequency(state_) - frequency_;
    return {phase_, level_, std::isfinite(error) ? error : std::numeric_limits<double>::infinity()};
  }

 private:
  PointTracker tracker_;
  double low_, high_;
  std::vector<PointTube> tubes_;  // one for each way that the frequency may go
  AttackedTone tone_;
  std::vector<Eigen::VectorXd> directions_;
  std::vector<double> amplitudes_;  ///< places in the range: the ends of one from which each sample may come
  std::vector<Eigen::VectorXd> nexts_;
  PointFrame frame_;
  Eigen::VectorXd state_, coordinates_;
  Eigen::MatrixXd place_;
  double phase_ = 0.0;
  double frequency_ = 0.0;
  double level_ = 0.0;
};

/// A direction of the rim from which the next level is larger: ascent along the gradient, of length R_0
/// again.
Eigen::VectorXd steeper(AttackRun& run, const Eigen::VectorXd& start) {
  const double radius = start.norm();
  run.begin(start);
  const Eigen::VectorXd reached = run.step();
  Eigen::VectorXd gradient(start.size());
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    const double change = 1e-5 * radius;
    Eigen::VectorXd beside = start;
    beside[i] += change;
    run.begin(beside);
    gradient[i] = (run.step().norm() - reached.norm()) / change;
  }
  const double length = gradient.norm();
  return std::isfinite(length) && length > 0.0 ? Eigen::VectorXd(gradient * (radius / length)) : start;
}

/// Uniform in [0, 1), the same on every platform.
double uniform(std::mt19937_64& engine) {
  return static_cast<double>(engine() >> 11) * 0x1p-53;
}

Eigen::VectorXd random_direction(std::mt19937_64& engine, Eigen::Index size) {
  Eigen::VectorXd direction(size);
  do {
    for (Eigen::Index i = 0; i < size; ++i) {
      direction[i] = 2.0 * uniform(engine) - 1.0;
    }
  } while (direction.norm() < 0.1 || direction.norm() > 1.0);
  return direction.normalized();
}

/// At the border of the symmetric matrices of a norm of at most 1: eigenvalues 1 and -1, often only one of
/// them.
Eigen::MatrixXd extreme_place(std::mt19937_64& engine, Eigen::Index size) {
  const double sign = uniform(engine) < 0.5 ? -1.0 : 1.0;
  const double turned = uniform(engine) < 0.5 ? 0.0 : 2.0;
  const Eigen::VectorXd direction = random_direction(engine, size);
  return sign * (Eigen::MatrixXd::Identity(size, size) - turned * direction * direction.transpose());
}

}  // namespace

std::vector<AttackedSample> simulate_attack(const TrackerModel& model, const Tube& tube,
                                            const AttackedTone& tone, const Eigen::VectorXd& start,
                                            int samples) {
  const rigor::NearestRounding nearest;
  AttackRun run(model, tube, tone);
  run.begin(start);
  std::vector<AttackedSample> result{run.now()};
  result.reserve(static_cast<std::size_t>(samples) + 1);
  for (int k = 0; k < samples; ++k) {
    run.step();
    if (!run.is_finite()) {
      break;
    }
    result.push_back(run.now());
  }
  return result;
}

namespace {

/// Each tube at the amplitudes for which it is proved; the starts are shared between the parts.
TubeAttack attack_parts(const TrackerModel& model, const TubeSet& set, const AttackSettings& settings) {
  const std::vector<TubeSet> parts = sets_of_amplitudes(set);
  TubeAttack attack;
  attack.samples = settings.samples;
  AttackSettings of_part = settings;
  const int count = static_cast<int>(parts.size());
  of_part.starts = (settings.starts + count - 1) / count;
  for (const TubeSet& part : parts) {
    const TubeAttack here = attack_tubes(on_amplitudes_of(model, part), part, of_part);
    attack.starts += here.starts;
    attack.level_share = std::max(attack.level_share, here.level_share);
    attack.frequency_error = std::max(attack.frequency_error, here.frequency_error);
    of_part.seed += static_cast<std::uint64_t>(of_part.starts);
  }
  return attack;
}

}  // namespace

TubeAttack attack_tubes(const TrackerModel& model, const TubeSet& set, const AttackSettings& settings) {
  TubeAttack attack;
  if (set.tubes.empty()) {
    return attack;
  }
  if (set.amplitudes.size() > 1) {
    return attack_parts(model, set, settings);
  }
  attack.starts = settings.starts;
  attack.samples = settings.samples;
  struct Reached {
    double level_share = 0.0;
    double frequency_error = 0.0;
  };
  const TrackerModel tracker = on_amplitudes_of(model, set);
  std::vector<Reached> reached(static_cast<std::size_t>(settings.starts));
  tbb::parallel_for(std::size_t{0}, reached.size(), [&](std::size_t number) {
    const rigor::NearestRounding nearest;
    std::mt19937_64 engine(settings.seed + number);
    const ProvedTube& proved = set.tubes[number % set.tubes.size()];
    const double frequency = proved.tube.frequency + (2.0 * uniform(engine) - 1.0) * proved.tube.half_width;
    AttackRun run(tracker, proved.tube, {frequency, kTurn * uniform(engine), set.noise, set.slew});
    Eigen::VectorXd start =
        proved.levels.front() * random_direction(engine, static_cast<Eigen::Index>(proved.tube.curve.size()));
    if (proved.tube.bounds_covariance()) {
      run.begin_with_covariance(extreme_place(engine, start.size()));
    }
    for (int i = 0; i < settings.ascents; ++i) {
      start = steeper(run, start);
    }
    run.begin(start);
    Reached& result = reached[number];
    result.frequency_error = std::fabs(run.now().frequency_error);
    for (int k = 0; k < settings.samples && run.is_finite(); ++k) {
      run.step();
      const AttackedSample now = run.now();
      result.level_share = std::max(result.level_share, now.level / proved.levels.front());
      result.frequency_error = std::max(result.frequency_error, std::fabs(now.frequency_error));
    }
  });
  for (const Reached& each : reached) {
    attack.level_share = std::max(attack.level_share, each.level_share);
    attack.frequency_error = std::max(attack.frequency_error, each.frequency_error);
  }
  return attack;
}

}  // namespace veritrack::model
