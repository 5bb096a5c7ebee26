#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "conchoid/core/wide_clones.hpp"

/// Four numbers at a time, with the functions that the closed forms need; the compiler makes of them what the
/// processor has. Arguments are references, as vectors of this width have no calling convention on older
/// processors.
namespace conchoid {

constexpr int lanes = 4;
typedef double Lanes __attribute__((vector_size(lanes * sizeof(double)), may_alias));
typedef std::int64_t IntLanes __attribute__((vector_size(lanes * sizeof(double)), may_alias));

inline double sum_lanes(const double (&s)[lanes]) {
  return (s[0] + s[1]) + (s[2] + s[3]);
}

CONCHOID_INTO_CLONES void take_root(Lanes& x) {
  for (int l = 0; l < lanes; ++l)
    x[l] = std::sqrt(x[l]);
}

CONCHOID_INTO_CLONES void take_absolute(Lanes& x) {
  x = (Lanes)((IntLanes)x & 0x7fffffffffffffffLL);
}

/// x + c₃ x³ + c₅ x⁵ …, both for artanh (all 1/k) and arctan (alternating).
template <bool alternating>
CONCHOID_INTO_CLONES void odd_series(Lanes& x) {
  const Lanes square = alternating ? -x * x : x * x;
  Lanes sum = square * (1.0 / 21) + 1.0 / 19;
  sum = sum * square + 1.0 / 17;
  sum = sum * square + 1.0 / 15;
  sum = sum * square + 1.0 / 13;
  sum = sum * square + 1.0 / 11;
  sum = sum * square + 1.0 / 9;
  sum = sum * square + 1.0 / 7;
  sum = sum * square + 1.0 / 5;
  sum = sum * square + 1.0 / 3;
  x += x * (square * sum);
}

/// result = log(numerator/denominator), or 2 artanh(small/large) in the lanes of `near_one`: there the ratio is
/// so near 1 that it is better said by its distance from 1, and small/large ≤ 0.17. All positive and normal.
/// log(a/b) = 2 artanh((a−b)/(a+b)) + k log 2 with b scaled by 2ᵏ to within √2 of a: |argument| ≤ 0.172, where
/// eleven terms are exact to rounding.
CONCHOID_INTO_CLONES void log_of_ratio(const Lanes& numerator, const Lanes& denominator,
                                       const IntLanes& near_one, const Lanes& small, const Lanes& large,
                                       Lanes& result) {
  constexpr std::int64_t mantissa = 0x000fffffffffffffLL, one = 0x3ff0000000000000LL;
  const IntLanes up = (IntLanes)numerator, down = (IntLanes)denominator;
  Lanes a = (Lanes)((up & mantissa) | one), b = (Lanes)((down & mantissa) | one);
  // A small integer as a double: added to the bits of 1.5·2⁵².
  Lanes power = (Lanes)((up >> 52) - (down >> 52) + 0x4338000000000000LL) - 6755399441055744.0;
  const IntLanes high = (IntLanes)(a > std::numbers::sqrt2 * b),
                 low = (IntLanes)(b > std::numbers::sqrt2 * a);
  b = high ? b + b : b;
  a = low ? a + a : a;
  power = high ? power + 1 : low ? power - 1 : power;
  Lanes w = (near_one ? small : a - b) / (near_one ? large : a + b);
  odd_series<false>(w);
  result = near_one ? 2 * w : 2 * w + power * std::numbers::ln2;
}

/// result = atan2(y, x), 0 at the origin. The angle is turned back by 0, π/8 or π/4, so that |tan| ≤ tan(π/16)
/// = 0.199, where eleven terms are exact to rounding.
CONCHOID_INTO_CLONES void angle_of(const Lanes& y, const Lanes& x, Lanes& result) {
  constexpr double pi = std::numbers::pi, tan_pi_16 = 0.19891236737965800691,
                   tan_pi_8 = 0.41421356237309504880, tan_3_pi_16 = 0.66817863791929891999;
  Lanes across = y, along = x;
  take_absolute(across);
  take_absolute(along);
  const IntLanes steep = (IntLanes)(across > along);
  const Lanes larger = steep ? across : along, smaller = steep ? along : across;
  const IntLanes far = (IntLanes)(smaller > tan_3_pi_16 * larger);
  const IntLanes middle = (IntLanes)(smaller > tan_pi_16 * larger);
  const Lanes zero = {};
  const Lanes slope = far ? zero + 1.0 : middle ? zero + tan_pi_8 : zero;
  Lanes angle = far ? zero + pi / 4 : middle ? zero + pi / 8 : zero;
  Lanes t = (smaller - slope * larger) / (larger + slope * smaller);
  t = larger > 0 ? t : zero;
  odd_series<true>(t);
  angle += t;
  angle = steep ? pi / 2 - angle : angle;
  angle = x < 0 ? pi - angle : angle;
  result = (Lanes)((IntLanes)angle | ((IntLanes)y & INT64_MIN));
}

}  // namespace conchoid
