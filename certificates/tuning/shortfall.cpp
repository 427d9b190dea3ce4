#include "certificates/tuning/shortfall.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "analysis/rigor/decimal.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/sets/gaussian_noise.hpp"
#include "certificates/tuning/design_values.hpp"

namespace veritrack::certificates {

namespace {

constexpr double kMissing = 20.0;  // for numbers that are not certified at all; larger than any ratio's
                                   // logarithm
constexpr int kShortfallDigits = 3;
constexpr std::string_view kLeakName = "leak";

/// 0 when the value is as large as requested; otherwise the logarithm of the missing factor.
double missing(double value, double wanted) {
  if (value >= wanted) {
    return 0.0;
  }
  const double ratio = std::log(wanted / value);
  return std::isfinite(ratio) ? std::min(ratio, kMissing) : kMissing;
}
double excess(double value, double allowed) {
  if (value < allowed) {
    return 0.0;
  }
  // Even a value that is just as large is too large.
  const double ratio = std::log(value / allowed) + 1e-12;
  return std::isfinite(ratio) ? std::min(ratio, kMissing) : kMissing;
}

double shortage_with_gaussian_noise(const CertifiedValues& found, const Requirements& require) {
  double sum = 0.0;
  if (!(found.lock_margin >= kEnoughMargin)) {
    constexpr double kSteep = 20.0;
    sum += 1.0 + kSteep * std::min(kEnoughMargin - found.lock_margin, 1.0);
  }
  if (const auto& wanted = require.rms_frequency_error_below) {
    sum += excess(found.rms, wanted->nearest);
  }
  return sum;
}

/// The numbers that may be smaller: the assumptions, and the leak of the design.
struct Terms {
  Assumptions assume;
  Number leak;
};

/// A number of the terms that may be smaller, with its words.
struct Reducible {
  std::string_view name;
  std::string_view words;
  void (*reduce)(Terms& terms, double factor);
  std::string (*shown)(const Terms& terms);
  std::string (*as_written)(const Terms& terms);
  bool (*is_there)(const Terms& terms);
};

Number times(const Number& number, double factor) {
  return number_of(number.nearest * factor);
}

/// A reduced number is shown a little too small, so that the printed one was certified.
std::string rounded_down(double value) {
  return rigor::to_decimal(value, kShortfallDigits, rigor::Direction::down);
}

void reduce_starts(Terms& terms, double factor) {
  Assumptions& assume = terms.assume;
  for (Number* number :
       {&assume.initial_frequency_error, &assume.initial_phase_error, &assume.initial_amplitude_error}) {
    *number = times(*number, factor);
  }
}

double decibels_of(const Assumptions& assume) {
  return -20.0 * std::log10(std::sqrt(2.0) * nearest_deviation(assume));
}

const Reducible kReducible[] = {
    {"noise", "noise of at most",
     [](Terms& terms, double factor) { terms.assume.noise = times(terms.assume.noise, factor); },
     [](const Terms& terms) { return rounded_down(terms.assume.noise.nearest) + " signal units"; },
     [](const Terms& terms) { return terms.assume.noise.text; },
     [](const Terms& terms) { return !terms.assume.gaussian && terms.assume.noise.nearest > 0.0; }},
    {"noise", "an SNR of at least",
     [](Terms& terms, double factor) {
       const double decibels = decibels_of(terms.assume) - 20.0 * std::log10(factor);
       terms.assume.gaussian = GaussianNoise{number_of(decibels), std::nullopt};
     },
     [](const Terms& terms) {
       return rigor::to_decimal(decibels_of(terms.assume), kShortfallDigits, rigor::Direction::up) + " dB";
     },
     [](const Terms& terms) {
       const GaussianNoise& noise = *terms.assume.gaussian;
       return noise.snr_db ? noise.snr_db->text + " dB" : "a deviation of " + noise.deviation->text;
     },
     [](const Terms& terms) { return terms.assume.gaussian.has_value(); }},
    {"walk", "a walk of at most",
     [](Terms& terms, double factor) {
       terms.assume.frequency_walk = times(*terms.assume.frequency_walk, factor);
     },
     [](const Terms& terms) {
       return FrequencyUnits(terms.assume.sample_rate)
           .at_least(terms.assume.frequency_walk->nearest, kShortfallDigits);
     },
     [](const Terms& terms) { return frequency_words(*terms.assume.frequency_walk); },
     [](const Terms& terms) { return frequency_walks(terms.assume); }},
    {"slew", "a slew of at most",
     [](Terms& terms, double factor) { terms.assume.slew = times(terms.assume.slew, factor); },
     [](const Terms& terms) {
       return FrequencyUnits(terms.assume.sample_rate).slew(terms.assume.slew.nearest, kShortfallDigits);
     },
     [](const Terms& terms) { return slew_words(terms.assume.slew); },
     [](const Terms& terms) { return terms.assume.slew.nearest > 0.0; }},
    {kLeakName, "a leak of at most",
     [](Terms& terms, double factor) { terms.leak = times(terms.leak, factor); },
     [](const Terms& terms) { return rounded_down(terms.leak.nearest); },
     [](const Terms& terms) { return terms.leak.text; },
     [](const Terms& terms) { return terms.leak.nearest > 0.0; }},
    {"start error", "starts within", reduce_starts,
     [](const Terms& terms) {
       const Assumptions& assume = terms.assume;
       const FrequencyUnits units(assume.sample_rate);
       return fmt::format("{}, {} rad and {} signal units",
                          units.at_least(assume.initial_frequency_error.nearest, kShortfallDigits),
                          rounded_down(assume.initial_phase_error.nearest),
                          rounded_down(assume.initial_amplitude_error.nearest));
     },
     [](const Terms& terms) {
       const Assumptions& assume = terms.assume;
       return fmt::format("{}, {} and {}", frequency_words(assume.initial_frequency_error),
                          assume.initial_phase_error.text, assume.initial_amplitude_error.text);
     },
     [](const Terms& terms) {
       const Assumptions& assume = terms.assume;
       // An estimate in Gaussian noise does not cover starts.
       return !assume.gaussian &&
              (assume.initial_frequency_error.nearest > 0.0 || assume.initial_phase_error.nearest > 0.0 ||
               assume.initial_amplitude_error.nearest > 0.0);
     }}};

/// The largest factor that works, to within a few per cent; empty when the smallest one tried does not work.
std::optional<double> largest_factor(const std::function<bool(double)>& does) {
  constexpr double kLeast = 1.0 / 256.0;
  constexpr int kBisections = 6;
  if (!does(kLeast)) {
    return std::nullopt;
  }
  double good = kLeast;
  double bad = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double between = std::sqrt(good * bad);
    (does(between) ? good : bad) = between;
  }
  return good;
}

/// "a", "a or b", "a, b or c"; not empty.
std::string joined(const std::vector<std::string>& items) {
  const auto last = items.end() - 1;
  return items.size() == 1 ? *last : fmt::format("{} or {}", fmt::join(items.begin(), last, ", "), *last);
}

}  // namespace

double shortage(const CertifiedValues& found, const Assumptions& assume, const Requirements& require) {
  if (assume.gaussian) {
    return shortage_with_gaussian_noise(found, require);
  }
  double sum = 0.0;
  if (!std::isfinite(found.for_ever)) {
    // Not covered: the distance of the set from the starts, or, without a set, the shortfall in noise and
    // slew.
    sum += 1.0 + missing(found.radius, assume.initial_frequency_error.nearest);
    if (!(found.radius > 0.0)) {
      sum += missing(found.noise, assume.noise.nearest / assume.amplitude.nearest);
      sum += missing(found.slew, assume.slew.nearest);
    }
  }
  if (const auto& wanted = require.frequency_error_below) {
    sum += excess(found.for_ever, wanted->nearest);
  }
  if (const auto& wanted = require.settled_below) {
    sum += excess(found.long_run, wanted->nearest);
    if (found.long_run < wanted->nearest && require.settles_within) {
      sum += missing(require.settles_within->nearest, found.settles);
    }
  }
  if (const auto& wanted = require.largest_noise_at_least) {
    sum += missing(found.noise, wanted->nearest / assume.amplitude.nearest);
  }
  if (const auto& wanted = require.largest_slew_at_least) {
    sum += missing(found.slew, wanted->nearest);
  }
  if (const auto& wanted = require.frequency_error_radius_at_least) {
    sum += missing(found.radius, wanted->nearest);
  }
  return sum;
}

std::vector<std::string> unmet_requirements(const CertifiedValues& found, const Assumptions& assume,
                                            const Requirements& require) {
  std::vector<std::string> sentences;
  const auto add = [&](double amount, const std::string& wanted, const std::string& instead) {
    if (amount > 0.0) {
      sentences.push_back(fmt::format("Required: {}; certified: {}.", wanted, instead));
    }
  };
  const auto value = [&](Objective objective) { return shown(found, objective, assume); };
  if (assume.gaussian) {
    if (!(found.lock_margin >= kEnoughMargin)) {
      sentences.emplace_back(
          "In this noise the search found no set with which a probability of losing lock could be proved.");
    } else if (const auto& wanted = require.rms_frequency_error_below) {
      const bool is_known = std::isfinite(found.rms);
      if (!is_known || excess(found.rms, wanted->nearest) > 0.0) {
        sentences.push_back(fmt::format("Required: a root mean square of {} in lock; estimated: {}.",
                                        frequency_words(*wanted),
                                        is_known ? value(Objective::rms) : std::string("none")));
      }
    }
    return sentences;
  }
  if (!std::isfinite(found.for_ever)) {
    sentences.push_back(fmt::format(
        "No certified set covers the assumed starts, noise and slew together: it reaches {}; at a constant "
        "frequency the noise that is tolerated is {}, without noise the slew {}.",
        value(Objective::radius), value(Objective::noise), value(Objective::slew)));
  }
  if (const auto& wanted = require.frequency_error_below; wanted && std::isfinite(found.for_ever)) {
    add(excess(found.for_ever, wanted->nearest), frequency_words(*wanted) + " for ever",
        value(Objective::for_ever));
  }
  if (const auto& wanted = require.settled_below; wanted && std::isfinite(found.long_run)) {
    const double amount = excess(found.long_run, wanted->nearest);
    add(amount, frequency_words(*wanted) + " once settled", value(Objective::long_run));
    if (!(amount > 0.0) && require.settles_within) {
      add(missing(require.settles_within->nearest, found.settles),
          fmt::format("settled within {} samples", require.settles_within->text),
          std::isfinite(found.settles) ? fmt::format("{:.0f} samples", found.settles)
                                       : std::string("no settling time"));
    }
  }
  if (const auto& wanted = require.largest_noise_at_least) {
    add(missing(found.noise, wanted->nearest / assume.amplitude.nearest),
        fmt::format("noise of {} signal units", wanted->text), value(Objective::noise));
  }
  if (const auto& wanted = require.largest_slew_at_least) {
    add(missing(found.slew, wanted->nearest), "a slew of " + slew_words(*wanted), value(Objective::slew));
  }
  if (const auto& wanted = require.frequency_error_radius_at_least) {
    add(missing(found.radius, wanted->nearest), "a radius of " + frequency_words(*wanted),
        value(Objective::radius));
  }
  return sentences;
}

std::vector<std::string> changes_that_would_do(const CertifiedUnder& certify, const Assumptions& assume,
                                               const Requirements& require, const Number& leak) {
  const Terms given{assume, leak};
  std::vector<std::string> tried;
  std::vector<std::string> alone;
  for (const Reducible& each : kReducible) {
    if (!each.is_there(given)) {
      continue;
    }
    tried.emplace_back(each.name);
    const auto reduced = [&](double factor) {
      Terms less = given;
      each.reduce(less, factor);
      return less;
    };
    const auto does = [&](double factor) {
      const Terms less = reduced(factor);
      return shortage(certify(less.assume, less.leak), less.assume, require) == 0.0;
    };
    const auto factor = largest_factor(does);
    // Without a leak there is another certificate, which may be much better.
    if (!factor && each.name == kLeakName && does(0.0)) {
      alone.push_back(fmt::format("no leak (in place of {})", each.as_written(given)));
    }
    if (factor) {
      alone.push_back(fmt::format("{} {} (in place of {})", each.words, each.shown(reduced(*factor)),
                                  each.as_written(given)));
    }
  }
  if (tried.empty()) {
    return {};
  }
  if (alone.empty()) {
    return {fmt::format("No less {}{} would do for these values, as far as was tried.", joined(tried),
                        tried.size() > 1 ? ", each by itself," : "")};
  }
  return {fmt::format("{} {}.",
                      assume.gaussian
                          ? "As far as can be estimated, with these values everything required could be "
                            "certified with"
                          : "With these values everything required would be certified with",
                      joined(alone))};
}

}  // namespace veritrack::certificates
