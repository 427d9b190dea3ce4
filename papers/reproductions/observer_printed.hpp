// The captions of Figures 1 to 6 (trackers/kkl_observer/kkl_observer.hpp) and 7 to 9
// (trackers/kkl_observer/adaptive_oscillator_observer.hpp) of the paper of Praly, Marconi and Isidori.
#pragma once

#include <array>

#include "papers/reproductions/entry.hpp"

namespace veritrack::reports::printed {

/// The new observer's estimates, for a disturbance of 10, 100 and 1000 rad/s.
struct EstimateCaption {
  PrintedNumber amplitude_mean, amplitude_deviation;  ///< Figures 1 to 3
  PrintedNumber frequency_mean, frequency_deviation;  ///< Figures 4 to 6
};
inline constexpr std::array<EstimateCaption, 3> kEstimateCaptions{
    {{{"praly/figure-1/mean", "paper, Figure 1", "mean of the amplitude at 10 rad/s, signal units", "1.9999"},
      {"praly/figure-1/deviation", "paper, Figure 1", "its standard deviation", "0.0947"},
      {"praly/figure-4/mean", "paper, Figure 4", "mean of the frequency at 10 rad/s, rad/s", "2.9956"},
      {"praly/figure-4/deviation", "paper, Figure 4", "its standard deviation", "0.1164"}},
     {{"praly/figure-2/mean", "paper, Figure 2", "mean of the amplitude at 100 rad/s, signal units", "2.0"},
      {"praly/figure-2/deviation", "paper, Figure 2", "its standard deviation", "0.0108"},
      {"praly/figure-5/mean", "paper, Figure 5", "mean of the frequency at 100 rad/s, rad/s", "3.0"},
      {"praly/figure-5/deviation", "paper, Figure 5", "its standard deviation", "0.0142"}},
     {{"praly/figure-3/mean", "paper, Figure 3", "mean of the amplitude at 1000 rad/s, signal units", "2.0"},
      {"praly/figure-3/deviation", "paper, Figure 3", "its standard deviation", "0.0011"},
      {"praly/figure-6/mean", "paper, Figure 6", "mean of the frequency at 1000 rad/s, rad/s", "3.0"},
      {"praly/figure-6/deviation", "paper, Figure 6", "its standard deviation", "0.0014"}}}};
inline constexpr PrintedNumber kSectionVEll{"praly/section-v/ell", "paper, section V, Figures 1 to 6",
                                            "ℓ of the observer whose estimates the captions describe", "5"};

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
