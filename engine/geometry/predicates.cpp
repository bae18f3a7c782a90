#include "engine/geometry/predicates.h"

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdlib>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/geometry/filters.h"

namespace ccdt {
namespace {

// Fixed-size integers without allocation. The widest insphere needs 5 * 53 + 7 bits.
__extension__ typedef unsigned __int128 UnsignedInt128;
template <unsigned bits>
using WideInt = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<bits, bits, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

/// Differences from one point as integers, without the trailing zero bits that all of them share. This does not change
/// the sign of a homogeneous determinant.
template <int n>
struct Differences {
  std::array<std::array<std::int64_t, 3>, n> row;
  int bits = 0;  ///< magnitudes are below 2^bits
};

template <int n>
Differences<n> shifted_differences(const std::array<const Point3*, n>& points, const Point3& base) {
  Differences<n> result;
  std::uint64_t low_bits = 0, magnitudes = 0;
  for (int i = 0; i < n; ++i) {
    const Point3& p = *points[i];
    result.row[i] = {static_cast<std::int64_t>(p.x - base.x), static_cast<std::int64_t>(p.y - base.y),
                     static_cast<std::int64_t>(p.z - base.z)};
    for (const std::int64_t v : result.row[i]) {
      low_bits |= static_cast<std::uint64_t>(v);
      magnitudes |= static_cast<std::uint64_t>(v < 0 ? -v : v);
    }
  }
  if (low_bits == 0) return result;
  const int shift = std::countr_zero(low_bits);
  for (auto& row : result.row)
    for (std::int64_t& v : row) v >>= shift;
  result.bits = std::bit_width(magnitudes >> shift);
  return result;
}

/// x = 2^64 * rest(x) + low_digit(x).
constexpr std::uint64_t low_digit(Int128 x) {
  return static_cast<std::uint64_t>(x);
}

constexpr Int128 rest(Int128 x) {
  return x >> 64;  // rounds down
}

/// The cross product of the first two of three rows. `Minor` holds 2 * bits + 1 bits.
template <class Minor>
std::array<Minor, 3> first_minors(const std::array<std::array<std::int64_t, 3>, 3>& m) {
  return {Minor(m[0][1]) * m[1][2] - Minor(m[0][2]) * m[1][1], Minor(m[0][2]) * m[1][0] - Minor(m[0][0]) * m[1][2],
          Minor(m[0][0]) * m[1][1] - Minor(m[0][1]) * m[1][0]};
}

/// Determinant of three rows; `Result` holds 3 * bits + 3 bits.
template <class Minor, class Result>
Result determinant3(const std::array<std::array<std::int64_t, 3>, 3>& m) {
  const auto [x, y, z] = first_minors<Minor>(m);
  return Result(x) * m[2][0] + Result(y) * m[2][1] + Result(z) * m[2][2];
}

/// Its sign for up to 60 bits: products of 128-bit and 64-bit numbers are added up in two digits.
int determinant3_sign_in_digits(const std::array<std::array<std::int64_t, 3>, 3>& m) {
  const std::array<Int128, 3> minor = first_minors<Int128>(m);
  Int128 first = 0, second = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    first += Int128(low_digit(minor[i])) * m[2][i];
    second += rest(minor[i]) * m[2][i];
  }
  second += rest(first);
  if (second != 0) return sign_of(second);
  return low_digit(first) != 0 ? 1 : 0;
}

/// The heights of four rows, that is, their squared lengths, and the volumes that multiply them in the insphere
/// determinant, which is the sum of height[i] * volume[i]. `Minor` holds 2 * bits + 2 bits, `Volume` 3 * bits + 3.
template <class Minor, class Volume>
struct InsphereTerms {
  std::array<Minor, 4> height;
  std::array<Volume, 4> volume;

  explicit InsphereTerms(const std::array<std::array<std::int64_t, 3>, 4>& m) {
    const auto minor = [&](int i, int j) -> Minor {
      return static_cast<Minor>(Minor(m[i][0]) * m[j][1] - Minor(m[j][0]) * m[i][1]);
    };
    const Minor ab = minor(0, 1), bc = minor(1, 2), cd = minor(2, 3), da = minor(3, 0), ac = minor(0, 2),
                bd = minor(1, 3);
    const auto z = [&](int i) { return Volume(m[i][2]); };
    volume = {z(1) * cd - z(2) * bd + z(3) * bc, -(z(2) * da + z(3) * ac + z(0) * cd),
              z(3) * ab + z(0) * bd + z(1) * da, -(z(0) * bc - z(1) * ac + z(2) * ab)};
    for (int i = 0; i < 4; ++i)
      height[i] = Minor(m[i][0]) * m[i][0] + Minor(m[i][1]) * m[i][1] + Minor(m[i][2]) * m[i][2];
  }
};

/// `Result` holds 5 * bits + 7 bits.
template <class Minor, class Volume, class Result>
int insphere_sign(const std::array<std::array<std::int64_t, 3>, 4>& m) {
  const InsphereTerms<Minor, Volume> terms(m);
  Result sum = 0;
  for (int i = 0; i < 4; ++i) sum += Result(terms.height[i]) * terms.volume[i];
  return sign_of(sum);
}

/// Sign of the sum of four products first[i] * second[i] of 62 and 93 bits, added up in two digits. The first factors
/// are not negative.
int sum_sign_in_two_digits(const std::array<std::int64_t, 4>& first, const std::array<Int128, 4>& second) {
  UnsignedInt128 low = 0;  // up to 12 * 2^124: there is no bit left for a sign
  Int128 high = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    low += UnsignedInt128(low_digit(second[i])) * static_cast<std::uint64_t>(first[i]);
    high += rest(second[i]) * first[i];
  }
  high += static_cast<std::uint64_t>(low >> 64);
  if (high != 0) return sign_of(high);
  return static_cast<std::uint64_t>(low) != 0 ? 1 : 0;
}

/// Sign of the sum of up to four products first[i] * second[i] of 123 bits each, added up in three digits of 64.
template <std::size_t n>
int sum_sign_in_digits(const std::array<Int128, n>& first, const std::array<Int128, n>& second) {
  Int128 low = 0, middle = 0, high = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Int128 a = first[i], b = second[i];
    const auto product = static_cast<UnsignedInt128>(low_digit(a)) * low_digit(b);
    low += static_cast<std::uint64_t>(product);
    middle += static_cast<std::uint64_t>(product >> 64);
    middle += Int128(low_digit(a)) * rest(b) + rest(a) * Int128(low_digit(b));
    high += rest(a) * rest(b);
  }
  middle += rest(low);
  high += rest(middle);
  if (high != 0) return sign_of(high);
  return (low_digit(middle) | low_digit(low)) != 0 ? 1 : 0;
}

void count_narrow_evaluation() {
  ++work_done.narrow_evaluations;
  ++work_done.exact_evaluations;
}

void count_wide_evaluation() {
  ++work_done.wide_evaluations;
  ++work_done.exact_evaluations;
}

void count_tie() {
  ++work_done.perturbed_ties;
  ++work_done.exact_evaluations;
}

WideInt<256> signed_volume(const Point3& p, const Point3& q, const Point3& r, const Point3& x) {
  const auto row = [&](const Point3& v) -> std::array<std::int64_t, 3> {
    return {static_cast<std::int64_t>(v.x - p.x), static_cast<std::int64_t>(v.y - p.y),
            static_cast<std::int64_t>(v.z - p.z)};
  };
  return determinant3<WideInt<256>, WideInt<256>>({row(q), row(r), row(x)});
}

/// `orient3d` with x in the place of corner i.
int orient3d_with(std::array<const Point3*, 4> corners, std::size_t i, const Point3& x) {
  corners[i] = &x;
  return orient3d(*corners[0], *corners[1], *corners[2], *corners[3]);
}

/// Calls `coefficient(i)`, the sign of the effect of raising point i, in descending order of ranks, until one is not
/// zero.
template <std::size_t n, class Coefficient>
int first_nonzero(const std::array<std::uint32_t, n>& ranks, const Coefficient& coefficient) {
  std::uint64_t below = std::uint64_t{1} << 32;
  for (std::size_t round = 0; round < n; ++round) {
    std::size_t best = n;
    for (std::size_t i = 0; i < n; ++i)
      if (ranks[i] < below && (best == n || ranks[i] > ranks[best])) best = i;
    if (const int sign = coefficient(best); sign != 0) return sign;
    below = ranks[best];
  }
  return 0;
}

}  // namespace

int orient3d_exactly(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  ++work_done.orient3d_filter_failures;
  const Differences<3> m = shifted_differences<3>({&b, &c, &d}, a);
  if (m.bits <= 41) {
    count_narrow_evaluation();
    return m.bits <= 20 ? sign_of(determinant3<std::int64_t, std::int64_t>(m.row))
                        : sign_of(determinant3<Int128, Int128>(m.row));
  }
  count_wide_evaluation();
  return determinant3_sign_in_digits(m.row);
}

int insphere_exactly(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e) {
  ++work_done.insphere_filter_failures;
  const Differences<4> m = shifted_differences<4>({&a, &b, &c, &d}, e);
  if (m.bits <= 40) {
    count_narrow_evaluation();
    if (m.bits <= 20) return insphere_sign<std::int64_t, std::int64_t, Int128>(m.row);
    if (m.bits <= 24) return insphere_sign<std::int64_t, Int128, Int128>(m.row);
    if (m.bits <= 30) {
      const InsphereTerms<std::int64_t, Int128> terms(m.row);
      return sum_sign_in_two_digits(terms.height, terms.volume);
    }
    const InsphereTerms<Int128, Int128> terms(m.row);
    return sum_sign_in_digits(terms.height, terms.volume);
  }
  count_wide_evaluation();
  if (m.bits <= 49) return insphere_sign<Int128, WideInt<256>, WideInt<256>>(m.row);
  return insphere_sign<Int128, WideInt<512>, WideInt<512>>(m.row);
}

int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  if (const Sign sign = orient3d_filter(a, b, c, d); sign != Sign::unknown) return static_cast<int>(sign);
  return orient3d_exactly(a, b, c, d);
}

int insphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e) {
  if (const Sign sign = insphere_filter(a, b, c, d, e); sign != Sign::unknown) return static_cast<int>(sign);
  return insphere_exactly(a, b, c, d, e);
}

int insphere_perturbed(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e,
                       const std::array<std::uint32_t, 5>& ranks) {
  const int sign = insphere(a, b, c, d, e);
  return sign != 0 ? sign : insphere_tie(a, b, c, d, e, ranks);
}

// Let e = sum of l_i p_i over a, b, c, d. Then e is inside if its height is below the sum of l_i h_i. So the effect of
// raising a corner has the sign of the volume with e in place of that corner, and the effect of raising e has the sign
// of minus the whole volume.
int insphere_tie(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e,
                 const std::array<std::uint32_t, 5>& ranks) {
  count_tie();
  return first_nonzero(ranks, [&](std::size_t i) {
    return i < 4 ? orient3d_with({&a, &b, &c, &d}, i, e) : -orient3d(a, b, c, d);
  });
}

namespace {

/// `incircle` after its filter failed.
int incircle_exactly(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  ++work_done.insphere_filter_failures;
  const Differences<3> m = shifted_differences<3>({&a, &b, &c}, d);
  if (m.bits <= 40)
    count_narrow_evaluation();
  else
    count_wide_evaluation();
  const auto& [p, q, r] = m.row;
  const std::array<std::int64_t, 3> u = {p[0] - r[0], p[1] - r[1], p[2] - r[2]};
  const std::array<std::int64_t, 3> v = {q[0] - r[0], q[1] - r[1], q[2] - r[2]};
  const auto product = [](const auto& s, const auto& t) {
    return Int128(s[0]) * t[0] + Int128(s[1]) * t[1] + Int128(s[2]) * t[2];
  };
  const auto area = [](const auto& s, const auto& t, int i, int j) {
    return Int128(s[i]) * t[j] - Int128(s[j]) * t[i];
  };
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 0)})
    if (const Int128 at_c = area(u, v, i, j); at_c != 0)
      return -sign_of(at_c) * sum_sign_in_digits<2>({{product(u, v), product(p, q)}}, {{area(q, p, i, j), at_c}});
  return 0;
}

}  // namespace

// d is inside when the angles at c and d over the chord ab add up to more than 180 degrees, that is, when the sine of
// the sum is negative: sin(c + d) = sin c cos d + cos c sin d, with dot products for the cosines and signed areas for
// the sines. Since all areas are in one plane, those of a projection along an axis will do.
int incircle(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  if (const Sign sign = incircle_filter(a, b, c, d); sign != Sign::unknown) return static_cast<int>(sign);
  return incircle_exactly(a, b, c, d);
}

int incircle_perturbed(const Point3& a, const Point3& b, const Point3& c, const Point3& apex, const Point3& d,
                       const std::array<std::uint32_t, 4>& ranks) {
  if (const int sign = incircle(a, b, c, d); sign != 0) return sign;
  count_tie();
  return first_nonzero(ranks, [&](std::size_t i) {
    return i < 3 ? orient3d_with({&a, &b, &c, &apex}, i, d) : -orient3d(a, b, c, apex);
  });
}

int orient3d_centroid(const Point3& p, const Point3& q, const Point3& r, const Point3& a, const Point3& b,
                      const Point3& c) {
  if (const Sign sign = orient3d_centroid_filter(p, q, r, a, b, c); sign != Sign::unknown)
    return static_cast<int>(sign);
  ++work_done.centroid_filter_failures;
  const int sa = orient3d(p, q, r, a), sb = orient3d(p, q, r, b), sc = orient3d(p, q, r, c);
  if (sa >= 0 && sb >= 0 && sc >= 0) return sa + sb + sc > 0 ? 1 : 0;
  if (sa <= 0 && sb <= 0 && sc <= 0) return -1;
  count_wide_evaluation();
  const WideInt<256> va = signed_volume(p, q, r, a), vb = signed_volume(p, q, r, b), vc = signed_volume(p, q, r, c);
  // The centroid is moved toward b and, infinitely less, toward c.
  if (const int sign = sign_of(WideInt<256>(va + vb + vc)); sign != 0) return sign;
  if (const int sign = sign_of(WideInt<256>(vb - va)); sign != 0) return sign;
  return sign_of(WideInt<256>(vc - va));
}

bool collinear(const Point3& a, const Point3& b, const Point3& c) {
  const Differences<2> m = shifted_differences<2>({&b, &c}, a);
  const auto parallel = [&](int i, int j) {
    return Int128(m.row[0][i]) * m.row[1][j] == Int128(m.row[0][j]) * m.row[1][i];
  };
  return parallel(0, 1) && parallel(1, 2) && parallel(2, 0);
}

}  // namespace ccdt
