#include "reports/quadrature/lock_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "reports/gnuplot.hpp"

namespace veritrack::reports {

namespace {

using certificates::Certificate;

/// What a certified set says.
struct CertifiedLock {
  double decibels = 0.0;
  double probability = 0.0;  ///< within the assumed samples
  double at_once = 0.0;      ///< of it, what does not grow with the samples
};

std::optional<CertifiedLock> certified_lock(const Certificate& certificate, const char* derivation_id,
                                            const std::optional<quadrature::LockSet>& set) {
  const theorems::Derivation* derivation = certificates::find_derivation(certificate, derivation_id);
  if (derivation == nullptr || !set) {
    return std::nullopt;
  }
  const auto* probability = theorems::applicable_quantity(*derivation, "probability_of_losing_lock");
  const auto* level = theorems::applicable_quantity(*derivation, "start_level");
  if (probability == nullptr || level == nullptr) {
    return std::nullopt;
  }
  return CertifiedLock{
      -10.0 * std::log10(2.0 * set->noise_deviation * set->noise_deviation), probability->value.upper(),
      (std::exp(level->value.upper()) + set->drift / (1.0 - set->decay)) * std::exp(-set->level)};
}

/// Everything that is drawn.
struct LockCurves {
  std::optional<CertifiedLock> assumed;
  CertifiedLock lowest;
  const quadrature::LockLoss& simulated;
  std::optional<double> union_bound;  ///< dB
  double samples = 0.0;
  double required = 0.0;  ///< probability within them
};

std::string over_decibels(const LockCurves& curves) {
  const double rate = curves.required / curves.samples;
  const double right = std::max({curves.lowest.decibels, curves.union_bound.value_or(0.0),
                                 curves.assumed ? curves.assumed->decibels : 0.0}) +
                       3.0;
  std::string script = gnuplot_style(420);
  script += "$simulated << END\n";
  for (const quadrature::LossRate& counted : curves.simulated.rates) {
    if (counted.losses > 0) {
      script += fmt::format("{} {:.6g}\n", counted.decibels, counted.rate());
    }
  }
  script += "NaN NaN\nEND\n$certified << END\n";
  script += fmt::format("{0:.6g} 1\n{0:.6g} {1:.6g}\n{2:.6g} {1:.6g}\nEND\n$places << END\n{0:.6g} {1:.6g}\n",
                        curves.lowest.decibels, curves.lowest.probability / curves.samples, right);
  if (curves.assumed) {
    script += fmt::format("{:.6g} {:.6g}\n", curves.assumed->decibels,
                          curves.assumed->probability / curves.samples);
  }
  script += fmt::format(
      "END\nset xlabel 'signal-to-noise ratio, dB'\nset ylabel 'probability of losing lock, per sample'\n"
      "set logscale y\nunset mytics\nset format y '10^{{%L}}'\nset xrange [-4:{:.6g}]\n"
      "set yrange [{:.6g}:1]\nset key maxcols 2\nset samples 1000\n"
      "plot $certified using 1:2 with lines lw 3 lc rgb '#000000' title 'certified', "
      "$places using 1:2 with points pt 7 ps 0.9 lc rgb '#000000' notitle, "
      "$simulated using 1:2 with points pt 6 ps 0.8 lw 1.4 lc rgb '#000000' title 'simulated', ",
      right, 1e-3 * rate);
  if (curves.simulated.law) {
    script += fmt::format(
        "exp({:.9g} + ({:.9g}) * 2 * 10**(x / 10)) with lines lw 1.4 dt '-' lc rgb '#000000' title "
        "'simulated, extrapolated', ",
        curves.simulated.law->intercept, curves.simulated.law->slope);
  }
  if (curves.union_bound) {
    // |v| exceeds V in a sample with exp(-V^2/(2 sigma^2)).
    script += fmt::format(
        "exp(({:.9g}) * 10**((x - ({:.9g})) / 10)) with lines lw 1.8 dt '-.' lc rgb '#666666' title 'union "
        "bound for bounded noise', ",
        std::log(rate), *curves.union_bound);
  }
  script += fmt::format("{:.6g} with lines lw 1 dt '.' lc rgb '#000000' title 'required'\n", rate);
  return run_gnuplot(script);
}

std::string over_sample_numbers(const LockCurves& curves) {
  std::string script = gnuplot_style(400);
  const double last = 1e3 * curves.samples;
  const auto certified = [&](const CertifiedLock& lock, const char* style) {
    return fmt::format("{:.9g} + {:.9g} * x with lines {} title 'certified at {:.4g} dB', ", lock.at_once,
                       (lock.probability - lock.at_once) / curves.samples, style, lock.decibels);
  };
  script += fmt::format(
      "set xlabel 'samples'\nset ylabel 'probability of losing lock'\nset logscale xy\nunset mxtics\n"
      "unset mytics\nset format xy '10^{{%L}}'\nset xrange [1:{:.6g}]\nset yrange [{:.6g}:1]\n"
      "set key maxcols 2\nplot ",
      last, 1e-6 * curves.required);
  if (curves.assumed && std::fabs(curves.assumed->decibels - curves.lowest.decibels) > 0.1) {
    script += certified(*curves.assumed, "lw 5 lc rgb '#bbbbbb'");
  }
  script += certified(curves.lowest, "lw 1.8 lc rgb '#000000'");
  if (curves.simulated.law) {
    for (const double more : {0.0, 1.0}) {
      const double decibels =
          curves.simulated.law->decibels_of(curves.required / curves.samples) - 1.0 + more;
      script += fmt::format(
          "1 - exp(-{:.9g} * x) with lines lw 1.6 dt {} lc rgb '#000000' title 'simulated, extrapolated, at "
          "{:.2g} dB', ",
          curves.simulated.law->rate_at(decibels), more > 0.0 ? "'-'" : "'.'", decibels);
    }
  }
  if (curves.union_bound) {
    script += fmt::format(
        "{:.9g} * x with lines lw 1.8 dt '-.' lc rgb '#666666' title 'union bound at {:.3g} dB', ",
        curves.required / curves.samples, *curves.union_bound);
  }
  script += "NaN notitle\n";
  return run_gnuplot(script);
}

}  // namespace

std::vector<Figure> draw_lock_figures(const Certificate& certificate) {
  const certificates::QuadratureParticulars& particulars = certificates::quadrature_particulars(certificate);
  const auto lowest = certified_lock(certificate, "lowest-snr", particulars.lowest_snr_set);
  if (!lowest || !particulars.lock_loss) {
    return {};
  }
  const certificates::QuadratureEkfTables& tables = certificates::quadrature_tables(certificate.design);
  const auto& required = tables.require.probability_of_losing_lock_below;
  const auto& sets = particulars.lock_sets;
  const LockCurves curves{
      certified_lock(certificate, "lock", sets.empty() ? std::nullopt : std::optional(sets.front())),
      *lowest,
      *particulars.lock_loss,
      particulars.union_bound_snr,
      tables.assume.samples.value().nearest,
      required ? required->nearest : 1e-6};
  return {{"lock-snr.svg",
           "Probability of losing lock per sample (within the assumed samples, divided by their number) over "
           "the signal-to-noise ratio: certified from the lowest ratio on (black; dots where a set is in the "
           "certificate); counted in simulation (circles) and extrapolated with log rate linear in 1/sigma^2 "
           "(dashed), which proves nothing; and what the certificate for bounded noise would give, by the "
           "probability that its noise is exceeded (grey).",
           over_decibels(curves), "Probability of losing lock over the signal-to-noise ratio"},
          {"lock-samples.svg",
           "Probability of losing lock within so many samples, each at a ratio of its own: certified, "
           "simulated and extrapolated, which proves nothing, and by the union bound.",
           over_sample_numbers(curves), "Probability of losing lock within so many samples"}};
}

}  // namespace veritrack::reports
