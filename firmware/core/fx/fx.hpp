/*
 * fx.hpp: Q16.16 as a number type of C++14, for those who would rather write a * b + c than fx_add_sat(fx_mul_sat(..)).
 *
 * pinhole::fixed holds an fx_t and nothing else, so arrays of it are arrays of fx_t. Its operators are those of fx.h:
 * they saturate, and round to nearest, a tie towards +infinity. No floating point is involved, not even in literals:
 * 0.1_fx is the nearest number to 0.1, by integers, when the program is compiled. Functions of fx.h and fx_math.h take
 * x.raw(), and their result becomes a number by from_raw(). Cost: that of the function of fx.h.
 */
#ifndef FX_HPP
#define FX_HPP

#include "fx.h"

#include <type_traits>

namespace pinhole
{

class fixed
{
  public:
    constexpr fixed() : raw_(0)
    {
    }

    /* A whole number of any type; what is not in -32768 .. 32767 saturates. */
    template <typename T, std::enable_if_t<std::is_integral<T>::value, int> = 0>
    constexpr fixed(T whole)
        : raw_(whole > 0 && static_cast<unsigned long long>(whole) > 32767 ? FX_MAX
               : whole < 0 && static_cast<long long>(whole) < -32768       ? FX_MIN
                                                                           : static_cast<fx_t>(whole) * FX_ONE)
    {
    }

    /* Write 0.5_fx: a number with a fraction would lose it here without a word. */
    template <typename T, std::enable_if_t<std::is_floating_point<T>::value, int> = 0> fixed(T) = delete;

    /* A number of so many 1/65536ths. */
    static constexpr fixed from_raw(fx_t raw)
    {
        return fixed(raw, std::true_type());
    }

    constexpr fx_t raw() const
    {
        return raw_;
    }

    /* The whole part: a fraction is dropped, as C++ does it. */
    explicit constexpr operator int() const
    {
        return raw_ / FX_ONE;
    }

    fixed &operator+=(fixed b)
    {
        raw_ = fx_add_sat(raw_, b.raw_);
        return *this;
    }

    fixed &operator-=(fixed b)
    {
        raw_ = fx_sub_sat(raw_, b.raw_);
        return *this;
    }

    fixed &operator*=(fixed b)
    {
        raw_ = fx_mul_sat(raw_, b.raw_);
        return *this;
    }

    /* By 0: FX_MAX, or FX_MIN, as fx_div_sat has it. */
    fixed &operator/=(fixed b)
    {
        raw_ = fx_div_sat(raw_, b.raw_);
        return *this;
    }

    constexpr fixed operator+() const
    {
        return *this;
    }

    constexpr fixed operator-() const
    {
        return from_raw(raw_ == FX_MIN ? FX_MAX : -raw_);
    }

    friend fixed operator+(fixed a, fixed b)
    {
        return a += b;
    }

    friend fixed operator-(fixed a, fixed b)
    {
        return a -= b;
    }

    friend fixed operator*(fixed a, fixed b)
    {
        return a *= b;
    }

    friend fixed operator/(fixed a, fixed b)
    {
        return a /= b;
    }

    friend constexpr bool operator==(fixed a, fixed b)
    {
        return a.raw_ == b.raw_;
    }

    friend constexpr bool operator!=(fixed a, fixed b)
    {
        return a.raw_ != b.raw_;
    }

    friend constexpr bool operator<(fixed a, fixed b)
    {
        return a.raw_ < b.raw_;
    }

    friend constexpr bool operator>(fixed a, fixed b)
    {
        return a.raw_ > b.raw_;
    }

    friend constexpr bool operator<=(fixed a, fixed b)
    {
        return a.raw_ <= b.raw_;
    }

    friend constexpr bool operator>=(fixed a, fixed b)
    {
        return a.raw_ >= b.raw_;
    }

  private:
    constexpr fixed(fx_t raw, std::true_type) : raw_(raw)
    {
    }

    fx_t raw_;
};

/* The raw value of a literal's text: digits, with a point or without. -1: it is none, or 32768 or more. */
template <unsigned size> constexpr fx_t fixed_from_text(const char (&text)[size])
{
    char digits[size] = {};
    unsigned count = 0, at = 0;
    int32_t whole = 0;
    for (; at < size - 1 && text[at] != '.'; at++) {
        if (text[at] == '\'') {
            continue;
        }
        whole = whole * 10 + (text[at] - '0');
        if (text[at] < '0' || text[at] > '9' || whole > 32767) {
            return -1;
        }
    }
    for (at++; at < size - 1; at++) {
        if (text[at] == '\'') {
            continue;
        }
        if (text[at] < '0' || text[at] > '9') {
            return -1;
        }
        digits[count++] = static_cast<char>(text[at] - '0');
    }
    uint32_t fraction = 0; /* in 2^-17: each turn doubles the digits, and takes what comes before the point */
    for (int bit = 0; bit < 17; bit++) {
        int carry = 0;
        for (unsigned i = count; i-- > 0;) {
            const int twice = 2 * digits[i] + carry;
            carry = twice >= 10;
            digits[i] = static_cast<char>(twice - 10 * carry);
        }
        fraction = 2 * fraction + static_cast<uint32_t>(carry);
    }
    const uint32_t raw = static_cast<uint32_t>(whole) * 65536 + ((fraction + 1) >> 1);
    return raw > static_cast<uint32_t>(FX_MAX) ? -1 : static_cast<fx_t>(raw);
}

namespace literals
{

/* 0.1_fx: the nearest number, a tie upwards. Text that is no decimal number below 32768 does not compile. */
template <char... text> constexpr fixed operator""_fx()
{
    constexpr char characters[] = {text..., '\0'};
    constexpr fx_t raw = fixed_from_text(characters);
    static_assert(raw >= 0, "_fx: a decimal number below 32768, as 1.5_fx; without an exponent, not hexadecimal");
    return fixed::from_raw(raw);
}

} // namespace literals
} // namespace pinhole

#endif
