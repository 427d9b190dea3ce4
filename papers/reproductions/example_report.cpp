#include "papers/reproductions/example_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "certificates/document/markdown_text.hpp"
#include "certificates/document/output_files.hpp"
#include "papers/reproductions/example_linearization.hpp"
#include "papers/reproductions/seed_share.hpp"
#include "reports/gnuplot.hpp"

namespace veritrack::reports {

namespace {

using single_channel::Example;
using single_channel::ExampleRun;
using single_channel::ExampleSetting;
using single_channel::ProcessNoiseReading;
using single_channel::StatementRate;

constexpr double kReproduced =
    0.1;  // of the seeds: a published figure is one run, and need not be the usual one
constexpr std::uint64_t kDrawnSeed = 1;

/// Whether every statement on a start came out often enough, as far as so many seeds can say.
enum class Reproduced { yes, no, undecided };
Reproduced reproduces_all(const std::vector<StatementRate>& rates, int seeds) {
  Reproduced all = Reproduced::yes;
  for (const StatementRate& one : rates) {
    const auto [low, high] = share_interval(one.rate, seeds);
    if (high < kReproduced) {
      return Reproduced::no;
    }
    all = low >= kReproduced ? all : Reproduced::undecided;
  }
  return all;
}

/// The verdict on a reading: that of its best start.
template <typename Member>
Reproduced reproduced_for_some_start(const std::vector<StartRates>& rates, Member member, int seeds) {
  Reproduced best = Reproduced::no;
  for (const StartRates& one : rates) {
    const Reproduced here = reproduces_all(one.*member, seeds);
    best = here == Reproduced::yes || best == Reproduced::yes               ? Reproduced::yes
           : here == Reproduced::undecided || best == Reproduced::undecided ? Reproduced::undecided
                                                                            : Reproduced::no;
  }
  return best;
}

/// "43.5 ± 3.5 %", the standard error of a share of seeds; "0 of 200" where it says nothing.
std::string share_words(double rate, int seeds) {
  if (rate <= 0.0 || rate >= 1.0) {
    return fmt::format("{:.0f} of {}", rate * seeds, seeds);
  }
  return fmt::format("{:.1f} ± {:.1f} %", 100.0 * rate, 100.0 * std::sqrt(rate * (1.0 - rate) / seeds));
}

/// A panel: its title, and the run.
struct Panel {
  std::string title;
  ExampleRun run;
};

/// The runs of the panels; each is an index.
FigureTable table_of(const std::vector<Panel>& panels) {
  FigureTable table("runs", {"panel", "sample", "frequency of the signal [rad/sample]",
                             "estimated frequency [rad/sample]", "estimated quadrature part [signal units]"});
  for (const Panel& panel : panels) {
    for (std::size_t i = 0; i < panel.run.frequency.size(); ++i) {
      table.add({panel.title, static_cast<double>(i + 1), panel.run.true_frequency[i], panel.run.frequency[i],
                 panel.run.quadrature[i]});
    }
    table.next_index();
  }
  return table;
}

std::string preamble(std::size_t panels) {
  return gnuplot_style(60 + 220 * panels) + "set xrange [0:1000]\nset key off\n";
}

/// Panels one above the other: the true frequency broad and grey, the estimate thin and black.
Figure draw_panels(const char* file, const char* title, const std::vector<Panel>& panels) {
  FigureTable table = table_of(panels);
  std::string script = preamble(panels.size()) + table.block();
  script += fmt::format("set multiplot layout {},1\nset yrange [-0.5:3.2]\n", panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i) {
    script += fmt::format(
        "set title '{0}'\nset ylabel 'rad/sample'\n{2}"
        "plot $runs index {1} using 2:3 with lines lw 3 lc rgb '#aaaaaa', '' index {1} using 2:4 with lines "
        "lw 1 lc rgb '#000000'\n",
        panels[i].title, i, i + 1 == panels.size() ? "set xlabel 'sample t'\n" : "");
  }
  return {file, {}, script + "unset multiplot\n", title, {std::move(table)}};
}

/// The estimate of the frequency and of the quadrature part of one run.
Figure draw_failure(const char* file, const char* title, const ExampleRun& run) {
  FigureTable table = table_of({{"near zero", run}});
  std::string script = preamble(2) + table.block();
  script +=
      "set multiplot layout 2,1\nset yrange [-0.5:3.2]\nset title 'frequency'\nset ylabel 'rad/sample'\n"
      "plot $runs using 2:3 with lines lw 3 lc rgb '#aaaaaa', '' using 2:4 with lines lw 1 lc rgb '#000000'\n"
      "set autoscale y\nset title 'estimate of the quadrature part'\nset ylabel 'signal units'\n"
      "set xlabel 'sample t'\nplot $runs using 2:5 with lines lw 1 lc rgb '#000000'\nunset multiplot\n";
  return {file, {}, std::move(script), title, {std::move(table)}};
}

/// How far two runs are apart in frequency, logarithmic.
Figure draw_difference(const char* file, const char* title, const std::vector<Panel>& others,
                       const ExampleRun& run) {
  FigureTable table("differences", {"run", "sample", "difference of the frequency estimates [rad/sample]"});
  for (const Panel& other : others) {
    for (std::size_t t = 0; t < run.frequency.size(); ++t) {
      const double difference = std::fabs(other.run.frequency[t] - run.frequency[t]);
      table.add({other.title, static_cast<double>(t + 1), std::max(difference, 1e-17)});
    }
    table.next_index();
  }
  std::string script = preamble(1) + table.block();
  script +=
      "set key outside top center horizontal\nset logscale y\nset yrange [1e-17:1]\nset xrange [0:300]\n"
      "set format y '10^{%L}'\nset xlabel 'sample t'\nset ylabel 'rad/sample'\nplot ";
  for (std::size_t i = 0; i < others.size(); ++i) {
    script +=
        fmt::format("{}$differences index {} using 2:3 with lines lw 1.4 dt {} lc rgb '#000000' title '{}'",
                    i == 0 ? "" : ", ", i, i + 1, others[i].title);
  }
  return {file, {}, script + "\n", title, {std::move(table)}};
}

std::string rate_table(const std::vector<StartRates>& rates, int seeds) {
  std::vector<std::string> header{"Statement", "Reading of Q"};
  for (const StartRates& one : rates) {
    header.push_back(one.start.words);
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < rates.front().identity.size(); ++i) {
    std::vector<std::string> printed{rates.front().identity[i].statement, "q diag(0, 0, 1)"};
    std::vector<std::string> identity{"", "q diag(1, 1, 1)"};
    for (const StartRates& one : rates) {
      printed.push_back(share_words(one.frequency_only[i].rate, seeds));
      identity.push_back(share_words(one.identity[i].rate, seeds));
    }
    rows.push_back(printed);
    rows.push_back(identity);
  }
  return certificates::markdown::table(header, rows);
}

ExampleSetting drawn(Example example, ProcessNoiseReading reading, double q, double r, double epsilon) {
  return {example, reading, q, r, epsilon, single_channel::example_starts().at(3)};
}

ExampleSetting drawn_example_2(double lambda) {
  return drawn(Example::two, ProcessNoiseReading::identity, 1.0, lambda, 0.0);
}

/// The first seed for which Example 2 comes out as in Figure 3: locked after the jump for lambda = 0 and 1,
/// lost for 10. The first seed of all when there is none.
std::uint64_t seed_of_figure_3(int seeds) {
  const auto zero = single_channel::summarize_runs(drawn_example_2(0.0), seeds);
  const auto one = single_channel::summarize_runs(drawn_example_2(1.0), seeds);
  const auto ten = single_channel::summarize_runs(drawn_example_2(10.0), seeds);
  for (std::size_t i = 0; i < zero.size(); ++i) {
    if (zero[i].first.locked && zero[i].last.locked && one[i].first.locked && one[i].last.locked &&
        ten[i].first.locked && !ten[i].last.locked) {
      return i + 1;
    }
  }
  return kDrawnSeed;
}

std::string document(const std::vector<StartRates>& rates, int seeds, std::uint64_t figure_3_seed) {
  std::string text = "# Which process noise the examples of Bittanti and Savaresi (2000) were run with\n\n";
  text += reading_sentence(rates, seeds) + "\n\n";
  text += fmt::format(
      "The paper prints the process noise covariance as $`q I_3`$ and defines $`I_3`$ as "
      "$`\\mathrm{{diag}}(0, 0, 1)`$. Both readings were simulated over {} noise seeds for each of {} starts "
      "of the tracker, which the paper does not give. A rate is the fraction of the seeds for which a "
      "statement of the text or of a figure was reproduced, ± its standard error. Locked means: over the 100 "
      "samples before the "
      "frequency first changes, or the last 100, the mean error is below 0.35 rad/sample and the deviation "
      "about the mean below 0.5 rad/sample; an estimate that settles at an alias, a multiple of $`2\\pi`$ "
      "away, is not locked. These are simulations in double precision; they prove nothing.\n\n",
      seeds, rates.size());
  text += rate_table(rates, seeds) + "\n" + linearization_section();
  text +=
      "## Figure 2\n\n![Two panels: the estimate over 1000 samples, with and without "
      "leak](figures/figure-2.svg)\n\n"
      "*Example 1 with Q = q diag(1, 1, 1), seed 1, start x = (1, 0, π/6), P = I: frequency of the signal "
      "(broad "
      "grey) and estimate (thin black), rad/sample.*\n\n"
      "## Figure 3\n\n![Three panels: the estimate for lambda = 0, 1 and 10](figures/figure-3.svg)\n\n"
      "*Example 2, the same start and reading, seed " +
      std::to_string(figure_3_seed) +
      ", the first for which all three panels agree with the published ones.*\n\n## Proposition 2 when P(0) "
      "is not scaled\n\n![The difference of the estimates falls below "
      "rounding](figures/start-influence.svg)\n\n*Example 1 without leak, the same start, reading and seed: "
      "difference between the frequency estimates with (q, r) = (0.005, 0.01) and with both multiplied by α, "
      "P(0) = I in all cases; rad/sample, logarithmic, cut off at 1e-17.* The estimates are the same from "
      "the start only if P(0) is also multiplied by α, which is proved. With the same P(0) they differ, and "
      "the difference decays with the influence of the start.\n\n## The tracker that settles near frequency "
      "zero\n\n![The frequency estimate near zero, the quadrature part "
      "large](figures/near-zero.svg)\n\n*Example 1 with Q = q diag(0, 0, 1), ε = 0, the same start.*\n\nOnly "
      "one channel is measured, so the measurements do not bound the other one. Near $`\\hat x_3 = 0`$ the "
      "prediction is $`\\hat x_1 - \\hat x_3 \\hat x_2`$: with a large, nearly constant $`\\hat x_2`$ a "
      "frequency estimate that oscillates slightly about zero, $`\\hat x_3(t) \\approx \\omega \\sin(\\omega "
      "t) / \\hat x_2`$, explains any measured sinusoid of amplitude 1. A model in which noise drives only "
      "the frequency prefers this explanation: the larger $`\\hat x_2`$, the less noise it needs. Process "
      "noise on $`x_1`$ and $`x_2`$ removes that advantage, but a start without a guess of the frequency "
      "still ends there.\n";
  return text;
}

}  // namespace

std::vector<StartRates> simulate_published_examples(int seeds,
                                                    const std::function<void(int, int)>& progress) {
  std::vector<StartRates> rates;
  const std::vector<single_channel::ExampleStart> starts = single_channel::example_starts();
  for (const single_channel::ExampleStart& start : starts) {
    rates.push_back({start,
                     single_channel::statement_rates(ProcessNoiseReading::frequency_only, start, seeds),
                     single_channel::statement_rates(ProcessNoiseReading::identity, start, seeds)});
    if (progress) {
      progress(static_cast<int>(rates.size()), static_cast<int>(starts.size()));
    }
  }
  return rates;
}

std::string too_few_seeds(const std::vector<StartRates>& rates, int seeds) {
  const Reproduced printed = reproduced_for_some_start(rates, &StartRates::frequency_only, seeds);
  const Reproduced identity = reproduced_for_some_start(rates, &StartRates::identity, seeds);
  if (printed != Reproduced::undecided && identity != Reproduced::undecided) {
    return {};
  }
  return fmt::format(
      "{} seeds are too few to say whether Q = q diag({}) can have produced the published figures: two "
      "standard errors do not decide whether every statement is reproduced for at least a tenth of the "
      "seeds. "
      "More seeds would.",
      seeds,
      printed != Reproduced::undecided    ? "1, 1, 1"
      : identity != Reproduced::undecided ? "0, 0, 1"
                                          : "0, 0, 1) or Q = q diag(1, 1, 1");
}

std::string reading_sentence(const std::vector<StartRates>& rates, int seeds) {
  if (std::string undecided = too_few_seeds(rates, seeds); !undecided.empty()) {
    return undecided;
  }
  const Reproduced printed = reproduced_for_some_start(rates, &StartRates::frequency_only, seeds);
  const Reproduced identity = reproduced_for_some_start(rates, &StartRates::identity, seeds);
  const std::string criterion =
      " (for some start every statement is reproduced for at least a tenth of the seeds, two standard errors "
      "included)";
  if (printed == Reproduced::no && identity == Reproduced::no) {
    return "Neither reading reproduces every statement of the examples for any of the starts tried.";
  }
  if (printed == Reproduced::yes && identity == Reproduced::yes) {
    return "Either reading can have produced the published figures" + criterion + ".";
  }
  return fmt::format(
      "Only the reading Q = q diag({}) can have produced the published figures{}: the other one "
      "fails for every start tried.",
      printed == Reproduced::no ? "1, 1, 1" : "0, 0, 1", criterion);
}

WrittenReport write_example_report(int seeds, const std::filesystem::path& directory,
                                   const page::Renderings& renderings, const StartProgress& progress) {
  const auto run = [](const ExampleSetting& setting) { return run_example(setting, kDrawnSeed); };
  const std::uint64_t figure_3_seed = seed_of_figure_3(seeds);
  const auto run_2 = [&](double lambda) { return run_example(drawn_example_2(lambda), figure_3_seed); };
  constexpr auto kIdentity = ProcessNoiseReading::identity;
  const auto scaled = [&](double factor) {
    return run(drawn(Example::one, kIdentity, factor * 0.005, factor * 0.01, 0.0));
  };
  const std::vector<StartRates> rates = simulate_published_examples(seeds, progress);
  page::Document report{"report", document(rates, seeds, figure_3_seed)};
  report.figure_folder = "figures/";
  report.figures = with_pictures(
      {draw_panels("figure-2.svg", "Two panels: the estimate over 1000 samples, with and without leak",
                   {{"(a) ε = 0.05", run(drawn(Example::one, kIdentity, 0.005, 0.01, 0.05))},
                    {"(b) ε = 0", run(drawn(Example::one, kIdentity, 0.005, 0.01, 0.0))}}),
       draw_panels("figure-3.svg", "Three panels: the estimate for lambda = 0, 1 and 10",
                   {{"(a) λ = 0", run_2(0.0)}, {"(b) λ = 1", run_2(1.0)}, {"(c) λ = 10", run_2(10.0)}}),
       draw_failure("near-zero.svg", "The frequency estimate near zero, the quadrature part large",
                    run(drawn(Example::one, ProcessNoiseReading::frequency_only, 0.005, 0.01, 0.0))),
       draw_difference("start-influence.svg", "The difference of the estimates falls below rounding",
                       {{"α = 2", scaled(2.0)}, {"α = 100", scaled(100.0)}}, scaled(1.0))});
  certificates::OutputFiles files;
  stage_document(files, directory, report, renderings);
  files.commit();
  return {directory / "report.md", too_few_seeds(rates, seeds)};
}

}  // namespace veritrack::reports
