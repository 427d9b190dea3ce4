// The design file beside a harness.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "certificates/code/compilation.hpp"
#include "certificates/code/harness/new_code.hpp"
#include "trackers/code/listing_run.hpp"

namespace veritrack::certificates::code {

namespace {

constexpr double kTwoPi = 6.283185307179586;

struct Band {
  double low, high;  ///< rad/sample
  std::string why;
};

Band band_of(const NewCode& code, double start) {
  const bool is_known = start > 1e-6 && start < 2.9;
  if (code.samples == 2) {
    // Two channels: bands are wide, and the start is likely in the middle.
    const Band usual{0.01, 0.5, "a guess"};
    return is_known && (start < usual.low || start > usual.high)
               ? Band{start / 2, std::min(1.5 * start, 3.0), "a guess, around the frequency after setup"}
               : usual;
  }
  constexpr double kNarrow = 0.02;
  return is_known
             ? Band{(1 - kNarrow) * start, (1 + kNarrow) * start, "a guess, around the frequency after setup"}
             : Band{0.2, 0.3, "a guess"};
}

std::string number_text(double value) {
  return fmt::format("{:.3g}", value);
}

/// In Hz where the program has a time, in rad/sample otherwise; four digits, as bands may be narrow.
std::string frequency_text_of(const NewCode& code, double value) {
  return fmt::format("{:.4g}", code.sample_rate > 0.0 ? value * code.sample_rate / kTwoPi : value);
}

std::string in_unit(const NewCode& code, const std::string& value) {
  return code.sample_rate > 0.0 ? fmt::format("{{ hz = {} }}", value) : value;
}

std::string quoted_list(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) {
    list += (list.empty() ? "'" : ", '") + text + "'";
  }
  return "[" + list + "]";
}

}  // namespace

std::string new_code_design(const NewCode& code, double start) {
  const Band band = band_of(code, start);
  const double noise = code.samples == 2 ? 0.1 : 0.01;
  const std::string rate =
      code.sample_rate > 0.0
          ? fmt::format("sample_rate = {:.6g} # Hz{}\n", code.sample_rate,
                        code.is_guessed_rate ? ": a guess, the file does not say it; the harness has it, too"
                                             : ", as the file says")
          : std::string("# sample_rate = 10000 # Hz; needed where something is in Hz\n");
  std::string text = fmt::format(
      "# A design for the C code in {0}, which `veritrack new` has written. Check what is a guess, here and "
      "in {1}.\n"
      "#\n"
      "#   veritrack show FILE      the recursion that the code is\n"
      "#   veritrack certify FILE   the certificate\n"
      "#   veritrack explain KEY    what a key means; docs/firmware.md: what is proved of code\n\n"
      "name = \"Code of {0}\"\n"
      "tracker = \"model\"\n"
      "{4}\n\n"
      "[code] # setup, step and frequency; the step is {2}\n"
      "files = {3}\n",
      code.source, code.harness.empty() ? "the file" : code.harness.filename().string(), code.step,
      quoted_list(code.files),
      code.guessed.empty() ? std::string("# source = \"where the numbers come from\"")
                           : fmt::format("source = \"{}: guesses of veritrack new, in {}\"", code.guessed,
                                         code.harness.filename().string()));
  text += code.flags.empty() ? "# flags = ['-DMOTOR=3'] # of your build: -D, -U, -I, -std=\n"
                             : fmt::format("flags = {} # of your build\n", quoted_list(code.flags));
  text += fmt::format(
      "\n[assume] # what you know of the signal; the certificate covers all of it\n"
      "amplitude = 1 # of the samples as the program reads them\n"
      "{}"
      "frequency = {} # lowest and highest{}: {}\n"
      "noise = {} # at most this at every sample, in the unit of the samples: a guess\n"
      "# slew = {{ hz_per_second = 5 }} # how fast the frequency changes; without it, it is constant\n"
      "# start_within = {{ ... }} # how far the start may be from the steady state; without it: any start in "
      "the "
      "certified set\n"
      "# signal = 'A*cos(phi) + 0.03*A*cos(3*phi)' # what the tracker sees; without it, a pure tone\n",
      rate,
      in_unit(code,
              fmt::format("[{}, {}]", frequency_text_of(code, band.low), frequency_text_of(code, band.high))),
      code.sample_rate > 0.0 ? "" : ", rad/sample", band.why, noise);
  constexpr double kShare = 0.05;
  const double bound = kShare * band.high * (code.sample_rate > 0.0 ? code.sample_rate / kTwoPi : 1.0);
  return text + fmt::format(
                    "\n[require] # what must be PROVED; each line is optional\n"
                    "frequency_error_below = {} # at every sample{}: a guess, 5 % of the highest frequency\n"
                    "# bias_below = ...   # without noise: the mean over the phase\n"
                    "# ripple_below = ... # without noise: how much the error varies over the phase\n",
                    in_unit(code, number_text(bound)), code.sample_rate > 0.0 ? "" : ", rad/sample");
}

double start_frequency(const NewCode& code, const std::filesystem::path& design) {
  CodeTable table;
  for (const std::string& file : code.files) {
    table.files.push_back({file, {}});
  }
  for (const std::string& flag : code.flags) {
    table.flags.push_back({flag, {}});
  }
  const CompiledCode program = compiled(table, design);
  const trackers::code::Listing& listing = program.listing;
  std::vector<std::uint64_t> states;
  for (const trackers::code::State& state : listing.states) {
    states.push_back(state.start_bits);
  }
  try {
    const std::vector<std::uint64_t> registers =
        trackers::code::run(listing, states, std::vector<std::uint64_t>(listing.samples.size(), 0));
    const auto frequency = static_cast<std::size_t>(listing.frequency);
    return std::fabs(trackers::code::number_of(listing.instructions[frequency].format, registers[frequency]));
  } catch (const trackers::code::UndefinedOperation&) {
    return 0.0;
  }
}

}  // namespace veritrack::certificates::code
