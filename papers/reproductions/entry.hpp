// A printed number or sentence beside our simulation, and the verdict, which is reached only here.
//
// A difference counts from two standard errors on, the half unit of the last printed digit allowed for. An
// entry that this many runs do not decide is undecided, and the report says that more seeds would decide it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::reports {

/// "2.503 ± 0.012"; "± unknown" where the error is not finite.
[[nodiscard]] std::string with_error(double value, double error);

/// A printed number. Tables of them are data, beside their sources.
struct PrintedNumber {
  std::string_view id;     ///< "la-scala-1994/table-3.2/figure-3.4"
  std::string_view place;  ///< paper, section and table or figure, for a reader
  std::string_view what;   ///< the meaning of the number, with its unit
  std::string_view text;   ///< its digits

  [[nodiscard]] double value() const;
  /// Half a unit of the last digit.
  [[nodiscard]] double half_unit() const;
};

/// A sentence, or the claim about a figure, in our words.
struct PrintedSentence {
  std::string_view id;
  std::string_view place;
  std::string_view what;
};

/// Whether the runs reproduce the printed number or sentence, and our number with its error.
enum class ComesOut : std::uint8_t { yes, no, undecided };
struct Outcome {
  ComesOut comes_out = ComesOut::undecided;
  std::string ours;
};

/// A number of one run, against the same number of our runs: it comes out when it lies among them, neither
/// below nor above more than all but 2.5 % of them. Ours: the range of the others, and the median with its
/// standard error (experiments::median_of).
[[nodiscard]] Outcome among_runs(const PrintedNumber& printed, std::span<const double> runs);

/// A mean of `printed_runs` runs with a printed deviation, against the mean of ours. It comes out when the
/// two differ by no more than two standard errors of the difference, and these are at most 5 % of it; or,
/// with a tolerance, when they certainly differ by no more than that part of it.
[[nodiscard]] Outcome same_mean(const PrintedNumber& printed, double printed_deviation, int printed_runs,
                                std::span<const double> runs, double tolerance = 0.0);
/// The same for the deviation over runs, taking that of the printed runs to be as uncertain as ours; two
/// standard errors may be up to 20 % of it.
[[nodiscard]] Outcome same_deviation(const PrintedNumber& printed, int printed_runs,
                                     std::span<const double> runs, double tolerance = 0.0);

/// A number without chance, against ours: equal after rounding.
[[nodiscard]] Outcome same_number(const PrintedNumber& printed, double ours);

/// The same to within a part of it, under conditions that are ours.
[[nodiscard]] Outcome near_number(const PrintedNumber& printed, double ours, double tolerance);

/// For a sentence about an event: in the one run that was printed, so that at least 2.5 % of ours should do
/// it; in more than half of the runs; in all of them; in none.
enum class Claimed : std::uint8_t { sometimes, usually, always, never };
/// `held`: in which of the runs it happened. `always` and `never` come out when no run of at least 100 says
/// otherwise.
[[nodiscard]] Outcome share_of_runs(Claimed claimed, const std::vector<bool>& held);

/// That something happens in a share of the runs, to within `allowed` of it.
[[nodiscard]] Outcome share_near(double wanted, double allowed, const std::vector<bool>& held);

/// That one quantity is smaller than another, both of the same runs: by the mean difference and its standard
/// error. NaN and infinities count as large.
[[nodiscard]] Outcome smaller_mean(std::span<const double> smaller, std::span<const double> larger);

/// A statement that a computation without chance decides; `ours` says what it gave.
[[nodiscard]] Outcome decided(bool comes_out, std::string ours);

/// Under which conditions ours was computed.
struct Conditions {
  enum class Kind : std::uint8_t {
    published,  ///< those of the paper, and its unpublished conditions do not matter
    chosen,     ///< some are unpublished and were chosen by us
    searched    ///< some are unpublished; the outcome is the same for all the choices tried
  };
  Kind kind = Kind::published;
  std::string_view unpublished = {};  ///< what, after "because": "the signal is unpublished"
};

enum class EntryVerdict : std::uint8_t { agrees, does_not_agree, cannot_be_compared, undecided };

/// One row.
struct Entry {
  std::string id, place, what, printed, ours;
  EntryVerdict verdict = EntryVerdict::undecided;
  std::string because;  ///< why it cannot be compared, or for which choices it does not agree
};

/// A reproduced entry agrees, under any conditions. One that is not reproduced does not agree under published
/// conditions, nor when the choices were searched, and cannot be compared when they are ours.
[[nodiscard]] Entry entry_of(const PrintedNumber& printed, const Outcome& outcome,
                             const Conditions& conditions = {});
[[nodiscard]] Entry entry_of(const PrintedSentence& printed, const Outcome& outcome,
                             const Conditions& conditions = {});

/// The row of a deviation over runs, beside that of their mean: one that agrees says nothing for the
/// experiment where the mean cannot be compared, and cannot be compared either.
[[nodiscard]] Entry beside_mean(Entry deviation, const Entry& mean);

/// "agrees", "does not agree", "cannot be compared", "undecided: too few runs", with the reason.
[[nodiscard]] std::string verdict_words(const Entry& entry);

/// The rows as a table in Markdown: place, what, printed, ours, verdict, id.
[[nodiscard]] std::string entry_table(std::span<const Entry> entries);

/// "8 of 12 entries agree, 3 do not agree, 1 cannot be compared." `fitted`: the quantity fitted to the
/// compared numbers themselves, "a signal fitted to this table": then the sentence begins with it.
[[nodiscard]] std::string count_sentence(std::span<const Entry> entries, std::string_view fitted = {});

/// In place of a report's conclusion, when its runs are too few.
inline constexpr const char* kNoConclusion = "So few runs allow no conclusion.\n\n";

/// The questions for which this many runs are too few, a sentence; empty when nothing is undecided.
[[nodiscard]] std::string too_few_runs(std::span<const Entry> entries, int runs);

}  // namespace veritrack::reports
