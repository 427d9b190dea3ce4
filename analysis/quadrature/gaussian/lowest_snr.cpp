#include "analysis/quadrature/gaussian/lowest_snr.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/rounding.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::quadrature {

namespace {

using rigor::Interval;

/// Signal-to-noise ratios that are looked at, in quarters of a decibel.
constexpr int kLeastQuarters = 0;
constexpr int kMostQuarters = 200;
/// With less left of the inequality at the sampled points, cells have to be too small for a proof in seconds.
constexpr double kProvable = 0.022;
constexpr std::int64_t kMostCellsInPart = 100'000;

/// dB, so that another program finds the ratio below what is said of it.
constexpr double kRoom = 1e-9;

double nearest_decibels(double deviation) {
  return -10.0 * std::log10(2.0 * deviation * deviation);
}

/// Looks for the ratio, each time from the set for the last noise that was good.
class SnrSearch {
 public:
  SnrSearch(const LockQuestion& question, const std::optional<LockProposal>& known,
            std::int64_t affordable_cells)
      : question_(question), affordable_cells_(affordable_cells) {
    if (known) {
      shape_ = known->shape;
    }
  }

  /// The lowest ratio with a good margin, in quarters of a decibel, from a first guess on; nothing when none
  /// is.
  std::optional<int> lowest_with_margin(int first) {
    return lowest(first, -1, [&](int quarters) { return has_margin(quarters); });
  }

  /// The lowest ratio above or at this one for which a proof is affordable.
  std::optional<int> lowest_affordable(int first) {
    return lowest(first, 1, [&](int quarters) { return is_affordable(quarters); });
  }

  [[nodiscard]] LockQuestion question_at(int quarters) const {
    LockQuestion question = question_;
    question.noise_deviation = Interval(deviation_at(quarters));
    return question;
  }

  std::optional<LockProposal> propose(int quarters) {
    LockRequest request = proposal_request(question_at(quarters));
    request.near = shape_;
    return propose_lock_set(request);
  }

 private:
  /// The lowest that is good, those above it being good: from `first` on upwards, or, where that is good and
  /// `direction` is down, from there downwards.
  template <typename Good>
  static std::optional<int> lowest(int first, int direction, Good is_good) {
    int good = first;
    int bad = first;
    int step = direction < 0 ? 8 : 2;
    if (is_good(first)) {
      if (direction > 0) {
        return first;
      }
      do {
        good = bad;
        bad -= step;
      } while (bad >= kLeastQuarters && is_good(bad));
    } else {
      do {
        bad = good;
        good += step;
        step *= 2;
        if (good > kMostQuarters) {
          return std::nullopt;
        }
      } while (!is_good(good));
    }
    while (good - bad > 1) {
      const int middle = bad + (good - bad) / 2;
      (is_good(middle) ? good : bad) = middle;
    }
    return good;
  }

  bool has_margin(int quarters) {
    const std::optional<LockProposal> found = propose(quarters);
    const bool good = found && found->margin >= kProvable;
    if (good) {
      shape_ = found->shape;
    }
    return good;
  }

  bool is_affordable(int quarters) {
    constexpr std::size_t kEvery = 13;
    const std::optional<LockProposal> found = propose(quarters);
    return found && expects_cells(question_.design, found->set, kEvery, affordable_cells_);
  }

  LockQuestion question_;
  std::int64_t affordable_cells_;
  std::optional<LockShape> shape_;
};

/// The items of a LockCertificate that are reported at the lowest ratio.
template <typename Item, typename Name>
std::vector<Item> kept(const std::vector<Item>& items, Name name,
                       std::initializer_list<std::string_view> names) {
  std::vector<Item> result;
  for (const Item& item : items) {
    if (std::find(names.begin(), names.end(), name(item)) != names.end()) {
      result.push_back(item);
    }
  }
  return result;
}

LowestSnr as_lowest(LockCertificate found) {
  LowestSnr result;
  theorems::Derivation& derivation = result.derivation;
  derivation.title = "Gaussian noise: the lowest signal-to-noise ratio";
  derivation.id = "lowest-snr";
  derivation.conditions =
      kept(found.derivation.conditions, [](const theorems::Condition& condition) { return condition.id; },
           {"leak", "drift", "rounding", "start-in-set"});
  theorems::conclude(derivation);
  theorems::add_quantity(derivation,
                         {"lowest_snr", "\\mathrm{SNR}", "-10\\log_{10}(2\\sigma^2)", "docs/gaussian.md",
                          "lowest signal-to-noise ratio for which the required probability is certified, dB",
                          theorems::Sense::at_most},
                         found.sets.empty()
                             ? Interval()
                             : decibels_of(Interval(found.sets.front().noise_deviation)) + Interval(kRoom),
                         "No set could be certified.");
  for (theorems::Quantity& quantity :
       kept(found.derivation.quantities, [](const theorems::Quantity& quantity) { return quantity.name; },
            {"probability_of_losing_lock", "lock_frequency_error", "start_level"})) {
    derivation.quantities.push_back(std::move(quantity));
  }
  if (!found.sets.empty()) {
    result.set = found.sets.front();
  }
  result.cells = found.cells;
  result.covariance_multiples = found.covariance_multiples;
  return result;
}

}  // namespace

double deviation_at(int quarters) {
  constexpr double kHair = 1.0 + 1e-9;  // so that rounding does not spoil the number
  return kHair * std::sqrt(0.5 * std::pow(10.0, -0.025 * quarters));
}

Interval decibels_of(const Interval& deviation) {
  return -(Interval(10.0) * rigor::log(Interval(2.0) * rigor::square(deviation)) /
           rigor::log(Interval(10.0)));
}

LowestSnr certify_lowest_snr(const LockQuestion& question, const std::optional<LockProposal>& at_its_noise,
                             std::int64_t affordable_cells) {
  const rigor::UpwardRounding upward;
  if (!(question.design.epsilon == Interval(0.0))) {
    throw std::invalid_argument("the lowest signal-to-noise ratio is for a tracker without a leak");
  }
  if (!is_well_posed(question)) {
    return as_lowest(certify_lock(question, std::nullopt));
  }
  SnrSearch search(question, at_its_noise, affordable_cells);
  constexpr int kTries = 3;
  const double assumed = 4.0 * nearest_decibels(question.noise_deviation.upper());
  const int first =
      static_cast<int>(std::clamp(std::ceil(assumed - 1e-6), double{kLeastQuarters}, double{kMostQuarters}));
  std::optional<int> lowest = search.lowest_with_margin(first);
  lowest = lowest ? search.lowest_affordable(*lowest) : std::nullopt;
  for (int k = 0; lowest && k < kTries; ++k) {
    LockCertificate found =
        certify_lock(search.question_at(*lowest + k), search.propose(*lowest + k), kMostCellsInPart);
    if (!found.sets.empty()) {
      return as_lowest(std::move(found));
    }
  }
  return as_lowest(certify_lock(question, std::nullopt));
}

}  // namespace veritrack::quadrature
