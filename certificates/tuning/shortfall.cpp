#include "certificates/tuning/shortfall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/rigor/decimal.hpp"
#include "certificates/sets/frequency_units.hpp"
#include "certificates/tuning/design_values.hpp"

namespace veritrack::certificates {

namespace {

constexpr double kMissing = 20.0;  // of what is not certified at all; larger than any ratio's logarithm
constexpr int kShortfallDigits = 3;

/// 0 when the value is as large as is wanted; else the logarithm of what is missing.
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

/// A number of the assumptions that may be smaller, with its words.
struct Reducible {
  std::string_view words;
  void (*reduce)(Assumptions& assume, double factor);
  std::string (*shown)(const Assumptions& assume);
  std::string (*as_written)(const Assumptions& assume);
  bool (*is_there)(const Assumptions& assume);
};

Number times(const Number& number, double factor) {
  return number_of(number.nearest * factor);
}

/// What is smaller is shown a little too small, so that what is said was certified.
std::string rounded_down(double value) {
  return rigor::to_decimal(value, kShortfallDigits, rigor::Direction::down);
}

void reduce_starts(Assumptions& assume, double factor) {
  for (Number* number :
       {&assume.initial_frequency_error, &assume.initial_phase_error, &assume.initial_amplitude_error}) {
    *number = times(*number, factor);
  }
}

const Reducible kReducible[] = {
    {"noise of at most",
     [](Assumptions& assume, double factor) { assume.noise = times(assume.noise, factor); },
     [](const Assumptions& assume) { return rounded_down(assume.noise.nearest) + " signal units"; },
     [](const Assumptions& assume) { return assume.noise.text; },
     [](const Assumptions& assume) { return assume.noise.nearest > 0.0; }},
    {"a slew of at most",
     [](Assumptions& assume, double factor) { assume.slew = times(assume.slew, factor); },
     [](const Assumptions& assume) {
       return FrequencyUnits(assume.sample_rate).slew(assume.slew.nearest, kShortfallDigits);
     },
     [](const Assumptions& assume) { return slew_words(assume.slew); },
     [](const Assumptions& assume) { return assume.slew.nearest > 0.0; }},
    {"starts within", reduce_starts,
     [](const Assumptions& assume) {
       const FrequencyUnits units(assume.sample_rate);
       return fmt::format("{}, {} rad and {} signal units",
                          units.at_least(assume.initial_frequency_error.nearest, kShortfallDigits),
                          rounded_down(assume.initial_phase_error.nearest),
                          rounded_down(assume.initial_amplitude_error.nearest));
     },
     [](const Assumptions& assume) {
       return fmt::format("{}, {} and {}", frequency_words(assume.initial_frequency_error),
                          assume.initial_phase_error.text, assume.initial_amplitude_error.text);
     },
     [](const Assumptions& assume) {
       return assume.initial_frequency_error.nearest > 0.0 || assume.initial_phase_error.nearest > 0.0 ||
              assume.initial_amplitude_error.nearest > 0.0;
     }}};

/// The largest factor that does, to within a few per cent; none when the least that is tried does not.
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

}  // namespace

double shortage(const CertifiedValues& found, const Assumptions& assume, const Requirements& require) {
  if (assume.gaussian) {
    return shortage_with_gaussian_noise(found, require);
  }
  double sum = 0.0;
  if (!std::isfinite(found.for_ever)) {
    // Not covered: how far the set is from the starts, or, without one, from the noise and the slew.
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
  if (!assume.gaussian && !std::isfinite(found.for_ever)) {
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
                                               const Requirements& require) {
  std::vector<std::string> sentences;
  if (assume.gaussian) {
    return sentences;
  }
  std::vector<std::string> alone;
  for (const Reducible& each : kReducible) {
    if (!each.is_there(assume)) {
      continue;
    }
    const auto reduced = [&](double factor) {
      Assumptions less = assume;
      each.reduce(less, factor);
      return less;
    };
    const auto factor = largest_factor([&](double part) {
      const Assumptions less = reduced(part);
      return shortage(certify(less), less, require) == 0.0;
    });
    if (factor) {
      alone.push_back(fmt::format("{} {} (in place of {})", each.words, each.shown(reduced(*factor)),
                                  each.as_written(assume)));
    }
  }
  if (alone.empty()) {
    sentences.emplace_back(
        "No less noise, slew or start error, each by itself, would do for these values, as far as was "
        "tried.");
    return sentences;
  }
  std::string list = alone.front();
  for (std::size_t i = 1; i < alone.size(); ++i) {
    list += (i + 1 == alone.size() ? ", or " : ", ") + alone[i];
  }
  sentences.push_back("With these values everything required would be certified with " + list + ".");
  return sentences;
}

}  // namespace veritrack::certificates
