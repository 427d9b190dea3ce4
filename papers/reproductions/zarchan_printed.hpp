// The statements of the slides (trackers/zarchan/zarchan_ekf.hpp), in our words, each with its experiment.
#pragma once

#include <array>
#include <cstdint>

#include "papers/experiments/zarchan_runs.hpp"
#include "papers/reproductions/entry.hpp"

namespace veritrack::reports::printed {

/// The observed quantity of a run.
enum class ZarchanLook : std::uint8_t {
  frequency,           ///< the frequency (or its square) is right in the last 5 s
  frequency_fails,     ///< it is not
  amplitude,           ///< the amplitude of filter 1 is right in the last 5 s
  amplitude_fails,     ///< it is not
  wrong_sign,          ///< the frequency is right except for its sign
  signal,              ///< x is right in the last 5 s
  derivative,          ///< its derivative is
  after_five_seconds,  ///< the square of the frequency is right from 5 s on
  theory_1,
  theory_2,
  theory_3  ///< the error of a state at 20 s is within the deviation computed
};

struct ZarchanSentence {
  PrintedSentence sentence;
  experiments::ZarchanExperiment experiment;
  ZarchanLook look;
  Claimed claimed;
};

inline constexpr auto kF1 = experiments::ZarchanFilter::phase;
inline constexpr auto kF2 = experiments::ZarchanFilter::known_amplitude;
inline constexpr auto kF3 = experiments::ZarchanFilter::oscillator;
inline constexpr auto kF4 = experiments::ZarchanFilter::squared_frequency;
inline constexpr double kReduced = 0.1;         // signal units
inline constexpr double kProcessNoise = 0.001;  // the best for the filter of the values tried
inline constexpr std::string_view kSlides1 = "slides, initial formulation";
inline constexpr std::string_view kSlides2 = "slides, two-state filter";
inline constexpr std::string_view kSlides3 = "slides, alternate filter";
inline constexpr std::string_view kSlides4 = "slides, another filter (z = ω²)";

inline constexpr std::array kZarchan{
    ZarchanSentence{{"zarchan/phase/positive-from-positive/frequency", kSlides1, "ω = 1 is found from ω̂ = 2"},
                    {kF1, 1.0, 2.0},
                    ZarchanLook::frequency,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/phase/positive-from-positive/amplitude", kSlides1, "and so is the amplitude"},
                    {kF1, 1.0, 2.0},
                    ZarchanLook::amplitude,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/phase/negative-from-positive/frequency", kSlides1,
                     "ω = −1 is not found from ω̂ = 2 (one run)"},
                    {kF1, -1.0, 2.0},
                    ZarchanLook::frequency_fails,
                    Claimed::sometimes},
    ZarchanSentence{{"zarchan/phase/negative-from-positive/amplitude", kSlides1,
                     "and neither is the amplitude (one run)"},
                    {kF1, -1.0, 2.0},
                    ZarchanLook::amplitude_fails,
                    Claimed::sometimes},
    ZarchanSentence{
        {"zarchan/phase/negative-from-negative/frequency", kSlides1, "ω = −1 is found from ω̂ = −2"},
        {kF1, -1.0, -2.0},
        ZarchanLook::frequency,
        Claimed::usually},
    ZarchanSentence{{"zarchan/phase/negative-from-negative/amplitude", kSlides1, "and so is the amplitude"},
                    {kF1, -1.0, -2.0},
                    ZarchanLook::amplitude,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/phase/positive-from-negative/frequency", kSlides1,
                     "ω = 1 is found from ω̂ = −2, as a title says"},
                    {kF1, 1.0, -2.0},
                    ZarchanLook::frequency,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/phase/positive-from-negative/amplitude", kSlides1,
                     "the amplitude is then not found (one run)"},
                    {kF1, 1.0, -2.0},
                    ZarchanLook::amplitude_fails,
                    Claimed::sometimes},
    ZarchanSentence{{"zarchan/phase/only-with-the-right-sign", kSlides1,
                     "the filter only works when the first sign is right: it never finds ω = −1 from ω̂ = 2"},
                    {kF1, -1.0, 2.0},
                    ZarchanLook::frequency,
                    Claimed::never},
    ZarchanSentence{{"zarchan/phase/process-noise/frequency", kSlides1,
                     "process noise does not let it find the frequency (one run; ω = 1 from ω̂ = −2)"},
                    {kF1, 1.0, -2.0, 1.0, kProcessNoise},
                    ZarchanLook::frequency_fails,
                    Claimed::sometimes},
    ZarchanSentence{{"zarchan/phase/process-noise/amplitude", kSlides1, "nor the amplitude (one run)"},
                    {kF1, 1.0, -2.0, 1.0, kProcessNoise},
                    ZarchanLook::amplitude_fails,
                    Claimed::sometimes},
    ZarchanSentence{{"zarchan/phase/reduced-noise/frequency", kSlides1,
                     "a tenth of the noise does not let it find the frequency (ω = 1 from ω̂ = −2)"},
                    {kF1, 1.0, -2.0, kReduced},
                    ZarchanLook::frequency_fails,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/phase/reduced-noise/amplitude", kSlides1, "nor the amplitude"},
                    {kF1, 1.0, -2.0, kReduced},
                    ZarchanLook::amplitude_fails,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/phase/printed-interval", "slides, first listing",
                     "the first result comes out with the interval printed there, TS = 1 s"},
                    {kF1, 1.0, 2.0, 1.0, 0.0, 1.0},
                    ZarchanLook::frequency,
                    Claimed::usually},

    ZarchanSentence{{"zarchan/known-amplitude/positive-from-positive", kSlides2, "ω = 1 is found from ω̂ = 2"},
                    {kF2, 1.0, 2.0},
                    ZarchanLook::frequency,
                    Claimed::usually},
    ZarchanSentence{
        {"zarchan/known-amplitude/negative-from-positive", kSlides2, "ω = −1 is found from ω̂ = 2"},
        {kF2, -1.0, 2.0},
        ZarchanLook::frequency,
        Claimed::usually},
    ZarchanSentence{
        {"zarchan/known-amplitude/negative-from-negative", kSlides2, "ω = −1 is found from ω̂ = −2"},
        {kF2, -1.0, -2.0},
        ZarchanLook::frequency,
        Claimed::usually},
    ZarchanSentence{
        {"zarchan/known-amplitude/positive-from-negative", kSlides2, "ω = 1 is found from ω̂ = −2"},
        {kF2, 1.0, -2.0},
        ZarchanLook::frequency,
        Claimed::usually},
    ZarchanSentence{
        {"zarchan/known-amplitude/not-all-the-time", kSlides2, "ω = −1 is not found from ω̂ = 2 in every run"},
        {kF2, -1.0, 2.0},
        ZarchanLook::frequency_fails,
        Claimed::sometimes},
    ZarchanSentence{{"zarchan/known-amplitude/reduced-noise", kSlides2,
                     "with a tenth of the noise it is found all the time"},
                    {kF2, -1.0, 2.0, kReduced},
                    ZarchanLook::frequency,
                    Claimed::always},
    ZarchanSentence{
        {"zarchan/known-amplitude/theory", kSlides2, "then the error of the frequency agrees with theory"},
        {kF2, -1.0, 2.0, kReduced},
        ZarchanLook::theory_2,
        Claimed::usually},
    ZarchanSentence{{"zarchan/known-amplitude/printed-interval", "slides, second listing",
                     "ω = −1 is found from ω̂ = 2 with the interval printed there, TS = 1 s"},
                    {kF2, -1.0, 2.0, 1.0, 0.0, 1.0},
                    ZarchanLook::frequency,
                    Claimed::usually},

    ZarchanSentence{{"zarchan/oscillator/signal", kSlides3, "x is estimated well (ω = 1 from ω̂ = 2)"},
                    {kF3, 1.0, 2.0},
                    ZarchanLook::signal,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/oscillator/derivative", kSlides3, "so is its derivative"},
                    {kF3, 1.0, 2.0},
                    ZarchanLook::derivative,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/oscillator/positive-from-positive", kSlides3, "ω = 1 is found from ω̂ = 2"},
                    {kF3, 1.0, 2.0},
                    ZarchanLook::frequency,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/oscillator/negative-from-negative", kSlides3, "ω = −1 is found from ω̂ = −2"},
                    {kF3, -1.0, -2.0},
                    ZarchanLook::frequency,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/oscillator/negative-from-positive", kSlides3,
                     "of ω = −1 from ω̂ = 2 the magnitude is found, not the sign"},
                    {kF3, -1.0, 2.0},
                    ZarchanLook::wrong_sign,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/oscillator/positive-from-negative", kSlides3,
                     "of ω = 1 from ω̂ = −2 the magnitude is found, not the sign"},
                    {kF3, 1.0, -2.0},
                    ZarchanLook::wrong_sign,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/oscillator/wrong-sign/signal", kSlides3, "even then x is estimated"},
                    {kF3, -1.0, 2.0},
                    ZarchanLook::signal,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/oscillator/wrong-sign/derivative", kSlides3, "and so is its derivative"},
                    {kF3, -1.0, 2.0},
                    ZarchanLook::derivative,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/oscillator/theory/x", kSlides3, "the error of x agrees with theory"},
                    {kF3, 1.0, 2.0},
                    ZarchanLook::theory_1,
                    Claimed::usually},
    ZarchanSentence{
        {"zarchan/oscillator/theory/derivative", kSlides3, "the error of its derivative agrees with theory"},
        {kF3, 1.0, 2.0},
        ZarchanLook::theory_2,
        Claimed::usually},
    ZarchanSentence{
        {"zarchan/oscillator/theory/frequency", kSlides3, "the error of the frequency agrees with theory"},
        {kF3, 1.0, 2.0},
        ZarchanLook::theory_3,
        Claimed::usually},

    ZarchanSentence{{"zarchan/square/signal", kSlides4, "x is estimated quite well (ω = 1 from ω̂ = 2)"},
                    {kF4, 1.0, 2.0},
                    ZarchanLook::signal,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/square/derivative", kSlides4, "so is its derivative"},
                    {kF4, 1.0, 2.0},
                    ZarchanLook::derivative,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/square/frequency", kSlides4, "ω² is found"},
                    {kF4, 1.0, 2.0},
                    ZarchanLook::frequency,
                    Claimed::usually},
    ZarchanSentence{{"zarchan/square/after-five-seconds", kSlides4, "ω² is found after 5 s (one run)"},
                    {kF4, 1.0, 2.0},
                    ZarchanLook::after_five_seconds,
                    Claimed::sometimes},
    ZarchanSentence{{"zarchan/square/theory/x", kSlides4, "the error of x agrees with theory"},
                    {kF4, 1.0, 2.0},
                    ZarchanLook::theory_1,
                    Claimed::usually},
    ZarchanSentence{
        {"zarchan/square/theory/derivative", kSlides4, "the error of its derivative agrees with theory"},
        {kF4, 1.0, 2.0},
        ZarchanLook::theory_2,
        Claimed::usually},
    ZarchanSentence{{"zarchan/square/theory/square", kSlides4, "the error of ω² agrees with theory"},
                    {kF4, 1.0, 2.0},
                    ZarchanLook::theory_3,
                    Claimed::usually},
};

}  // namespace veritrack::reports::printed
