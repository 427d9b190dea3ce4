// Tables 4.1 and 4.2 of the thesis (trackers/dft_block/dft_block_ekf.hpp).
#pragma once

#include <array>

#include "papers/experiments/sonar_pass.hpp"
#include "papers/reproductions/entry.hpp"

namespace veritrack::reports::printed {

/// A data set: the noise of Table 4.1, the design and the sums of Table 4.2, and the statements of the text
/// about it.
struct SonarSet {
  double far_decibels;  ///< SNR at the largest range; 10 dB more at the smallest
  double noise_variance;
  experiments::SonarDesign design;
  PrintedNumber power, frequency;
  PrintedSentence start, tracks, unbiased;
};
inline constexpr std::string_view kTable42 = "thesis, Table 4.2";
inline constexpr std::string_view kSection452 = "thesis, section 4.5.2";
inline constexpr std::string_view kSection453 = "thesis, section 4.5.3";
inline constexpr std::array<SonarSet, 3> kSonarSets{
    {{-10.0,
      1.0,
      {0.00005, 0.0010, 0.0025, 12.5},
      {"la-scala-1994/table-4.2/set-1/power", kTable42, "set 1: sum of squared errors of the power, dB²",
       "35.21"},
      {"la-scala-1994/table-4.2/set-1/frequency", kTable42, "set 1: the same of the frequency, bins²",
       "0.0354"},
      {"la-scala-1994/section-4.5.3/start/set-1", kSection453,
       "set 1, −10 dB: in general the initialisation is good enough (within half a bin)"},
      {"la-scala-1994/section-4.5.3/tracks/set-1", kSection453,
       "set 1, −10 to 0 dB: the tracker is accurate (within half a bin at the end)"},
      {"la-scala-1994/section-4.5.2/unbiased/set-1", kSection452,
       "set 1, −10 dB: the initial estimate is unbiased (to a tenth of its deviation, for offsets of 0 to "
       "1.42 bins)"}},
     {-20.0,
      10.0,
      {0.0001, 0.0010, 0.0045, 20.0},
      {"la-scala-1994/table-4.2/set-2/power", kTable42, "set 2: sum of squared errors of the power, dB²",
       "31.91"},
      {"la-scala-1994/table-4.2/set-2/frequency", kTable42, "set 2: the same of the frequency, bins²",
       "0.0327"},
      {"la-scala-1994/section-4.5.3/start/set-2", kSection453,
       "set 2, −20 dB: in general the initialisation is good enough"},
      {"la-scala-1994/section-4.5.3/tracks/set-2", kSection453,
       "set 2, −20 to −10 dB: the tracker is accurate"},
      {"la-scala-1994/section-4.5.2/unbiased/set-2", kSection452,
       "set 2, −20 dB: the initial estimate is unbiased"}},
     {-30.0,
      100.0,
      {0.0001, 0.0010, 0.0100, 125.0},
      {"la-scala-1994/table-4.2/set-3/power", kTable42, "set 3: sum of squared errors of the power, dB²",
       "44.06"},
      {"la-scala-1994/table-4.2/set-3/frequency", kTable42, "set 3: the same of the frequency, bins²",
       "0.0402"},
      {"la-scala-1994/section-4.5.3/start/set-3", kSection453,
       "set 3, −30 dB: in general the initialisation is good enough"},
      {"la-scala-1994/section-4.5.3/tracks/set-3", kSection453,
       "set 3, −30 to −20 dB: the tracker is accurate"},
      {"la-scala-1994/section-4.5.2/unbiased/set-3", kSection452,
       "set 3, −30 dB: the initial estimate is unbiased"}}}};

}  // namespace veritrack::reports::printed
