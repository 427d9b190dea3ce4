// The printed numbers of Table 3.2 of the thesis and Table I of the 1996 paper (both under
// trackers/quadrature/quadrature_ekf.hpp).
#pragma once

#include <array>
#include <string_view>

#include "papers/reproductions/entry.hpp"

namespace veritrack::reports::printed {

/// A row of Table 3.2: Q = q I, leak, r, and the sum of squared errors of one run.
struct Table32Row {
  PrintedNumber sum;
  double q, epsilon, r;
};
inline constexpr std::array<Table32Row, 4> kTable32{
    {{{"la-scala-1994/table-3.2/figure-3.2", "thesis, Table 3.2, row (3.2)",
       "sum of squared errors, (rad/sample)²; q = 0.0005, ε = 0.05, r = 0.01", "2.9236"},
      0.0005,
      0.05,
      0.01},
     {{"la-scala-1994/table-3.2/figure-3.3", "thesis, Table 3.2, row (3.3)",
       "the same; q = 0.0065, ε = 0.05, r = 0.01", "1.8317"},
      0.0065,
      0.05,
      0.01},
     {{"la-scala-1994/table-3.2/figure-3.4", "thesis, Table 3.2, row (3.4)",
       "the same; q = 0.0013, ε = 0.01, r = 0.01", "0.3416"},
      0.0013,
      0.01,
      0.01},
     {{"la-scala-1994/table-3.2/figure-3.5", "thesis, Table 3.2, row (3.5)",
       "the same; q = 0.0023, ε = 0.01, r = 0.05", "0.2853"},
      0.0023,
      0.01,
      0.05}}};

inline constexpr PrintedNumber kFigure31Best{"la-scala-1994/figure-3.1/best-q",
                                             "thesis, section 3.7, Figure 3.1",
                                             "q with the smallest sum, at ε = 0.05 and r = 0.01", "0.0065"};
inline constexpr PrintedSentence kFigure31Shape{
    "la-scala-1994/figure-3.1/shape", "thesis, section 3.7, Figure 3.1",
    "too small a q costs more than too large a one: q = 0.0005 more than q = 0.05"};
inline constexpr PrintedSentence kOneTenth{"la-scala-1994/section-3.7/one-tenth",
                                           "thesis, section 3.7; 1996 paper, section V",
                                           "the sum of row (3.5) is less than a tenth of that of row (3.2)"};
inline constexpr PrintedSentence kSameSlew{
    "la-scala-1994/section-3.7/same-slew", "thesis, section 3.7 and (3.12)",
    "rows (3.3) and (3.4) have the same variance of the frequency, q/(1 − (1 − ε)²), to 3 %"};

/// Mean and deviation over 1000 runs.
struct Table1Entry {
  PrintedNumber mean, deviation;
};
/// A signal-to-noise ratio of Table I.
struct Table1Row {
  double decibels;
  Table1Entry notch, best, actual;
};
inline constexpr int kTable1Runs = 1000;
inline constexpr std::string_view kTable1Place = "1996 paper, Table I";
inline constexpr std::array<Table1Row, 4> kTable1{{
    {
        17.0,
        {{"la-scala-bitmead-1996/table-1/notch/17/mean", kTable1Place,
          "notch filter, best, at 17 dB: mean of the sum, (rad/sample)²", "0.4185"},
         {"la-scala-bitmead-1996/table-1/notch/17/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0342"}},
        {{"la-scala-bitmead-1996/table-1/best/17/mean", kTable1Place,
          "EKF, best, at 17 dB: mean of the sum, (rad/sample)²", "0.3252"},
         {"la-scala-bitmead-1996/table-1/best/17/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0255"}},
        {{"la-scala-bitmead-1996/table-1/actual/17/mean", kTable1Place,
          "EKF, actual, at 17 dB: mean of the sum, (rad/sample)²", "2.9740"},
         {"la-scala-bitmead-1996/table-1/actual/17/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0329"}},
    },
    {
        13.0,
        {{"la-scala-bitmead-1996/table-1/notch/13/mean", kTable1Place,
          "notch filter, best, at 13 dB: mean of the sum, (rad/sample)²", "0.4497"},
         {"la-scala-bitmead-1996/table-1/notch/13/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0534"}},
        {{"la-scala-bitmead-1996/table-1/best/13/mean", kTable1Place,
          "EKF, best, at 13 dB: mean of the sum, (rad/sample)²", "0.4493"},
         {"la-scala-bitmead-1996/table-1/best/13/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0290"}},
        {{"la-scala-bitmead-1996/table-1/actual/13/mean", kTable1Place,
          "EKF, actual, at 13 dB: mean of the sum, (rad/sample)²", "3.9001"},
         {"la-scala-bitmead-1996/table-1/actual/13/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0765"}},
    },
    {
        10.0,
        {{"la-scala-bitmead-1996/table-1/notch/10/mean", kTable1Place,
          "notch filter, best, at 10 dB: mean of the sum, (rad/sample)²", "0.5287"},
         {"la-scala-bitmead-1996/table-1/notch/10/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0506"}},
        {{"la-scala-bitmead-1996/table-1/best/10/mean", kTable1Place,
          "EKF, best, at 10 dB: mean of the sum, (rad/sample)²", "0.4904"},
         {"la-scala-bitmead-1996/table-1/best/10/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0374"}},
        {{"la-scala-bitmead-1996/table-1/actual/10/mean", kTable1Place,
          "EKF, actual, at 10 dB: mean of the sum, (rad/sample)²", "4.7783"},
         {"la-scala-bitmead-1996/table-1/actual/10/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.1572"}},
    },
    {
        7.0,
        {{"la-scala-bitmead-1996/table-1/notch/7/mean", kTable1Place,
          "notch filter, best, at 7 dB: mean of the sum, (rad/sample)²", "0.6361"},
         {"la-scala-bitmead-1996/table-1/notch/7/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0908"}},
        {{"la-scala-bitmead-1996/table-1/best/7/mean", kTable1Place,
          "EKF, best, at 7 dB: mean of the sum, (rad/sample)²", "0.7268"},
         {"la-scala-bitmead-1996/table-1/best/7/deviation", kTable1Place,
          "the same: standard deviation over the runs", "0.0517"}},
        {{"la-scala-bitmead-1996/table-1/actual/7/mean", kTable1Place,
          "EKF, actual, at 7 dB: mean of the sum, (rad/sample)²", "25.782"},
         {"la-scala-bitmead-1996/table-1/actual/7/deviation", kTable1Place,
          "the same: standard deviation over the runs", "17.868"}},
    },
}};
inline constexpr PrintedSentence kOwnRegion{"la-scala-bitmead-1996/lemma-1/own-region", "1996 paper, lemma 1",
                                            "lemma 1 for the tracker itself: of random starts fewer do not "
                                            "lock with Q = q2 I than with q1 = q2/10, the "
                                            "four designs together"};
inline constexpr PrintedSentence kEkfFirstAt17{
    "la-scala-bitmead-1996/table-1/order/17", kTable1Place,
    "at 17 dB the best EKF has a smaller mean than the best notch filter"};
inline constexpr PrintedSentence kNotchFirstAt7{
    "la-scala-bitmead-1996/table-1/order/7", kTable1Place,
    "at 7 dB the best notch filter has a smaller mean than the best EKF"};

}  // namespace veritrack::reports::printed
