#include "certificates/tuning/certified_outcome.hpp"

#include <fmt/format.h>

#include "analysis/rigor/decimal.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::certificates {

std::vector<std::string> certified_in_gaussian_noise(const Certificate& certificate) {
  constexpr int kDigits = 4;
  std::vector<std::string> sentences;
  const auto quantity = [&](const char* derivation, const char* name) -> const theorems::Quantity* {
    const theorems::Derivation* found = find_derivation(certificate, derivation);
    return found == nullptr ? nullptr : theorems::applicable_quantity(*found, name);
  };
  if (const auto* ratio = quantity("lowest-snr", "lowest_snr")) {
    sentences.push_back(
        fmt::format("Certified: the probability of losing lock at a signal-to-noise ratio of at least {} dB.",
                    rigor::upper_decimal(ratio->value, kDigits)));
  } else if (find_derivation(certificate, "lowest-snr") != nullptr) {
    sentences.emplace_back("At no signal-to-noise ratio a probability of losing lock could be certified.");
  }
  if (const auto* rms = quantity("mean-square", "rms_frequency_error")) {
    sentences.push_back(
        fmt::format("Certified: a root mean square of the frequency error in lock of at most {} rad/sample.",
                    rigor::upper_decimal(rms->value, kDigits)));
  }
  return sentences;
}

}  // namespace veritrack::certificates
