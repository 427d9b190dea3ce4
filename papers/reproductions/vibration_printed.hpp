// The printed numbers of sections 5.4.1 and 5.4.2 of the thesis
// (trackers/regulator/self_tuning_regulator.hpp).
#pragma once

#include <array>

#include "papers/reproductions/entry.hpp"

namespace veritrack::reports::printed {

inline constexpr std::string_view kSection54 = "thesis, section 5.4";
inline constexpr std::string_view kTable51 = "thesis, Table 5.1";
inline constexpr std::string_view kTable52 = "thesis, Table 5.2";

inline constexpr PrintedNumber kEfraLower{"la-scala-1994/section-5.4/efra/lower", kSection54,
                                          "lower bound of P in EFRA, α = 0.5, β = δ = 0.005, λ = 0.95",
                                          "0.011"};
inline constexpr PrintedNumber kEfraUpper{"la-scala-1994/section-5.4/efra/upper", kSection54,
                                          "upper bound of P in EFRA", "10.1"};

/// Table 5.1: the estimates over rho = 1.1133, numerator and denominator.
inline constexpr std::array<PrintedNumber, 3> kNumerator51{
    {{"la-scala-1994/table-5.1/c1-a1", kTable51, "c1 − a1 of the limit, over ρ", "1.7980"},
     {"la-scala-1994/table-5.1/c2-a2", kTable51, "c2 − a2 of the limit, over ρ", "-1.6164"},
     {"la-scala-1994/table-5.1/c3-a3", kTable51, "c3 − a3 of the limit, over ρ", "0.4802"}}};
inline constexpr std::array<PrintedNumber, 2> kDenominator51{
    {{"la-scala-1994/table-5.1/b1", kTable51, "b1 of the limit, over ρ", "-5.1962"},
     {"la-scala-1994/table-5.1/b2", kTable51, "b2 of the limit, over ρ", "3.0000"}}};
inline constexpr double kLeading51 = 3.0;  // b0 over rho

/// Table 5.2, numerator and denominator.
inline constexpr std::array<PrintedNumber, 10> kTable52Numbers{
    {{"la-scala-1994/table-5.2/c1-a1", kTable52, "c1 − a1 of the limit", "2.2585"},
     {"la-scala-1994/table-5.2/c2-a2", kTable52, "c2 − a2 of the limit", "-1.9837"},
     {"la-scala-1994/table-5.2/c3-a3", kTable52, "c3 − a3 of the limit", "0.4610"},
     {"la-scala-1994/table-5.2/c4-a4", kTable52, "c4 − a4 of the limit", "0.2449"},
     {"la-scala-1994/table-5.2/c5-a5", kTable52, "c5 − a5 of the limit", "-0.0845"},
     {"la-scala-1994/table-5.2/b0", kTable52, "b0 of the limit", "2.9604"},
     {"la-scala-1994/table-5.2/b1", kTable52, "b1 of the limit", "-5.5496"},
     {"la-scala-1994/table-5.2/b2", kTable52, "b2 of the limit", "3.2754"},
     {"la-scala-1994/table-5.2/b3", kTable52, "b3 of the limit", "0.2984"},
     {"la-scala-1994/table-5.2/b4", kTable52, "b4 of the limit", "-0.4159"}}};

inline constexpr std::string_view kSection542 = "thesis, section 5.4.2";
inline constexpr std::array<PrintedNumber, 4> kPoles52{
    {{"la-scala-1994/section-5.4.2/pole/1", kSection542, "a pole of the limit of Table 5.2", "-3.2232"},
     {"la-scala-1994/section-5.4.2/pole/2", kSection542, "another pole of it", "2.2085"},
     {"la-scala-1994/section-5.4.2/pole/3/real", kSection542, "the real part of its pair of poles", "0.8660"},
     {"la-scala-1994/section-5.4.2/pole/3/imaginary", kSection542, "the imaginary part of that pair",
      "0.5"}}};

inline constexpr std::string_view kSection541 = "thesis, section 5.4.1";
inline constexpr PrintedSentence kEfraPoles{"la-scala-1994/section-5.4.1/efra-poles", kSection541,
                                            "EFRA: the poles are 0.8660 ± 0.5000j after 250 samples"};
inline constexpr PrintedSentence kMonitoredPoles{
    "la-scala-1994/section-5.4.1/bnm-poles", kSection541,
    "condition number monitoring: the poles are 0.8660 ± 0.5000j after 10000 samples (one run)"};
inline constexpr PrintedSentence kMonitoredSlow{
    "la-scala-1994/section-5.4.1/bnm-slow", kSection541,
    "EFRA is closer to the vibration's pole after 250 samples than monitoring"};
inline constexpr PrintedSentence kDenominatorMultiple{
    "la-scala-1994/section-5.4.1/denominator", kSection541,
    "the denominator of the limit is a multiple of the ideal one"};
inline constexpr PrintedSentence kNumeratorNoMultiple{
    "la-scala-1994/section-5.4.1/numerator", kSection541,
    "its numerator is not (to 1 %) that multiple of the ideal one"};
inline constexpr PrintedSentence kMatch51{
    "la-scala-1994/figures-5.6-5.7/match", "thesis, Figures 5.6 and 5.7",
    "at ω the limit of Table 5.1 matches the ideal controller: the same numerator there, over the same pole"};
inline constexpr PrintedSentence kMatch52{
    "la-scala-1994/figures-5.10-5.11/match", "thesis, Figures 5.10 and 5.11",
    "at ω the limit of Table 5.2 matches the ideal controller: the same residue at the common pole"};
inline constexpr PrintedSentence kOutput52{
    "la-scala-1994/figure-5.9/output", "thesis, Figure 5.9",
    "order 5: the output is driven to zero (below 0.01 after 500 samples)"};
inline constexpr PrintedSentence kSurplus52{
    "la-scala-1994/figure-5.8/surplus", "thesis, section 5.4.2 and Figure 5.8",
    "order 5: the four surplus parameters do not vanish (one is above 0.01 in size)"};
inline constexpr PrintedSentence kStableLimit{"la-scala-1994/section-5.3.2/stable-limit",
                                              "thesis, section 5.3.2, Consistency",
                                              "the regulator converges to a controller that regulates the "
                                              "plant: the loop with the limit, held constant, "
                                              "is stable (order 3)"};
inline constexpr PrintedSentence kStableLimit5{
    "la-scala-1994/section-5.3.2/stable-limit-5", "thesis, section 5.3.2, Consistency",
    "the same for the order 5, where the controller has the vibration's pole"};
inline constexpr PrintedSentence kSameLimit{"la-scala-1994/section-5.4/same-limit", "thesis, section 5.4",
                                            "EFRA and condition number monitoring lead to the same "
                                            "controller (to 1 %, where both have the vibration's "
                                            "pole)"};
inline constexpr PrintedSentence kPole52{"la-scala-1994/section-5.4.2/vibration-pole", kSection542,
                                         "order 5: the limit has the vibration's pole"};

}  // namespace veritrack::reports::printed
