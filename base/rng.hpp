#pragma once
/// \file
/// Rng: the one source of chance, always an argument. A counter-based stream: the n-th number of a stream is a hash of
/// (key, n), so streams made by `split` are independent and adding a draw in one never shifts another. The same numbers
/// on every machine and compiler; the standard library's distributions are not portable and are not used.

#include <cstdint>

namespace axil {

class Rng {
 public:
  explicit constexpr Rng(std::uint64_t seed) : key_(mix(seed + 0x9E3779B97F4A7C15ull)) {}

  /// The stream that belongs to `a` (and `b`) within this one, wherever this one stands: split(step, module).
  [[nodiscard]] constexpr Rng split(std::uint64_t a, std::uint64_t b = 0) const {
    return Rng(mix(key_ ^ mix(a + 0xD1B54A32D192ED03ull)) ^ mix(b + 0x8CB92BA72F3D8DD7ull));
  }
  /// 64 even random bits.
  constexpr std::uint64_t bits() { return mix(key_ + 0x9E3779B97F4A7C15ull * ++count_); }
  /// Uniform in [0, 1), a multiple of 2^-53.
  constexpr double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  /// Uniform in [low, high).
  constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// An even whole number in [0, count); `count` must be above 0.
  std::uint64_t below(std::uint64_t count);
  /// Normal with the given mean and standard deviation (Box-Muller, one value a call).
  double normal(double mean = 0, double standardDeviation = 1);

 private:
  // The finaliser of splitmix64.
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

}  // namespace axil
