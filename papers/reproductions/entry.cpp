#include "papers/reproductions/entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "certificates/document/markdown_text.hpp"
#include "papers/experiments/repeated_runs.hpp"
#include "papers/reproductions/seed_share.hpp"

namespace veritrack::reports {

namespace {

using experiments::Summary;

constexpr double kErrors = 2.0;
constexpr double kTail = 0.025;          // of the runs, on either side
constexpr double kMeanPrecision = 0.05;  // two standard errors, as a part of the printed number
constexpr double kDeviationPrecision = 0.2;
constexpr std::size_t kEnoughForAll = 100;  // runs

/// Four digits, as the tables print.
std::string number(double value) {
  return fmt::format("{:.4g}", value);
}

/// Whether the share of the runs is above `limit`: by Wilson's interval at two standard errors.
ComesOut is_above(double share, double limit, std::size_t runs) {
  const auto [low, high] = share_interval(share, static_cast<int>(runs));
  return low > limit ? ComesOut::yes : high < limit ? ComesOut::no : ComesOut::undecided;
}

Outcome within_errors(const PrintedNumber& printed, double ours, double error, double printed_error,
                      double precision, double tolerance) {
  const double difference = std::fabs(ours - printed.value());
  const double allowed = kErrors * std::hypot(error, printed_error);
  Outcome outcome{ComesOut::undecided, with_error(ours, error)};
  const double tolerated = tolerance * std::fabs(printed.value());
  if (!std::isfinite(ours) || difference > allowed + tolerated + printed.half_unit()) {
    outcome.comes_out = ComesOut::no;
  } else if (allowed <= precision * std::fabs(printed.value()) ||
             difference + allowed <= tolerated) {  // NaN is neither
    outcome.comes_out = ComesOut::yes;
  }
  return outcome;
}

Entry entry_from(std::string_view id, std::string_view place, std::string_view what, std::string printed,
                 const Outcome& outcome, const Conditions& conditions) {
  Entry entry{std::string(id),
              std::string(place),
              std::string(what),
              std::move(printed),
              outcome.ours,
              EntryVerdict::undecided,
              {}};
  if (outcome.comes_out == ComesOut::yes) {
    entry.verdict = EntryVerdict::agrees;
  } else if (outcome.comes_out == ComesOut::no) {
    entry.because = conditions.unpublished;
    entry.verdict = conditions.kind == Conditions::Kind::chosen ? EntryVerdict::cannot_be_compared
                                                                : EntryVerdict::does_not_agree;
  }
  return entry;
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

std::string with_error(double value, double error) {
  return std::isfinite(error) ? fmt::format("{:.4g} ± {:.2g}", value, error)
                              : fmt::format("{:.4g} ± unknown", value);
}

double PrintedNumber::value() const {
  double result = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw std::invalid_argument(fmt::format("\"{}\" is not a number", text));
  }
  return result;
}

double PrintedNumber::half_unit() const {
  const auto point = text.find('.');
  const auto decimals = point == std::string_view::npos ? 0.0 : static_cast<double>(text.size() - point - 1);
  return 0.5 * std::pow(10.0, -decimals);
}

Outcome among_runs(const PrintedNumber& printed, std::span<const double> runs) {
  const double value = printed.value();
  const double half = printed.half_unit();
  const auto share = [&](auto counts) {
    return static_cast<double>(std::count_if(runs.begin(), runs.end(), counts)) /
           static_cast<double>(runs.size());
  };
  const double above = share([&](double run) { return !(run < value - half); });  // NaN counts as large
  const double below = share([&](double run) { return run <= value + half; });
  const double low = experiments::quantile_of(runs, kTail);
  const double high = experiments::quantile_of(runs, 1.0 - kTail);
  const experiments::Median median = experiments::median_of(runs);
  return {
      is_above(std::min(above, below), kTail, runs.size()),
      fmt::format("{} to {}, median {}", number(low), number(high), with_error(median.value, median.error))};
}

Outcome same_mean(const PrintedNumber& printed, double printed_deviation, int printed_runs,
                  std::span<const double> runs, double tolerance) {
  const Summary summary = experiments::summary_of(runs);
  return within_errors(printed, summary.mean, summary.mean_error,
                       printed_deviation / std::sqrt(static_cast<double>(printed_runs)), kMeanPrecision,
                       tolerance);
}

Outcome same_deviation(const PrintedNumber& printed, int printed_runs, std::span<const double> runs,
                       double tolerance) {
  const Summary summary = experiments::summary_of(runs);
  const double printed_error =
      summary.deviation_error * std::sqrt(static_cast<double>(runs.size()) / printed_runs);
  return within_errors(printed, summary.deviation, summary.deviation_error, printed_error,
                       kDeviationPrecision, tolerance);
}

Outcome same_number(const PrintedNumber& printed, double ours) {
  const bool equal = std::fabs(ours - printed.value()) <= printed.half_unit() * (1.0 + 1e-9);
  return {equal ? ComesOut::yes : ComesOut::no, fmt::format("{:.5g}", ours)};
}

Outcome near_number(const PrintedNumber& printed, double ours, double tolerance) {
  const bool near = std::fabs(ours - printed.value()) <= tolerance * std::fabs(printed.value());
  return {near ? ComesOut::yes : ComesOut::no, fmt::format("{:.5g}", ours)};
}

Outcome share_of_runs(Claimed claimed, const std::vector<bool>& held) {
  const auto count = static_cast<std::size_t>(std::count(held.begin(), held.end(), true));
  const double share = static_cast<double>(count) / static_cast<double>(held.size());
  Outcome outcome;
  outcome.ours =
      count == 0 || count == held.size()
          ? fmt::format("{} of {} runs", count, held.size())
          : fmt::format("{:.1f} ± {:.1f} % of the runs", 100.0 * share,
                        100.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(held.size())));
  if (claimed == Claimed::sometimes || claimed == Claimed::usually) {
    outcome.comes_out = is_above(share, claimed == Claimed::usually ? 0.5 : kTail, held.size());
  } else {
    const std::size_t wanted = claimed == Claimed::always ? held.size() : 0;
    outcome.comes_out = count != wanted                ? ComesOut::no
                        : held.size() >= kEnoughForAll ? ComesOut::yes
                                                       : ComesOut::undecided;
  }
  return outcome;
}

Outcome share_near(double wanted, double allowed, const std::vector<bool>& held) {
  Outcome outcome = share_of_runs(Claimed::usually, held);
  const double share =
      static_cast<double>(std::count(held.begin(), held.end(), true)) / static_cast<double>(held.size());
  const auto [low, high] = share_interval(share, static_cast<int>(held.size()));
  outcome.comes_out = low >= wanted - allowed && high <= wanted + allowed ? ComesOut::yes
                      : high < wanted - allowed || low > wanted + allowed ? ComesOut::no
                                                                          : ComesOut::undecided;
  return outcome;
}

Outcome smaller_mean(std::span<const double> smaller, std::span<const double> larger) {
  if (smaller.size() != larger.size() || smaller.empty()) {
    throw std::invalid_argument("two quantities of the same runs are compared");
  }
  std::vector<double> differences(smaller.size());
  std::transform(larger.begin(), larger.end(), smaller.begin(), differences.begin(),
                 [](double a, double b) { return a - b; });
  const Summary summary = experiments::summary_of(differences);
  Outcome outcome{ComesOut::undecided,
                  fmt::format("{} against {}: difference {}", number(experiments::summary_of(smaller).mean),
                              number(experiments::summary_of(larger).mean),
                              with_error(summary.mean, summary.mean_error))};
  if (summary.mean > kErrors * summary.mean_error) {
    outcome.comes_out = ComesOut::yes;
  } else if (summary.mean < -kErrors * summary.mean_error) {
    outcome.comes_out = ComesOut::no;
  }
  return outcome;
}

Outcome decided(bool comes_out, std::string ours) {
  return {comes_out ? ComesOut::yes : ComesOut::no, std::move(ours)};
}

Entry entry_of(const PrintedNumber& printed, const Outcome& outcome, const Conditions& conditions) {
  return entry_from(printed.id, printed.place, printed.what, std::string(printed.text), outcome, conditions);
}

Entry entry_of(const PrintedSentence& printed, const Outcome& outcome, const Conditions& conditions) {
  return entry_from(printed.id, printed.place, printed.what, "–", outcome, conditions);
}

Entry beside_mean(Entry deviation, const Entry& mean) {
  if (deviation.verdict == EntryVerdict::agrees && mean.verdict == EntryVerdict::cannot_be_compared) {
    deviation.verdict = EntryVerdict::cannot_be_compared;
    deviation.because = "the mean beside it does not come out";
  }
  return deviation;
}

std::string verdict_words(const Entry& entry) {
  switch (entry.verdict) {
    case EntryVerdict::agrees:
      return "**agrees**";
    case EntryVerdict::does_not_agree:
      return "**does not agree**" + (entry.because.empty() ? "" : ", " + entry.because);
    case EntryVerdict::cannot_be_compared:
      return "cannot be compared, because " + entry.because;
    case EntryVerdict::undecided:
      break;
  }
  return "undecided: too few runs";
}

std::string entry_table(std::span<const Entry> entries) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(entries.size());
  for (const Entry& entry : entries) {
    rows.push_back(
        {entry.place, entry.what, entry.printed, entry.ours, verdict_words(entry), "`" + entry.id + "`"});
  }
  return certificates::markdown::table({"Place", "What", "Printed", "Ours", "Verdict", "Id"}, rows);
}

std::string count_sentence(std::span<const Entry> entries, std::string_view fitted) {
  const auto count = [&](EntryVerdict verdict) {
    return static_cast<std::size_t>(std::count_if(
        entries.begin(), entries.end(), [&](const Entry& entry) { return entry.verdict == verdict; }));
  };
  const std::array<std::pair<EntryVerdict, std::pair<const char*, const char*>>, 4> words{
      {{EntryVerdict::agrees, {"agrees", "agree"}},
       {EntryVerdict::does_not_agree, {"does not agree", "do not agree"}},
       {EntryVerdict::cannot_be_compared, {"cannot be compared", "cannot be compared"}},
       {EntryVerdict::undecided, {"is undecided", "are undecided"}}}};
  std::string text;
  for (const auto& [verdict, forms] : words) {
    if (const std::size_t number_of = count(verdict); number_of > 0) {
      const std::string share =
          text.empty() ? fmt::format("{} of {}", number_of, counted(entries.size(), "entry", "entries"))
                       : fmt::format(", {}", number_of);
      text += fmt::format("{} {}", share, number_of == 1 ? forms.first : forms.second);
    }
  }
  return fmt::format("{}{}.", fitted.empty() ? std::string() : fmt::format("With {}, ", fitted), text);
}

std::string too_few_runs(std::span<const Entry> entries, int runs) {
  const auto undecided = std::count_if(entries.begin(), entries.end(), [](const Entry& entry) {
    return entry.verdict == EntryVerdict::undecided;
  });
  return undecided == 0
             ? ""
             : fmt::format(
                   "{} too few for {} of the {} entries: two standard errors do not decide them. More seeds "
                   "would.",
                   counted(static_cast<std::size_t>(runs), "run is", "runs are"), undecided, entries.size());
}

}  // namespace veritrack::reports
