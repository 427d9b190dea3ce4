// What a design file of a block tracker may say, and what it is told otherwise.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "certificates/design/design_reader.hpp"
#include "certificates/design/input_error.hpp"
#include "certificates/dft_block/dft_block_design.hpp"
#include "certificates/dft_block/dft_block_track.hpp"

namespace {

using namespace veritrack;

constexpr const char* kText = R"(name = "a block tracker"
tracker = "dft-block-ekf"
[design]
q1 = 5e-5
q2 = 1e-3
q3 = 2.5e-3
r = 0.003
[assume]
offset = [0.2, 0.4]
noise = 0.001
initial_amplitude_error = 0.001
initial_phase_error = 0.01
initial_offset_error = 0.002
)";

std::string with(std::vector<std::pair<std::string, std::string>> replacements) {
  std::string text = kText;
  for (const auto& [from, to] : replacements) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string message_of(const std::string& text) {
  try {
    (void)certificates::read_design(text, "design.toml");
  } catch (const certificates::InputError& error) {
    return error.what();
  }
  return "";
}

bool holds(const std::string& text, const char* words) {
  const std::string message = message_of(text);
  CAPTURE(message);
  CHECK(message.find(words) != std::string::npos);
  return message.find(words) != std::string::npos;
}

const std::pair<std::string, std::string> kGaussian{"noise = 0.001", "noise = { snr_db = 6 }\nblocks = 1000"};
const std::pair<std::string, std::string> kLength{"r = 0.003", "r = 0.003\nblock_length = 64"};

}  // namespace

TEST_CASE("keys that are read") {
  CHECK(message_of(kText).empty());
  CHECK(message_of(with({kGaussian, kLength})).empty());
  CHECK(message_of(with({{"noise = 0.001", "noise = { bound = 0.001 }"}})).empty());
}

TEST_CASE("malformed keys are refused with what is allowed") {
  holds(with({{"offset = [0.2, 0.4]", "offset = [0.4, 0.2]"}}), "two numbers of bins from -8 to 8");
  holds(with({{"offset = [0.2, 0.4]", "offset = [0.2, 9]"}}), "two numbers of bins from -8 to 8");
  holds(with({{"r = 0.003", "r = 0"}}), "a number above 0");
  holds(with({{"r = 0.003", "r = 0.003\nhalf_width = 9"}}), "a whole number from 1 to 8");
  holds(with({{"r = 0.003", "r = 0.003\nblock_length = 6"}}), "a whole number of samples from 7 to 1e9");
  holds(with({{"r = 0.003", "r = 0.003\nblock_length = 64.5"}}), "a whole number of samples from 7 to 1e9");
  holds(with({{"r = 0.003", "r = 0.003\ncentre = 5"}}), "centre without block_length");
  holds(with({{"noise = 0.001", "noise = { snr = 6 }"}}), "snr_db");
  holds(with({{"noise = 0.001", "noise = { snr_db = 6 }\nblocks = 0"}, kLength}), "a number from 1 to 1e15");
}

TEST_CASE("keys that do not go together") {
  holds(with({{"noise = 0.001", "noise = { snr_db = 6 }"}, kLength}), "Gaussian noise without blocks");
  holds(with({{"noise = 0.001", "noise = 0.001\nblocks = 5"}}), "blocks with a bound on the noise");
  holds(with({kGaussian}), "no block_length with Gaussian noise");
  holds(with({kGaussian,
              kLength,
              {"offset =", "amplitude = [1, 2]\ninitial_covariance = [[1,0,0],[0,1,0],[0,0,1]]\noffset ="}}),
        "with a range of amplitudes");
  const std::string bound = "\n[require]\noffset_error_below = 0.1\n";
  holds(with({kGaussian, kLength}) + bound, "which has no bound");
  holds(kText + std::string("\n[require]\nprobability_of_losing_lock_below = 0.1\n"),
        "with a bound on the noise");
  holds(with({kGaussian, kLength}) + "\n[require]\nprobability_of_losing_lock_below = 1\n",
        "a number above 0 and below 1");
}

TEST_CASE("bins are where white noise is independent from bin to bin") {
  const auto with_bins = [](const std::string& bins) {
    return with({{"r = 0.003", "r = 0.003\n" + bins}, kGaussian});
  };
  CHECK(message_of(with_bins("block_length = 11")).empty());
  CHECK(message_of(with_bins("block_length = 7\nhalf_width = 1")).empty());
  CHECK(message_of(with_bins("block_length = 64\ncentre = 3")).empty());
  CHECK(message_of(with_bins("block_length = 64\ncentre = 29")).empty());
  CHECK(message_of(with_bins("block_length = 63\ncentre = 29")).empty());
  holds(with_bins("block_length = 10"), "block_length > 4 half_width + 2");
  for (const char* centre : {"2", "30", "32", "1000000"}) {
    holds(with_bins("block_length = 64\ncentre = " + std::string(centre)),
          "half_width < centre < block_length/2 - half_width");
  }
  holds(with_bins("block_length = 62\ncentre = 29"), "are not all between 1 and half of block_length = 62");
  holds(with({{"r = 0.003", "r = 0.003\nblock_length = 64\ncentre = 2"}}),
        "M - L ... M + L, 2 - 2 ... 2 + 2,");
}

TEST_CASE("a recording needs blocks and a centre") {
  const auto refused = [](const std::string& text) {
    try {
      (void)certificates::track_dft_block(certificates::read_design(text, "design.toml"));
    } catch (const certificates::NotTrackable& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refused(kText).find("block_length = ... and centre = ...") != std::string::npos);
  CHECK(refused(with({{"r = 0.003", "r = 0.003\nblock_length = 64\ncentre = 10"}})).empty());
}
