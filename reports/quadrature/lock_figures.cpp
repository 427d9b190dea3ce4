#include "reports/quadrature/lock_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_particulars.hpp"
#include "reports/gnuplot.hpp"

namespace veritrack::reports {

namespace {

using certificates::Certificate;

/// The statement of a certified set.
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

/// A figure: what draws it, and its numbers.
struct Drawn {
  std::string script;
  std::vector<FigureTable> data;
};

Drawn over_decibels(const LockCurves& curves) {
  const double rate = curves.required / curves.samples;
  const double right = std::max({curves.lowest.decibels, curves.union_bound.value_or(0.0),
                                 curves.assumed ? curves.assumed->decibels : 0.0}) +
                       3.0;
  std::string script = gnuplot_style(420);
  const std::vector<std::string> columns{"signal-to-noise ratio [dB]",
                                         "probability of losing lock [per sample]"};
  FigureTable simulated("simulated", columns);
  for (const quadrature::LossRate& counted : curves.simulated.rates) {
    if (counted.losses > 0) {
      simulated.add({counted.decibels, counted.rate()});
    }
  }
  const double certified_rate = curves.lowest.probability / curves.samples;
  FigureTable certified("certified", columns);
  certified.add({curves.lowest.decibels, 1.0});
  certified.add({curves.lowest.decibels, certified_rate});
  certified.add({right, certified_rate});
  FigureTable places("places", columns);
  places.add({curves.lowest.decibels, certified_rate});
  if (curves.assumed) {
    places.add({curves.assumed->decibels, curves.assumed->probability / curves.samples});
  }
  FigureTable curve("curves", {"signal-to-noise ratio [dB]", "simulated, extrapolated [per sample]",
                               "union bound for bounded noise [per sample]"});
  constexpr int kPlaces = 400;
  constexpr double kLeft = -4.0;
  for (int i = 0; i <= kPlaces; ++i) {
    const double x = kLeft + (right - kLeft) * i / kPlaces;
    const auto& law = curves.simulated.law;
    // |v| exceeds V in a sample with exp(-V^2/(2 sigma^2)).
    curve.add({x, law ? std::exp(law->intercept + law->slope * 2.0 * std::pow(10.0, x / 10.0)) : std::nan(""),
               curves.union_bound
                   ? std::exp(std::log(rate) * std::pow(10.0, (x - *curves.union_bound) / 10.0))
                   : std::nan("")});
  }
  script += simulated.block() + certified.block() + places.block() + curve.block();
  script += fmt::format(
      "set xlabel 'signal-to-noise ratio, dB'\nset ylabel 'probability of losing lock, per sample'\n"
      "set logscale y\nunset mytics\nset format y '10^{{%L}}'\nset xrange [-4:{:.6g}]\n"
      "set yrange [{:.6g}:1]\nset key maxcols 2\n"
      "plot $certified using 1:2 with lines lw 3 lc rgb '#000000' title 'certified', "
      "$places using 1:2 with points pt 7 ps 0.9 lc rgb '#000000' notitle, "
      "$simulated using 1:2 with points pt 6 ps 0.8 lw 1.4 lc rgb '#000000' title 'simulated', ",
      right, 1e-3 * rate);
  if (curves.simulated.law) {
    script += "$curves using 1:2 with lines lw 1.4 dt '-' lc rgb '#000000' title 'simulated, extrapolated', ";
  }
  if (curves.union_bound) {
    script +=
        "$curves using 1:3 with lines lw 1.8 dt '-.' lc rgb '#666666' title 'union bound for bounded "
        "noise', ";
  }
  script += fmt::format("{:.6g} with lines lw 1 dt '.' lc rgb '#000000' title 'required'\n", rate);
  return {std::move(script),
          {std::move(simulated), std::move(certified), std::move(places), std::move(curve)}};
}

/// A probability over the number of samples.
struct Growth {
  std::string title, style;
  std::function<double(double samples)> probability;
};

std::vector<Growth> growths(const LockCurves& curves) {
  std::vector<Growth> all;
  const auto add_certified = [&](const CertifiedLock& lock, const char* style) {
    const double rate = (lock.probability - lock.at_once) / curves.samples;
    all.push_back({fmt::format("certified at {:.4g} dB", lock.decibels), style,
                   [=](double samples) { return lock.at_once + rate * samples; }});
  };
  if (curves.assumed && std::fabs(curves.assumed->decibels - curves.lowest.decibels) > 0.1) {
    add_certified(*curves.assumed, "lw 5 lc rgb '#bbbbbb'");
  }
  add_certified(curves.lowest, "lw 1.8 lc rgb '#000000'");
  const double required_rate = curves.required / curves.samples;
  if (curves.simulated.law) {
    for (const double more : {0.0, 1.0}) {
      const double decibels = curves.simulated.law->decibels_of(required_rate) - 1.0 + more;
      const double rate = curves.simulated.law->rate_at(decibels);
      all.push_back({fmt::format("simulated, extrapolated, at {:.2g} dB", decibels),
                     fmt::format("lw 1.6 dt {} lc rgb '#000000'", more > 0.0 ? "'-'" : "'.'"),
                     [=](double samples) { return -std::expm1(-rate * samples); }});
    }
  }
  if (curves.union_bound) {
    all.push_back({fmt::format("union bound at {:.3g} dB", *curves.union_bound),
                   "lw 1.8 dt '-.' lc rgb '#666666'",
                   [=](double samples) { return required_rate * samples; }});
  }
  return all;
}

Drawn over_sample_numbers(const LockCurves& curves) {
  const double last = 1e3 * curves.samples;
  const std::vector<Growth> all = growths(curves);
  std::vector<std::string> columns{"samples"};
  std::string plot = "plot ";
  for (std::size_t i = 0; i < all.size(); ++i) {
    columns.push_back(all[i].title + " [probability]");
    plot += fmt::format("{}$growth using 1:{} with lines {} title '{}'", i == 0 ? "" : ", ", i + 2,
                        all[i].style, all[i].title);
  }
  FigureTable table("growth", std::move(columns));
  constexpr int kPlaces = 200;
  for (int i = 0; i <= kPlaces; ++i) {
    const double samples = std::pow(last, static_cast<double>(i) / kPlaces);
    std::vector<FigureTable::Cell> row{samples};
    for (const Growth& one : all) {
      row.emplace_back(one.probability(samples));
    }
    table.add(std::move(row));
  }
  std::string script =
      gnuplot_style(400) + table.block() +
      fmt::format(
          "set xlabel 'samples'\nset ylabel 'probability of losing lock'\nset logscale xy\nunset mxtics\n"
          "unset mytics\nset format xy '10^{{%L}}'\nset xrange [1:{:.6g}]\nset yrange [{:.6g}:1]\n"
          "set key maxcols 2\n{}\n",
          last, 1e-6 * curves.required, plot);
  return {std::move(script), {std::move(table)}};
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
  Drawn decibels = over_decibels(curves);
  Drawn samples = over_sample_numbers(curves);
  return {{"lock-snr.svg",
           "Probability of losing lock per sample (within the assumed samples, divided by their number) over "
           "the signal-to-noise ratio: certified from the lowest ratio on (black; dots where a set is in the "
           "certificate); counted in simulation (circles) and extrapolated with log rate linear in 1/sigma^2 "
           "(dashed), which proves nothing; and what the certificate for bounded noise would give, by the "
           "probability that its noise is exceeded (grey).",
           std::move(decibels.script), "Probability of losing lock over the signal-to-noise ratio",
           std::move(decibels.data)},
          {"lock-samples.svg",
           "Probability of losing lock within a number of samples, each at a ratio of its own: certified, "
           "simulated and extrapolated, which proves nothing, and by the union bound.",
           std::move(samples.script), "Probability of losing lock within a number of samples",
           std::move(samples.data)}};
}

}  // namespace veritrack::reports
