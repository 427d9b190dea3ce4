#include "certificates/model/markdown_model_lock.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/model/gaussian/gaussian_set.hpp"
#include "analysis/rigor/decimal.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/model/model_sets.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

using rigor::Direction;
using rigor::Interval;
using rigor::to_decimal;

std::vector<std::string> row_of(const char* purpose, const ModelLock& lock, const std::string& snr_db,
                                const FrequencyUnits& units) {
  if (!lock.is_proved()) {
    return {purpose, "not proved", "—", "—", "—", "—"};
  }
  return {purpose,
          snr_db + " dB",
          to_decimal(lock.tubes.gaussian->deviation, 4, Direction::down),
          fmt::format("{}", lock.tubes.tubes.size()),
          units.at_most(lock.frequency_error),
          to_decimal(lock.probability, 4, Direction::up)};
}

/// The probability over the number of samples, for the same starts.
std::string over_samples(const ModelLock& lock, int channels) {
  std::vector<std::vector<std::string>> rows;
  constexpr std::array<double, 5> kSamples{1e3, 1e4, 1e6, 1e8, 1e9};
  for (const double samples : kSamples) {
    const double probability =
        model::leaving_probability(*lock.tubes.gaussian, channels, Interval(samples), lock.start_share);
    rows.push_back({fmt::format("{:.0e}", samples),
                    probability < 1.0 ? to_decimal(probability, 3, Direction::up) : "nothing is known"});
  }
  return markdown::table({"Successive samples", "Probability of losing lock, at most"}, rows);
}

}  // namespace

std::string model_lock_section(const Certificate& certificate) {
  const ModelTables& tables = model_tables(certificate.design);
  const ModelSets& sets = model_sets(certificate);
  if (!tables.assume.gaussian || !sets.gaussian) {
    return "";
  }
  const FrequencyUnits units(tables.assume.sample_rate);
  std::string text =
      "## Gaussian noise: the probability of losing lock\n\nGaussian noise has no bound, so no guarantee is "
      "valid for ever. The tracker is *in lock* while its state is in a certified tube, a set of states "
      "around the one "
      "in "
      "which it settles. In the tube the expectation of a function that is large at its rim hardly grows "
      "from sample to sample; this bounds the probability that the tube is left. The same is true of all "
      "noise that is sub-Gaussian with this deviation: bounded noise of mean zero, for example.\n\n";
  const std::optional<Number>& assumed = tables.assume.gaussian->snr_db;
  std::vector<std::vector<std::string>> rows{
      row_of("the assumed noise", *sets.gaussian, assumed ? assumed->text : sets.gaussian->snr_db, units)};
  if (sets.lowest_snr) {
    rows.push_back(row_of("as much noise as was proved", *sets.lowest_snr, sets.lowest_snr->snr_db, units));
  }
  text += markdown::table({"For", "SNR, at least", "Deviation in each channel, at most, signal units",
                           "Cells of frequencies", "Frequency error in lock, at most",
                           fmt::format("Probability of losing lock within {} samples, at most",
                                       tables.assume.samples.value().text)},
                          rows) +
          "\n";
  for (const ModelLock* lock : {&*sets.gaussian, sets.lowest_snr ? &*sets.lowest_snr : nullptr}) {
    for (const std::string& reason : lock != nullptr ? lock->tubes.reasons : std::vector<std::string>()) {
      text += "- " + markdown::escaped(reason) + "\n";
    }
  }
  if (sets.gaussian->is_proved()) {
    text += "For the assumed noise, within any given number of successive samples, however late:\n\n" +
            over_samples(*sets.gaussian, static_cast<int>(tables.model.samples.size())) + "\n";
  }
  return text;
}

}  // namespace veritrack::certificates
