// The captions of Figures 7 to 9 of the paper (trackers/kkl_observer/adaptive_oscillator_observer.hpp).
#pragma once

#include <array>

#include "reports/reproductions/entry.hpp"

namespace veritrack::reports::printed {

/// For a disturbance of 10, 100 and 1000 rad/s.
struct ObserverCaption {
  PrintedNumber mean, deviation;
  PrintedSentence better;
};
inline constexpr std::array<ObserverCaption, 3> kObserverCaptions{
    {{{"praly/figure-7/mean", "paper, Figure 7", "mean of the frequency at 10 rad/s, rad/s", "2.6677"},
      {"praly/figure-7/deviation", "paper, Figure 7", "its standard deviation", "0.8463"},
      {"praly/section-v/better/10", "paper, section V, Figures 4 and 7",
       "at 10 rad/s the new observer errs less than the adaptive one, tuned to settle as fast"}},
     {{"praly/figure-8/mean", "paper, Figure 8", "mean of the frequency at 100 rad/s, rad/s", "3.7028"},
      {"praly/figure-8/deviation", "paper, Figure 8", "its standard deviation", "1.1004"},
      {"praly/section-v/better/100", "paper, section V, Figures 5 and 8",
       "at 100 rad/s the new observer errs less than the adaptive one, tuned to settle as fast"}},
     {{"praly/figure-9/mean", "paper, Figure 9", "mean of the frequency at 1000 rad/s, rad/s", "2.8141"},
      {"praly/figure-9/deviation", "paper, Figure 9", "its standard deviation", "0.5285"},
      {"praly/section-v/better/1000", "paper, section V, Figures 6 and 9",
       "at 1000 rad/s the new observer errs less than the adaptive one, tuned to settle as fast"}}}};

}  // namespace veritrack::reports::printed
